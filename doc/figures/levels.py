# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the guide: one brick under the same load at each level of deformation, as StaticEquilibrium of the library finds it.

    build/yade -n -x -j1 doc/figures/levels.py [--out DIR]

A cube stands in mortar on the ground; a stiff block presses on half of its top. Displacements are drawn 60 times too large. Below each
picture is how far the block goes down and turns. A rigid brick does not deform: what it moves by is in the springs of its joints, which have its compliance.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import drawing
import numpy as np

import yade_brick

side, thickness, load, scale = .2, .002, 400, 60  # [m], [m], [N], [-]
levels = {
        "rigid": dict(deformation="rigid"),
        "uniform": dict(deformation="uniform"),
        "trilinear": dict(deformation="trilinear", element="incompatible"),
        "refined, 4 cells": dict(deformation="refined", element="incompatible", cells=4)
}


def loaded(options):
	"""The brick under its load, and the block."""
	O.reset()
	strong = Mortar(tensileStrength=1e12, cohesion=1e12, frictionAngle=.5, compressiveStrength=1e12)
	clay = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.5, mortar=strong)
	steel = BrickMat(young=9.8e9, poisson=.25, density=1800, frictionAngle=.5, mortar=strong)
	O.bodies.append(wall(0, axis=2, sense=1, material=clay))
	cube = yade_brick.brick((side, side, side), center=(0, 0, side / 2), material=clay, inner="full", contactThickness=thickness, segments=8, **options)
	block = yade_brick.brick((side / 2, side, side / 4), center=(side / 4, 0, 1.125 * side), material=steel, deformation="rigid", segments=8)
	O.bodies.append([cube, block])
	O.engines = yade_brick.engines(gravity=None)
	MortarJoints()()
	O.forces.setPermF(block.id, (0, 0, -load))
	StaticEquilibrium(gravity=(0, 0, 0))()
	return cube, block


def gridOfFront(cells):
	"""Indices (cells + 1, cells + 1) of the nodes on the front, y = -side/2, by z and x, in the order of Brick.displacement."""
	n, index = cells + 1, {}
	corners = [(0, 0, 0), (cells, 0, 0), (cells, cells, 0), (0, cells, 0), (0, 0, cells), (cells, 0, cells), (cells, cells, cells), (0, cells, cells)]
	rest = [(i, j, k) for k in range(n) for j in range(n) for i in range(n) if {0, cells} & {i, j, k} and (i, j, k) not in corners]
	for place, node in enumerate(corners + rest):
		index[node] = place
	return np.array([[index[i, 0, k] for i in range(n)] for k in range(n)])


def front(body):
	"""Nodes of the front of a brick (z, x, 2) at rest and displaced, drawn with `scale` [m]."""
	shape, state = body.shape, body.state
	cells = shape.cells if shape.deformation == "refined" else 1
	place = np.linspace(-.5, .5, cells + 1) * side
	rest = np.array([[(x, z + side / 2) for x in place] for z in place])
	moved = np.array([[tuple(state.ori * Vector3(x, -side / 2, z)) for x in place] for z in place])
	if shape.deformation != "rigid":
		axes = np.array(state.ori.toRotationMatrix()).reshape(3, 3)
		moved = moved + (np.array([tuple(u) for u in shape.displacement]) @ axes.T)[gridOfFront(cells)]
	moved = moved + np.array(tuple(state.pos))
	return rest, rest + scale * (moved[:, :, [0, 2]] - rest)


def main():
	figure = drawing.figure(9, 3.1)
	for ax, (name, options) in zip(figure.subplots(1, len(levels)), levels.items()):
		cube, block = loaded(options)
		rest, shown = front(cube)
		outline = np.vstack([shown[0], shown[1:, -1], shown[-1, -2::-1], shown[-2::-1, 0]])
		ax.fill(*outline.T, color=drawing.brick, lw=0)
		for lines in (shown, shown.transpose(1, 0, 2)):
			for place, line in enumerate(lines):
				ax.plot(*line.T, color=drawing.edge, lw=1.4 if place in (0, len(lines) - 1) else .6)
		ax.plot(*shown.reshape(-1, 2).T, "o", ms=3, color=drawing.edge)
		ax.plot(*rest[[0, 0, -1, -1, 0], [0, -1, -1, 0, 0]].T, "--", color="#777777", lw=.8)
		drop = block.state.pos - Vector3(side / 4, 0, 1.125 * side)
		corners = np.array([tuple(c) for c in block.shape.worldCorners(block.state)])[[0, 1, 5, 4]][:, [0, 2]]
		restCorners = np.array([(0, side), (side / 2, side), (side / 2, 1.25 * side), (0, 1.25 * side)])
		ax.fill(*(restCorners + scale * (corners - restCorners)).T, color="#9aa4ad", lw=0)
		ax.annotate("", (side / 4, 1.2 * side), (side / 4, 1.5 * side), arrowprops=dict(arrowstyle="-|>", color=drawing.ink))
		ax.plot([-.16, .16], [0, 0], color=drawing.ink, lw=2)
		ax.set(aspect="equal", xlim=(-.16, .16), ylim=(-.02, .31), title=name)
		ax.text(0, -.045, f"block goes down {-1e3 * drop[2]:.2f} mm,\nturns {1e3 * abs(2 * block.state.ori[1]):.1f} mrad", ha="center", va="top", fontsize=9)
		ax.axis("off")
	drawing.save(figure, "levels", __doc__.splitlines()[0])


main()
