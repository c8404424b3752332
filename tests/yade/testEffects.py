# SPDX-License-Identifier: GPL-2.0-or-later
# An effect that is switched off, or has nothing to do, leaves no trace: the result is to the last bit that of a scene that never had it.
# Terms of the law are in testLawVariants.py, levels of deformation in testLevels.py.
import unittest

import collapse
from yade import O, Vector3, utils
from yade.wrapper import ForceResetter, InsertionSortCollider, InteractionLoop, Bo1_Box_Aabb, Bo1_Wall_Aabb, NewtonIntegrator, PyRunner
from yade_brick import *

STEPS = 600
WEAK = dict(tensileStrength=2e3, cohesion=2e3, frictionAngle=.5, compressiveStrength=5e5)
STRONG = dict(tensileStrength=1e9, cohesion=1e9, frictionAngle=.5, compressiveStrength=1e9)


def wall(mortar=WEAK, lay=True, collider=True, boxes=False, stepper=BrickTimeStepper, runners=(), motions=(), **dynamics):
	"""A wall of 3 x 4 bricks of all levels, not at rest: its upper half flies off if its mortar is weak. The stepper is called for an engine, or None."""
	O.reset()
	O.materials.append(
	        BrickMat(young=9.8e6, poisson=.25, density=collapse.DENSITY, frictionAngle=.5, mortar=Mortar(**mortar) if mortar else None, dampingRatio=.02)
	)
	material = O.materials[0]
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
	for k in range(4):
		for i in range(3):
			centre = Vector3(collapse.SIDE * (i + .5), 0, collapse.SIDE * (k + .5))
			body = collapse.cube(centre, material, collapse.LEVELS[(i + 2 * k) % len(collapse.LEVELS)])
			body.state.vel = Vector3(.5, 1.5, .2) * (k > 1)
			O.bodies.append(body)
	bounds, pairs = [Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()]
	if boxes:
		bounds.append(Bo1_Box_Aabb())
		pairs.append(Ig2_Box_Brick_BrickGeom())
	engines = [
	        ForceResetter(),
	        InsertionSortCollider(bounds, verletDist=.01) if collider else None,
	        InteractionLoop(pairs, [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]),
	        stepper() if stepper else None, *runners,
	        BrickDynamics(**dynamics), *motions,
	        NewtonIntegrator(gravity=(0, 0, -9.8), damping=0),
	]
	O.engines = [engine for engine in engines if engine]
	if lay:
		MortarJoints()()


stepsToTake = []  # of a PyRunner [s]


def engine(kind):
	return next(engine for engine in O.engines if isinstance(engine, kind))


def run(steps=STEPS):
	for _ in range(steps):
		O.step()


class Effects(unittest.TestCase):

	def tearDown(self):
		O.trackEnergy = False
		O.reset()

	def sameAs(self, reference, failed=True):
		"""That the present scene has ended as another did.

		:param failed: whether segments are to have failed
		"""
		self.assertEqual(sum(collapse.failures()) > 0, failed)
		self.assertEqual(collapse.fingerprint(), reference)

	def collapsed(self, **options):
		"""Fingerprint of the scene with these options, run."""
		wall(**options)
		run()
		return collapse.fingerprint()

	def test_ledger_on_for_some_steps_and_off_again(self):
		never = self.collapsed()
		wall()
		run(100)
		O.trackEnergy = True
		run(200)
		self.assertIn('fracture', O.energy.keys())
		O.trackEnergy = False
		run(STEPS - 300)
		self.sameAs(never)

	def test_guard(self):
		on = self.collapsed()
		self.assertEqual(self.collapsed(guard=False), on)
		wall(guard=False)
		for guard in (True, False, True):
			engine(BrickDynamics).guard = guard
			run(STEPS // 3)
		self.sameAs(on)

	def test_ground_motion_of_zeros_or_dead_or_over(self):
		none = self.collapsed()
		still = dict(dt=1, acceleration=[Vector3.Zero] * 3)
		shaking = dict(dt=1, acceleration=[Vector3(5, 5, 5)] * 3)
		for motion in (GroundMotion(**still), GroundMotion(ids=[0], **still), GroundMotion(dead=True, **shaking), GroundMotion(startTime=-10, **shaking)):
			wall(motions=[motion])
			run()
			self.sameAs(none)

	def test_mortar_joints_that_find_no_mortar(self):
		none = self.collapsed(mortar=None, lay=False)
		wall(mortar=None)
		run()
		self.sameAs(none, failed=False)

	def test_collider_of_a_wall_that_stays_whole(self):
		with_ = self.collapsed(mortar=STRONG)
		wall(mortar=STRONG, collider=False)
		run()
		self.sameAs(with_, failed=False)

	def test_functors_that_no_body_asks_for(self):
		none = self.collapsed()
		wall(boxes=True)
		run()
		self.sameAs(none)

	def test_steps_of_the_stepper_set_by_hand(self):
		wall()
		given = []
		for _ in range(STEPS):
			O.step()
			given.append(O.dt)
		stepped = collapse.fingerprint()
		self.assertGreater(len(set(given)), 1)
		for stepper in (None, lambda: BrickTimeStepper(dead=True), lambda: BrickTimeStepper(active=False)):
			# where the stepper stands: the law still sees the step before
			wall(stepper=stepper, runners=[PyRunner(command='import testEffects; O.dt = testEffects.stepsToTake.pop(0)', iterPeriod=1, initRun=True)])
			stepsToTake[:] = given
			run()
			self.sameAs(stepped)
