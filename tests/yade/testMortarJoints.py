# SPDX-License-Identifier: GPL-2.0-or-later
# MortarJoints: which faces are joined, how their overlap is cut, what mortar they get.
import unittest

from yade import O, Vector3, wrapper, utils
from yade.wrapper import Bo1_Box_Aabb, Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator
from yade_brick import *


def mortar(**attributes):
	given = dict(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=.56, compressiveStrength=4.9e5)
	given.update(attributes)
	return Mortar(**given)


def adobe(**attributes):
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56, **attributes)


def joints():
	return {(i.id1, i.id2): i for i in O.interactions if i.phys.jointed}


def engines(gravity=0):
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb()], verletDist=0),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom(), Ig2_Box_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys(), Ip2_FrictMat_BrickMat_BrickPhys()],
	                [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(),
	        BrickDynamics(damping=.3),
	        NewtonIntegrator(damping=.3, gravity=(0, 0, -gravity)),
	]


class MortarJointsCase(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_straight_wall_has_a_full_joint_between_all_neighbours(self):
		O.bodies.append(straightJointWall(3, 2, material=adobe(mortar=mortar())).bodies)
		joining = MortarJoints()
		joining()
		self.assertEqual((joining.made, joining.dead), (7, True))
		for i in joints().values():
			self.assertEqual(len(i.phys.segmentState), 16)
			self.assertAlmostEqual(sum(i.phys.segmentArea), .04, delta=1e-16)

	def test_staggered_bricks_share_partial_joints(self):
		wall = englishBondWall(2, 2, material=adobe(mortar=mortar()))
		O.bodies.append(wall.bodies)
		MortarJoints()()
		whole, over = wall.courses[0][0].id, wall.courses[1][1].id
		i = joints()[(whole, over)]
		self.assertAlmostEqual(sum(i.phys.segmentArea), .02, delta=1e-16)
		self.assertEqual(len(i.phys.segmentState), 8)  # 2 x 4 of the faces' own size

	def test_walls_boxes_and_fixed_bricks_support(self):
		material = adobe(mortar=mortar())
		bricks = [O.bodies.append(brick((.2, .2, .2), center=(x, 0, x + .1), material=material)) for x in (0, 1, 2)]
		supports = [
		        O.bodies.append(utils.wall(0, axis=2, sense=1, material=wrapper.FrictMat())),
		        O.bodies.append(utils.box((1, 0, .9), (.3, .3, .1), fixed=True, material=wrapper.FrictMat())),
		        O.bodies.append(brick((1, 1, .2), center=(2, 0, 1.9), material=material, fixed=True))
		]
		engines(gravity=9.8)
		for support, on in zip(supports, bricks):
			MortarJoints(ids=[support, on])()
		O.run(3000, True)
		for support, on in zip(supports, bricks):
			self.assertTrue(O.interactions[support, on].phys.jointed)
			self.assertAlmostEqual(O.forces.f(support)[2], -14.4 * 9.8, delta=.01 * 14.4 * 9.8)  # at rest to 1 %

	def test_bed_and_head_joints_can_differ(self):
		O.bodies.append(straightJointWall(2, 2, material=adobe(mortar=mortar())).bodies)
		beds = MortarJoints(normal=(0, 0, 1), mortar=mortar(tensileStrength=1))
		beds()
		others = MortarJoints()
		others()
		self.assertEqual((beds.made, others.made), (2, 2))

	def test_thick_mortar_is_in_series_with_the_bricks(self):
		r, t, soft = 2e-3, 3e-3, 1e6
		O.bodies.append(straightJointWall(2, 1, material=adobe(mortar=mortar(thickness=t, young=soft, poisson=.2)), contactThickness=r).bodies)
		engines()
		MortarJoints()()
		O.step()
		kn = .04 / (2 * (r - t / 2) * (1 - .25**2) / 9.8e6 + t * (1 - .2**2) / soft)  # eq. (2) times the area
		self.assertAlmostEqual(joints()[(0, 1)].phys.kn / kn, 1, delta=1e-12)

	def test_bricks_without_mortar_and_bricks_apart_are_not_joined(self):
		O.bodies.append(straightJointWall(2, 1, material=adobe()).bodies)
		O.bodies.append(brick((.2, .2, .2), center=(5, 0, 0), material=adobe(mortar=mortar())))
		O.bodies.append(brick((.2, .2, .2), center=(5.2001, 0, 0), material=adobe(mortar=mortar())))
		MortarJoints()()
		self.assertEqual(len(joints()), 0)
		MortarJoints(tolerance=1e-3)()
		self.assertEqual(len(joints()), 1)

	def test_missing_strength_different_mortar_and_thick_mortar_are_refused(self):
		for words, first, second in (
		        ('cohesion', Mortar(tensileStrength=1, frictionAngle=.5, compressiveStrength=1), None),
		        ('different mortar', mortar(), mortar(tensileStrength=1)),
		        ('twice', mortar(thickness=.01), None)
		):
			O.reset()
			O.bodies.append(brick((.2, .2, .2), center=(0, 0, 0), material=adobe(mortar=first), contactThickness=1e-3))
			O.bodies.append(brick((.2, .2, .2), center=(.2, 0, 0), material=adobe(mortar=second or first), contactThickness=1e-3))
			with self.assertRaisesRegex(ValueError, words):
				MortarJoints()()
