# SPDX-License-Identifier: GPL-2.0-or-later
# A column of 50 courses stands for some thousand steps in each level of deformation. Criterion and reason: see standingColumn.py; a million
# steps: slowStandingColumn.py.
import unittest

from standingColumn import *

GROUP = '4 A column of 50 courses stands'


class ShortStand(StandingColumn):

	def test_rigid(self):
		"""50 courses at rest under their weight."""
		self.stand('rigid', 20000)

	def test_uniform(self):
		"""The same."""
		self.stand('uniform', 20000)

	def test_trilinear(self):
		"""The same."""
		self.stand('trilinear', 20000)

	def test_refined(self):
		"""The same with fewer steps."""
		self.stand('refined', 4000)
