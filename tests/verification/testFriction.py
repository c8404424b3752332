# SPDX-License-Identifier: GPL-2.0-or-later
# Blocks on the ground that slide or topple: under a rectangular pulse, and on a slope.
#
# Deformable blocks have a little damping inside. Without any, the friction on their base excites their modes (brakes squeal for the same reason) and
# the mean friction falls by some percent.
import unittest

import numpy as np

from tilting import setTilt
from cases import *

GROUP = 'Sliding blocks'
FLAT = (.2, .2, .1)
STIFF = 9.8e8  # a hundred times the paper's [Pa], where the compliance of contact is to vanish
INSIDE = .1  # damping ratio of the modes


ELASTIC = 'friction comes with the elastic slip of the shear springs, a tenth of what it is with the paper\'s stiffness (1.5 to 2.5 %)'


def exactSlip(excess, times):
	"""Slip [m] of a rigid block from rest; excess(t): what the driving acceleration exceeds friction by. It stays once it stops."""
	slips, velocity = [0.], 0.
	for t, step in zip(times, np.diff(times)):
		before = velocity
		velocity = max(0., velocity + step * excess(t + step / 2))
		slips.append(slips[-1] + step * (before + velocity) / 2)
	return np.array(slips)


class SlidingUnderAPulse(Case):

	def slide(self, level, moveGround, expected, dt, samples, seconds):
		"""Slip of a block under a pulse, by time from the start of the pulse [s], [m], and the time at which it stops."""
		slippery = material(young=STIFF, frictionAngle=math.atan(expected['mu']), dampingRatio=INSIDE)
		base = add((1, 1, .2), center=(0, 0, -.1), material=slippery, deformation='rigid', fixed=True) if moveGround else O.bodies[ground(slippery)]
		block = add(FLAT, center=(0, 0, .05), material=slippery, deformation=level, contactThickness=.005)
		pulse = GroundMotion(dt=dt, acceleration=[Vector3(a, 0, 0) for a in samples], startTime=1e9, ids=[base.id] if moveGround else [])
		engines(before=[pulse])
		untilRest(.05)
		engine(BrickTimeStepper).active = False
		length = dt * (len(samples) - 1)
		O.dt = length / math.ceil(length / O.dt)
		# with its ends half way between two steps a rectangular pulse acts in exactly length/dt of them
		start, pulse.startTime = O.time, O.time - O.dt / 2
		slip = lambda: base.state.pos[0] - block.state.pos[0]
		velocity = lambda: base.state.vel[0] - block.state.vel[0]
		place, stopped, times, slips, self.velocities = slip(), None, [], [], []
		while O.time < start + seconds:
			O.step()
			times.append(O.time - start)
			slips.append(slip() - place)
			self.velocities.append(velocity())
			if stopped is None and O.time > start + length and velocity() <= 0: stopped = O.time - start
		return times, slips, stopped

	def draw(self, figure, series, times, slips, excess):
		every = max(1, len(times) // 50)
		self.curve(figure, series, times[::every], slips[::every], 'time [s]', 'slip [m]', line=False)
		fine = np.linspace(0, times[-1], 2001)
		self.curve(figure, 'exact', fine[::10], exactSlip(excess, fine)[::10])

	def rectangle(self, level, moveGround):
		expected = reference('dyn.slide_rect')
		times, slips, stopped = self.slide(level, moveGround, expected, expected['t0'], [expected['a0']] * 2, 1.2 * expected['t_stop'])
		self.judge('slip [m]', slips[-1], expected['D'], 4e-3, ELASTIC)
		self.judge('stops at [s]', stopped, expected['t_stop'], 4e-3, ELASTIC)
		name = '%s, %s' % (level, 'moving base' if moveGround else 'inertia forces')
		self.draw('Sliding under a rectangular pulse: ' + name, 'ours', times, slips, lambda t: (t < expected['t0']) * expected['a0'] - expected['mu'] * GRAVITY)

	def halfSine(self, level, moveGround):
		expected, count = reference('dyn.slide_halfsine'), 400
		top, length, friction = expected['A'], expected['T'], expected['mu'] * GRAVITY
		pulse = lambda t: top * math.sin(math.pi * t / length) if 0 < t < length else 0.
		samples = [pulse(length * k / count) for k in range(count + 1)]
		times, slips, stopped = self.slide(level, moveGround, expected, length / count, samples, 1.2 * expected['t_stop'])
		self.judge('slip [m]', slips[-1], expected['slip'], 4e-3, ELASTIC)
		self.judge('stops at [s]', stopped, expected['t_stop'], 4e-3, ELASTIC)
		# the slip's velocity begins as the square of the time since it starts: looked for where it has grown to 1 cm/s
		driven = lambda t: -top * length / math.pi * math.cos(math.pi * t / length) - friction * t
		wanted = next(t for t in np.arange(expected['t_start'], length, 1e-6) if driven(t) - driven(expected['t_start']) >= .01)
		slides = next(t for t, v in zip(times, self.velocities) if v >= .01)
		self.judge('slides with 1 cm/s at [s]', slides, wanted, 4e-3, ELASTIC)
		name = '%s, %s' % (level, 'moving base' if moveGround else 'inertia forces')
		self.draw('Sliding under half a sine: ' + name, 'ours', times, slips, lambda t: pulse(t) - friction)

	def test_rigid_by_inertia_forces(self):
		"""A flat rigid block on the ground under a rectangular pulse of ground acceleration, given as inertia forces. Expected: slip and time of rest of a rigid
		block with Coulomb friction, in closed form. The half-sine pulse of the other tests likewise.
		"""
		self.rectangle('rigid', False)

	def test_rigid_on_a_moving_base(self):
		"""The same with a base that moves in space: seen from it, the same slip."""
		self.rectangle('rigid', True)

	def test_deformable_by_inertia_forces(self):
		"""The same with a deformable block, whose modes are damped a little."""
		self.rectangle('trilinear', False)

	def test_half_sine_rigid_by_inertia_forces(self):
		"""A half-sine pulse: the block stays until the pulse exceeds friction, slides, and stops after the pulse. Expected in closed form."""
		self.halfSine('rigid', False)

	def test_half_sine_rigid_on_a_moving_base(self):
		"""The same with a base that moves in space."""
		self.halfSine('rigid', True)

	def test_half_sine_deformable_by_inertia_forces(self):
		"""The same with a deformable block."""
		self.halfSine('trilinear', False)


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
		"""A flat block on a slope 0.2 degrees below and above its angle of friction: it stays at rest below, and slides with the uniform acceleration of a rigid
		block above. Rigid and deformable.
		"""
		expected, margin, seconds = reference('dyn.tilt')['slip_deg'], .2, .3
		for level in ('rigid', 'trilinear'):
			below, above = (self.moved(expected + sign * margin, FLAT, seconds, level, STIFF) for sign in (-1, 1))
			self.atMost('%s, %g degrees below: moves [m]' % (level, margin), below, 1e-6, 'rest')
			excess = GRAVITY * (math.sin(math.radians(expected + margin)) - math.tan(FRICTION) * math.cos(math.radians(expected + margin)))
			self.judge('%s, %g degrees above: moves [m]' % (level, margin), above, excess * seconds**2 / 2, 1e-3, 'uniform acceleration')

	def test_slowly_steepened_slope(self):
		"""Gravity turns by 2 degrees a second from 31 to 33.5 degrees. Expected: the slip of a rigid block, integrated; it begins at the angle of friction and
		grows as the cube of what the slope has turned since.
		"""
		start, end, rate = 31., 33.5, 2.
		expected = reference('dyn.tilt')
		for level in ('rigid', 'trilinear'):
			O.reset()
			rough = material(young=STIFF, frictionAngle=math.atan(expected['mu']), dampingRatio=INSIDE, hn=.02, hs=.02)
			ground(rough)
			block = add(FLAT, center=(0, 0, FLAT[2] / 2), material=rough, deformation=level, contactThickness=.005)
			engines(gravity=(GRAVITY * math.sin(math.radians(start)), 0, -GRAVITY * math.cos(math.radians(start))))
			untilRest(.06, .8)
			began, place, angles, slips = O.time, block.state.pos[0], [start], [0.]
			while angles[-1] < end:
				setTilt(start + rate * (O.time - began))
				O.step()
				angles.append(start + rate * (O.time - began))
				slips.append(block.state.pos[0] - place)
			slope = lambda t: math.radians(start + rate * t)
			times = np.linspace(0, (end - start) / rate, 4001)
			exact = exactSlip(lambda t: GRAVITY * (math.sin(slope(t)) - expected['mu'] * math.cos(slope(t))), times)
			for slip in (1e-4, 1e-3):
				angle = angles[int(np.argmax(np.array(slips) >= slip))]
				wanted = start + rate * times[int(np.argmax(exact >= slip))]
				self.judge('%s: has slipped %g m at [degrees]' % (level, slip), angle, wanted, 1e-3, 'elastic slip; the step of turning')
			# slip grows as the cube of the angle beyond: two of its values give where it begins
			first, second = (angles[int(np.argmax(np.array(slips) >= slip))] for slip in (1e-4, 8e-4))
			self.judge('%s: begins to slip at [degrees]' % level, 2 * first - second, expected['slip_deg'], 1e-3, 'from the angles at 0.1 and 0.8 mm, as a cube')
			every = max(1, len(angles) // 60)
			self.curve('Slope steepened slowly', level + ': ours', angles[::every], slips[::every], 'slope [degrees]', 'slip [m]', line=False)
			if level == 'rigid': self.curve('Slope steepened slowly', 'exact', start + rate * times[::40], exact[::40])

	def test_acceleration(self):
		"""A flat block on a slope of 40 degrees, after 0.1 s of sliding. Expected: g (sin - mu cos)."""
		expected = reference('dyn.tilt')['acc40']
		for level in ('rigid', 'trilinear'):
			self.moved(40, FLAT, .1, level, STIFF)
			before, time = self.block.state.vel[0], O.time
			runFor(.2)
			self.judge('%s: acceleration [m/s2]' % level, (self.block.state.vel[0] - before) / (O.time - time), expected, 1e-4, 'uniform; contact swings a little')

	def test_angle_of_toppling(self):
		"""Blocks of four slendernesses, rigid and deformable, stand 0.4 degrees below the angle whose tangent is width over height, and fall 0.4 degrees above. How
		the angle comes to be a little smaller than that, and what springs of the product's stiffness must give, is in the group of the tilting table.
		"""
		margin = .4
		for name, expected in reference('dyn.tilt')['topple_deg'].items():
			width, height = map(float, name.split('/'))
			# a rigid block's springs are softer by its size over the contact part of a deformable one
			for level, young in (('rigid', 2e11), ('trilinear', 3e9)):
				below, above = (self.moved(expected + sign * margin, (width, .2, height), .4, level, young, math.radians(60)) for sign in (-1, 1))
				reason = 'the indentation of the edge takes a tenth of a degree or two of the slender ones\' angle; within it they rock'
				self.atMost('%s %s, %g degrees below: moves [m]' % (name, level, margin), below, 1e-3, reason)
				self.atMost('%s %s, %g degrees above: 5 mm over what it moves' % (name, level, margin), 5e-3 / max(above, 1e-9), 1, reason)
