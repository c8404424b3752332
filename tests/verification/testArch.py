# SPDX-License-Identifier: GPL-2.0-or-later
# Semicircular arches of five and nine rigid voussoirs under their own weight: the thinnest that stands. More of them: slowArch.py.
import unittest

from voussoirs import *

GROUP = 'Arch of voussoirs'


class ArchOfVoussoirs(ThinnestArch):

	def test_five_voussoirs(self):
		"""Rigid hexahedra with radial dry joints that do not slide stand on the ground; weight is put on slowly, with damping. Expected: exact statics of the half
		arch on springs that only press (thrust and its place at the crown follow from the springing's standing still) gives the thinnest arch that has an
		equilibrium. One 1.5 % thicker must stand, one 1.5 % thinner fall.
		"""
		self.standOrFall(5, 9.8e8)

	def test_nine_voussoirs(self):
		"""The same with nine voussoirs."""
		self.standOrFall(9, 9.8e8)

	def test_limit_of_rigid_voussoirs(self):
		"""The references are linear programs of rigid sectors; ours gives their numbers. Exact statics of ever stiffer springs converges to them as the inverse
		cubic root of the stiffness, so what an arch of bricks has to be thicker than the reference is the method's compliance.
		"""
		for count in (5, 9):
			self.judgeLimit(count, (9.8e10, 9.8e11))
