# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks stacked so that each overhangs the one below by as much as it can: they stand a little below the limit, and fall a little above.
import unittest

from cases import *

GROUP = 'Overhang'
LENGTH, HEIGHT, MARGIN = .2, .1, .04


class Overhang(Case):

	def drop(self, count, share, level, young):
		"""How far the outer edge of the top brick comes down in a tenth of a second [m]; all overhangs are the given share of their limits."""
		O.reset()
		dry = material(young=young, dampingRatio=.1, hn=.02, hs=.02)
		options = dict(material=dry, deformation=level, contactThickness=.005)
		add((1, LENGTH, HEIGHT), center=(-.5, 0, -HEIGHT / 2), fixed=True, **options)
		edge = 0
		for k in range(count):
			# the k-th from below carries count - k - 1 bricks; its own overhang is L / (2 (count - k))
			edge += share * LENGTH / (2 * (count - k))
			top = add((LENGTH, LENGTH, HEIGHT), center=(edge - LENGTH / 2, 0, HEIGHT * (k + .5)), **options)
		self.overhang = edge / share
		engines()
		untilRest(.03)
		height = lambda: (top.state.pos + top.state.ori * Vector3(LENGTH / 2, 0, 0))[2]
		start = height()
		runFor(.1)
		return start - height()

	def test_stacks(self):
		"""One to six bricks, each pushed out over the one below by 4 % less than it can be, stand; by 4 % more, they fall. Rigid and deformable. Expected: the k-th
		brick from the top can overhang by L / (2 k); the sums are the references.
		"""
		limits = reference('dyn.overhang')
		for level, young in (('rigid', 2e10), ('trilinear', 2e9)):
			counts = range(1, len(limits) + 1)
			self.curve('Overhang, ' + level, 'limit', counts, limits, 'bricks', 'overhang [m]')
			for factor, name in ((1 - MARGIN, 'stands'), (1 + MARGIN, 'falls')):
				self.curve('Overhang, ' + level, name, counts, [factor * limit for limit in limits], line=False)
			for count, expected in enumerate(limits, 1):
				stands, falls = (self.drop(count, 1 + sign * MARGIN, level, young) for sign in (-1, 1))
				reason = '%g %% of each overhang are left for the indentation of the edges' % (100 * MARGIN)
				self.judge('%s, %d: overhang at the limit [m]' % (level, count), self.overhang, expected, 1e-6, 'the digits of the reference')
				self.atMost('%s, %d, less: drop [m]' % (level, count), stands, 4e-4, reason)
				self.atMost('%s, %d, more: 2 mm over the drop' % (level, count), 2e-3 / max(falls, 1e-9), 1, reason)
