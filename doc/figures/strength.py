# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the guide: the strength of mortar in the plane of normal and shear stress, found by driving one joint in YADE until it fails.

    build/yade -n -x -j1 doc/figures/strength.py [--out DIR]

Two rigid bricks with one segment between them; the upper one is moved along a straight path, in steps of 1/500 of what eqs. (6)-(8) allow,
until the segment fails. What it carried last is a point, what it failed in its colour. The script fails when a point
is farther from the equations than two steps.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import drawing
import numpy as np

import yade_brick

tension, cohesion, angle, compression, Cs = 4.6e3, 2.9e3, math.radians(32), 4.9e5, 9.0  # the paper's mortar, Table 3; Cs is ours
steps = 500
modes = {1: ("tension, f1", "#0b6fa4"), 2: ("shear, f2", "#c8500a"), 3: ("compression, f3", "#6a0dad")}


def joint():
	"""Two rigid bricks in mortar; returns the upper one's body and their interaction."""
	O.reset()
	mortar = Mortar(tensileStrength=tension, cohesion=cohesion, frictionAngle=angle, compressiveStrength=compression, Cs=Cs)
	clay = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=angle, mortar=mortar)
	lower = yade_brick.brick((.2, .2, .2), material=clay, deformation="rigid", segments=1, fixed=True)
	upper = yade_brick.brick((.2, .2, .2), center=(0, 0, .2), material=clay, deformation="rigid", segments=1)
	O.bodies.append([lower, upper])
	loop = yade_brick.engines(gravity=None, dt=1e-6, contact=False, guard=False)
	loop.remove(loop.newton)  # it is moved by hand
	O.engines = loop
	MortarJoints()()
	O.step()
	return upper, O.interactions[0, 1]


def carried(interaction):
	"""Normal and shear stress of the segment [Pa]."""
	return interaction.phys.normalStress(interaction.geom)[0], interaction.phys.shearStress(interaction.geom)[0].norm()


def stiffness():
	"""Normal and shear stress for 1 m of displacement [Pa/m], as the joint shows it."""
	upper, interaction = joint()
	upper.state.pos = (1e-7, 0, .2 + 1e-7)
	O.step()
	return [stress / 1e-7 for stress in carried(interaction)]


def allowed(direction):
	"""By what factor a stress (normal, shear) may be multiplied until the first of eqs. (6)-(8) is met."""
	sigma, tau = direction
	factors = [tension / sigma] if sigma > 0 else [compression / math.hypot(sigma, math.sqrt(Cs) * tau)]
	rise = tau + sigma * math.tan(angle)
	return min(factors + ([cohesion / rise] if rise > 0 else []))


def failure(direction, springs):
	"""What the segment carried last on its way along a direction of stress [Pa], and in which mode it failed."""
	upper, interaction = joint()
	sigma, tau = (stress * allowed(direction) / spring / steps for stress, spring in zip(direction, springs))
	for step in range(1, 2 * steps):
		last = carried(interaction)
		upper.state.pos = (step * tau, 0, .2 + step * sigma)
		O.step()
		state = O.interactions[0, 1].phys.segmentState[0]
		if state:
			return last, state
	raise RuntimeError(f"along {direction} nothing has failed at twice the strength")


def main():
	springs = stiffness()
	# directions that share out the three branches: by the ends that they have on them
	ends = [(tension, 0), (tension, .5 * (cohesion - tension * math.tan(angle)))]
	ends += [(s, cohesion - s * math.tan(angle)) for s in np.concatenate([np.linspace(.85 * tension, 0, 5), -np.linspace(.004, .44, 11) * compression])]
	ends += [(-compression * math.cos(a), compression * math.sin(a) / math.sqrt(Cs)) for a in np.linspace(0, 1.02, 9)]
	found = [failure(end, springs) for end in ends]
	for (sigma, tau), _ in found:
		assert 1 - 2 / steps <= 1 / allowed((sigma, tau)) <= 1, (sigma, tau)

	figure = drawing.figure(9, 3.4)
	whole, near = figure.subplots(1, 2, width_ratios=(1.6, 1))
	draw(whole, found, (-500, 15), (0, 215))
	draw(near, found, (-8, 6), (0, 9))
	near.set_title("near the origin", fontsize=10)
	near.annotate("cohesion c", (0, cohesion / 1e3), (.6, 2.9), color=modes[2][1])
	near.annotate("$f_t$", (tension / 1e3, 0), (4.9, .35), color=modes[1][1])
	near.annotate("slope tan $\\phi$", (0, 0), (-4.6, 6.4), color=modes[2][1])
	whole.annotate("$f_m$", (0, 0), (-482, 6), color=modes[3][1])
	whole.legend(frameon=False, loc="upper left", fontsize=9, bbox_to_anchor=(0, 1.05))
	drawing.save(figure, "strength", __doc__.splitlines()[0])


def draw(ax, found, sigmaRange, tauRange):
	"""Equations as a line, what was found as points, within these ranges [kPa]."""
	normal = np.append(np.linspace(-compression, tension, 4000), tension)
	limit = np.minimum(cohesion - normal * math.tan(angle), np.where(normal < 0, np.sqrt(np.maximum(compression**2 - normal**2, 0) / Cs), np.inf))
	limit[-1] = 0  # f1
	ax.fill_between(normal / 1e3, limit / 1e3, color="#eeeae4", lw=0)
	ax.plot(normal / 1e3, limit / 1e3, color=drawing.ink, lw=1, label="eqs. (6)-(8)")
	ax.axvline(0, color="#bbbbbb", lw=.6)
	for state, (name, color) in reversed(modes.items()):
		points = np.array([point for point, mode in found if mode == state]) / 1e3
		points = points[points[:, 0] >= sigmaRange[0]]
		if len(points):
			ax.plot(points[:, 0], points[:, 1], "o", ms=5, color=color, label=f"failed in {name}", clip_on=False, zorder=3 + 1 / state)
	ax.set(xlim=sigmaRange, ylim=tauRange, xlabel="normal stress $\\sigma$ [kPa], tension positive", ylabel="shear stress $|\\tau|$ [kPa]")


main()
