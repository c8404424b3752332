# SPDX-License-Identifier: GPL-2.0-or-later
# What pictures are made from: corners of bricks, and joints that are followed until they are gone.
import math, os, tempfile, unittest

from yade import *
from yade import Quaternion, Vector3
import numpy as np
from yade_brick import BrickMat, Mortar, MortarJoints, build, picture, snapshot

phi = math.radians(32)


def couplet(**strengths):
	"""Two bricks on each other, the lower one fixed; dt is a tenth of the bound."""
	O.reset()
	mortar = Mortar(**{**dict(tensileStrength=1e3, cohesion=1e6, frictionAngle=phi, compressiveStrength=1e9), **strengths})
	adobe = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=phi, mortar=mortar)
	wall = build.straightJointWall(1, 2, material=adobe, segments=2)
	wall.bodies[0].dynamic = False
	O.bodies.append(wall.bodies)
	O.bodies.append(Body())
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb()], verletDist=0),
	        InteractionLoop([Ig2_Brick_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]),
	        BrickDynamics(),
	        NewtonIntegrator(damping=0),
	]
	O.dt = 2e-5
	MortarJoints()()
	O.step()
	return wall


class Patches(unittest.TestCase):

	def test_only_bricks_are_drawn_and_fixed_ones_are_supports(self):
		wall = couplet()
		found = snapshot.patches(O.bodies)
		self.assertEqual([patch.support for patch in found], [True, False])
		np.testing.assert_allclose(found[1].corners, [tuple(c) for c in wall.bodies[1].shape.worldCorners(wall.bodies[1].state)])

	def test_colours_are_those_chosen(self):
		wall = couplet()
		self.assertEqual([patch.color for patch in snapshot.patches(O.bodies)], [None, None])
		wall.bodies[1].shape.color = (0, 1, 0)
		self.assertEqual([patch.color for patch in snapshot.patches(O.bodies)], [None, (0, 1, 0)])
		self.assertEqual([patch.color for patch in snapshot.patches(O.bodies, {1: 2.5})], [None, 2.5])

	def test_scene_becomes_a_picture(self):
		couplet()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'couplet.png')
			picture.wallPicture(path, snapshot.patches(O.bodies), snapshot.JointRecord().marks(), time=O.time)
			self.assertGreater(os.path.getsize(path), 1000)


class Joints(unittest.TestCase):

	def test_segments_lie_in_the_joint(self):
		couplet()
		record = snapshot.JointRecord()
		marks = record.marks()
		self.assertEqual(record.segmentCount(), 4)
		self.assertEqual(sorted(marks.states), [0, 0, 0, 0])
		expected = [(x, y, .2) for x in (.05, .15) for y in (.05, .15)]
		# unloaded, one step: nothing has moved
		np.testing.assert_allclose(sorted(map(tuple, np.round(marks.points, 9))), expected, atol=1e-9)

	def test_segments_follow_the_bricks(self):
		wall = couplet()
		record = snapshot.JointRecord()
		for body in wall.bodies:
			body.state.pos += Vector3(1, 0, 0)
		self.assertAlmostEqual(record.marks().points[:, 0].mean(), 1.1, places=9)

	def test_segments_turn_with_the_bricks(self):
		wall = couplet()
		record = snapshot.JointRecord()
		before, turn = record.marks().points, Quaternion((1, 2, 3), 2)
		for body in wall.bodies:
			body.state.pos, body.state.ori = turn * body.state.pos, turn * body.state.ori
		expected = [tuple(turn * Vector3(*map(float, point))) for point in before]
		# coordinates below 1 m, round-off of some operations
		np.testing.assert_allclose(record.marks().points, expected, atol=1e-14)

	def test_wide_cracks_are_left_out(self):
		wall = couplet()
		record = snapshot.JointRecord()
		wall.bodies[1].state.pos += Vector3(0, 0, .03)
		self.assertEqual(len(record.marks().points), 0)
		np.testing.assert_allclose(record.marks(widest=.04).points[:, 2], .215, atol=1e-9)

	def test_joint_that_is_pulled_apart_between_two_looks_has_failed_unseen(self):
		wall = couplet()
		record = snapshot.JointRecord()
		wall.bodies[1].state.vel = Vector3(0, 0, 1)
		O.run(2000, True)
		record.update()
		failed = record.failedByMode()
		self.assertEqual(sum(failed.values()), 4)
		self.assertEqual(failed['shear'] + failed['compression'], 0)

	def test_failures_stay_as_they_were_seen(self):
		wall = couplet()
		record = snapshot.JointRecord()
		# A spin about y opens the joint from one side: its far segments fail first, the near ones a little later.
		wall.bodies[1].state.angVel = Vector3(0, 2, 0)
		wall.bodies[1].state.angMom = Vector3(0, 2 * wall.bodies[1].state.inertia[1], 0)
		for _ in range(200):
			for _ in range(5):
				O.step()
			record.update()
		first = record.failedByMode()
		self.assertGreater(first['tension'], 0)
		wall.bodies[1].state.vel = Vector3(0, 0, 2)
		O.run(2000, True)
		record.update()
		last = record.failedByMode()
		self.assertEqual(sum(last.values()), 4)
		self.assertGreaterEqual(last['tension'], first['tension'])

	def test_scene_without_joints_is_refused(self):
		O.reset()
		with self.assertRaisesRegex(ValueError, 'no mortar joint'):
			snapshot.JointRecord()
