# SPDX-License-Identifier: GPL-2.0-or-later
# StaticEquilibrium, IntactAssembly and the criterion of rest: what they take from the scene, what they leave, what they refuse.
import math, unittest

import numpy as np

from yade import O, Vector3, utils
from yade.wrapper import Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator
from yade_brick import *

SIDE = .2


class Scene(unittest.TestCase):

	def setUp(self):
		O.reset()

	def engines(self):
		O.engines = [
		        ForceResetter(),
		        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
		        InteractionLoop(
		                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]
		        ),
		        BrickTimeStepper(),
		        BrickDynamics(),
		        NewtonIntegrator(damping=0, gravity=(0, 0, -9.8)),
		]

	def tower(self, tensileStrength=1e9, **options):
		mortar = Mortar(tensileStrength=tensileStrength, cohesion=1e9, frictionAngle=.56, compressiveStrength=1e9)
		O.materials.append(BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56, mortar=mortar))
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=O.materials[-1]))
		self.bricks = [brick((SIDE, SIDE, SIDE), center=(0, 0, SIDE * (k + .5)), material=O.materials[-1], **options) for k in range(3)]
		O.bodies.append(self.bricks)
		self.engines()

	def expectRefusal(self, error, words, call):
		with self.assertRaises(error) as caught:
			call()
		for word in words:
			self.assertIn(word, str(caught.exception))


class StaticEquilibriumCase(Scene):

	def test_loop_keeps_the_state(self):
		for options in (dict(deformation='rigid'), dict(deformation='uniform'), dict(element='incompatible'), dict(inner='full', contactThickness=.005)):
			O.reset()
			self.tower(**options)
			MortarJoints()()
			rest = StaticEquilibrium()
			rest()
			self.assertTrue(rest.dead)
			self.assertLess(rest.imbalance, 1e-8)
			O.step()
			before = [b.state.pos for b in self.bricks]
			state = restState()
			self.assertLess(state.imbalance, 1e-6)  # round-off of lengths times springs of 2e8 N/m, over forces of some 100 N
			self.assertLess(state.energyRatio, 1e-12)
			self.assertAlmostEqual(state.elastic / rest.elasticEnergy, 1, delta=1e-6)
			O.run(300, True)
			self.assertLess(max((b.state.pos - x).norm() for b, x in zip(self.bricks, before)), 1e-11)

	def test_works_once_as_an_engine(self):
		self.tower()
		O.engines = [MortarJoints(), StaticEquilibrium(label='rest')] + O.engines
		O.run(5, True)
		self.assertTrue(O.engines[1].dead)
		self.assertTrue(isAtRest())

	def test_takes_gravity_and_permanent_forces(self):
		self.tower(deformation='rigid')
		MortarJoints()()
		top = self.bricks[-1]
		O.forces.setPermF(top.id, (0, 0, 3 * top.state.mass * 9.8))
		StaticEquilibrium()()
		lifted = top.state.displ()[2]
		self.assertAlmostEqual(self.bricks[0].state.displ()[2], 0, delta=1e-14)  # weight of three, lift of three
		self.assertGreater(lifted, 0)
		O.forces.setPermF(top.id, (0, 0, 0))
		StaticEquilibrium(gravity=(0, 0, 9.8))()
		self.assertGreater(self.bricks[0].state.displ()[2], 0)

	def test_takes_velocities_away(self):
		self.tower()
		MortarJoints()()
		for b in self.bricks:
			b.state.vel, b.state.angVel = (1, 2, 3), (4, 5, 6)
		StaticEquilibrium()()
		for b in self.bricks:
			self.assertEqual((b.state.vel, b.state.angVel, b.state.angMom), (Vector3.Zero,) * 3)

	def test_counts_what_will_crack(self):
		self.tower(tensileStrength=100, deformation='rigid')
		MortarJoints()()
		rest = StaticEquilibrium(gravity=(0, 0, 9.8))
		rest()
		self.assertEqual(rest.overloaded, 48)  # three joints hang on 100 Pa; the last bears 3528 Pa
		O.step()
		self.assertEqual(O.engines[2].lawDispatcher.functors[0].tensionFailures, 48)

	def test_refuses_bricks_that_nothing_holds_and_leaves_the_scene(self):
		self.tower()
		MortarJoints(ids=[0, 1, 2])()
		before = [b.state.pos for b in self.bricks]
		self.expectRefusal(RuntimeError, ('#3', 'not held'), StaticEquilibrium())
		self.assertEqual(before, [b.state.pos for b in self.bricks])

	def test_refuses_a_joint_of_one_row_of_segments(self):
		self.tower()
		flat = [brick((.4, .1, .1), center=(2, 0, .05 + .1 * k), material=O.materials[-1], deformation='rigid', fixed=k == 0) for k in range(2)]
		O.bodies.append(flat)
		MortarJoints()()
		self.expectRefusal(RuntimeError, ('#%d' % flat[1].id, 'single row', 'segments'), StaticEquilibrium())

	def test_refuses_what_is_not_intact(self):
		self.tower(tensileStrength=100)
		MortarJoints()()
		O.forces.setPermT(self.bricks[-1].id, (0, 8, 0))
		for _ in range(400):
			O.step()
			if any(0 < sum(s > 0 for s in i.phys.segmentState) < 16 for i in O.interactions): break
		self.expectRefusal(ValueError, ('failed in part',), StaticEquilibrium())
		O.reset()
		self.tower(deformation='rigid')
		MortarJoints(ids=[0, 1, 2])()
		O.run(300, True)  # the third brick sinks into the second by its own weight
		self.expectRefusal(ValueError, ('#2', '#3', 'without mortar'), StaticEquilibrium())

	def test_refuses_wrong_attributes(self):
		self.expectRefusal(ValueError, ('tolerance', '2'), lambda: StaticEquilibrium(tolerance=2))
		self.expectRefusal(ValueError, ('mostIterations', '0'), lambda: StaticEquilibrium(mostIterations=0))
		self.expectRefusal(ValueError, ('gravity', 'inf'), lambda: StaticEquilibrium(gravity=(0, 0, math.inf)))
		self.tower()
		MortarJoints()()
		O.engines = O.engines[:-1]
		self.expectRefusal(ValueError, ('NewtonIntegrator',), StaticEquilibrium())


class IntactAssemblyCase(Scene):

	def test_matrices_are_those_of_the_bricks(self):
		self.tower()
		MortarJoints()()
		a = assembled()
		self.assertEqual(a.stiffness.shape, (72, 72))
		self.assertEqual([a.place(b.id) for b in self.bricks], [0, 24, 48])
		self.assertEqual(list(a.free), list(range(72)))
		self.assertLess(abs(a.stiffness - a.stiffness.T).max(), 1e-6 * abs(a.stiffness).max())
		self.assertAlmostEqual(a.mass[0, 0], self.bricks[0].state.mass, delta=1e-12)
		for k in range(3):
			self.assertAlmostEqual(a.nodalMap(1)[k, k], 1, delta=0)

	def test_solve_and_the_loop_agree(self):
		self.tower()
		MortarJoints()()
		a = assembled()
		loads = np.zeros(72)
		for b in self.bricks:
			loads[a.place(b.id) + 2] = -9.8 * b.state.mass
		x = a.solve(loads)
		StaticEquilibrium()()
		for b in self.bricks:  # linear against geometrically exact: strains of 1e-3
			self.assertAlmostEqual(b.state.displ()[2] / x[a.place(b.id) + 2], 1, delta=2e-3)

	def test_frequencies_rise_and_are_the_same_again(self):
		self.tower()
		MortarJoints()()
		first, second = assembled().frequencies(6), assembled().frequencies(6)
		self.assertEqual(list(first), list(second))
		self.assertEqual(list(first), sorted(first))
		self.assertLess(2 * math.pi * first[-1], assembled().maxFrequency())
		self.expectRefusal(ValueError, ('count', '0'), lambda: assembled().frequencies(0))

	def test_frequencies_of_what_nothing_holds(self):
		for columns in (1, 4):  # dense, sparse
			O.reset()
			self.tower()
			O.bodies.erase(0)
			O.bodies.append(straightJointWall(columns, 3, (SIDE, SIDE, SIDE), origin=(1, 0, 0), material=O.materials[0]).bodies)
			MortarJoints()()
			found = assembled().frequencies(13)  # two bodies, six free motions each
			self.assertLess(found[11], 1e-2)
			self.assertGreater(found[12], 1)

	def test_held_coordinates(self):
		self.tower()
		self.bricks[0].state.blockedDOFs = 'xZ'
		MortarJoints()()
		self.assertEqual(sorted(set(range(72)) - set(assembled().free)), [0, 5])

	def test_refuses_misuse(self):
		self.expectRefusal(RuntimeError, ('gather',), lambda: IntactAssembly().size)
		self.tower()
		MortarJoints()()
		self.expectRefusal(ValueError, ('id is 0',), lambda: assembled().place(0))
		self.expectRefusal(ValueError, ('shape', '(72,)'), lambda: assembled().solve([1, 2]))


class Rest(Scene):

	def test_energies_of_a_falling_and_a_resting_brick(self):
		self.tower(deformation='rigid')
		O.step()
		for b in self.bricks:
			b.state.vel = (0, 0, -1)
		O.step()
		self.assertAlmostEqual(restState().kinetic, utils.kineticEnergy(), delta=1e-12)
		self.assertFalse(isAtRest())
		self.expectRefusal(ValueError, ('energyRatio', '0'), lambda: isAtRest(energyRatio=0))

	def test_energy_of_a_swinging_tower_goes_to_and_fro(self):
		"""Kinetic and elastic energy and that of height add up, so the energies of bricks, joints and deformation are complete."""
		self.tower(element='incompatible', contactThickness=.01)
		MortarJoints()()
		O.dt = 1e-6
		O.engines[3].active = False
		totals, parts = [], []
		for _ in range(20000):
			O.step()
			state = restState()
			height = sum(9.8 * b.state.mass * b.state.displ()[2] for b in self.bricks)
			totals.append(state.kinetic + state.elastic + height)
			parts.append(state.elastic)
		# rates are half a step behind, and joints are seen one step before the deformation: of first order in the step
		self.assertLess(max(totals) - min(totals), .02 * max(parts))


if __name__ == '__main__':
	unittest.main()
