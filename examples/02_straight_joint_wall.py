# SPDX-License-Identifier: GPL-2.0-or-later
"""A masonry wall of 6 x 6 deformable bricks settles under its weight, is shaken in its plane, cracks and falls.

    build/yade -n -x examples/02_straight_joint_wall.py [--model rigid|deform] [--motion FILE] [--duration S] [--out DIR]

       z   +---+---+---+---+---+---+     Straight joints: cubes of 0.2 m, joined to each other and to the ground by mortar
     1.2 m | A |   |   |   |   | B |     (Furukawa et al. 2014, section 4.2, Fig. 7 (a), Tables 1 and 3). A and B, whose
           +---+---+---+---+---+---+     displacement relative to the ground is recorded, are our choice: the paper's text
           |   |   |   |   |   |   |     does not say which upper bricks it means.
            ...
           +---+---+---+---+---+---+
         ========================== ---> x, direction of the ground motion

Leaves in DIR: histories.csv (A and B, failed segments), histories.png, wall.png (the wall at chosen times), result.json.
The default motion is synthetic, made by yade_brick.motion.syntheticNearFault: it is no record of any earthquake.
"""

import argparse
import math
import os
import sys
import time

import yade_brick
from yade_brick import motion as motions
from yade_brick import build, picture, progress, report, snapshot

gravity = 9.8  # [m/s2]
side = 0.2  # of a brick [m]
floorTolerance = 0.01 * side  # how deep a brick may be below the floor at the end [m]

# ---- 1. what to run ------------------------------------------------------------------------------------------------------------


def options():
	parser = argparse.ArgumentParser(prog="02_straight_joint_wall.py", description=__doc__.splitlines()[0])
	parser.add_argument("--model", choices=("rigid", "deform"), default="deform", help="RIGID or DEFORM of the paper (default: deform)")
	parser.add_argument("--motion", metavar="FILE", help="PEER AT2 file, or columns of time [s] and acceleration [m/s2]; default: synthetic near-fault motion")
	parser.add_argument("--duration", type=float, default=10, help="seconds of shaking (default: 10)")
	parser.add_argument("--thickness", type=float, default=0.001, help="thickness r of the contact part [m] (default: 0.001)")
	parser.add_argument("--segments", type=int, default=4, help="segments along each edge of a face (default: 4)")
	parser.add_argument("--out", metavar="DIR", default="result-02", help="folder for the results (default: result-02)")
	chosen = parser.parse_args()
	if not (math.isfinite(chosen.duration) and chosen.duration > 0):
		parser.error(f"--duration is {chosen.duration}; allowed is a finite number of seconds > 0")
	return chosen


def groundMotion(path):
	if path is None:
		return motions.syntheticNearFault()
	return motions.readAt2(path) if path.lower().endswith(".at2") else motions.readColumns(path, units="m/s2")


# ---- 2. the scene --------------------------------------------------------------------------------------------------------------


def buildScene(chosen):
	"""The wall on the ground, joined, and its engines; returns the bricks by course."""
	phi = math.radians(32)
	mortar = yade_brick.Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	adobe = yade_brick.BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=phi, mortar=mortar)
	O.materials.append(adobe)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	masonry = build.straightJointWall(
	        6, 6, (side, side, side), material=adobe, deformation="rigid" if chosen.model == "rigid" else "trilinear", contactThickness=chosen.thickness,
	        segments=chosen.segments
	)
	O.bodies.append(masonry.bodies)
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()],
	                [Ip2_BrickMat_BrickMat_BrickPhys()],
	                [Law2_BrickGeom_BrickPhys_Mortar(label="law")],
	        ),
	        BrickTimeStepper(label="stepper"),
	        BrickDynamics(label="dynamics"),
	        NewtonIntegrator(gravity=(0, 0, -gravity), label="newton"),
	]
	yade_brick.MortarJoints()()
	return masonry


def settle():
	"""Self weight, with damping, until the forces balance; then the damping is taken away."""
	newton.damping = dynamics.damping = 0.3
	O.step()  # finds the time step
	stage = progress.runWithProgress(duration=2, label="self weight", every=0.02, callback=lambda: unbalancedForce() < 1e-4)
	newton.damping = dynamics.damping = 0
	return stage


# ---- 3. what is recorded -------------------------------------------------------------------------------------------------------


class Recorder:
	"""Displacement of A and B, failed segments over time, and pictures at chosen times."""

	def __init__(self, masonry, start, pictureTimes):
		self.masonry, self.start, self.pending = masonry, start, list(pictureTimes)
		self.followed = {"A": masonry.courses[-1][0], "B": masonry.courses[-1][-1]}
		self.times, self.displacements = [], {name: [] for name in self.followed}
		self.failures = {"tension": [], "shear": [], "compression": []}
		self.joints, self.frames = snapshot.JointRecord(), []

	def look(self):
		now = O.time - self.start
		self.times.append(now)
		for name, body in self.followed.items():
			self.displacements[name].append(tuple(body.state.pos - body.state.refPos))
		for mode in self.failures:
			self.failures[mode].append(getattr(law, mode + "Failures"))
		self.joints.update()
		if self.pending and now >= self.pending[0] - 0.5 * O.dt:
			self.pending.pop(0)
			self.frames.append((now, snapshot.patches(self.masonry.bodies), self.joints.marks()))

	def fallen(self):
		"""Bricks whose centre has come down by more than half a brick."""
		return sum(body.state.refPos[2] - body.state.pos[2] > side / 2 for body in self.masonry.bodies)

	def write(self, out, title):
		columns = {"time [s]": self.times}
		for name, rows in self.displacements.items():
			for axis in range(3):
				columns[f"{name} u{'xyz'[axis]} [m]"] = [row[axis] for row in rows]
		for mode, counts in self.failures.items():
			columns[f"failed in {mode} [-]"] = counts
		report.writeHistories(os.path.join(out, "histories.csv"), columns)
		picture.historyPlot(os.path.join(out, "histories.png"), self.times, self.displacements, title=title)
		picture.pictureSeries(os.path.join(out, "wall.png"), self.frames, title=title)


# ---- 4. the run ----------------------------------------------------------------------------------------------------------------


def depthBelowFloor(masonry):
	"""How deep the lowest corner is below the floor [m]."""
	return -min(corner[2] for body in masonry.bodies for corner in body.shape.worldCorners(body.state))


def lastState(masonry, recorder, chosen, synthetic):
	"""What has to hold at the end of every run, and of the default one: a collapsed wall."""
	wrong = sum(not all(math.isfinite(value) for corner in body.shape.worldCorners(body.state) for value in corner) for body in masonry.bodies)
	rows = [report.judgedRow("bricks that are not finite", wrong, limit=0)]
	# RIGID puts the compliance of the whole brick into its springs: a brick that leans on an edge sinks by millimetres, as the model says.
	if chosen.model == "deform":
		rows.append(report.judgedRow("depth of the lowest corner below the floor [m]", depthBelowFloor(masonry), limit=floorTolerance))
	if synthetic and chosen.duration >= 6:
		rows.append(report.judgedRow("bricks that have not fallen", len(masonry.bodies) - recorder.fallen(), limit=len(masonry.bodies) - 6))
	return rows


def main():
	chosen = options()
	motion = groundMotion(chosen.motion)
	masonry = buildScene(chosen)
	begun = time.perf_counter()
	settling, balance = settle(), unbalancedForce()
	start = O.time
	O.engines = O.engines[:-1] + [build.groundMotion(motion, startTime=start)] + O.engines[-1:]
	pictureTimes = [share * chosen.duration for share in (0, 0.25, 0.35, 0.45, 0.6, 1)]
	recorder = Recorder(masonry, start, pictureTimes)
	recorder.look()
	shaking = progress.runWithProgress(duration=chosen.duration, label="shaking", every=0.01, callback=recorder.look)

	title = f"{'RIGID' if chosen.model == 'rigid' else 'DEFORM'}, {motion.name}"
	rows = lastState(masonry, recorder, chosen, motion.synthetic)
	os.makedirs(chosen.out, exist_ok=True)
	recorder.write(chosen.out, title)
	every = max(1, len(recorder.times) // 100)
	report.writeResult(
	        chosen.out,
	        rows,
	        model=chosen.model,
	        motion=motion.name,
	        motionIsSynthetic=motion.synthetic,
	        threads=O.numThreads,
	        steps=settling.steps + shaking.steps,
	        dt=O.dt,
	        limitingBrick=stepper.limitingBrick,
	        settlingSeconds=settling.simulated,
	        unbalancedForceAfterSettling=balance,
	        wallSeconds=time.perf_counter() - begun,
	        secondsPerSimulatedSecond=shaking.secondsPerSimulatedSecond,
	        microsecondsPerBrickStep=1e6 * shaking.wallSeconds / shaking.steps / len(masonry.bodies),
	        failedSegments={"time": recorder.times[::every], **{mode: counts[::every] for mode, counts in recorder.failures.items()}},
	        bricksFallen=recorder.fallen(),
	        depthBelowFloor=depthBelowFloor(masonry),
	        contactsBeyondContactPart=law.crushedContacts,
	)
	print(report.table(rows, title=f"{title}: {recorder.fallen()} of {len(masonry.bodies)} bricks fallen; results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
