# SPDX-License-Identifier: GPL-2.0-or-later
# What counts as a number, and as a finite one, with NumPy's own numbers.
"""Tests of yade_brick.checks; no YADE needed."""

import doctest
import unittest

import numpy as np

import standalone

checks = standalone.load("checks")


class ChecksTest(unittest.TestCase):

	def test_docstring_examples_hold(self):
		self.assertEqual(doctest.testmod(checks).failed, 0)

	def test_numbers_of_numpy_count_its_truth_values_do_not(self):
		for value in (np.float32(1), np.float64(1), np.int8(1)):
			self.assertTrue(checks.isFinite(value) and checks.isNumber(value))
		self.assertFalse(checks.isFinite(np.float32("nan")))
		self.assertTrue(checks.isNumber(np.float32("nan")))
		self.assertFalse(checks.isFinite(np.bool_(True)))
		self.assertFalse(checks.isNumber(np.array([1.])))


if __name__ == "__main__":
	unittest.main()
