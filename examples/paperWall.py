# SPDX-License-Identifier: GPL-2.0-or-later
# The walls of Furukawa et al. 2014, section 4.2 (Fig. 7, Tables 1 and 3): options, scene, self weight, shaking and what is written down.
# Examples 02 (straight joints) and 03 (English bond) lay the bricks and call these functions in order; 04 and 07 compare what they leave behind.
"""A wall of the paper from its options to its results; see `WallRun`."""

import argparse
import contextlib
import math
import os
import sys
import time

import numpy as np

import yade_brick
from yade import O
from yade.utils import coordsAndDisplacements, momentum
from yade.utils import wall as supportingWall
from yade_brick import build, picture, progress, report, rest, snapshot

gravity = 9.8  # [m/s2]
side = 0.2  # of a brick [m]
courses = columns = 6
density, height = 1800, courses * side  # [kg/m3], [m]
lookEvery, frameEvery = 0.005, 0.25  # between two samples of the histories, and between two shapes that are kept [s]
# 1 % of what the wall has by its height: contact on edges makes or takes some percent of what it stores (doc/method.md), a few J in a collapse
energyTolerance = 0.01 * (density * columns * side * side * height) * gravity * height / 2  # [J]
pictureLimits = (-1.2, 2.8, -0.15, 1.4)  # of x and z in wall.png: bricks that have flown farther are outside [m]
restRatio, restImbalance = 1e-8, 1e-4  # criterion of rest: kinetic over elastic energy, mean net force over mean force in joints

modelNames = {"rigid": "RIGID", "deform": "DEFORM", "demand": "DEFORM on demand"}

# What to run


def attribute(text):
	"""NAME=VALUE as (name, number)."""
	name, value = text.split("=")
	return name, int(value) if value.isdigit() else float(value)


def options(description, out, given=None):
	"""The options of a wall from the command line, or from a list of arguments."""
	parser = argparse.ArgumentParser(prog=os.path.basename(sys.argv[0]), description=description.splitlines()[0])
	parser.add_argument("--model", choices=tuple(modelNames), default="deform", help="RIGID or DEFORM of the paper, or bricks that deform on demand (default: deform)")
	parser.add_argument(
	        "--demand", nargs="+", type=attribute, default=[], metavar="NAME=VALUE",
	        help="attributes of DeformationOnDemand; with --model deform for bricks that begin deformable"
	)
	parser.add_argument("--together", action="store_true", help="with --model demand: when one brick has to deform, all do; see WallTogether")
	parser.add_argument("--motion", metavar="FILE", help="PEER AT2 file, or columns of time [s] and acceleration [m/s2]; default: synthetic near-fault motion")
	parser.add_argument("--direction", choices=("x", "y"), default="x", help="shake in the wall's plane (x) or out of it (y) (default: x)")
	parser.add_argument("--scale", type=float, default=1, help="factor on the motion; 0: no motion, the wall has to stay at rest (default: 1)")
	parser.add_argument("--duration", type=float, default=10, help="seconds of shaking (default: 10)")
	parser.add_argument("--settle", choices=("static", "damped"), default="static", help="self weight by a static solution, or in time with damping")
	parser.add_argument("--thickness", type=float, default=0.001, help="thickness r of the contact part [m] (default: 0.001)")
	parser.add_argument("--segments", type=int, default=4, help="segments along each edge of a face, see Brick (default: 4)")
	parser.add_argument("--young", type=float, default=9.8e6, help="Young's modulus of bricks and mortar [Pa] (default: 9.8e6)")
	parser.add_argument("--poisson", type=float, default=0.25, help="Poisson's ratio of bricks and mortar (default: 0.25)")
	parser.add_argument("--element", choices=("full", "incompatible", "bbar"), default="full", help="finite element of the inner part (default: full)")
	parser.add_argument("--inner", choices=("inset", "full"), default="inset", help="inner part r inside the brick's corners (the paper), or at them")
	parser.add_argument("--hn", type=float, default=0.1, help="damping ratio of the normal contact dashpots (default: 0.1)")
	parser.add_argument("--hs", type=float, default=0.1, help="damping ratio of the tangential contact dashpots (default: 0.1)")
	parser.add_argument("--damping-ratio", type=float, default=0, help="fraction of critical damping of the bricks' deformation (default: 0)")
	parser.add_argument("--bill", action="store_true", help="where the time of the shaking went, also in result.json; measuring takes some of it itself")
	parser.add_argument("--out", metavar="DIR", default=out, help=f"folder for the results (default: {out})")
	chosen = parser.parse_args(given)
	if not (math.isfinite(chosen.duration) and chosen.duration > 0):
		parser.error(f"--duration is {chosen.duration}; allowed is a finite number of seconds > 0")
	return chosen


def groundMotion(chosen):
	"""The motion that was chosen, in its direction and strength."""
	if chosen.motion is None:
		motion = yade_brick.syntheticNearFault()
	else:
		motion = yade_brick.readAt2(chosen.motion) if chosen.motion.lower().endswith(".at2") else yade_brick.readColumns(chosen.motion, units="m/s2")
	if chosen.direction == "y":
		# a quarter turn about the vertical: what was along x is along y
		turned = motion.acceleration @ np.array([(0, 1, 0), (-1, 0, 0), (0, 0, 1)])
		motion = yade_brick.Motion(motion.dt, turned, f"{motion.name}, out of plane", motion.synthetic)
	return motion if chosen.scale == 1 else motion.scaled(chosen.scale)


# The bricks: adobe and mortar of Table 3


def brickOptions(chosen):
	"""Material and numerical choices of every brick of the wall, for the builders of walls."""
	phi = math.radians(32)
	mortar = yade_brick.Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	adobe = yade_brick.BrickMat(
	        young=chosen.young, poisson=chosen.poisson, density=density, frictionAngle=phi, mortar=mortar, hn=chosen.hn, hs=chosen.hs,
	        dampingRatio=chosen.damping_ratio
	)
	deformation = "trilinear" if chosen.model == "deform" else "rigid"
	return {
	        "material": adobe, "deformation": deformation, "element": chosen.element, "inner": chosen.inner, "contactThickness": chosen.thickness,
	        "segments": chosen.segments
	}


# The run


class WallRun:
	"""A wall on the ground from laying its mortar to its results: `settle`, `shake`, `write`, in this order."""

	def __init__(self, masonry, chosen):
		"""Puts ground, bricks, mortar and engines into the scene."""
		self.masonry, self.chosen, self.begun = masonry, chosen, time.perf_counter()
		self.unloaded = corners(masonry.bodies)
		O.bodies.append(supportingWall(0, axis=2, sense=1, material=masonry.bodies[0].material))
		O.bodies.append(masonry.bodies)
		O.engines = self.loop = yade_brick.engines(gravity=(0, 0, -gravity), onDemand=dict(chosen.demand) or chosen.model == "demand")
		self.law = self.loop.law
		self.together = WallTogether(masonry, self.loop) if chosen.together else None
		yade_brick.MortarJoints()()

	def settle(self):
		"""Brings the wall to rest under its weight: at once by the statics of the intact wall, or in time with damping that is then taken away."""
		if self.chosen.settle == "static":
			yade_brick.StaticEquilibrium()()
			self.loop.newton.damping = 0.2  # of what round-off has left
			O.step()  # finds the time step
		else:
			self.loop.newton.damping = self.loop.dynamics.damping = 0.3
			O.step()
			progress.runWithProgress(duration=4, label="self weight", every=0.02, callback=lambda: rest.isAtRest(restRatio, restImbalance))
		self.loop.newton.damping = self.loop.dynamics.damping = 0
		self.settled = SettledWall(self.masonry, self.unloaded, self.law)

	def shake(self, motion):
		"""Applies the ground motion and records what happens."""
		self.motion = motion
		ground = build.groundMotion(motion, startTime=O.time)
		self.loop.insert(self.loop.index(self.loop.newton), ground)
		O.engines = self.loop
		self.recorder = Recorder(self.masonry, self.unloaded, self.law, self.chosen.duration, EnergyBalance(self.masonry, ground))
		begun = time.process_time() - self.recorder.lookedSeconds  # the look at the start was before
		with yade_brick.Bill() if self.chosen.bill else contextlib.nullcontext() as self.bill:
			self.stage = progress.runWithProgress(duration=self.chosen.duration, label="shaking", every=lookEvery, callback=self.look)
		self.processorSeconds = time.process_time() - begun - self.recorder.lookedSeconds
		self.rested = rest.restState()

	def look(self):
		if self.together:
			self.together.look()
		return self.recorder.look()

	@property
	def title(self):
		return f"{modelNames[self.chosen.model]}, {self.motion.name}"

	def judged(self, leastFallen=0):
		"""What has to hold: the wall was at rest before the shaking, and at the end every brick is somewhere above the floor."""
		bodies = self.masonry.bodies
		lost = sum(not all(math.isfinite(value) for corner in body.shape.worldCorners(body.state) for value in corner) for body in bodies)
		rows = self.settled.judged() + [report.judgedRow("bricks that are not finite", lost, limit=0)]
		rows.append(report.judgedRow("depth of the lowest corner below the floor [m]", depthBelowFloor(bodies), limit=deepestCorner(self.chosen)))
		rows.append(report.judgedRow("energy gained without work [J]", self.recorder.energy.gained, limit=energyTolerance))
		if self.chosen.scale == 0:
			rows += self.recorder.judgedStill() + judgedRest(self.rested, "at the end")
		elif leastFallen:
			rows.append(report.judgedRow("bricks that have not fallen", len(bodies) - self.recorder.fallen(), limit=len(bodies) - leastFallen))
		return rows

	def write(self, leastFallen=0):
		"""Leaves all results in the folder that was chosen; the exit status.

		:param leastFallen: so many bricks have to be down at the end; 0: that is not judged
		"""
		chosen, rows = self.chosen, self.judged(leastFallen)
		os.makedirs(chosen.out, exist_ok=True)
		self.recorder.write(chosen.out, self.title, view="elevation" if chosen.direction == "x" else "3d")
		report.writeResult(
		        chosen.out,
		        rows,
		        options={name: value for name, value in vars(chosen).items() if name != "out"},
		        model=chosen.model,
		        motion=self.motion.name,
		        motionIsSynthetic=self.motion.synthetic,
		        threads=O.numThreads,
		        steps=O.iter,
		        dt=O.dt,
		        limitingBrick=self.loop.stepper.limitingBrick,
		        settlingSeconds=self.settled.duration,
		        unbalancedForceAfterSettling=self.settled.state.imbalance,
		        atRest=self.settled.facts(),
		        wallSeconds=time.perf_counter() - self.begun,
		        shakingSteps=self.stage.steps,
		        processorSeconds=self.processorSeconds,
		        levelChanges=[self.loop.onDemand.promoted, self.loop.onDemand.demoted] if self.loop.onDemand else [0, 0],
		        secondsPerSimulatedSecond=self.stage.secondsPerSimulatedSecond,
		        microsecondsPerBrickStep=1e6 * self.stage.wallSeconds / self.stage.steps / len(self.masonry.bodies),
		        depthBelowFloor=depthBelowFloor(self.masonry.bodies),
		        contactsBeyondContactPart=self.law.crushedContacts,
		        bill=self.bill.facts() if self.bill else None,
		        **self.recorder.facts(),
		)
		if self.bill:
			print(f"Bill of the shaking:\n{self.bill.table()}\n")
		down, count = self.recorder.fallen(), len(self.masonry.bodies)
		print(report.table(rows, title=f"{self.title}: {down} of {count} bricks fallen; results in {chosen.out}"))
		return report.exitStatus(rows)


class WallTogether:
	"""Lets all bricks deform as soon as DeformationOnDemand has found one that has to, and a brick be rigid again when no mortar has held it for a while.

	A brick that deforms beside one that does not bends and shears the joint between them; see doc/on-demand.md. The engine's release has to be 0.
	"""

	levelTime = 0.05  # of all bricks the same, so that halves do not change before whole ones; half a period of the wall [s]

	def __init__(self, masonry, loop):
		self.bodies, self.engine, self.begun, self.loose = masonry.bodies, loop.onDemand, False, {}
		loop.dynamics.levelTime = self.levelTime

	def look(self):
		if not self.engine.promoted:
			return
		if not self.begun:
			self.begun = True
			self.change(self.bodies, self.engine.level)
		held = {id for joint in O.interactions if joint.isReal and joint.phys.jointed for id in (joint.id1, joint.id2)}
		self.loose = {body.id: self.loose.get(body.id, O.time) for body in self.bodies if body.id not in held}
		self.change([body for body in self.bodies if O.time - self.loose.get(body.id, math.inf) >= self.engine.patience], "rigid")

	@staticmethod
	def change(bodies, level):
		for body in bodies:
			if body.shape.deformation != level:
				body.shape.deformation = level


def depthBelowFloor(bodies):
	"""How deep the lowest corner is below the floor [m]."""
	return -min(corner[2] for body in bodies for corner in body.shape.worldCorners(body.state))


def deepestCorner(chosen):
	"""How deep the corner of a cube sinks into the floor when it takes up the cube's fall from the top of the wall [m].

	At depth d the corner of a cube that stands on it has the volume sqrt(3)/2 d^3 below the floor, and the force is kn times that.
	"""
	springLength = chosen.thickness if chosen.model == "deform" and not chosen.demand else side / 2
	stiffness = chosen.young / ((1 - chosen.poisson**2) * springLength)
	fallEnergy = density * side**3 * gravity * height
	return (8 / math.sqrt(3) * fallEnergy / stiffness)**0.25


# The wall at rest


class SettledWall:
	"""The wall under its own weight: how far from rest it is, by how much it has spread, how its bricks press on each other."""

	def __init__(self, masonry, unloaded, law):
		"""
		:param unloaded: corners of all bricks before they carried their weight (n, 8, 3) [m]
		"""
		self.state, self.duration, self.failed = rest.restState(), O.time, failures(law)
		spread = [courseSpread(corners, moved) for corners, moved in byCourse(masonry, unloaded, corners(masonry.bodies) - unloaded)]
		self.spreadX, self.spreadY = zip(*spread)
		self.headStress, self.largestBedTension, self.baseThrust = jointStresses(masonry)

	def judged(self):
		return judgedRest(self.state, "before the shaking")

	def facts(self):
		return {
		        "kineticEnergy": self.state.kinetic, "elasticEnergy": self.state.elastic, "failed": self.failed, "spreadX": self.spreadX,
		        "spreadY": self.spreadY, "headJointStress": self.headStress, "largestBedTension": self.largestBedTension,
		        "baseThrust": self.baseThrust
		}


def judgedRest(state, when):
	"""Rows of the criterion of rest."""
	return [
	        report.judgedRow(f"kinetic over elastic energy {when}", state.energyRatio, limit=restRatio),
	        report.judgedRow(f"imbalance of forces {when}", state.imbalance, limit=restImbalance),
	]


def failures(law):
	"""Segments failed so far, by mode."""
	return {"tension": law.tensionFailures, "shear": law.shearFailures, "compression": law.compressionFailures}


def corners(bodies):
	"""Present corners of bricks, (n, 8, 3) [m]."""
	return np.array([snapshot.worldCorners(body) for body in bodies])


def byCourse(masonry, *arrays):
	"""The rows of arrays with a row for each brick, course by course from below."""
	ends = np.cumsum([len(course) for course in masonry.courses])[:-1]
	return zip(*(np.split(array, ends) for array in arrays))


def courseSpread(corners, moved):
	"""By how much the half width of a course has grown [m]: of its length (x), and of the brick that has grown most in depth (y).

	:param corners: of its bricks before (bricks, 8, 3) [m]
	:param moved: displacement of the corners since, likewise
	"""
	x, y = corners[..., 0], corners[..., 1]
	alongX = 0.5 * (moved[..., 0][np.isclose(x, x.max())].mean() - moved[..., 0][np.isclose(x, x.min())].mean())
	front, back = np.isclose(y, y.min()), np.isclose(y, y.max())
	alongY = [0.5 * (brick[..., 1][far].mean() - brick[..., 1][near].mean()) for brick, near, far in zip(moved, front, back)]
	return float(alongX), float(max(alongY))


def jointStresses(masonry):
	"""Mean normal stress of each head joint [Pa], tension positive, by course from below and in each from the left; the largest tension of a
	segment of a bed joint [Pa]; and the horizontal force with which the ground holds the left half of the wall together [N].
	"""
	headJoints, bedTension, thrust, bricks = [[] for _ in masonry.courses], -math.inf, 0, set(masonry.ids)
	for joint in (i for i in O.interactions if i.isReal and i.phys.jointed):
		stress, areas, place = joint.phys.normalStress(joint.geom), joint.phys.segmentArea, joint.geom.contactPoint
		if abs(joint.geom.normal[0]) > 0.5:
			headJoints[int(place[2] / side)].append((place[0], float(np.average(stress, weights=areas))))
			continue
		bedTension = max(bedTension, *stress)
		if place[2] < 0.5 * side and place[0] < 0.5 * columns * side:
			onBrick = joint.phys.normalForce + joint.phys.shearForce  # acts on id2
			thrust += onBrick[0] if joint.id2 in bricks else -onBrick[0]
	return [[stress for _, stress in sorted(course)] for course in headJoints], bedTension, thrust


# What is recorded


class EnergyBalance:
	"""Energy of the bricks (kinetic, elastic, height) less the work of the ground motion: friction, dashpots and cracks lower it, nothing may raise it.

	The work is summed from look to look, which misses a few J of an impact that falls between two.
	"""

	def __init__(self, masonry, ground):
		self.shapes, self.ground = [body.shape for body in masonry.bodies], ground
		self.masses = np.array([body.state.mass for body in masonry.bodies])
		self.work, self.power, self.time = 0, 0, O.time
		self.lowest, self.gained = math.inf, 0

	def look(self, heights):
		"""
		:param heights: of the bricks' centres [m]
		"""
		power = -momentum().dot(self.ground.groundAcceleration(O.time))  # only the bricks have mass
		self.work += 0.5 * (power + self.power) * (O.time - self.time)
		self.power, self.time = power, O.time
		kinetic, elastic = rest.energies(self.shapes)
		balance = kinetic + elastic + gravity * float(self.masses @ heights) - self.work
		self.lowest = min(self.lowest, balance)
		self.gained = max(self.gained, balance - self.lowest)


class Recorder:
	"""Displacement of every brick, failed segments, and the wall's shape now and then, from the start of the shaking on.

	Displacements are relative to the ground and to where the bricks were laid, before they carried their weight. A and B are the first and the
	last brick of the top course; besides their centres their outer upper corners in front are followed, which Poisson's effect moves in y too.
	"""

	pictureShares = (0, 0.25, 0.35, 0.45, 0.6, 1)  # of the duration: the shapes in wall.png

	def __init__(self, masonry, unloaded, law, duration, energy):
		self.masonry, self.law, self.start, self.energy = masonry, law, O.time, energy
		self.bodies, self.ids = masonry.bodies, np.array(masonry.ids)
		top = {"A": len(self.bodies) - len(masonry.courses[-1]), "B": len(self.bodies) - 1}
		outward = {"A": (-1, -1, 1), "B": (1, -1, 1)}
		self.followed = {name: (brick, int((unloaded[brick] @ outward[name]).argmax())) for name, brick in top.items()}
		self.unloaded, self.cornersMoved = unloaded, {name: [] for name in top}
		self.pictureTimes = [share * duration for share in self.pictureShares]
		self.pending = sorted({*self.pictureTimes, *np.arange(0, duration, frameEvery).tolist()})
		self.failed = failures(law)
		self.times, self.displacements, self.failures, self.frames = [], [], {mode: [] for mode in self.failed}, []
		self.joints = snapshot.JointRecord()
		self.steps, self.deformable, self.asked, self.lookedSeconds = [], [], [], 0
		self.look()

	def look(self):
		begun = time.process_time()
		self.record()
		self.lookedSeconds += time.process_time() - begun

	def record(self):
		now = O.time - self.start
		self.times.append(now)
		# of all bodies at once, axis by axis: asking brick by brick takes forty times as long
		places, moved = zip(*(coordsAndDisplacements(axis) for axis in range(3)))
		self.displacements.append(np.array(moved).T[self.ids])
		self.steps.append(O.iter)
		self.asked.append(sum(shape.deformation != "rigid" for shape in self.energy.shapes))
		self.deformable.append(sum(shape.deformation != "rigid" or shape.share < 1 for shape in self.energy.shapes))
		for name, (brick, corner) in self.followed.items():
			body = self.bodies[brick]
			self.cornersMoved[name].append(snapshot.numbers(body.shape.worldCorners(body.state)[corner]) - self.unloaded[brick, corner])
		failed = failures(self.law)
		if failed != self.failed:  # as long as no segment has failed, joints are as they were
			self.joints.update()
			self.failed = failed
		for mode, count in failed.items():
			self.failures[mode].append(count)
		self.energy.look(heights=np.array(places[2])[self.ids])
		if self.pending and now >= self.pending[0] - 0.5 * O.dt:
			self.pending.pop(0)
			self.frames.append((now, snapshot.patches(self.bodies), self.joints.marks()))

	def lowered(self):
		"""By how much the centre of each brick has come down since the shaking began, (times, bricks) [m]."""
		heights = np.array(self.displacements)[:, :, 2]
		return heights[0] - heights

	def fallen(self):
		"""Bricks whose centre has come down by more than half a brick."""
		return int((self.lowered()[-1] > side / 2).sum())

	def facts(self):
		every = max(1, len(self.times) // 100)
		down = (self.lowered() > side / 2).any(axis=1)
		return {
		        "failedSegments": {"time": self.times[::every], **{mode: counts[::every] for mode, counts in self.failures.items()}},
		        "segments": self.joints.segmentCount(),
		        "firstCrack": {mode: self.firstTime(np.array(counts) > counts[0]) for mode, counts in self.failures.items()},
		        "halfFailed": self.firstTime(np.sum(list(self.failures.values()), axis=0) >= 0.5 * self.joints.segmentCount()),
		        "collapse": self.firstTime(down),
		        "bricksFallen": self.fallen(),
		        "energyGained": self.energy.gained,
		}

	def firstTime(self, happened):
		"""Time of the first sample at which something had happened [s]; None if it never did."""
		return self.times[int(np.argmax(happened))] if happened.any() else None

	def judgedStill(self):
		"""Without a motion: nothing may crack or move."""
		moved = np.array(self.displacements)
		settlement = np.abs(moved[0]).max()
		cracked = sum(counts[-1] - counts[0] for counts in self.failures.values())
		drift = np.abs(moved - moved[0]).max() / settlement
		return [report.judgedRow("segments failed without motion", cracked, limit=0), report.judgedRow("largest drift over settlement", drift, limit=1e-4)]

	def write(self, out, title, view):
		"""histories.csv and histories.png of A and B, wall.png, and all of it as arrays in wall.npz."""
		moved = np.array(self.displacements)
		followed = {name: moved[:, brick] for name, (brick, _) in self.followed.items()}
		columns = {"time [s]": self.times}
		for name, rows in (*followed.items(), *((f"{name} corner", np.array(rows)) for name, rows in self.cornersMoved.items())):
			columns.update({f"{name} u{'xyz'[axis]} [m]": rows[:, axis] for axis in range(3)})
		columns.update({f"failed in {mode} [-]": counts for mode, counts in self.failures.items()})
		report.writeHistories(os.path.join(out, "histories.csv"), columns)
		picture.historyPlot(os.path.join(out, "histories.png"), self.times, followed, title=title)
		shown = [min(self.frames, key=lambda frame: abs(frame[0] - wanted)) for wanted in self.pictureTimes]
		limits = pictureLimits if view == "elevation" else None
		picture.pictureSeries(os.path.join(out, "wall.png"), shown, view=view, title=title, limits=limits)
		self.writeArrays(os.path.join(out, "wall.npz"))

	def writeArrays(self, path):
		"""time (m,) [s]; displacement of the bricks' centres (m, bricks, 3) and of the corners of A and B (m, 2, 3) [m]; failed (m, 3) in tension,
		shear, compression; step (m,), deformable (m,), asked (m,): number of step, of bricks that deform (those on the way to rigid too), and of bricks
		that are asked to; course (bricks,) from 0; of the shapes frameTime (f,) [s], frameCorners (f, bricks, 8, 3) [m], and their marks one after the other: markCount (f,), markPoint (.., 3) [m], markState.
		"""
		times, shapes, marks = zip(*self.frames)
		np.savez_compressed(
		        path,
		        time=self.times,
		        displacement=np.array(self.displacements),
		        corner=np.stack(list(self.cornersMoved.values()), axis=1),
		        failed=np.column_stack(list(self.failures.values())),
		        step=self.steps,
		        deformable=self.deformable,
		        asked=self.asked,
		        course=np.repeat(np.arange(len(self.masonry.courses)), [len(course) for course in self.masonry.courses]),
		        frameTime=times,
		        frameCorners=np.array([[patch.corners for patch in shape] for shape in shapes]),
		        markCount=[len(mark.states) for mark in marks],
		        markPoint=np.concatenate([mark.points for mark in marks]),
		        markState=np.concatenate([mark.states for mark in marks]),
		)
