# SPDX-License-Identifier: GPL-2.0-or-later
# Contact in the loop: supports of every kind carry, voussoirs lean, spinning bricks are not missed by the collider's strides, time steps hold.
import math, unittest

from yade import O, Quaternion, Vector3, wrapper, utils
from yade.wrapper import Bo1_Box_Aabb, Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator
from yade_brick import *

weight = 14.4 * 9.8  # of a brick of 0.2 m [N]


def adobe(**attributes):
	given = dict(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56)
	given.update(attributes)
	return BrickMat(**given)


def engines(gravity=9.8, damping=.2, verletDist=0):
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb()], verletDist=verletDist),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom(), Ig2_Box_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys(), Ip2_FrictMat_BrickMat_BrickPhys()],
	                [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(label='stepper'),
	        BrickDynamics(damping=damping),
	        NewtonIntegrator(damping=damping, gravity=(0, 0, -gravity)),
	]


class ContactCase(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_every_support_carries_every_kind_of_brick(self):
		supports = (
		        lambda x: utils.wall(0, axis=2, sense=1, material=wrapper.FrictMat()) if x == 0 else None,
		        lambda x: utils.box((x, 0, -.1), (.3, .3, .1), fixed=True, material=wrapper.FrictMat()),
		        lambda x: brick((1, 1, .2), center=(x, 0, -.1), material=adobe(), fixed=True),
		)
		for level in ('rigid', 'uniform', 'trilinear'):
			for support in supports:
				O.reset()
				below = O.bodies.append(support(0))
				O.bodies.append(brick((.2, .2, .2), center=(0, 0, .1), material=adobe(), deformation=level, contactThickness=2e-3))
				engines()
				O.run(4000, True)
				self.assertAlmostEqual(O.forces.f(below)[2] / weight, -1, delta=.01, msg='%s on support %d' % (level, supports.index(support)))

	def test_a_keystone_leans_on_its_springers(self):
		# faces 10 degrees from the vertical, no friction: two normal forces carry the weight, N = W / (2 sin 10 deg)
		slope, weight = math.tan(math.radians(10)), 1800 * 9.8 * (.2 * .2 * .2 + .2 * .2 * .2 * math.tan(math.radians(10)))
		keystone = [(x * (.1 + slope * z), y, z) for z in (0, .2) for x, y in ((-1, -.1), (1, -.1), (1, .1), (-1, .1))]
		springer = [(.1 + slope * z if inner else .4, y, z) for z in (0, .2) for inner, y in ((True, -.1), (False, -.1), (False, .1), (True, .1))]
		material = adobe(frictionAngle=0)
		key = O.bodies.append(brick(corners=keystone, material=material, contactThickness=2e-3))
		for turn in (0, math.pi):
			O.bodies.append(brick(corners=springer, orientation=Quaternion(Vector3(0, 0, 1), turn), material=material, contactThickness=2e-3, fixed=True))
		engines(damping=.4)
		O.run(10000, True)
		for side in (1, 2):
			force = O.interactions[key, side].phys.normalForce
			self.assertAlmostEqual(force.norm() * 2 * math.sin(math.radians(10)) / weight, 1, delta=.01)  # at rest to 1 %
			self.assertAlmostEqual(abs(force[2]) / force.norm(), math.sin(math.radians(10)), delta=1e-3)

	def test_a_turning_brick_is_not_missed_between_runs_of_the_collider(self):
		# the centre stands still, so YADE's strides see no motion; turning by 45 degrees the edge reaches the wall at 0.13 m
		for verletDist in (0, .01):
			O.reset()
			O.bodies.append(utils.wall(.13, axis=0, sense=-1, material=wrapper.FrictMat()))
			spinning = O.bodies.append(brick((.2, .2, .2), material=adobe()))
			engines(gravity=0, damping=0, verletDist=verletDist)
			O.bodies[spinning].state.angVel = (0, 0, 5)
			O.bodies[spinning].state.angMom = O.bodies[spinning].state.inertia[2] * Vector3(0, 0, 5)
			O.step()
			reached = False
			for _ in range(40):
				O.run(int(.005 / O.dt), True)
				reached = reached or any(i.isReal for i in O.interactions)
			self.assertTrue(reached)
			self.assertLess(O.bodies[spinning].state.pos[0], -1e-3)

	def test_time_step_is_bounded_by_the_stiffest_neighbour_and_never_grows(self):
		O.bodies.append(brick((.2, .2, .2), material=adobe(), fixed=True))
		O.bodies.append(brick((.2, .2, .2), center=(0, 0, .2), material=adobe()))
		engines()
		O.step()
		soft = stepper.limit
		self.assertEqual(O.dt, .9 * soft)
		O.bodies.append(brick((.2, .2, .2), center=(0, 0, .4), material=adobe(young=9.8e9)))
		O.run(2, True)
		self.assertLess(stepper.limit, soft / 10)  # sqrt(1000) stiffer
		self.assertEqual(stepper.limitingBrick, 2)
		stiff = stepper.limit
		O.bodies.erase(2)
		O.run(2, True)
		self.assertEqual(stepper.limit, stiff)

	def test_overlapping_supports_shorten_the_time_step(self):
		# the box and the wall both carry the whole lower face: twice the springs, sqrt(1/2) of the step
		steps = []
		for supports in (1, 2):
			O.reset()
			O.bodies.append(brick((.2, .2, .2), center=(0, 0, .1 - 1e-6), material=adobe(hn=0, hs=0), deformation='rigid'))
			O.bodies.append(utils.wall(0, axis=2, sense=1, material=wrapper.FrictMat()))
			if supports == 2: O.bodies.append(utils.box((0, 0, -.1), (.3, .3, .1), fixed=True, material=wrapper.FrictMat()))
			engines()
			O.step()
			steps.append(stepper.limit)
		self.assertLess(steps[1], .95 * steps[0])

	def test_a_deformed_brick_changes_its_element(self):
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=wrapper.FrictMat()))
		b = O.bodies[O.bodies.append(brick((.2, .2, .2), center=(0, 0, .1), material=adobe()))]
		b.shape.element = 'incompatible'
		engines()
		O.run(100, True)
		deformed = b.shape.amplitudes
		for name, value in (('element', 'bbar'), ('inner', 'full'), ('deformation', 'rigid'), ('contactThickness', 5e-3)):
			setattr(b.shape, name, value)
		b.shape.segments = 3
		self.assertEqual(b.shape.amplitudes, deformed)  # nothing jumps
		with self.assertRaisesRegex(ValueError, 'deformed'):
			b.shape.corners = [1.1 * corner for corner in b.shape.corners]
		O.run(10, True)

	def test_a_loop_without_brick_dynamics_is_refused(self):
		O.bodies.append(brick((.2, .2, .2), material=adobe()))
		engines()
		O.engines = O.engines[:-2] + O.engines[-1:]
		with self.assertRaisesRegex(RuntimeError, 'BrickDynamics'):
			O.step()

	def test_deep_penetration_is_counted(self):
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=wrapper.FrictMat()))
		O.bodies.append(brick((.2, .2, .2), center=(0, 0, .1 - 3e-3), material=adobe(), contactThickness=1e-3))
		engines()
		O.step()
		law = O.engines[2].lawDispatcher.functors[0]
		self.assertEqual(law.crushedContacts, 1)
		self.assertAlmostEqual(O.interactions[0, 1].phys.deepest, 3, delta=1e-6)
