# SPDX-License-Identifier: GPL-2.0-or-later
# Thirty bricks of all deformation levels fall into a pit: see heap.py.
import unittest

import heap
from heap import GROUP


class HeapOf30(heap.Heap):

	def test_heap(self):
		"""30 bricks, rigid, uniform, trilinear and refined by turns, fall into a pit of 0.68 m and come to rest."""
		self.build(30, 2, ('rigid', 'uniform', 'trilinear', 'refined'))
		self.check(20, 1e-6)
