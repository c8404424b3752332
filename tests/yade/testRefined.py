# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks whose inner part is several elements: what may be asked of them, and that they fall, rest, crack and keep their momentum as other bricks do.
# Threads, vector instructions, saving and loading: collapse.py has such bricks among others. Accuracy: tests/verification/testRefined.py.
import math
import unittest

import numpy as np
import yade_brick
from yade import O, Vector3, utils, wrapper
from yade_brick import Brick, BrickDynamics, BrickMat, BrickTimeStepper, MortarJoints, brick

SIDE = .2


def clay(mortar=None):
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=math.radians(32), mortar=mortar)


def mortar(strength=1e9):
	return yade_brick.Mortar(tensileStrength=strength, cohesion=strength, frictionAngle=.5, compressiveStrength=1e12)


def engines(gravity=9.8, damping=0):
	O.engines = [
	        wrapper.ForceResetter(),
	        wrapper.InsertionSortCollider([yade_brick.Bo1_Brick_Aabb(), wrapper.Bo1_Wall_Aabb()], verletDist=0),
	        wrapper.InteractionLoop(
	                [yade_brick.Ig2_Brick_Brick_BrickGeom(), yade_brick.Ig2_Wall_Brick_BrickGeom()], [yade_brick.Ip2_BrickMat_BrickMat_BrickPhys()],
	                [yade_brick.Law2_BrickGeom_BrickPhys_Mortar(label='law')]
	        ),
	        BrickTimeStepper(),
	        BrickDynamics(damping=damping),
	        wrapper.NewtonIntegrator(damping=damping, gravity=(0, 0, -gravity)),
	]


def momentum(bodies):
	"""Linear [kg m/s], and angular about the origin [kg m2/s]."""
	linear, angular = Vector3.Zero, Vector3.Zero
	for b in bodies:
		s = b.state
		spin = s.ori * Vector3(*(s.inertia[k] * (s.ori.conjugate() * s.angVel)[k] for k in range(3)))
		linear += s.mass * s.vel
		angular += s.pos.cross(s.mass * s.vel) + spin
	return np.array([*linear, *angular])


class Asked(unittest.TestCase):

	def setUp(self):
		O.reset()

	def refused(self, parts, **options):
		with self.assertRaises(ValueError) as caught:
			brick((SIDE,) * 3, material=clay(), **options)
		for part in parts:
			self.assertIn(part, str(caught.exception))

	def test_cells_out_of_range(self):
		self.refused(['Brick.cells: 0', '1 to 8'], deformation='refined', cells=0)
		self.refused(['Brick.cells: 9', '1 to 8'], deformation='refined', cells=9, segments=9)

	def test_segments_that_cells_cut(self):
		self.refused(['4 segments', 'cells = 3', 'multiple'], deformation='refined', cells=3)

	def test_cells_of_a_brick_that_has_none(self):
		self.refused(['cells is 2', "'trilinear'", "deformation='refined'"], cells=2)

	def test_nodes_and_modes(self):
		for cells, nodes in ((1, 8), (2, 26), (3, 56)):
			O.reset()
			b = O.bodies[O.bodies.append(brick((SIDE,) * 3, material=clay(), deformation='refined', cells=cells, segments=6))]
			engines()
			O.step()
			self.assertEqual(len(b.shape.displacement), nodes)
			self.assertEqual(len(b.shape.amplitudes), 3 * nodes - 6)
			self.assertEqual(len(b.shape.worldCorners(b.state)), 8)

	def test_cells_of_a_deformed_brick_change_by_the_rigid_one(self):
		b = O.bodies[O.bodies.append(brick((SIDE,) * 3, center=(0, 0, SIDE / 2 - 1e-5), material=clay(), deformation='refined', segments=8))]
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=b.material))
		engines(damping=.3)
		O.engines[4].levelTime = .02
		O.run(5, True)
		b.shape.cells = 4
		nodes = []
		while len(nodes) < 3 or b.shape.share < 1:
			O.step()
			nodes.append(len(b.shape.displacement))
		self.assertEqual(list(dict.fromkeys(nodes)), [26, 98])
		O.run(2000, True)
		bottom = next(i for i in O.interactions if i.isReal).phys.normalForce.norm()
		self.assertAlmostEqual(bottom, 9.8 * b.state.mass, delta=1e-3 * 9.8 * b.state.mass)

	def test_a_refused_change_leaves_the_brick_as_it_was(self):
		material = clay(mortar())
		O.materials.append(material)
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
		b = O.bodies[O.bodies.append(brick((SIDE,) * 3, center=(0, 0, SIDE / 2), material=material, deformation='refined'))]
		engines()
		MortarJoints()()
		O.run(5, True)
		for attribute, value, text in (('cells', 4, 'joints cannot change'), ('contactThickness', .2, 'thickness'), ('deformation', 'trilinear', 'joints cannot')):
			before = getattr(b.shape, attribute)
			with self.assertRaisesRegex(ValueError, text):
				setattr(b.shape, attribute, value)
			setattr(b.shape, attribute, before)
		material.young *= 1.01
		O.run(5, True)
		self.assertEqual(len(b.shape.displacement), 26)
		self.assertTrue(all(math.isfinite(x) for x in b.shape.stress()))

	def test_help_says_what_cells_are(self):
		self.assertIn('Elements along each edge', Brick.cells.__doc__)


class Moving(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_a_brick_comes_to_rest_on_the_ground_and_on_another(self):
		for cells in (2, 3):
			O.reset()
			material = clay()
			O.materials.append(material)
			O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
			options = dict(material=material, deformation='refined', cells=cells, segments=6, contactThickness=2e-3)
			lower, upper = (O.bodies[O.bodies.append(brick((SIDE,) * 3, center=(x, 0, z), **options))] for x, z in ((0, .5 * SIDE), (.3 * SIDE, 1.5 * SIDE)))
			engines(damping=.3)
			O.run(3000, True)
			weight = 9.8 * lower.state.mass
			onGround, between = O.interactions[0, lower.id], O.interactions[lower.id, upper.id]
			self.assertAlmostEqual(onGround.phys.normalForce.norm() / (2 * weight), 1, delta=1e-3)
			self.assertAlmostEqual(between.phys.normalForce.norm() / weight, 1, delta=1e-3)
			self.assertLess(lower.shape.stress()[2], -9.8 * 1800 * SIDE)  # its own half, and the other's weight on 0.7 of its area
			self.assertGreater(np.ptp([u[2] for u in lower.shape.displacement]), 0)

	def test_what_hits_something_keeps_its_momentum(self):
		material = clay()
		options = dict(material=material, contactThickness=5e-3)
		one = brick((SIDE,) * 3, deformation='refined', cells=2, **options)
		other = brick((SIDE,) * 3, center=(1.2 * SIDE, .3 * SIDE, .1 * SIDE), orientation=utils.Quaternion((1, 2, 3), .4), deformation='refined', cells=4, **options)
		O.bodies.append([one, other])
		engines(gravity=0)
		one.state.vel, one.state.angVel = Vector3(3, 0, 0), Vector3(0, 1, 2)
		one.state.angMom = Vector3(*(one.state.inertia[k] * one.state.angVel[k] for k in range(3)))
		before, touched = momentum([one, other]), False
		for _ in range(400):
			O.step()
			touched = touched or any(i.isReal for i in O.interactions)
		self.assertTrue(touched)
		self.assertGreater(other.state.vel.norm(), .1)
		# contact acts at one place on both: what is left is the half step between velocities and places, and round-off of the orientation
		np.testing.assert_allclose(momentum([one, other]), before, rtol=0, atol=2e-3 * np.abs(before).max())

	def test_joints_of_refined_bricks_crack_and_go_on_as_contact(self):
		material = clay(mortar(2e3))
		O.materials.append(material)
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
		O.bodies.append([brick((SIDE,) * 3, center=(0, 0, SIDE * (k + .5)), material=material, deformation='refined', contactThickness=5e-3) for k in range(2)])
		engines()
		MortarJoints()()
		self.assertEqual(len(O.interactions[1, 2].phys.segmentState), 16)
		O.step()
		O.bodies[2].state.vel, O.bodies[2].state.angVel = Vector3(.6, 0, 0), Vector3(0, 3, 0)
		O.run(4000, True)
		law = O.engines[2].lawDispatcher.functors[0]
		self.assertGreaterEqual(law.tensionFailures + law.shearFailures + law.compressionFailures, 16)
		self.assertFalse(O.interactions[1, 2].phys.jointed if O.interactions.has(1, 2) else False)
		for b in O.bodies:
			self.assertTrue(all(math.isfinite(x) for x in b.state.pos))

	def test_one_cell_is_the_trilinear_brick(self):
		ends = []
		for options in (dict(deformation='trilinear'), dict(deformation='refined', cells=1)):
			O.reset()
			material = clay(mortar())
			O.materials.append(material)
			O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
			O.bodies.append([brick((SIDE,) * 3, center=(0, 0, SIDE * (k + .5)), material=material, contactThickness=5e-3, **options) for k in range(2)])
			engines()
			MortarJoints()()
			O.dt = 1e-4
			O.engines[3].active = False
			O.bodies[2].state.vel = Vector3(.01, 0, 0)
			O.run(200, True)
			ends.append(np.array([tuple(corner) for k in (1, 2) for corner in O.bodies[k].shape.worldCorners(O.bodies[k].state)]))
		np.testing.assert_allclose(ends[1], ends[0], rtol=0, atol=1e-10)  # of displacements of 1e-4 m: modes of one frequency may be mixed otherwise


if __name__ == '__main__':
	unittest.main()
