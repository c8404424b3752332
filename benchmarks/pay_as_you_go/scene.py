# SPDX-License-Identifier: GPL-2.0-or-later
# A wall with the effects that are asked for and no others. Counts the instructions of its steps when callgrind watches, and tells the bytes that it takes.
"""One or more scenes, each given by what differs from the minimal one (effects.Scene), as JSON:

    build/yade -n -x -j1 benchmarks/pay_as_you_go/scene.py '{}' '{"guard": true, "bricks": 6}'

Leaves a line of JSON for each: its name, bricks, the bytes that malloc has given for it, and its joints, contacts and failed segments.
With SWITCH=<libcallgrindSwitch.so> in the environment and under callgrind, the counted steps of each scene become a file of callgrind's.
"""

import ctypes
import gc
import json
import math
import os
import sys

from yade import O, Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator, Quaternion, Vector3
from yade.utils import wall as supportingWall

import yade_brick

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from effects import Scene

side, warmSteps = 0.2, 10
fixedStep = 5e-6  # stable with every effect [s]
# of rigid and of other bricks: opens joints beyond what mortar holds, and closes them by a fraction of what crushes it [rad]
tilt = {True: 1.5e-3, False: 1e-4}
overlap = 1e-5  # of dry bricks, by the brick

mortar = yade_brick.Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=math.radians(32), compressiveStrength=4.9e5)
adobe = yade_brick.BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=math.radians(32), mortar=mortar)


class Built:
	"""A scene of YADE, ready to run."""

	def __init__(self, options):
		O.reset()
		self.options = options
		O.trackEnergy = options.ledger
		O.dt = fixedStep
		O.bodies.append(supportingWall(0, axis=2, sense=1, material=adobe))
		self.courses = [[O.bodies[O.bodies.append(body)] for body in course] for course in self.masonry()]
		self.makeEngines()
		if options.joints != "dry":
			self.layMortar()
		if options.joints == "cracked":
			self.bend()
		if options.joints == "dry":
			self.press()

	@property
	def bricks(self):
		return [body for course in self.courses for body in course]

	def masonry(self):
		return yade_brick.straightJointWall(
		        self.options.bricks, self.options.bricks, size=3 * (side, ), material=adobe, deformation=self.options.deformation, contactThickness=5e-3
		).courses

	def makeEngines(self):
		options = self.options
		self.law = yade_brick.Law2_BrickGeom_BrickPhys_Mortar(
		        failure=options.failure or options.joints == "cracked", friction=options.friction, dashpots=options.dashpots
		)
		self.collider = InsertionSortCollider([yade_brick.Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0.01)
		self.loop = InteractionLoop(
		        [yade_brick.Ig2_Brick_Brick_BrickGeom(), yade_brick.Ig2_Wall_Brick_BrickGeom()], [yade_brick.Ip2_BrickMat_BrickMat_BrickPhys()], [self.law]
		)
		self.stepper = yade_brick.BrickTimeStepper(safety=0.015)  # about the fixed step, so that the states are much the same
		self.dynamics = yade_brick.BrickDynamics(guard=options.guard, stopFile="")
		self.motion = yade_brick.GroundMotion(dt=1, acceleration=2 * [Vector3(1, 0, 0)])
		self.onDemand = yade_brick.DeformationOnDemand() if options.onDemand else None
		newton = NewtonIntegrator(damping=0, gravity=(0, 0, -9.8))
		newton.dead = options.joints == "dry"  # what a search has to do hangs on places to the last bit
		engines = [
		        ForceResetter(), options.contact and self.collider, self.loop, options.stepper and self.stepper, self.onDemand, self.dynamics,
		        options.motion and self.motion, newton
		]
		O.engines = [engine for engine in engines if engine]

	def layMortar(self):
		if not self.options.searchCore:
			yade_brick.MortarJoints()()
			return
		# bricks that are joined one pair after the other are not known to be neighbours at an edge
		rows = [[O.bodies[0]] * self.options.bricks] + self.courses
		pairs = [(lower, upper) for below, above in zip(rows, rows[1:]) for lower, upper in zip(below, above)]
		pairs += [(left, right) for course in self.courses for left, right in zip(course, course[1:])]
		for pair in pairs:
			yade_brick.MortarJoints(ids=[body.id for body in pair])()

	def bend(self):
		"""Turns every other brick one way in the plane, and the others the other way."""
		angle = tilt[self.options.deformation == "rigid"]
		for k, course in enumerate(self.courses):
			for i, body in enumerate(course):
				body.state.ori = Quaternion((0, 1, 0), angle if (i + k) % 2 else -angle)

	def press(self):
		"""Has bricks overlap a little, and courses slide on each other; they stay where they are."""
		for k, course in enumerate(self.courses):
			for body in course:
				x, y, z = body.state.pos
				body.state.pos = ((1 - overlap) * x, y, (1 - overlap) * z - overlap * side / 2)
				body.state.vel = (0.1 if k % 2 else -0.1, 0, 0)

	def end(self):
		"""Switches off what the scene was not meant to have any more, and what was only needed to crack joints."""
		self.law.failure = self.options.failure
		name = self.options.ended
		if name == "deformation":
			self.dynamics.levelTime = 0  # at once
			for body in self.bricks:
				body.shape.deformation = "rigid"
		elif name == "ledger":
			O.trackEnergy = False
		elif name == "guard":
			self.dynamics.guard = False
		elif name in ("failure", "friction", "dashpots"):
			setattr(self.law, name, False)
		elif name in ("motion", "stepper", "onDemand"):
			getattr(self, name).dead = True
		elif name:
			raise ValueError(f"ended is {name!r}; that cannot be switched off")


class MallocInfo(ctypes.Structure):
	"""What mallinfo2 of the C library returns."""

	names = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"
	_fields_ = [(name, ctypes.c_size_t) for name in names.split()]


mallinfo = ctypes.CDLL(None).mallinfo2
mallinfo.restype = MallocInfo


def allocatedBytes():
	"""What malloc has given and not got back; small Python objects, which are Python's own, are not in it."""
	gc.collect()
	info = mallinfo()
	return info.uordblks + info.hblkhd


def run(steps):
	for _ in range(steps):
		O.step()


def measure(options, switch):
	"""Builds and runs a scene; its line."""
	O.reset()
	before = allocatedBytes()
	built = Built(options)
	run(warmSteps)
	built.end()
	run(warmSteps)
	taken = allocatedBytes() - before
	if switch:
		switch.startCounting()
	run(options.steps)
	if switch:
		switch.endCounting(options.name.encode())
	if built.onDemand and built.onDemand.promoted:
		raise RuntimeError(f"{built.onDemand.promoted} bricks deform in a scene where all have to stay rigid")
	real = [i for i in O.interactions if i.isReal]
	joints = [i.phys for i in real if i.phys.jointed]
	failed = sum(state > 0 for phys in joints for state in phys.segmentState)
	facts = {"bricks": len(built.bricks), "steps": options.steps, "bytes": taken, "joints": len(joints), "contacts": len(real) - len(joints), "failed": failed}
	return {"scene": options.name, **facts}


def main(arguments):
	switch = ctypes.CDLL(os.environ["SWITCH"]) if "SWITCH" in os.environ else None
	measure(Scene(bricks=2), None)  # what is made once and for all
	for argument in arguments:
		options = Scene(**json.loads(argument))
		try:
			line = measure(options, switch)
		except Exception as trouble:
			line = {"scene": options.name, "trouble": f"{type(trouble).__name__}: {trouble}"}
		print(json.dumps(line), flush=True)


main(sys.argv[1:])
