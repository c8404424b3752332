# SPDX-License-Identifier: GPL-2.0-or-later
# Three hundred bricks fall into a pit: see heap.py.
import unittest

import heap
from heap import GROUP


class HeapOf300(heap.Heap):

	def test_heap(self):
		"""300 bricks fall into a pit of 2.1 m and come to rest; each fourth one is deformable."""
		self.build(300, 7, ('rigid', 'rigid', 'rigid', 'uniform'))
		self.check(5, 1e-6)
