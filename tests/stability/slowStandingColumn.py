# SPDX-License-Identifier: GPL-2.0-or-later
# A column of 50 courses stands for a million steps. Criterion and reason: see standingColumn.py.
import unittest

from standingColumn import *

GROUP = '4 A column of 50 courses stands'


class LongStand(StandingColumn):

	def test_rigid(self):
		"""50 courses at rest under their weight for 1e6 steps."""
		self.stand('rigid', 1000000)

	def test_trilinear(self):
		"""The same with deformable bricks."""
		self.stand('trilinear', 1000000)
