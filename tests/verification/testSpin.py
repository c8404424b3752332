# SPDX-License-Identifier: GPL-2.0-or-later
# Torque-free spin about the middle axis, which is unstable: the box turns over again and again.
#
# YADE's NewtonIntegrator turns bodies with an error of first order in the time step (halving the step halves it), so two runs are extrapolated to a
# step of zero. A deformable brick must not spin otherwise than a rigid one: its inertia is the solid's, not that of eight lumped nodes.
import unittest

from cases import *

GROUP = 'Free spin'
TIMES = ('1.0', '2.0')


class TorqueFreeSpin(Case):

	def spin(self, level, dt):
		"""Angular velocity in body axes at TIMES [rad/s]."""
		O.reset()
		expected = reference('dyn.spin')
		self.body = b = add(expected['dims'], material=material(), deformation=level, contactThickness=.001)
		b.state.angVel = Vector3(*expected['w0'])
		self.start = b.state.angMom = Vector3(*[b.state.inertia[k] * expected['w0'][k] for k in range(3)])
		engines(gravity=(0, 0, 0))
		engine(BrickTimeStepper).active = False
		O.dt = dt
		velocities = []
		for time in TIMES:
			O.run(round(float(time) / dt) - O.iter, True)
			velocities.append(b.state.ori.conjugate() * b.state.angVel)
		return velocities

	def check(self, level):
		expected = reference('dyn.spin')
		coarse, fine = self.spin(level, 1e-4), self.spin(level, 5e-5)
		for time, w, v in zip(TIMES, coarse, fine):
			for k in range(3):
				wanted = expected['w_t'][time][k]
				self.judge(
				        'w%d at %s s [rad/s]' % (k + 1, time), 2 * v[k] - w[k], wanted, 1e-3 / abs(wanted), 'second order in the step is left: 1e-3 of 5 rad/s'
				)
		energy = lambda w: sum(self.body.state.inertia[k] * w[k]**2 for k in range(3)) / 2
		self.judge('energy after 2 s [J]', 2 * energy(v) - energy(w), expected['T'], 1e-4, 'no torque; likewise extrapolated')
		self.judge('angular momentum [N m s]', self.body.state.angMom.norm(), expected['L'], 1e-7, 'no torque; the digits of the reference')
		self.judge('change of its direction', (self.body.state.angMom - self.start).norm(), 0, 1e-12, 'round-off')
		self.judge('moment of inertia [kg m2]', self.body.state.inertia[0], expected['I'][0], 1e-12, 'the solid, exactly')

	def test_rigid(self):
		self.check('rigid')

	def test_deformable(self):
		self.check('trilinear')
