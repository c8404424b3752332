# SPDX-License-Identifier: GPL-2.0-or-later
"""What the builders lay: walls in stack, running, English and Flemish bond with a window, a corner, a junction, a pier and a column, under their own weight.

    build/yade -n -x examples/08_bonds_and_openings.py [--deformation rigid|uniform|trilinear] [--out DIR]

Bricks are 250 x 125 x 75 mm, mortar included: they touch, and MortarJoints finds where. Each specimen stands alone in a scene: its joints are counted, statics
finds its rest, and 200 steps of the engine loop have to leave it there.

        +---+---+---+---+              stack and running bond: one brick thick as it is wide; in running bond each course is half a brick off the one below
        +-+---+---+---+-+              English bond: a course of headers, with a queen closer (half a header) beside the quoin, then a course of stretchers
        +---+=======+---+  lintel      Flemish bond: header and stretcher in each course, headers over the middles of stretchers
        +-+-+       +-+-+
        +---+       +---+  window: bricks are cut at the reveals, by no more than leaves a quarter of a brick, and no head joint lies above another

Leaves in DIR: gallery.png (all specimens), a picture of each, result.json. A few seconds.
"""

import argparse
import math
import os
import sys

import yade_brick
from yade_brick import Opening, bondedWall, column, pier, report, wallsAlong

size, gravity, density = (0.25, 0.125, 0.075), 9.81, 1800  # brick [m], [m/s2], [kg/m3]
window = Opening(at=0.625, width=0.5, sill=0.225, height=0.45, name="window")  # [m]
steps = 200

# Specimens: how to build each, its volume [m3], and where it stands in the gallery [m]

length, height = 1.75, 0.9  # seven bricks: what English and Flemish bond end with a quoin at either end
opening = window.width * window.height
corner, junction = [(0, 0), (1.25, 0), (1.25, 1)], [[(0, 0), (1.5, 0)], [(0.75, 0), (0.75, 0.9)]]
cornerHeight = 0.6


def specimens():
	"""Dict from a name to (builder, volume [m3], place in the gallery [m])."""
	solid = length * height - opening
	found = {}
	for row, (bond, thickness) in enumerate((("Flemish", 0.25), ("English", 0.25), ("running", 0.125), ("stack", 0.125))):
		found[f"{bond} bond"] = (wallOf(bond), solid * thickness, (0, -1.5 * row, 0))
	found["English corner"] = (along(corner, "English"), 2.25 * 0.25 * cornerHeight, (2.7, -2.6, 0))
	found["Flemish junction"] = (along(junction, "Flemish"), (1.5 + 0.9 - 0.125) * 0.25 * cornerHeight, (2.7, -0.8, 0))
	found["pier of 1.5 x 1.5 bricks"] = (lambda **more: pier((1.5, 1.5), height, size, **more), 0.375**2 * height, (2.6, -4.3, 0))
	drums = dict(drums=5, height=1.2, base=(0.4, 0.4), top=(0.3, 0.3))
	found["column of five drums"] = (lambda **more: column(**drums, **more), 1.2 * (0.16 + 0.12 + 0.09) / 3, (3.7, -4.1, 0))
	return found


def wallOf(bond):
	return lambda **more: bondedWall(length, height, bond, size, [window], **more)


def along(plan, bond):
	return lambda **more: wallsAlong(plan, cornerHeight, bond, size, **more)


def clay():
	phi = math.radians(32)
	mortar = yade_brick.Mortar(tensileStrength=1e5, cohesion=1.5e5, frictionAngle=phi, compressiveStrength=5e6)
	return yade_brick.BrickMat(young=2e9, poisson=0.2, density=density, frictionAngle=phi, mortar=mortar)


# Each under its weight


def examined(name, build, volume, deformation):
	"""Rows that judge a specimen, and what it consists of."""
	O.reset()
	material = clay()
	ground = O.bodies.append(wall(0, axis=2, sense=1, material=material))
	masonry = build(material=material, deformation=deformation)
	O.bodies.append(masonry.bodies)
	O.engines = yade_brick.engines(gravity=(0, 0, -gravity))
	laying, statics = yade_brick.MortarJoints(), yade_brick.StaticEquilibrium()
	laying()
	statics()
	O.step()
	weight = gravity * sum(body.state.mass for body in masonry.bodies)
	carried = -O.forces.f(ground)[2]
	joined = {id for joint in O.interactions if joint.phys.jointed for id in (joint.id1, joint.id2)}
	O.run(steps, True)
	rest = yade_brick.restState()
	rows = [
	        report.judgedRow(f"{name}: weight [N]", weight, expected=gravity * density * volume, tolerance=1e-9),
	        report.judgedRow(f"{name}: the ground carries [N]", carried, expected=weight, tolerance=1e-5),
	        report.judgedRow(f"{name}: bricks without a joint", len(set(masonry.ids) - joined), limit=0),
	        report.judgedRow(f"{name}: segments of mortar beyond their strength", statics.overloaded, limit=0),
	        report.judgedRow(f"{name}: kinetic over elastic energy after {steps} steps", rest.energyRatio, limit=1e-8),
	]
	facts = dict(name=name, bricks=len(masonry.bodies), joints=laying.made, ground=sum(ground in (i.id1, i.id2) for i in O.interactions if i.phys.jointed))
	return rows, facts, masonry


def main():
	parser = argparse.ArgumentParser(prog="08_bonds_and_openings.py", description=__doc__.splitlines()[0])
	parser.add_argument("--deformation", choices=("rigid", "uniform", "trilinear"), default="trilinear", help="of all bricks (default: trilinear)")
	parser.add_argument("--out", metavar="DIR", default="result-08", help="folder for the results (default: result-08)")
	chosen = parser.parse_args()
	os.makedirs(chosen.out, exist_ok=True)
	rows, table, gallery = [], [], []
	for name, (build, volume, place) in specimens().items():
		judged, facts, masonry = examined(name, build, volume, chosen.deformation)
		rows += judged
		table.append(facts)
		picture = os.path.join(chosen.out, f"{name.replace(' ', '-').replace('.', '')}.png")
		yade_brick.wallPicture(picture, yade_brick.patches(masonry.bodies), view="3d", title=name, width=6)
		gallery += build(material=clay(), origin=place).bodies
	yade_brick.wallPicture(os.path.join(chosen.out, "gallery.png"), yade_brick.patches(gallery), view=(-60, 36), width=10)
	report.writeResult(chosen.out, rows, specimens=table)
	print("specimen                    bricks  joints between bricks  joints with the ground")
	for facts in table:
		print(f"{facts['name']:26s}  {facts['bricks']:6d}  {facts['joints'] - facts['ground']:21d}  {facts['ground']:22d}")
	print(report.table(rows, title=f"\nResults in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
