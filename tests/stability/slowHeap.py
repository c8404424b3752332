# SPDX-License-Identifier: GPL-2.0-or-later
# Three hundred rigid bricks fall into a pit: see heap.py.
import unittest

import heap
from heap import GROUP


class HeapOf300(heap.Heap):

	def test_heap(self):
		"""300 rigid bricks fall into a pit of 2.1 m and come to rest."""
		self.build(300, 7, ('rigid',))
		self.check(20, 1e-6)
