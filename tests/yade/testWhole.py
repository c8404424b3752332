# SPDX-License-Identifier: GPL-2.0-or-later
# What a scene is spared while its joints hold, and that it gets it back when one does not: contact search between bricks laid edge to edge, lists of
# who acts on whom, time measured by stage only when asked for.
import math
import unittest

import yade_brick
from yade import O, Vector3, utils, wrapper
from yade_brick import Bill, BrickTimeStepper, MortarJoints, StaticEquilibrium, straightJointWall


def adobe(strength=1e9, mortar=True):
	filling = yade_brick.Mortar(tensileStrength=strength, cohesion=strength, frictionAngle=math.radians(32), compressiveStrength=1e12)
	return yade_brick.BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=math.radians(32), mortar=filling if mortar else None)


def engines(gravity=9.8):
	O.engines = [
	        wrapper.ForceResetter(),
	        wrapper.InsertionSortCollider([yade_brick.Bo1_Brick_Aabb(), wrapper.Bo1_Wall_Aabb()], verletDist=.01),
	        wrapper.InteractionLoop(
	                [yade_brick.Ig2_Brick_Brick_BrickGeom(), yade_brick.Ig2_Wall_Brick_BrickGeom()], [yade_brick.Ip2_BrickMat_BrickMat_BrickPhys()],
	                [yade_brick.Law2_BrickGeom_BrickPhys_Mortar(label='law')]
	        ),
	        BrickTimeStepper(),
	        yade_brick.BrickDynamics(),
	        wrapper.NewtonIntegrator(damping=0, gravity=(0, 0, -gravity)),
	]


def wall(columns=3, courses=3, material=None, joints=MortarJoints):
	"""A settled wall on the ground."""
	O.reset()
	material = material or adobe()
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
	masonry = straightJointWall(columns, courses, material=material, contactThickness=2e-3)
	O.bodies.append(masonry.bodies)
	engines()
	joints()()
	return masonry


def contacts():
	return {(i.id1, i.id2) for i in O.interactions if i.isReal and not i.phys.jointed}


class EdgeToEdge(unittest.TestCase):

	def test_diagonal_neighbours_of_a_wall_are_known_and_not_searched(self):
		masonry = wall()
		StaticEquilibrium()()
		O.run(50, True)
		middle = masonry.courses[1][1]
		self.assertTrue(middle.shape.whole)
		self.assertEqual(middle.shape.joints, 4)
		self.assertEqual(sorted(middle.shape.beside), sorted(masonry.courses[k][i].id for k in (0, 2) for i in (0, 2)))
		self.assertEqual(contacts(), set())

	def test_they_are_searched_once_a_joint_of_theirs_has_failed(self):
		masonry = wall()
		StaticEquilibrium()()
		O.run(5, True)
		a, b = masonry.courses[0][0], masonry.courses[1][1]
		O.interactions.erase(a.id, masonry.courses[1][0].id)
		O.step()
		self.assertFalse(a.shape.whole)
		self.assertTrue(b.shape.whole)
		b.state.vel = (0, 0, -2.)  # to be felt at once
		touched = set()
		for _ in range(30):
			O.step()
			touched |= contacts()
		self.assertIn((a.id, b.id), touched)

	def test_they_are_no_interactions_until_a_joint_has_failed(self):
		masonry = wall()
		StaticEquilibrium()()
		O.run(5, True)
		a, b = masonry.courses[0][0], masonry.courses[1][1]
		self.assertFalse(O.interactions.has(a.id, b.id))
		self.assertEqual(len([i for i in O.interactions if not i.isReal]), 0)
		O.interactions.erase(a.id, masonry.courses[1][0].id)
		O.step()
		self.assertTrue(O.interactions.has(a.id, b.id))
		self.assertFalse(O.interactions.has(masonry.courses[0][1].id, masonry.courses[1][2].id))

	def test_bricks_that_are_side_by_side_without_mortar_are_searched(self):
		masonry = wall(joints=lambda: MortarJoints(normal=(0, 0, 1)))
		self.assertEqual(masonry.courses[1][1].shape.joints, 2)
		self.assertNotIn(masonry.courses[1][0].id, masonry.courses[1][1].shape.beside)
		O.run(200, True)
		self.assertTrue(any(i.isReal and not i.phys.jointed and abs(i.geom.normal[0]) > .9 for i in O.interactions), 'they bulge and press on each other')

	def test_bricks_without_joints_are_never_whole(self):
		masonry = wall(material=adobe(mortar=False))
		O.run(5, True)
		self.assertFalse(any(b.shape.whole for b in masonry.bodies))


class WhoActs(unittest.TestCase):

	def test_an_interaction_that_was_erased_acts_no_more(self):
		masonry = wall(1, 2)
		StaticEquilibrium()()
		O.run(3, True)
		lower, upper = masonry.bodies
		weight = upper.state.mass * 9.8
		self.assertAlmostEqual(O.forces.f(upper.id)[2], weight, delta=1e-6 * weight)
		O.interactions.erase(lower.id, upper.id)
		upper.state.pos += Vector3(0, 0, .1)
		O.step()
		self.assertEqual(O.forces.f(upper.id).norm(), 0)

	def test_a_brick_that_comes_to_rest_on_another_is_felt_by_it(self):
		masonry = wall(1, 1)
		above = yade_brick.brick((.2, .2, .2), center=(masonry.bodies[0].state.pos[0], 0, .3005), material=masonry.bodies[0].material, contactThickness=2e-3)
		O.bodies.append(above)
		O.run(400, True)
		self.assertTrue(any(above.id in pair for pair in contacts()))
		self.assertGreater(O.forces.f(above.id)[2], 0)


class Stages(unittest.TestCase):

	def test_functors_keep_time_only_when_it_is_asked_for(self):
		wall()
		loop = O.engines[2]
		O.run(10, True)
		self.assertEqual((loop.geomDispatcher.functors[0].seconds, loop.lawDispatcher.functors[0].jointSeconds), (0, 0))
		with Bill() as bill:
			O.run(200, True)
		self.assertFalse(O.timingEnabled)
		facts = bill.facts()
		self.assertEqual(facts['steps'], 200)
		for stage in ('detection', 'joints', 'dynamics', 'YADE'):
			self.assertGreater(facts['stages'][stage]['seconds'], 0, stage)

	def test_the_face_that_limits_the_step_is_named(self):
		wall()
		O.step()
		self.assertIn(O.engines[3].limitingFace, range(6))


if __name__ == '__main__':
	unittest.main()
