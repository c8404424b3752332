# SPDX-License-Identifier: GPL-2.0-or-later
# What tests of builders share: an empty scene, places that are close, and calls that are refused before anything is added to the scene.
import unittest

from yade import O, Vector3


class BuildCase(unittest.TestCase):

	def setUp(self):
		O.reset()

	def close(self, got, expected, tolerance):
		self.assertLess((Vector3(*got) - Vector3(*expected)).norm(), tolerance, '%s is not %s' % (got, expected))

	def refused(self, words, call, error=ValueError):
		with self.assertRaisesRegex(error, words):
			call()
		self.assertEqual(len(O.bodies), 0)
