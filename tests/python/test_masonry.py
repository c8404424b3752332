# SPDX-License-Identifier: GPL-2.0-or-later
# The examples in the docstrings of the modules that build, list and check masonry; all else of them is tested in YADE.
import doctest
import unittest

import standalone


class Docstrings(unittest.TestCase):

	def test_examples_hold(self):
		for name in ("arches", "faces", "joints"):
			with self.subTest(name):
				result = doctest.testmod(standalone.load(name))
				self.assertEqual((result.failed, result.attempted > 0), (0, True))
