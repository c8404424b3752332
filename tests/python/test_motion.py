# SPDX-License-Identifier: GPL-2.0-or-later
# Ground motions: integration, operations with closed forms, and what is refused.
"""Tests of yade_brick.motion and baseline; no YADE needed."""

import doctest
import math
import unittest

import numpy as np

import standalone
from motionCase import FileCase

motion, synthetic = standalone.load("motion"), standalone.load("synthetic")


class MotionTest(FileCase):

	def test_docstring_example_holds(self):
		self.assertEqual(doctest.testmod(motion).failed, 0)

	def test_constant_acceleration_integrates_to_closed_form(self):
		constant = motion.Motion(0.01, np.tile([2.0, 0, -1], (101, 1)), "constant")
		# The trapezoidal rule is exact for a constant, and for the straight line that follows; what is left is round-off.
		np.testing.assert_allclose(constant.velocity()[-1], [2, 0, -1], atol=1e-13)
		np.testing.assert_allclose(constant.displacement()[-1], [1, 0, -0.5], atol=1e-13)

	def test_peak_is_per_axis_and_absolute(self):
		np.testing.assert_array_equal(motion.Motion(1, [[1, 0, 0], [-3, 0.5, 0]], "m").peak(), [3, 0.5, 0])

	def test_samples_cannot_be_changed_from_outside(self):
		values = np.zeros((3, 3))
		shake = motion.Motion(1, values, "m")
		values[1, 0] = 5
		self.assertEqual(shake.peak()[0], 0)
		with self.assertRaises(ValueError):
			shake.acceleration[0, 0] = 1

	def test_resampling_is_linear_and_keeps_the_last_sample(self):
		fine = motion.Motion(0.1, np.outer([0, 1, 0, 4], [1, 0, 0]), "m").resampled(0.05)
		np.testing.assert_allclose(fine.acceleration[:, 0], [0, 0.5, 1, 0.5, 0, 2, 4], atol=1e-15)

	def test_resampling_ends_at_the_last_multiple_within_the_duration(self):
		self.assertEqual(len(motion.Motion(0.1, np.zeros((4, 3)), "m").resampled(0.07)), 5)

	def test_displacement_is_exact_between_linear_samples(self):
		# by hand: z'' = 6 t on the first second, then 6: z = t^3, then 1 + 3 (t - 1) + 3 (t - 1)^2
		moved = motion.Motion(1.0, np.outer([0, 6, 6], [1, 0, 0]), "m").displacement()[:, 0]
		np.testing.assert_allclose(moved, [0, 1, 7], atol=1e-14)

	def test_residual_is_what_is_left_at_the_end(self):
		left = motion.Motion(1.0, np.outer([0, 6, 6], [0, 1, 0]), "m").residual()
		np.testing.assert_allclose(left.velocity, [0, 9, 0], atol=1e-14)
		np.testing.assert_allclose(left.displacement, [0, 7, 0], atol=1e-14)
		self.assertEqual(left.share, 1)
		self.assertEqual(motion.Motion(1.0, np.zeros((3, 3)), "m").residual().share, 0)

	def test_bad_motions_are_refused_with_the_value(self):
		self.refused(lambda: motion.Motion(0, np.zeros((4, 3)), "m"), "dt is 0")
		self.refused(lambda: motion.Motion(float("nan"), np.zeros((4, 3)), "m"), "nan")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 2)), "m"), "(4, 2)", "(n, 3)")
		self.refused(lambda: motion.Motion(0.1, [[0, 0, 0], [0, np.nan, 0]], "m"), "sample 1", "along y", "nan")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), ""), "name")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), "Bam", synthetic=True), "'Bam'", "synthetic")

	def test_scaling_by_nan_is_refused(self):
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), "m").scaled(float("nan")), "nan")


def sines(frequencies, dt=0.01, seconds=20.0, axis=0):
	"""A sum of sines that is faded in and out, along one axis."""
	times = np.arange(round(seconds / dt) + 1) * dt
	values = sum(np.sin(2 * math.pi * f * times) for f in frequencies) * np.sin(math.pi * times / seconds)**2
	return motion.Motion(dt, np.outer(values, np.eye(3)[axis]), "sines")


class ResamplingTest(FileCase):

	def test_coarser_keeps_what_the_new_interval_can_show(self):
		coarse, slow = sines([1, 3]).resampled(0.04), sines([1, 3])
		# The filter passes within 0.1 %; the two sines together reach 2.
		np.testing.assert_allclose(coarse.acceleration, slow.acceleration[::4], atol=2e-3 * 2)
		self.assertIn("anti-alias", coarse.name)

	def test_coarser_takes_out_what_would_come_back_as_a_false_frequency(self):
		# 20 Hz at 0.04 s would look like 5 Hz.
		self.assertLess(sines([20]).resampled(0.04).peak()[0], 1e-3)
		self.assertGreater(np.abs(sines([20.5]).acceleration[::4, 0]).max(), 0.9)

	def test_interval_may_be_in_any_ratio(self):
		for dt in (0.016, 0.01 * math.sqrt(5)):
			coarse, times = sines([2]).resampled(dt), np.arange(int(20 / dt) + 1) * dt
			exact = np.sin(4 * math.pi * times) * np.sin(math.pi * times / 20)**2
			np.testing.assert_allclose(coarse.acceleration[:, 0], exact, atol=2e-3)  # the filter's 0.1 %
		self.refused(lambda: sines([2]).resampled(1e-9, bandLimited=True), "1e-09", "thousandth")

	def test_band_limited_is_closer_to_a_smooth_motion_than_linear(self):
		fine, coarse = sines([5], dt=0.005), sines([5], dt=0.02)
		linear, smooth = coarse.resampled(0.005), coarse.resampled(0.005, bandLimited=True)
		# linear: (2 pi 5 Hz 0.02 s)^2 / 8 = 0.049 of the amplitude in the middle between samples
		self.assertAlmostEqual(np.abs(linear.acceleration - fine.acceleration).max(), 0.049, delta=0.003)
		self.assertLess(np.abs(smooth.acceleration - fine.acceleration).max(), 2e-3)
		self.assertIn("linear", linear.name)
		self.assertIn("band-limited", smooth.name)

	def test_fewer_than_two_samples_are_refused(self):
		self.refused(lambda: sines([1], seconds=1.0).resampled(1.5), "1.5", "duration")


class CuttingTest(FileCase):

	def test_between_keeps_the_samples_in_it_and_starts_at_zero(self):
		cut = motion.Motion(0.1, np.outer(np.arange(11), [1, 0, 0]), "m").between(0.3, 0.65)
		np.testing.assert_array_equal(cut.acceleration[:, 0], [3, 4, 5, 6])
		self.assertIn("0.3 to 0.65 s", cut.name)
		self.refused(lambda: cut.between(0.2, 0.1), "0.2", "0.1")
		self.refused(lambda: cut.between(0, 5), "5", "0.3")

	def test_padding_adds_zeros_to_the_next_interval(self):
		padded = motion.Motion(0.1, np.ones((2, 3)), "m").padded(before=0.25, after=0.1)
		np.testing.assert_array_equal(padded.acceleration[:, 1], [0, 0, 0, 1, 1, 0])
		self.refused(lambda: padded.padded(before=-1), "before is -1")

	def test_taper_is_half_a_cosine_at_each_end(self):
		tapered = motion.Motion(0.25, np.ones((9, 3)), "m").tapered(1.0, 0.5)
		quarter = 0.5 - 0.5 * math.sqrt(0.5)
		np.testing.assert_allclose(tapered.acceleration[:, 2], [0, quarter, 0.5, 1 - quarter, 1, 1, 1, 0.5, 0], atol=1e-15)
		self.refused(lambda: tapered.tapered(1.5), "1.5", "duration")

	def test_taper_of_equal_ends_is_scipys_tukey_window(self):
		from scipy.signal.windows import tukey
		tapered = motion.Motion(0.01, np.ones((201, 3)), "m").tapered(0.4)
		np.testing.assert_allclose(tapered.acceleration[:, 0], tukey(201, 0.4), atol=1e-14)


class BaselineTest(FileCase):

	def drifting(self, error):
		"""A motion that ends at rest where it began, and the same with an error."""
		times = np.arange(2001) * 0.01
		clean = synthetic.syntheticNearFault(duration=20, phaseTimes=(4, 8)).acceleration
		return clean, motion.Motion(0.01, clean + np.outer(error(times), [1, 0.5, 0]), "drifts")

	def test_constant_error_is_taken_out_exactly(self):
		# Velocity left by the error is linear in time, which the fit of degree 0 removes by its end alone.
		clean, drifts = self.drifting(lambda times: 0.05 + 0 * times)
		self.assertGreater(drifts.residual().velocity[0], 0.9)
		np.testing.assert_allclose(drifts.baselineCorrected(0).acceleration, clean, atol=1e-12)

	def test_last_velocity_is_zero_whatever_the_degree(self):
		_, drifts = self.drifting(lambda times: 0.02 + 0.001 * times**2)
		for degree in range(6):
			left = drifts.baselineCorrected(degree).residual()
			np.testing.assert_allclose(left.velocity, 0, atol=1e-12)  # round-off of 2000 sums
			self.assertLess(left.share, 1e-10)

	def test_last_displacement_is_zero_where_asked(self):
		_, drifts = self.drifting(lambda times: 0.02 + 0.001 * times)
		corrected = drifts.baselineCorrected(2, endDisplacement=True)
		np.testing.assert_allclose(corrected.residual().displacement, 0, atol=1e-11)
		np.testing.assert_allclose(corrected.residual().velocity, 0, atol=1e-12)
		self.assertIn("degree 2", corrected.name)

	def test_correction_is_the_best_fit_among_those_that_end_at_rest(self):
		_, drifts = self.drifting(lambda times: 0.03 * np.cos(0.2 * times))
		best = drifts.baselineCorrected(2)
		# Any other polynomial of that degree without a share in the last velocity leaves a larger sum of squares of the velocity.
		place = np.linspace(-1, 1, len(drifts))
		other = np.column_stack([place**2 - motion.baseline.runningIntegral(place[:, None]**2, 1)[-1] / (len(place) - 1)] * 3)
		least = (best.velocity()[:, 0]**2).sum()
		for size in (1e-3, -1e-3):
			tried = motion.Motion(0.01, best.acceleration + size * other, "other")
			self.assertLess(np.abs(tried.residual().velocity).max(), 1e-9)
			self.assertGreater((tried.velocity()[:, 0]**2).sum(), least)

	def test_wrong_degrees_are_refused(self):
		self.refused(lambda: sines([1]).baselineCorrected(-1), "degree is -1")
		self.refused(lambda: sines([1]).baselineCorrected(0, endDisplacement=True), "degree is 0", "1")
		self.refused(lambda: motion.Motion(1, np.zeros((3, 3)), "m").baselineCorrected(1), "3 samples")

	def test_high_pass_has_the_gain_of_butterworth_both_ways_and_no_phase(self):
		for frequency in (0.25, 0.5, 2.0):
			wave = sines([frequency], dt=0.02, seconds=120.0)
			passed = wave.highPassed(0.5, order=2)
			padding = (len(passed) - len(wave)) // 2
			middle = slice(padding + 2000, padding + 4000)
			ratio = passed.acceleration[middle, 0] @ wave.acceleration[2000:4000, 0] / (wave.acceleration[2000:4000, 0] @ wave.acceleration[2000:4000, 0])
			# The fading of the wave is slow; the filter's frequencies are warped by (pi f dt)^2 / 3, 0.1 % at 2 Hz.
			self.assertAlmostEqual(ratio, 1 / (1 + (0.5 / frequency)**4), delta=5e-3)

	def test_high_pass_leaves_no_drift(self):
		_, drifts = self.drifting(lambda times: 0.02 + 0.002 * times)
		corrected = drifts.highPassed(0.1)
		self.assertEqual(len(corrected), len(drifts) + 2 * 3000)
		# In 30 s, 3 / corner, what the filter still has in it has faded to 1e-6 of the displacement.
		self.assertLess(corrected.residual().share, 1e-5)
		self.assertLess(np.abs(corrected.residual().displacement).max(), 1e-4 * np.abs(corrected.displacement()).max())

	def test_wrong_corners_are_refused(self):
		self.refused(lambda: sines([1]).highPassed(0), "frequency is 0")
		self.refused(lambda: sines([1]).highPassed(50), "frequency is 50", "Nyquist")
		self.refused(lambda: sines([1]).highPassed(0.1, order=9), "order is 9")

	def test_ending_at_rest_leaves_the_record_and_brakes_smoothly(self):
		kicked = motion.Motion(0.01, np.outer(np.ones(101), [2.0, 0, -1]), "kicked")
		stopped = kicked.endingAtRest(0.5)
		np.testing.assert_array_equal(stopped.acceleration[:101], kicked.acceleration)
		np.testing.assert_allclose(stopped.residual().velocity, 0, atol=1e-13)
		self.assertLess(stopped.residual().share, 1e-12)
		# 2 m/s, and 0.01 m/s of the interval in which the acceleration falls to zero, over half a second by 1 - cos
		self.assertAlmostEqual(stopped.acceleration[:, 0].min(), -2 * 2.01 / 0.5, places=12)
		self.refused(lambda: kicked.endingAtRest(0.02), "0.02", "4 dt")


class StrengthTest(FileCase):

	def setUp(self):
		super().setUp()
		self.shake = motion.Motion(0.1, [[0, 0, 0], [3, 4, 0], [-5, 0, 1], [0, 0, 0]], "m")

	def test_peak_of_each_measure(self):
		expected = dict(x=5, y=4, z=1, largest=5, vector=math.sqrt(26), geometricMean=math.sqrt(20))
		for of, value in expected.items():
			self.assertAlmostEqual(self.shake.peakOf(of), value, places=14)
			self.assertAlmostEqual(self.shake.scaledToPeak(2.5, of).peakOf(of), 2.5, places=14)
			self.assertIn(of, self.shake.scaledToPeak(2.5, of).name)

	def test_scaling_without_what_is_scaled_or_by_an_unknown_measure_is_refused(self):
		flat = motion.Motion(0.1, [[0, 0, 0], [1, 0, 0]], "flat")
		self.refused(lambda: flat.scaledToPeak(1, "y"), "flat", "0 m/s2")
		self.refused(lambda: flat.scaledToPeak(1, "mean"), "'mean'", "'geometricMean'")
		self.refused(lambda: flat.scaledToPeak(-1), "-1")
		self.refused(lambda: flat.scaledToSpectralAcceleration(1, 0.5, of="vector"), "'vector'", "'largest'")

	def test_scaling_to_a_spectral_acceleration_reaches_it(self):
		spectrum = standalone.load("spectrum")
		scaled = sines([1, 2]).scaledToSpectralAcceleration(3.0, 0.7, damping=0.03)
		self.assertAlmostEqual(spectrum.responseSpectrum(scaled, [0.7], 0.03).of("x")[0], 3.0, places=12)
		self.assertIn("Sa(0.7 s, 3 %)", scaled.name)

	def test_turning_by_a_quarter_takes_x_to_y(self):
		turned = self.shake.rotated(math.pi / 2)
		np.testing.assert_allclose(turned.acceleration, np.array([[0, 0, 0], [-4, 3, 0], [0, -5, 1], [0, 0, 0]]), atol=1e-14)
		self.assertIn("90 degrees", turned.name)

	def test_directions(self):
		np.testing.assert_array_equal(motion.directionVector("-z"), [0, 0, -1])
		for wrong in ("w", "--x", "xy", "", (0, 0, 0), (1, 2), None, (1, float("nan"), 0)):
			self.refused(lambda: motion.directionVector(wrong), "direction is")


class CombineTest(FileCase):

	def test_two_motions_along_one_axis_are_refused(self):
		one = motion.Motion(0.1, [[0, 0, 0], [1, 0, 0]], "one")
		self.refused(lambda: motion.combineComponents([one, one]), "one", "along x")

	def test_different_intervals_are_refused(self):
		a, b = motion.Motion(0.1, np.eye(3)[:2], "a"), motion.Motion(0.2, np.eye(3)[1:], "b")
		self.refused(lambda: motion.combineComponents([a, b]), "b: dt is 0.2", "0.1")

	def test_different_intervals_are_brought_to_a_common_one_on_request(self):
		a, b = sines([1], dt=0.01), sines([2], dt=0.02, axis=1)
		both = motion.combineComponents([a, b], dt=0.02)
		np.testing.assert_allclose(both.acceleration[:, 0], a.acceleration[::2, 0], atol=1e-3)  # the filter's 0.1 %
		np.testing.assert_array_equal(both.acceleration[:, 1], b.acceleration[:, 1])

	def test_none_is_refused(self):
		self.refused(lambda: motion.combineComponents([]), "empty")

	def test_a_synthetic_component_makes_the_whole_synthetic(self):
		recorded = motion.Motion(0.01, np.outer(np.ones(901), [0, 0, 1]), "recorded")
		self.assertTrue(motion.combineComponents([synthetic.syntheticNearFault(), recorded]).synthetic)


if __name__ == "__main__":
	unittest.main()
