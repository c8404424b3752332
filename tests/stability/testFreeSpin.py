# SPDX-License-Identifier: GPL-2.0-or-later
# A brick spins freely 1000 turns about each of its axes, and tumbles about the middle one, which is unstable.
#
# Criterion: angular momentum L stays to the last bit, and no deformation comes up. The energy of a brick that spins about an axis stays to round-off.
# Of a tumbling brick it does not: YADE's NewtonIntegrator turns a body over a step with the angular velocity w (body axes) of the step's beginning, so
# the body moment l = I w is turned about a fixed w. Its energy T = l.w / 2 gains by second order in the step
#     dT = dt^2 / 2 (l x w).(I^-1 (l x w)) = dt^2 / 2 w'.(I w')            (Euler: I w' = l x w)
# that is, l' = l x (w - dt/2 w') to the next order. The gain is never negative: T creeps up to L^2 / (2 I_min), spin about the axis of the least moment,
# and about the axis of the largest moment a nutation grows, per unit of time, by
#     dt W^2 / 2 (x y + (x + y) / 2),   x = I_max / I_1 - 1,  y = I_max / I_2 - 1 ,
# and decays about that of the least (x, y < 0). This is the integrator's, first order in the step; the rows hold it to its closed form.
import unittest

import numpy as np

from hardCase import *

GROUP = '5 Free spin of 1000 turns'
SIZE = .25, .12, .06  # [m]
SPEED = 20.  # [rad/s]
LEVELS = 'rigid', 'uniform', 'trilinear', 'refined'


def spinning(level, velocity, place=0):
	"""A brick of its own, spinning at a velocity in its axes [rad/s]."""
	b = add(SIZE, center=(0, 2 * place, 0), material=O.materials[0], deformation=level, contactThickness=1e-3)
	b.state.angVel = Vector3(*velocity)
	b.state.angMom = Vector3(*[b.state.inertia[k] * velocity[k] for k in range(3)])
	return b


def bodySpin(b):
	"""Angular velocity in body axes, of the present orientation [rad/s]."""
	l = b.state.ori.conjugate() * b.state.angMom
	return np.array([l[k] / b.state.inertia[k] for k in range(3)])


def spinEnergy(b):
	return sum(b.state.inertia[k] * w**2 for k, w in enumerate(bodySpin(b))) / 2


def tumbled(inertia, w, dt, count):
	"""Angular velocity in body axes after so many steps, by a fourth-order rule: l' = l x (w - dt/2 w'), which turns with what w was half a step ago."""

	def rate(w):
		free = np.cross(inertia * w, w) / inertia
		return np.cross(inertia * w, w - dt / 2 * free) / inertia

	few = 10
	h = few * dt
	for _ in range(count // few):
		a = rate(w)
		b = rate(w + h / 2 * a)
		c = rate(w + h / 2 * b)
		w = w + h / 6 * (a + 2 * b + 2 * c + rate(w + h * c))
	return w


class FreeSpin(Case):

	def setUp(self):
		super().setUp()
		material()

	def start(self, dt):
		engines(gravity=(0, 0, 0))
		stepByHand(dt)

	def deformation(self):
		return max((u.norm() for b in bricks() if b.shape.deformation != 'rigid' for u in b.shape.displacement), default=0.)

	def test_about_each_axis(self):
		"""Bricks of all levels spin about the axes of the least, middle and largest moment of inertia for 1000 turns at 200 steps a turn, exactly along the axis."""
		turns, perTurn = 1000, 200
		spun = [(level, axis, spinning(level, [SPEED * (k == axis) for k in range(3)], 3 * j + axis)) for j, level in enumerate(LEVELS) for axis in range(3)]
		began = {b.id: (b.state.angMom, spinEnergy(b)) for _, _, b in spun}
		self.start(2 * math.pi / SPEED / perTurn)
		O.run(turns * perTurn, True)
		roundOff = turns * perTurn * 2.2e-16
		for level, axis, b in spun:
			momentum, energy = began[b.id]
			label = '%s about axis %d: ' % (level, axis + 1)
			self.atMost(label + 'change of angular momentum [kg m2/s]', (b.state.angMom - momentum).norm(), 0, 'no torque: nothing is added to it')
			self.atMost(label + 'change of energy, relative', abs(spinEnergy(b) / energy - 1), roundOff, 'round-off of the orientation, at most an eps a step')
			self.atMost(label + 'change of the axis', (b.state.angVel / SPEED - momentum / momentum.norm()).norm(), roundOff, 'the same')
		self.atMost('largest displacement of a node [m]', self.deformation(), 0, 'nothing loads the element: centrifugal forces are left out')

	def test_tumbling(self):
		"""A brick of each level is set spinning about its middle axis, 1 % off, for 6 s at a step of 0.1 ms: it turns over again and again."""
		dt, count = 1e-4, 60000
		start = np.array([.01, 1, .01]) * SPEED
		spun = [spinning(level, start, k) for k, level in enumerate(LEVELS)]
		first = spun[0]
		inertia, momentum, energy = np.array(first.state.inertia), first.state.angMom, spinEnergy(first)
		ceiling = momentum.squaredNorm() / 2 / inertia.min()
		self.start(dt)
		last, fell, turnsOver, side = energy, 0., 0, 1
		for _ in range(count // 20):
			steps(20)
			now = spinEnergy(first)
			fell, last = max(fell, last - now), now
			if bodySpin(first)[1] * side < 0: turnsOver, side = turnsOver + 1, -side
		self.atMost('turns over, inverse of their number', 1 / max(turnsOver, 1), 1 / 5, 'it tumbles')
		self.atMost('largest fall of the energy, relative', fell / energy, 1e-12, 'the integrator only adds; round-off')
		self.atMost('energy over that of the least moment of inertia', last / ceiling, 1 + 1e-12, 'all that the angular momentum allows')
		wanted = tumbled(inertia, start, dt, count)
		predicted = inertia @ wanted**2 / 2 / energy - 1
		reason = 'the integrator as analysed above; second order in W dt = .002 is left, times what a turn parts'
		self.judge('gain of energy, relative', last / energy - 1, predicted, .02, reason)
		for b in spun:
			self.atMost('%s: change of angular momentum [kg m2/s]' % b.shape.deformation, (b.state.angMom - momentum).norm(), 0, 'no torque')
			apart = (b.state.ori.toRotationMatrix() - first.state.ori.toRotationMatrix()).norm()
			self.atMost(b.shape.deformation + ': orientation against that of the rigid one', apart, 0, 'the same body')
		self.atMost('largest displacement of a node [m]', self.deformation(), 0, 'nothing loads the element')

	def test_nutation(self):
		"""Spin about the axis of the largest and of the least moment, .1 % off, for 50 turns of 1000 steps: nutation grows and decays as derived."""
		turns, perTurn, off = 50, 1000, 1e-3
		dt = 2 * math.pi / SPEED / perTurn
		for axis in (2, 0):
			O.bodies.clear()
			b = spinning('trilinear', [SPEED * (1 if k == axis else off) for k in range(3)])
			inertia = np.array(b.state.inertia)
			others = [k for k in range(3) if k != axis]
			x, y = (inertia[axis] / inertia[k] - 1 for k in others)
			# constant along the exact nutation: l1^2 (1/I1 - 1/I3) + l2^2 (1/I2 - 1/I3)
			size = lambda: math.sqrt(sum((bodySpin(b)[k] * inertia[k])**2 * (v / inertia[axis]) for k, v in zip(others, (abs(x), abs(y)))))
			self.start(dt)
			began = size()
			O.run(turns * perTurn, True)
			rate = math.log(size() / began) / (turns * perTurn * dt)
			expected = dt * SPEED**2 / 2 * (x * y + (x + y) / 2)
			self.judge('axis %d: growth of the nutation [1/s]' % (axis + 1), rate, expected, .02, 'closed form, first order in the step of W dt = .006')
