# SPDX-License-Identifier: GPL-2.0-or-later
# What tests of motions share: files that are made for a test, and refusals that say what was wrong.
"""Base class of the tests of ground motions."""

import os
import tempfile
import unittest


class FileCase(unittest.TestCase):

	def setUp(self):
		self.folder = tempfile.TemporaryDirectory()
		self.addCleanup(self.folder.cleanup)

	def file(self, text, name="motion.txt"):
		path = os.path.join(self.folder.name, name)
		with open(path, "w") as file:
			file.write(text)
		return path

	def refused(self, call, *words):
		"""`call` raises a ValueError whose message has all the words."""
		with self.assertRaises(ValueError) as caught:
			call()
		for word in words:
			self.assertIn(word, str(caught.exception))
