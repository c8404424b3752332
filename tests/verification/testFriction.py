# SPDX-License-Identifier: GPL-2.0-or-later
# Blocks on the ground that slide or topple: under a rectangular pulse, and on a slope.
#
# Deformable blocks have a little damping inside. Without any, the friction on their base excites their modes (brakes squeal for the same reason) and
# the mean friction falls by some percent.
import unittest

from cases import *

GROUP = 'Sliding blocks'
FLAT = (.2, .2, .1)
STIFF = 9.8e8  # a hundred times the paper's [Pa], where the compliance of contact is to vanish
INSIDE = .1  # damping ratio of the modes


class SlidingUnderAPulse(Case):

	def slide(self, level, moveGround):
		expected = reference('dyn.slide_rect')
		slippery = material(young=STIFF, frictionAngle=math.atan(expected['mu']), dampingRatio=INSIDE)
		base = add((1, 1, .2), center=(0, 0, -.1), material=slippery, deformation='rigid', fixed=True) if moveGround else O.bodies[ground(slippery)]
		block = add(FLAT, center=(0, 0, .05), material=slippery, deformation=level, contactThickness=.005)
		pulse = GroundMotion(dt=expected['t0'], acceleration=[Vector3(expected['a0'], 0, 0)] * 2, startTime=1e9, ids=[base.id] if moveGround else [])
		engines(before=[pulse])
		untilRest(.05)
		engine(BrickTimeStepper).active = False
		O.dt = expected['t0'] / math.ceil(expected['t0'] / O.dt)
		# with its ends half way between two steps the pulse acts in exactly t0/dt of them
		start, pulse.startTime = O.time, O.time - O.dt / 2
		position = lambda: block.state.pos[0] - base.state.pos[0]
		velocity = lambda: block.state.vel[0] - base.state.vel[0]
		place, stopped = position(), None
		while O.time < start + 1.2 * expected['t_stop']:
			O.step()
			if stopped is None and O.time > start + expected['t0'] and velocity() >= 0: stopped = O.time - start
		reason = 'friction comes with the elastic slip of the shear springs, a tenth of what it is with the paper\'s stiffness (1.5 to 2.5 %)'
		self.judge('slip [m]', place - position(), expected['D'], 4e-3, reason)
		self.judge('stops at [s]', stopped, expected['t_stop'], 4e-3, reason)

	def test_rigid_by_inertia_forces(self):
		self.slide('rigid', False)

	def test_rigid_on_a_moving_base(self):
		self.slide('rigid', True)

	def test_deformable_by_inertia_forces(self):
		self.slide('trilinear', False)


class TiltedGravity(Case):

	def moved(self, degrees, size, seconds, level, young, friction=FRICTION):
		"""How far the top of a block moves down the slope, from the rest to which it comes with damping [m]."""
		O.reset()
		rough = material(young=young, frictionAngle=friction, dampingRatio=INSIDE, hn=.02, hs=.02)
		ground(rough)
		self.block = add(size, center=(0, 0, size[2] / 2), material=rough, deformation=level, contactThickness=.005)
		angle = math.radians(degrees)
		engines(gravity=(GRAVITY * math.sin(angle), 0, -GRAVITY * math.cos(angle)))
		untilRest(.06, .8)
		top = lambda: (self.block.state.pos + self.block.state.ori * Vector3(0, 0, size[2] / 2))[0]
		before = top()
		runFor(seconds)
		return top() - before

	def test_angle_of_slip(self):
		expected, margin, seconds = reference('dyn.tilt')['slip_deg'], .2, .3
		for level in ('rigid', 'trilinear'):
			below, above = (self.moved(expected + sign * margin, FLAT, seconds, level, STIFF) for sign in (-1, 1))
			self.atMost('%s, %g degrees below: moves [m]' % (level, margin), below, 1e-6, 'rest')
			excess = GRAVITY * (math.sin(math.radians(expected + margin)) - math.tan(FRICTION) * math.cos(math.radians(expected + margin)))
			self.judge('%s, %g degrees above: moves [m]' % (level, margin), above, excess * seconds**2 / 2, 1e-3, 'uniform acceleration')

	def test_acceleration(self):
		expected = reference('dyn.tilt')['acc40']
		for level in ('rigid', 'trilinear'):
			self.moved(40, FLAT, .1, level, STIFF)
			before, time = self.block.state.vel[0], O.time
			runFor(.2)
			self.judge('%s: acceleration [m/s2]' % level, (self.block.state.vel[0] - before) / (O.time - time), expected, 1e-4, 'uniform; contact swings a little')

	def test_angle_of_toppling(self):
		margin = .4
		for name, expected in reference('dyn.tilt')['topple_deg'].items():
			width, height = map(float, name.split('/'))
			# a rigid block's springs are softer by its size over the contact part of a deformable one
			for level, young in (('rigid', 2e11), ('trilinear', 3e9)):
				below, above = (self.moved(expected + sign * margin, (width, .2, height), .4, level, young, math.radians(60)) for sign in (-1, 1))
				reason = 'the indentation of the edge takes a tenth of a degree or two of the slender ones\' angle; within it they rock'
				self.atMost('%s %s, %g degrees below: moves [m]' % (name, level, margin), below, 1e-3, reason)
				self.atMost('%s %s, %g degrees above: 5 mm over what it moves' % (name, level, margin), 5e-3 / max(above, 1e-9), 1, reason)
