# SPDX-License-Identifier: GPL-2.0-or-later
"""A small house with door, windows, lintels and a floor of planks: its own weight by statics, then a short shaking in both directions.

    build/yade -n -x examples/09_house.py [--duration S] [--scale F] [--quick] [--out DIR]

         +-------------------------+  planks of timber over the whole plan, rigid, mortared to the walls
         |   +=====+    +=====+    |  lintels of concrete
         |   |     |    +-----+    |
         |   |door |    |window    |  running bond of adobe bricks of 300 x 150 x 150 mm that deform (trilinear), walls 150 mm thick:
         +---+     +---------------+  a house of 1.95 x 1.35 x 1.1 m, about a third of true size, corners interlocked
       ===============================  x; the motion comes along x and, weaker, along y

Leaves in DIR: house.png (the house during the motion and at its end, coloured by how far each brick has moved relative to the ground, with failed
segments of mortar), histories.csv and histories.png (floor, top of the door's lintel), result.json. The motion is synthetic, made by
yade_brick.syntheticNearFault: it is no record of any earthquake.
"""

import argparse
import math
import os
import sys

import numpy as np

import yade_brick
from yade_brick import Floor, Opening, house, picture, progress, report, snapshot, syntheticNearFault

gravity, phi = 9.81, math.radians(32)
lookEvery = 0.0025  # between samples of the histories [s]
mostLowered = 0.01  # of the floor of a house that stands [m]


def options():
	parser = argparse.ArgumentParser(prog="09_house.py", description=__doc__.splitlines()[0])
	parser.add_argument("--duration", type=float, default=0.45, help="seconds of shaking, up to 3 (default: 0.45)")
	parser.add_argument("--scale", type=float, default=1, help="factor on the motion (default: 1)")
	parser.add_argument("--quick", action="store_true", help="0.05 s of shaking instead")
	parser.add_argument("--out", metavar="DIR", default="result-09", help="folder for the results (default: result-09)")
	chosen = parser.parse_args()
	if not 0 < chosen.duration <= 3:
		parser.error(f"--duration is {chosen.duration}; allowed is 0 < duration <= 3 s")
	chosen.duration = 0.05 if chosen.quick else chosen.duration
	return chosen


# The house


def material(young, density):
	"""Mortar is the same for all materials: it joins bricks, lintels and planks."""
	mortar = yade_brick.Mortar(tensileStrength=5e4, cohesion=7e4, frictionAngle=phi, compressiveStrength=2e6)
	return yade_brick.BrickMat(young=young, poisson=0.2, density=density, frictionAngle=phi, mortar=mortar)


def build(shake):
	"""Puts ground, house, mortar and engines into the scene; returns ground's id, the house, the engines, and the number of joints."""
	adobe, concrete, timber = material(1e8, 1800), material(2e9, 2400), material(3e8, 600)  # timber across its grain
	door = Opening(at=0.375, width=0.45, height=0.75, name="door")
	window = Opening(at=1.2, width=0.3, sill=0.3, height=0.45, name="south window")
	others = Opening(at=0.525, width=0.3, sill=0.3, height=0.45, name="side windows")
	masonry = house(
	        plan=(1.95, 1.35), storeyHeight=1.05, bond="running", size=(0.3, 0.15, 0.15), openings=dict(south=[door, window], east=[others], west=[others]),
	        floors=Floor("planks", thickness=0.05, count=6, options=dict(material=timber)), lintels=dict(material=concrete, deformation="rigid"), material=adobe,
	        contactThickness=0.004, segments=2
	)
	ground = O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	O.bodies.append(masonry.bodies)
	O.engines = loop = yade_brick.engines(gravity=(0, 0, -gravity), motion=shake)
	laying = yade_brick.MortarJoints()
	laying()
	return ground, masonry, loop, laying.made


def selfWeight(ground, masonry):
	"""Rests the house by statics; rows that judge it."""
	statics = yade_brick.StaticEquilibrium()
	statics()
	O.step()
	weight = gravity * sum(body.state.mass for body in masonry.bodies)
	rest = yade_brick.restState()
	return [
	        report.judgedRow("the ground carries the house's weight [N]", -O.forces.f(ground)[2], expected=weight, tolerance=1e-5),
	        report.judgedRow("segments of mortar beyond their strength", statics.overloaded, limit=0),
	        report.judgedRow("kinetic over elastic energy at rest", rest.energyRatio, limit=1e-8),
	        report.judgedRow("imbalance of forces at rest", rest.imbalance, limit=1e-4),
	]


# Shaking


class Recorder:
	"""Displacements relative to the ground since the house was at rest, of all bricks and of what is followed."""

	def __init__(self, masonry, law, duration):
		self.masonry, self.law, self.start = masonry, law, O.time
		self.pictureTimes, self.frames = [0.6 * duration, duration], []
		self.rest = self.places()
		self.joints = snapshot.JointRecord()
		self.floor = [masonry.bodies.index(body) for body in masonry.floors[0]]
		self.lintel = masonry.bodies.index(masonry.groups["door"][0])
		self.times, self.moved, self.failed = [], {"floor": [], "lintel of the door": []}, []
		self.look()

	def places(self):
		return np.array([snapshot.numbers(body.state.pos) for body in self.masonry.bodies])

	def look(self):
		moved = self.places() - self.rest
		self.times.append(O.time - self.start)
		self.moved["floor"].append(moved[self.floor].mean(axis=0))
		self.moved["lintel of the door"].append(moved[self.lintel])
		self.failed.append(self.law.tensionFailures + self.law.shearFailures + self.law.compressionFailures)
		if self.failed[-1] != self.failed[max(len(self.failed) - 2, 0)]:
			self.joints.update()
		if len(self.frames) < 2 and self.times[-1] >= self.pictureTimes[len(self.frames)] - 0.5 * O.dt:
			self.frames.append(self.frame(moved))

	def frame(self, moved):
		distance = dict(zip(self.masonry.ids, 1e3 * np.linalg.norm(moved, axis=1)))
		return self.times[-1], snapshot.patches(self.masonry.bodies, colors=distance), self.joints.marks()

	def judged(self):
		lowered = -min(float(moved[2]) for moved in self.moved["floor"])
		return [report.judgedRow("by how much the floor has come down [m]", lowered, limit=mostLowered)]

	def write(self, out, title):
		columns = {"time [s]": self.times, "failed segments [-]": self.failed}
		for name, rows in self.moved.items():
			columns.update({f"{name} u{'xyz'[axis]} [m]": np.array(rows)[:, axis] for axis in range(3)})
		report.writeHistories(os.path.join(out, "histories.csv"), columns)
		picture.historyPlot(os.path.join(out, "histories.png"), self.times, self.moved, title=title)
		picture.pictureSeries(
		        os.path.join(out, "house.png"), self.frames, view="3d", title=title, columns=2,
		        colorLabel="displacement relative to the ground [mm]", width=13
		)


def main():
	chosen = options()
	shake = syntheticNearFault(
	        duration=3, peak=0.5 * 9.81, pulsePeriod=0.5, pulseVelocity=0.25, phaseTimes=(0.5, 1.8), ratios=(1, 0.6, 0)
	)
	if chosen.scale != 1:
		shake = shake.scaled(chosen.scale)
	ground, masonry, loop, joints = build(shake)
	print(f"{len(masonry.bodies)} bricks, {len(masonry.lintels)} lintels and {len(masonry.floors[0])} planks among them, {joints} joints")
	rows = selfWeight(ground, masonry)
	recorder = Recorder(masonry, loop.law, chosen.duration)
	stage = progress.runWithProgress(duration=chosen.duration, label="shaking", every=lookEvery, callback=recorder.look)
	rows += recorder.judged()
	recorder.write(chosen.out, f"House, {shake.name}")
	report.writeResult(
	        chosen.out, rows, bricks=len(masonry.bodies), joints=joints, segments=recorder.joints.segmentCount(), failed=recorder.joints.failedByMode(),
	        motion=shake.name, steps=stage.steps, wallSeconds=stage.wallSeconds
	)
	print(report.table(rows, title=f"{recorder.failed[-1]} of {recorder.joints.segmentCount()} segments failed; results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
