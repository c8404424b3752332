# SPDX-License-Identifier: GPL-2.0-or-later
# Self weight of the paper's straight-joint wall of rigid bricks: springs in series.
import unittest

from cases import *

GROUP = 'Self weight of the walls'
SIDE, COURSES = .2, 6


class RigidWallUnderSelfWeight(Case):
	"""Settled by the engine loop with local damping, not by the direct solution (see testWallWeight), so that each checks the other."""

	def settlement(self, onBricks):
		mortar = material(mortar=Mortar(**UNBREAKABLE))
		if onBricks:
			for i in range(COURSES):
				add((SIDE, SIDE, SIDE), center=(SIDE * i, 0, -SIDE / 2), material=mortar, deformation='rigid', fixed=True)
		else:
			ground(mortar)
		wall = [
		        add((SIDE, SIDE, SIDE), center=(SIDE * i, 0, SIDE * (k + .5)), material=mortar, deformation='rigid')
		        for k in range(COURSES)
		        for i in range(COURSES)
		]
		MortarJoints()()
		engines(damping=.3)
		runFor(4)
		self.sideways = max(abs(b.state.pos[j] - b.state.refPos[j]) for b in wall for j in (0, 1))
		return [[b.state.refPos[2] - b.state.pos[2] for b in wall[COURSES * k:COURSES * (k + 1)]] for k in range(COURSES)]

	def check(self, id, onBricks):
		for k, (course, expected) in enumerate(zip(self.settlement(onBricks), reference(id)['uz'])):
			for which, got in (('least', min(course)), ('largest', max(course))):
				self.judge('%s uz in course %d [m]' % (which, k + 1), got, expected, 1e-6, 'linear springs at rest: what is left is the approach to rest')
		self.judge('sideways [m]', self.sideways, 0, 1e-12, 'rigid bricks have no Poisson effect')

	def test_on_ground(self):
		"""6 x 6 rigid cubes with straight joints on a rigid support, which has no length of its own. Expected: springs in series, each joint of
		two half bricks, the lowest of one."""
		self.check('wall.brick.rigid_closed_ground_l=0', False)

	def test_on_fixed_bricks(self):
		"""The same on a fixed course of such bricks, so that the lowest joint is of two half bricks too."""
		self.check('wall.brick.rigid_closed_ground_l=0.1', True)
