# SPDX-License-Identifier: GPL-2.0-or-later
# More arches, stiffer voussoirs: see testArch.py.
import unittest

from voussoirs import *

GROUP = 'Arch of voussoirs'


class MoreArches(ThinnestArch):

	def test_stiff_voussoirs(self):
		"""Arches of 5, 9 and 11 voussoirs ten times as stiff as those of testArch.py, likewise: they stand half as far above the reference as the softer ones."""
		for count in (5, 9, 11):
			self.standOrFall(count, 9.8e9)

	def test_more_voussoirs(self):
		"""Arches of 11, 13 and 15 voussoirs, as in testArch.py."""
		for count in (11, 13, 15):
			self.standOrFall(count, 9.8e8)

	def test_limits_of_rigid_voussoirs(self):
		"""All references against our linear program, and up to 31 voussoirs as the limit of exact statics of ever stiffer springs."""
		for name in reference('dyn.arch'):
			self.judgeLimit(int(name), (9.8e8, 9.8e9, 9.8e10, 9.8e11) if int(name) <= 31 else ())
