# SPDX-License-Identifier: GPL-2.0-or-later
# How far BrickTimeStepper's bound is from the largest stable step: a run just below the latter keeps its energy, one just above explodes.
import unittest

from cases import *

GROUP = 'Time step'
SIDE = .2


class LimitOfTheTimeStep(Case):

	def pair(self, level, thickness=None):
		undamped = material(mortar=Mortar(**UNBREAKABLE), hn=0, hs=0)
		for k in range(2):
			add((SIDE, SIDE, SIDE), center=(0, 0, SIDE * k), material=undamped, deformation=level, contactThickness=thickness)

	def wall(self, level, thickness=None):
		undamped = material(mortar=Mortar(**UNBREAKABLE), hn=0, hs=0)
		ground(undamped)
		for k in range(4):
			for i in range(4):
				add((SIDE, SIDE, SIDE), center=(SIDE * i, 0, SIDE * (k + .5)), material=undamped, deformation=level, contactThickness=thickness)

	def growth(self, dt, steps=400):
		"""Kinetic energy after many steps of a given size, as a multiple of the energy given at the start; infinite when forces became so."""
		MortarJoints()()
		engines(gravity=(0, 0, 0))
		O.step()
		engine(BrickTimeStepper).active = False
		O.dt = dt
		for k, b in enumerate(b for b in O.bodies if isinstance(b.shape, Brick)):
			b.state.vel = Vector3(1, .7, -1) * 1e-6 * (-1)**k
		start = utils.kineticEnergy()
		for _ in range(steps):
			try: O.step()
			except RuntimeError: return math.inf
		return utils.kineticEnergy() / start

	def bound(self, make):
		O.reset()
		make()
		MortarJoints()()
		engines(gravity=(0, 0, 0))
		O.step()
		return engine(BrickTimeStepper).limit

	def bracket(self, make, stable, unstable):
		"""Runs with both steps [s]."""
		for dt, id in ((stable, 'energy gained'), (unstable, 'inverse of the energy gained')):
			O.reset()
			make()
			got = self.growth(dt)
			reason = 'stable motion keeps its energy, springs and masses share it; one that is unstable by 1 % grows by e^0.28 a step'
			self.atMost('%s at %.4g s' % (id, dt), got if dt == stable else 1 / got, 4 if dt == stable else 1e-6, reason)

	def check(self, make, true, worst, *brick):
		build = lambda: make(*brick)
		self.bracket(build, .99 * true, 1.01 * true)
		bound = self.bound(build)
		self.atMost('bound over largest stable step', bound / true, 1, 'a bound')
		self.atMost('largest stable step over bound', true / bound, worst, 'the bound takes every face as joined to another brick: too many in a pair')

	def test_pair_of_rigid_bricks(self):
		# the bound is set by rotation, on six joined faces: omega^2 = 10 Kn/m; a pair has 2 Kn/m
		self.check(self.pair, reference('dt.pair.rigid.seg4.r0')['dt'], 1.01 * 5**.5, 'rigid')

	def test_pair_of_deformable_bricks(self):
		# the inner part is stepped so that it does not count: brick sqrt(m/K), against full_lumped where it does (-0.3 %)
		self.check(self.pair, reference('dt.pair.deform.seg4.r0.001')['brick sqrt(m/K)'], 1.6, 'trilinear', .001)

	def test_walls(self):
		for brick in (('rigid', None), ('uniform', .005), ('trilinear', .005), ('trilinear', .001)):
			build = lambda: self.wall(*brick)
			bound = self.bound(build)
			self.bracket(build, bound, 1.5 * bound)
