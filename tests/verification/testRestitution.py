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
PULLS = 'contact of half a cycle, whose dashpot pulls at the end; ours never attracts'
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
		start, began = momentum(), O.time
		O.run(5, True)
		contact = lambda: next((i for i in O.interactions if i.isReal), None)
		while contact().phys.normalForce.norm() > 0:
			O.step()
		# the force of a step is that at its beginning
		self.duration = O.time - O.dt - began
		while contact():
			O.run(100, True)
			if O.time > .1: self.fail('still in contact')
		if not onGround: self.drift = (momentum() - start).norm() / start.norm()
		return (second.state.vel - first.state.vel)[2] / SPEED

	def check(self, factor, onGround):
		rows = reference('dyn.restitution')
		length, mass = SIDE / 2 * (1 if onGround else 2), DENSITY * SIDE**3 / (1 if onGround else 2)
		frequency = math.sqrt(YOUNG / ((1 - POISSON**2) * length) * SIDE**2 / mass)
		figure, got = 'Restitution, ' + ('brick on ground' if onGround else 'two bricks'), []
		for ratio, expected in rows.items():
			got.append(self.collide(float(ratio) / factor, onGround))
			self.judge('true ratio %s: speed after over before' % ratio, got[-1], expected['no_tension'], 2e-3, REASON)
			duration, label = self.duration * frequency, 'true ratio %s: time of contact, times frequency' % ratio
			self.judge(label, duration, expected['t_nt'], 1e-2, REASON + ', and its end is seen to a step')
			self.compare('true ratio %s: speed after over before' % ratio, got[-1], expected['half_cycle'], PULLS)
			self.compare(label, duration, expected['t_half'], PULLS)
			if not onGround: self.judge('true ratio %s: change of momentum' % ratio, self.drift, 0, 1e-12, 'round-off')
		ratios = [float(ratio) for ratio in rows]
		self.curve(figure, 'ours', ratios, got, 'true damping ratio', 'speed after over before', line=False)
		self.curve(figure, 'contact that does not pull, exact', ratios, [row['no_tension'] for row in rows.values()])
		self.curve(figure, 'contact of half a cycle, exact', ratios, [row['half_cycle'] for row in rows.values()])

	def test_two_bricks(self):
		"""Two free rigid cubes collide at 1 cm/s without gravity. Expected: a mass on a linear spring and dashpot in closed form, whose contact ends when its force
		does; eq. (4) with h gives a true damping ratio of h sqrt(2) here.
		"""
		self.check(math.sqrt(2), False)

	def test_brick_on_ground(self):
		"""The same with a cube against the ground: eq. (4) with h gives a true damping ratio of h / sqrt(2) here."""
		self.check(1 / math.sqrt(2), True)
