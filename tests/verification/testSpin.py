# SPDX-License-Identifier: GPL-2.0-or-later
# Torque-free spin about the middle axis, which is unstable: the box turns over again and again.
#
# YADE's NewtonIntegrator turns bodies with an error of first order in the time step (halving the step halves it), so four runs are extrapolated to a
# step of zero. A deformable brick must not spin otherwise than a rigid one: its inertia is the solid's, not that of eight lumped nodes.
import unittest

import numpy as np

from cases import *

GROUP = 'Free spin'
BETWEEN = .05  # values of a history [s]
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])  # of a brick's corners


def exactSpin(inertia, start, times):
	"""Euler's equations of a free body, by a fourth-order rule in steps of 0.1 ms: angular velocities in body axes at the times."""
	inertia, w, step = np.array(inertia), np.array(start, dtype=float), 1e-4
	rate = lambda w: np.cross(inertia * w, w) / inertia
	out, t = [], 0.
	for time in times:
		while t < time - step / 2:
			a = rate(w)
			b = rate(w + step / 2 * a)
			c = rate(w + step / 2 * b)
			w = w + step / 6 * (a + 2 * b + 2 * c + rate(w + step * c))
			t += step
		out.append(w)
	return np.array(out)


def extrapolated(values):
	"""To a step of zero, from values of steps each half the one before."""
	order = 1
	while len(values) > 1:
		values = [(2**order * fine - coarse) / (2**order - 1) for coarse, fine in zip(values, values[1:])]
		order += 1
	return values[0]


class TorqueFreeSpin(Case):

	def spin(self, level, dt, duration):
		"""Angular velocities in body axes, BETWEEN apart [rad/s]."""
		O.reset()
		expected = reference('dyn.spin')
		self.body = b = add(expected['dims'], material=material(), deformation=level, contactThickness=.001)
		b.state.angVel = Vector3(*expected['w0'])
		self.start = b.state.angMom = Vector3(*[b.state.inertia[k] * expected['w0'][k] for k in range(3)])
		engines(gravity=(0, 0, 0))
		engine(BrickTimeStepper).active = False
		O.dt = dt
		velocities, every = [], round(BETWEEN / dt)
		while len(velocities) < round(duration / BETWEEN):
			for _ in range(every):
				O.step()
			velocities.append(b.state.ori.conjugate() * b.state.angVel)
		return np.array(velocities)

	def check(self, level, duration, step):
		"""With the largest of four steps [s]."""
		expected = reference('dyn.spin')
		runs = [self.spin(level, step / k, duration) for k in (1, 2, 4, 8)]
		velocities = extrapolated(runs)
		times = BETWEEN * np.arange(1, len(velocities) + 1)
		reason = 'fourth order in the step is left: 1e-3 rad/s, 5e-3 after four turns, each of which makes an error more than tenfold'
		for time, wanted in expected['w_t'].items():
			if float(time) > duration: continue
			w = velocities[round(float(time) / BETWEEN) - 1]
			for k in range(3):
				self.judge('w%d at %s s [rad/s]' % (k + 1, time), w[k], wanted[k], (1e-3 if float(time) < 10 else 5e-3) / abs(wanted[k]), reason)
		middle = velocities[:, 1]
		turns = [k for k in range(len(middle) - 1) if middle[k] * middle[k + 1] < 0]
		for turn, (k, wanted) in enumerate(zip(turns, expected['flip_times']), 1):
			# a polynomial through four values around the change of sign
			near = np.polyfit(middle[k - 1:k + 3], times[k - 1:k + 3], 3)
			self.judge('w2 changes its sign, %d, at [s]' % turn, near[-1], wanted, 1e-3, 'interpolated between values 0.05 s apart')
		energy = lambda w: sum(self.body.state.inertia[k] * w[k]**2 for k in range(3)) / 2
		self.judge('energy at the end [J]', extrapolated([energy(run[-1]) for run in runs]), expected['T'], 1e-4, 'no torque; likewise extrapolated')
		self.judge('angular momentum [N m s]', self.body.state.angMom.norm(), expected['L'], 1e-7, 'no torque; the digits of the reference')
		self.judge('change of its direction', (self.body.state.angMom - self.start).norm(), 0, 1e-12, 'round-off')
		for k in range(3):
			self.judge('moment of inertia %d [kg m2]' % (k + 1), self.body.state.inertia[k], expected['I'][k], 1e-12, 'the solid, exactly')
		self.judge('mass [kg]', self.body.state.mass, expected['m'], 1e-12, 'the solid, exactly')
		exact = exactSpin(expected['I'], expected['w0'], times)
		for k in range(3):
			self.curve('Free spin, ' + level, 'w%d: ours' % (k + 1), times[::2], velocities[::2, k], 'time [s]', 'angular velocity in body axes [rad/s]', line=False)
			self.curve('Free spin, ' + level, 'w%d: exact' % (k + 1), times, exact[:, k])

	def test_rigid(self):
		"""A free rigid block of unequal sides spins about its middle axis, which is unstable: it turns over every 2.4 s. Expected: Euler's equations (Jacobi's
		functions). Four runs are extrapolated to a step of zero.
		"""
		self.check('rigid', 10, 4e-5)

	def test_deformable(self):
		"""The same with a deformable block: it must spin as the rigid one, with the solid's inertia."""
		self.check('trilinear', 2, 1e-4)

	def test_strain_of_a_spinning_cube(self):
		"""A deformable cube of 0.2 m spins at 20 rad/s. The product leaves inertia forces of rotation out (its documented limit), so it must not deform at all;
		compared with the mean strain of the solid. The same forces put on the product's stiffness by hand give the solid's mean strain, and three times as much
		when all mass is in the corners: what is left out would be exact with consistent forces, and wrong with lumped ones.
		"""
		expected, side, speed = reference('dyn.spin_strain'), .2, 20.
		b = add((side, side, side), material=material(), inner='full', contactThickness=.001)
		b.state.angVel = Vector3(0, 0, speed)
		b.state.angMom = b.state.inertia[2] * b.state.angVel
		engines(gravity=(0, 0, 0))
		runFor(.3)
		strain = max(u.norm() for u in b.shape.displacement) / side
		self.judge('strain', strain, 0, 1e-15, 'no load on the element')
		self.compare('mean strain across the axis', strain, expected['exact_mean_exx'], 'documented: small rotations a second; 2e-4 at three turns a second')
		nodes = side / 2 * SIGNS
		matrix = np.array([[k for k in row] for row in Brick.stiffness([Vector3(*x) for x in nodes], YOUNG, POISSON, 'full')]).reshape(24, 24)
		mass = DENSITY * side**3
		for name, share in (('exact_mean_exx', 1 / 3), ('lumped8_exx', 1.)):
			# linear shape functions get a third of what the corner's own share of mass would
			load = share * mass / 8 * speed**2 * nodes * np.array([1, 1, 0])
			u = (np.linalg.pinv(matrix, rcond=1e-10) @ load.ravel()).reshape(8, 3)
			mean = lambda k: sum(u[a, k] * SIGNS[a, k] for a in range(8)) / 4 / side
			self.judge('%s, by hand' % name, mean(0), expected[name], 1e-6, 'the digits of the reference')
			if share < 1: self.judge('strain along the axis, by hand', mean(2), expected['ezz'], 1e-6, 'the digits of the reference')
