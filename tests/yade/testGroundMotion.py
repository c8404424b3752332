# SPDX-License-Identifier: GPL-2.0-or-later
# GroundMotion: inertia forces and imposed motion are the given acceleration and its exact integrals.
import unittest

from yade import O, Vector3, wrapper
from yade_brick import BrickMat, GroundMotion, brick

ramp = [Vector3(0, 0, 0), Vector3(2, 0, -1), Vector3(0, 4, 0)]  # one second apart [m/s2]


def adobe():
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56)


def freeBricks(motion):
	"""A free and a fixed brick far from each other, without gravity; their ids."""
	O.reset()
	ids = [O.bodies.append(brick((.2, .2, .2), center=(5 * i, 0, 0), material=adobe(), fixed=i == 1)) for i in range(2)]
	O.engines = [wrapper.ForceResetter(), motion, wrapper.NewtonIntegrator(damping=0)]
	O.dt = 1e-3
	return ids


class GroundMotionCase(unittest.TestCase):

	def test_integrals_of_linear_pieces_are_exact(self):
		g = GroundMotion(dt=1, acceleration=ramp, startTime=10)
		self.assertEqual(g.groundAcceleration(9.9), Vector3(0, 0, 0))
		self.assertLess((g.groundAcceleration(10.5) - Vector3(1, 0, -.5)).norm(), 1e-14)
		self.assertLess((g.groundVelocity(12) - Vector3(2, 2, -1)).norm(), 1e-14)  # areas of triangles
		self.assertLess((g.groundDisplacement(12) - Vector3(2 / 6 + 1 + 2 / 3, 4 / 6, -1)).norm(), 1e-14)  # by hand, piece by piece
		self.assertEqual(g.groundVelocity(20), g.groundVelocity(12))

	def test_free_bodies_get_minus_m_z_and_supports_stay(self):
		free, fixed = freeBricks(GroundMotion(dt=10, acceleration=[Vector3(3, 0, 0)] * 2))
		O.run(1000, True)
		# leap-frog is exact for a constant acceleration but for the half step at the start: v = -a (n dt)
		self.assertLess((O.bodies[free].state.vel + Vector3(3, 0, 0) * O.time).norm(), 1e-9)
		self.assertEqual(O.bodies[fixed].state.pos, O.bodies[fixed].state.refPos)

	def test_listed_bodies_follow_the_ground_in_space(self):
		motion = GroundMotion(dt=1, acceleration=ramp)
		free, fixed = freeBricks(motion)
		motion.ids = [fixed]
		O.run(2500, True)
		moved = O.bodies[fixed].state.pos - O.bodies[fixed].state.refPos
		self.assertLess((moved - motion.groundDisplacement(O.time)).norm(), 1e-9)  # the step's velocity is the mean of the exact motion: round-off of 2500 sums
		self.assertEqual(O.bodies[free].state.vel, Vector3(0, 0, 0))

	def test_wrong_motions_are_refused(self):
		for words, attributes in (
		        ('-1', dict(dt=-1, acceleration=ramp)), ('at least 2', dict(dt=1, acceleration=ramp[:1])),
		        ('sample 1', dict(dt=1, acceleration=[Vector3(0, 0, 0), Vector3(float('nan'), 0, 0)])), ('nan', dict(acceleration=ramp))
		):
			with self.assertRaisesRegex(ValueError, words):
				GroundMotion(**attributes)

	def test_a_motion_without_samples_or_for_no_body_stops_the_step(self):
		for motion in (GroundMotion(), GroundMotion(dt=1, acceleration=ramp, ids=[77])):
			freeBricks(motion)
			with self.assertRaisesRegex(ValueError, 'no samples|#77'):
				O.step()
