# SPDX-License-Identifier: GPL-2.0-or-later
# Rigid bricks collide face to face: the ratio of speeds after and before, against the linear spring and dashpot whose contact ends when its force does.
#
# The damping ratio that eq. (4) gives is not its h. With Kn and m a brick's stiffness and mass, c = 2 h sqrt(m_ave Kn):
#     two bricks       m_ave A = m,    reduced mass m/2:  true ratio h sqrt(2)
#     brick on ground  m_ave A = m/2,  mass m:            true ratio h / sqrt(2)
import unittest

from cases import *

GROUP = 'Restitution'
SIDE, SPEED = .2, .01
REASON = 'dashpots see velocities half a step late: a step of 1/50 of the limit'


class Restitution(Case):

	def collide(self, h, onGround):
		"""Ratio of the relative speeds after and before."""
		O.reset()
		damped = material(hn=h, hs=h)
		first = O.bodies[ground(damped)] if onGround else add((SIDE, SIDE, SIDE), center=(0, 0, -SIDE / 2), material=damped, deformation='rigid')
		second = add((SIDE, SIDE, SIDE), center=(0, 0, SIDE / 2), material=damped, deformation='rigid')
		engines(gravity=(0, 0, 0))
		O.step()
		engine(BrickTimeStepper).active = False
		O.dt = engine(BrickTimeStepper).limit / 50
		second.state.vel = Vector3(0, 0, -SPEED)
		momentum = lambda: sum((b.state.mass * b.state.vel for b in (first, second) if b.state.mass > 0), Vector3.Zero)
		start = momentum()
		O.run(5, True)
		while any(i.isReal for i in O.interactions):
			O.run(100, True)
			if O.time > .1: self.fail('still in contact')
		if not onGround: self.drift = (momentum() - start).norm() / start.norm()
		return (second.state.vel - first.state.vel)[2] / SPEED

	def check(self, factor, onGround):
		for ratio, expected in reference('dyn.restitution').items():
			got = self.collide(float(ratio) / factor, onGround)
			self.judge('true ratio %s' % ratio, got, expected['no_tension'], 2e-3, REASON)
			if not onGround: self.judge('change of momentum', self.drift, 0, 1e-12, 'round-off')

	def test_two_bricks(self):
		self.check(math.sqrt(2), False)

	def test_brick_on_ground(self):
		self.check(1 / math.sqrt(2), True)
