# SPDX-License-Identifier: GPL-2.0-or-later
# Spectrum-compatible noise: how close it comes, that it ends at rest, its envelope, its seed, and what is refused.
"""Tests of yade_brick.spectrumCompatible; no YADE needed."""

import math
import unittest

import numpy as np

import standalone
from motionCase import FileCase

made, designSpectrum = standalone.load("spectrumCompatible"), standalone.load("designSpectrum")
intensity = standalone.load("intensity").intensity

periods = np.geomspace(0.1, 3.0, 60)
target = designSpectrum.elasticSpectrum(periods, 2.0, "C")


class SpectrumCompatibleTest(FileCase):

	@classmethod
	def setUpClass(cls):
		cls.motion = made.syntheticFromSpectrum(periods, target, duration=12, dt=0.02, seed=3, ratios=(1, 0, 0.5), name="EN 1998-1, ground C")

	def test_spectrum_is_within_ten_percent_at_all_periods_also_between_those_that_are_matched(self):
		between = np.geomspace(0.1, 3.0, 333)
		exact = np.exp(np.interp(np.log(between), np.log(periods), np.log(target)))
		# 801 periods were looked at; 333 others lie no farther off than these, by 0.4 % of a period
		self.assertLess(made.mismatch(self.motion, between, exact), 0.1)
		self.assertLess(made.mismatch(self.motion, between, 0.5 * exact, axis="z"), 0.1)

	def test_it_ends_at_rest_where_it_began(self):
		np.testing.assert_allclose(self.motion.residual().velocity, 0, atol=1e-12)  # round-off of 600 sums
		np.testing.assert_allclose(self.motion.residual().displacement, 0, atol=1e-12)
		np.testing.assert_array_equal(self.motion.acceleration[[0, -1]], 0)

	def test_it_says_what_it_is(self):
		self.assertTrue(self.motion.synthetic)
		for word in ("synthetic", "EN 1998-1, ground C", "seed 3", "0.1 to 3 s"):
			self.assertIn(word, self.motion.name)

	def test_components_are_independent(self):
		x, _, z = self.motion.acceleration.T
		# 12 s of noise of some hertz: a correlation of 0.3 would be three standard deviations
		self.assertLess(abs(np.corrcoef(x, z)[0, 1]), 0.3)

	def test_strong_part_is_where_the_envelope_has_it(self):
		found = intensity(self.motion)
		# rises to 1.8 s, falls from 7.8 s on: the square of the envelope has 5 % at 1.6 and 95 % at 9.1 s, and phases scatter that
		self.assertAlmostEqual(found.significantBegin[0], 1.6, delta=1.0)
		self.assertAlmostEqual(found.significantBegin[0] + found.significantDuration[0], 9.1, delta=1.2)

	def test_a_target_that_is_one_already_is_kept_and_a_seed_is_kept_too(self):
		few = dict(duration=6, dt=0.02, matched=(0.3, 1.0), seed=5)
		first, again = (made.syntheticFromSpectrum(periods, target, **few) for _ in range(2))
		np.testing.assert_array_equal(first.acceleration, again.acceleration)
		other = made.syntheticFromSpectrum(periods, target, **{**few, "seed": 6})
		self.assertGreater(np.abs(first.acceleration - other.acceleration).max(), 0.5)
		inside = (periods > 0.3) & (periods < 1.0)
		for motion in (first, other):
			self.assertLess(made.mismatch(motion, periods[inside], target[inside]), 0.1)

	def test_what_cannot_be_met_is_refused_with_what_was_reached(self):
		# a spectrum that falls by a hundred between neighbouring periods is none that an oscillator of 5 % could have
		self.refused(
		        lambda: made.syntheticFromSpectrum([0.3, 0.5, 0.5001, 1.0], [10.0, 10.0, 0.1, 0.1], duration=3, dt=0.05), "tolerance is 0.1", "came within"
		)

	def test_wrong_parameters_are_refused_with_the_value(self):
		for arguments, words in (
		        (dict(duration=-1), ("duration is -1",)), (dict(dt=0), ("dt is 0",)), (dict(matched=(0.05, 1)), ("matched is (0.05, 1)", "0.1")),
		        (dict(matched=(0.1, 3.0), duration=6), ("matched", "2 s")), (dict(strong=(5, 4)), ("strong is (5, 4)",)), (dict(damping=0), ("damping is 0",)),
		        (dict(seed=-1), ("seed is -1",)), (dict(tolerance=0), ("tolerance is 0",)), (dict(ratios=(0, 0, 0)), ("ratios",)), (dict(ratios=(2, 0, 0)), ("ratios",)),
		):
			self.refused(lambda: made.syntheticFromSpectrum(periods, target, **arguments), *words)
		self.refused(lambda: made.syntheticFromSpectrum([1, 0.5], [1, 1]), "periods is", "rising")
		self.refused(lambda: made.syntheticFromSpectrum([0.5, 1], [1, 0]), "accelerations is")
		self.refused(lambda: made.syntheticFromSpectrum([0.5, 1], [1]), "accelerations is", "2")


if __name__ == "__main__":
	unittest.main()
