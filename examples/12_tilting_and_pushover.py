# SPDX-License-Identifier: GPL-2.0-or-later
"""How much sideways load does a dry wall bear? Two small walls on a table that is tilted, and pushed, until they fall; their capacity curves.

    build/yade -n -x examples/12_tilting_and_pushover.py [--quick] [--rate G_PER_S] [--out DIR] [--help]

       +---+---+       +-+---+-+
       |   |   |       | |   | |     -> load, in proportion to the masses: a tilted table (gravity turns) or a push (a force m a)
       +---+---+       +---+---+
       |   |   |       |   |   |     Cubes of 0.2 m, rigid, without mortar, friction angle 35 degrees. Straight joints: each column turns over by
       +---+---+       +-+---+-+     itself at its width over its height, b/h of rigid statics. Staggered joints: bricks ride on two others, so the
       |   |   |       | |   | |     wall bears more; a monolith would bear its own width over its height.
       +---+---+       +---+---+
     ===========================

The load grows evenly from a smooth start. The collapse multiplier is the largest base shear coefficient (base shear over weight; over the normal force on
the table) that is both applied and borne before the base stays behind the load. It is 12 % below b/h, since the springs of the contacts need an area to
stand on, while rigid blocks stand on an edge; the less the stiffer they are (and the shorter the time step).

Leaves in DIR: capacity.png, walls.png (as they fall when pushed), capacity-*.csv, result.json. Some 20 s.
"""

import argparse
import math
import os
import sys

import yade_brick
from yade_brick import report
from yade_brick.picture import Patch

gravity, side, columns, courses = 9.81, 0.2, 2, 4  # [m/s2], [m], bricks
young, density, friction = 1e8, 1800.0, math.radians(35)
bonds = {"straight joints": yade_brick.straightJointWall, "staggered joints": yade_brick.englishBondWall}
statics = side / (courses * side)  # b/h of a column
onSprings = 0.2200  # the same with springs that only press, for this stiffness: exact statics, tests/verification/tilting.py
monolith = columns * statics
fallenAt = 0.09  # lean of the top after which a run ends [m]
stepsAtOnce = 20


def loads(rate, largest):
	"""Name of each way of loading: its motion, and the coefficient that it has at a time. Both grow at about `rate` g/s, to `largest` g."""
	push = yade_brick.pushover(largest * gravity, rate=rate * gravity, hold=2.0)
	table = yade_brick.tiltingTable(rate, math.atan(largest), gravity=gravity, hold=2.0)
	return {
	        "push": (push, lambda time: yade_brick.loadAt(push, time)[0] / gravity),
	        "tilt": (table, lambda time: math.tan(yade_brick.tiltAt(table, time, gravity)))
	}


def standing(bond, motion):
	"""The wall on its floor, ready to be loaded; the Masonry and the floor's id."""
	O.reset()
	clay = yade_brick.BrickMat(young=young, poisson=0.25, density=density, frictionAngle=friction, hn=0.1, hs=0.1)
	floor = O.bodies.append(wall(0, axis=2, sense=1, material=clay))
	masonry = bonds[bond](columns, courses, (side, side, side), material=clay, deformation="rigid", segments=2)
	O.bodies.append(masonry.bodies)
	O.engines = yade_brick.engines(gravity=(0, 0, -gravity), motion=motion, damping=0.2)
	return masonry, floor


def loaded(bond, motion, applied):
	"""Loads the wall until it falls; its CapacityCurve, and how it then stands."""
	masonry, floor = standing(bond, motion)
	tops, rows = masonry.courses[-1], []
	while O.time < motion.duration:
		for _ in range(stepsAtOnce):
			O.step()
		force = O.forces.f(floor)
		lean = max(body.state.pos[0] - body.state.refPos[0] for body in tops)
		rows.append((lean, force[0], -force[2], applied(O.time)))
		if lean > fallenAt:
			break
	shown = [Patch([tuple(corner) for corner in body.shape.worldCorners(body.state)]) for body in masonry.bodies]
	return yade_brick.capacityCurve(*zip(*rows)), shown


def judged(curves):
	"""Columns fall at b/h, a little early; the bonded wall bears more and less than a monolith; a tilted table and a push agree."""
	rows = []
	for (bond, way), curve in curves.items():
		name = f"{bond}, {way}: collapse multiplier"
		if bond == "straight joints":
			# the load grows while the columns begin to fall, by some of 0.01 that equilibrium is allowed
			rows.append(report.judgedRow(name + ", against springs", curve.multiplier, expected=onSprings, tolerance=0.03))
			rows.append(report.judgedRow(name + ", against b/h", curve.multiplier, expected=statics, tolerance=0.15))
		else:
			rows.append(report.judgedRow(name + " over that of a monolith", curve.multiplier / monolith, limit=1.0))
			rows.append(report.judgedRow(f"{bond}, {way}: b/h of a column over the multiplier", statics / curve.multiplier, limit=1.0))
		rows.append(report.judgedRow(f"{bond}, {way}: still stands", int(not curve.collapsed), limit=0))
	for bond in bonds:
		pair = [curves[bond, way].multiplier for way in ("push", "tilt") if (bond, way) in curves]
		if len(pair) == 2:
			rows.append(report.judgedRow(f"{bond}: tilt against push", pair[1], expected=pair[0], tolerance=0.05))
	return rows


def main():
	parser = argparse.ArgumentParser(prog="12_tilting_and_pushover.py", description=__doc__.splitlines()[0])
	parser.add_argument("--quick", action="store_true", help="straight joints and the push alone")
	parser.add_argument("--rate", type=float, default=0.12, metavar="G_PER_S", help="growth of the load [g/s] (default: 0.12); slower is closer to statics")
	parser.add_argument("--out", metavar="DIR", default="result-12", help="folder for the results (default: result-12)")
	chosen = parser.parse_args()
	curves, frames = {}, {}
	for bond in list(bonds)[:1 if chosen.quick else None]:
		for way, (motion, applied) in list(loads(chosen.rate, 1.1 * monolith).items())[:1 if chosen.quick else None]:
			curves[bond, way], frames[bond, way] = loaded(bond, motion, applied)
			print(f"{bond}, {way}: collapse multiplier {curves[bond, way].multiplier:.3f} (b/h of a column {statics:.3f})")
	os.makedirs(chosen.out, exist_ok=True)
	rows = judged(curves)
	yade_brick.capacityPlot(
	        os.path.join(chosen.out, "capacity.png"), {f"{bond}, {way}": curve for (bond, way), curve in curves.items()},
	        {"b/h of a column, rigid statics": statics, "b/h of the wall, monolith": monolith}, shown=0.08, title="Dry walls of two columns of four cubes"
	)
	pushed = [(None, shown, None) for (_, way), shown in frames.items() if way == "push"]
	yade_brick.pictureSeries(os.path.join(chosen.out, "walls.png"), pushed, columns=1, rowLabels=list(bonds), width=4.5, dpi=150)
	for (bond, way), curve in curves.items():
		columnsOfCurve = {"control displacement [m]": curve.displacement, "base shear coefficient [-]": curve.coefficient, "applied [-]": curve.applied}
		report.writeHistories(os.path.join(chosen.out, f"capacity-{bond.split()[0]}-{way}.csv"), columnsOfCurve)
	report.writeResult(chosen.out, rows, multipliers={f"{bond}, {way}": curve.multiplier for (bond, way), curve in curves.items()}, columnStatics=statics)
	print(report.table(rows, title=f"Results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
