# SPDX-License-Identifier: GPL-2.0-or-later
# Tilting table and pushover in a scene: signs against gravity, sliding at the friction angle, turning over at width over height, and the
# collapse multiplier of dry blocks and columns against rigid-body statics.
import math
import unittest
import warnings

from yade import O, Vector3, wrapper
from yade.utils import wall
from yade_brick import BrickMat, Motion, brick, build, capacityCurve, engines, loadAt, pushover, straightJointWall, tiltAt, tiltingTable

G = 9.81  # [m/s2]


def dry(friction, young):
	return BrickMat(young=young, poisson=.25, density=1800, frictionAngle=friction, hn=.1, hs=.1)


def stand(bodies, motion, material, damping):
	"""Rigid bricks on a floor under a motion; the floor's id."""
	floor = O.bodies.append(wall(0, axis=2, sense=1, material=material))
	O.bodies.append(bodies)
	O.engines = engines(gravity=(0, 0, -G), motion=motion, damping=damping)
	return floor


def block(size, motion, friction=math.radians(60), young=9.8e8, damping=.3):
	O.reset()
	material = dry(friction, young)
	body = brick(size, center=(0, 0, size[2] / 2), material=material, deformation='rigid', segments=2)
	return body, stand([body], motion, material, damping)


def runUntil(time, stop=lambda: False, look=lambda: None, every=20):
	while O.time < time and not stop():
		for _ in range(every):
			O.step()
		look()


def push(floor, body, along, motion, applied):
	"""Runs a quasi-static motion until the body leans by 0.1 rad or the motion ends; the capacity curve.

	:param along: unit vector; applied: coefficient at a time
	"""
	rows = []

	def look():
		force = O.forces.f(floor)
		rows.append(((body.state.pos - body.state.refPos).dot(along), force.dot(along), -force[2], applied(O.time)))

	runUntil(motion.duration, lambda: abs(body.state.ori.toAxisAngle()[1]) > .1, look)
	displacement, shear, normal, load = zip(*rows)
	return capacityCurve(displacement, shear, normal, load)


class TiltingTable(unittest.TestCase):

	def test_gravity_turns_and_keeps_its_size(self):
		motion = tiltingTable(rate=.2, upTo=.5, direction=(3, 4, 0), hold=1.)
		body, _ = block((.2, .2, .2), motion)
		O.bodies.erase(0)  # nothing to stand on: the body falls freely
		O.engines = [wrapper.ForceResetter(), build.groundMotion(motion), wrapper.NewtonIntegrator(gravity=(0, 0, -G), damping=0)]
		O.dt = 1e-3
		for time in (.2, 1., 2.9):
			O.run(round((time - O.time) / O.dt), True)
			before, now = Vector3(body.state.vel), O.time
			O.step()
			felt, angle = (body.state.vel - before) / O.dt, tiltAt(motion, now, G)
			expected = G * (math.sin(angle) * Vector3(.6, .8, 0) - math.cos(angle) * Vector3(0, 0, 1))
			self.assertLess((felt - expected).norm(), 1e-4)  # linear between samples: g (0.2 * 0.01)^2 / 8, and 12 digits of a difference of velocities
			self.assertAlmostEqual(felt.norm(), G, delta=1e-4)

	def test_block_slides_at_the_angle_whose_tangent_is_the_friction(self):
		friction = .3
		for factor, slides in ((.97, False), (1.03, True)):
			motion = tiltingTable(rate=.3, upTo=math.atan(factor * friction), gravity=G, hold=1.)
			body, _ = block((.3, .2, .1), motion, friction=math.atan(friction), damping=0)
			runUntil(motion.duration - .8)
			began, start, speed = O.time, Vector3(body.state.pos), Vector3(body.state.vel)
			runUntil(motion.duration - .1)
			moved, time = (body.state.pos - start)[0], O.time - began
			if not slides:
				self.assertLess(abs(moved), 1e-6)  # springs under an unchanged load
				continue
			# downhill at g (sin - friction cos), which is the difference of two loads that are 33 times larger: 1 % stands for 3e-4 of them
			angle = math.atan(factor * friction)
			expected = speed[0] * time + G * (math.sin(angle) - friction * math.cos(angle)) * time**2 / 2
			self.assertGreater(expected, .02)
			self.assertAlmostEqual(moved / expected, 1, delta=.01)

	def test_block_turns_over_at_its_width_over_its_height_whichever_way(self):
		# Rigid statics of a block on springs that only press (tests/verification/tilting.py): 0.5 is 0.4776 at this stiffness.
		size, exact = (.2, .2, .4), .4776
		for direction, axis in (('x', 0), ('-y', 1)):
			for factor in (.97, 1.03):
				motion = tiltingTable(rate=.4, upTo=math.atan(factor * exact), direction=direction, gravity=G, hold=1.2)
				body, _ = block(size, motion)
				runUntil(motion.duration)
				leans = (body.state.pos - body.state.refPos)[axis] * (-1 if direction[0] == '-' else 1)
				if factor < 1: self.assertTrue(0 < leans < .005, leans)
				else: self.assertGreater(leans, .03)

	def test_multiplier_of_a_block_is_the_tangent_of_the_angle(self):
		motion = tiltingTable(rate=.2, upTo=.6, gravity=G)
		body, floor = block((.2, .2, .6), motion)
		curve = push(floor, body, Vector3(1, 0, 0), motion, lambda time: math.tan(tiltAt(motion, time, G)))
		self.assertTrue(curve.collapsed)
		# statics of the springs: 0.3113 (rigid: 1/3); the table turns on by 0.01 while the block begins to fall, a third of which its base feels
		self.assertAlmostEqual(curve.multiplier, .3113, delta=.005)


class Pushover(unittest.TestCase):

	def test_bodies_are_pushed_in_the_direction_and_held(self):
		motion = pushover(upTo=2., direction='-y', duration=1., hold=1.)
		body, _ = block((.2, .2, .2), motion)
		O.engines = [wrapper.ForceResetter(), build.groundMotion(motion), wrapper.NewtonIntegrator(damping=0)]
		O.bodies.erase(0)
		O.dt = 1e-3
		for time in (.5, 1.2, 1.6, 2.4):
			O.run(round((time - O.time) / O.dt), True)
			before, now = Vector3(body.state.vel), O.time
			O.step()
			felt = (body.state.vel - before) / O.dt
			expected = Vector3(*loadAt(motion, now))
			self.assertLess((felt - expected).norm(), 1e-9)
			if time > 1.5: self.assertLess((felt - Vector3(0, -2, 0)).norm(), 1e-9)
		O.run(200, True)
		before = Vector3(body.state.vel)
		O.step()
		self.assertEqual(body.state.vel, before)  # 2.6 s: the motion is over and the load is gone

	def test_multiplier_of_a_dry_column_is_its_width_over_its_height(self):
		for young, exact in ((9.8e8, .3181), (3e9, .3228)):  # statics of three cubes on springs, tests/verification/tilting.py; rigid: 1/3
			O.reset()
			motion = pushover(upTo=.4 * G, rate=.25 * G)
			column = straightJointWall(1, 3, (.2, .2, .2), material=dry(math.radians(60), young), deformation='rigid', segments=2)
			floor = stand(column.bodies, motion, column.bodies[0].material, .3)
			curve = push(floor, column.bodies[-1], Vector3(1, 0, 0), motion, lambda time: loadAt(motion, time)[0] / G)
			self.assertTrue(curve.collapsed)
			self.assertAlmostEqual(curve.multiplier, exact, delta=.006)  # as for the tilted block
			self.assertLess(curve.displacementAtMultiplier, .02)

	def test_multiplier_of_a_low_block_is_its_friction(self):
		motion = pushover(upTo=.5 * G, rate=.3 * G, direction='y')
		body, floor = block((.4, .4, .1), motion, friction=math.atan(.35))
		rows = []
		runUntil(motion.duration, lambda: body.state.pos[1] > .05, lambda: rows.append((body.state.pos[1], O.forces.f(floor)[1], loadAt(motion, O.time)[1] / G)))
		displacement, shear, load = zip(*rows)
		curve = capacityCurve(displacement, shear, 1800 * .4 * .4 * .1 * G, load)
		self.assertTrue(curve.collapsed)
		self.assertAlmostEqual(curve.multiplier, .35, delta=.002)  # Coulomb; the block has landed to 1 % of its weight


class MovedSupports(unittest.TestCase):

	def test_a_motion_that_does_not_end_at_rest_warns_where_supports_are_moved(self):
		kicked = Motion(.01, [(1, 0, 0)] * 101, 'kicked')
		with self.assertWarnsRegex(UserWarning, r'kicked: ends with a velocity of \(1, 0, 0\) m/s, 1e\+02 %.*endingAtRest'):
			build.groundMotion(kicked, ids=[0])
		with warnings.catch_warnings():
			warnings.simplefilter('error')
			build.groundMotion(kicked)
			build.groundMotion(kicked.endingAtRest(), ids=[0])
			build.groundMotion(kicked.baselineCorrected(), ids=[0])

	def test_a_base_that_is_moved_comes_to_rest_with_the_motion(self):
		motion = Motion(.01, [(1, 0, 0)] * 51, 'kicked').endingAtRest(.5)
		body, floor = block((.2, .2, .1), None)
		body.dynamic = False
		O.engines = [wrapper.ForceResetter(), build.groundMotion(motion, ids=[body.id]), wrapper.NewtonIntegrator()]
		O.dt = 1e-3
		O.run(round(motion.duration / O.dt) + 500, True)
		self.assertLess(body.state.vel.norm(), 1e-12)
		# until then exactly where Motion says it is
		self.assertAlmostEqual((body.state.pos - body.state.refPos)[0], motion.displacement()[-1][0], places=9)
