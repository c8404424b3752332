# SPDX-License-Identifier: GPL-2.0-or-later
# Response spectra, intensity measures and the spectrum of EN 1998-1 against closed forms.
"""Tests of yade_brick.spectrum, intensity and designSpectrum; no YADE needed."""

import doctest
import math
import unittest

import numpy as np

import standalone
from motionCase import FileCase

motion, spectrum, intensity = standalone.load("motion"), standalone.load("spectrum"), standalone.load("intensity")
designSpectrum = standalone.load("designSpectrum")
g = motion.standardGravity


def along(values, dt, axis=0):
	return motion.Motion(dt, np.outer(values, np.eye(3)[axis]), "m")


class OscillatorTest(FileCase):

	def test_step_is_answered_by_the_closed_form_at_any_interval(self):
		# u'' + 2 zeta w u' + w^2 u = -A from rest, which a constant acceleration is: exact, whatever dt.
		period, damping, size = 0.8, 0.07, 3.0
		w = 2 * math.pi / period
		damped = w * math.sqrt(1 - damping**2)
		for dt in (0.3, 0.01):
			step = along(np.full(round(6 / dt) + 1, size), dt)
			t = step.times()
			decay = np.exp(-damping * w * t)
			expected = -size / w**2 * (1 - decay * (np.cos(damped * t) + damping * w / damped * np.sin(damped * t)))
			rate = -size / damped * decay * np.sin(damped * t)
			displacement, velocity, acceleration = spectrum.oscillator(step, period, damping)
			np.testing.assert_allclose(displacement[:, 0], expected, atol=1e-13)  # round-off
			np.testing.assert_allclose(velocity[:, 0], rate, atol=1e-12)
			np.testing.assert_allclose(acceleration[:, 0], -2 * damping * w * rate - w**2 * expected, atol=1e-11)
			np.testing.assert_array_equal(displacement[:, 1:], 0)

	def test_harmonic_settles_to_the_closed_form_of_resonance_and_beside_it(self):
		# Steady amplitude A / sqrt((w^2 - p^2)^2 + (2 zeta w p)^2); the beginning has faded by exp(-2 pi 0.05 80).
		frequency, damping, dt = 2.0, 0.05, 0.001
		times = np.arange(40001) * dt
		shake = along(np.sin(2 * math.pi * frequency * times), dt)
		for period in (0.3, 0.5, 0.9):
			w, p = 2 * math.pi / period, 2 * math.pi * frequency
			expected = 1 / math.hypot(w**2 - p**2, 2 * damping * w * p)
			displacement, velocity, acceleration = (values[-2000:, 0] for values in spectrum.oscillator(shake, period, damping))
			# Samples miss the largest value by (p dt)^2 / 8, and are linear between: 1e-4 covers both.
			self.assertAlmostEqual(np.abs(displacement).max() / expected, 1, delta=1e-4)
			self.assertAlmostEqual(np.abs(velocity).max() / (p * expected), 1, delta=1e-4)
			self.assertAlmostEqual(np.abs(acceleration).max() / (expected * math.hypot(w**2, 2 * damping * w * p)), 1, delta=1e-4)

	def test_linear_pieces_agree_with_scipys_own_integration(self):
		# An independent way: scipy.signal.lsim with first-order hold, exact for linear pieces as well.
		from scipy.signal import lsim
		values = np.random.RandomState(3).normal(size=400)
		for period, damping in ((0.05, 0.02), (0.5, 0.0), (3.0, 0.4)):
			w = 2 * math.pi / period
			_, _, states = lsim(([[0, 1], [-w**2, -2 * damping * w]], [[0], [-1]], np.eye(2), np.zeros((2, 1))), values, np.arange(400) * 0.02)
			displacement, velocity, _ = spectrum.oscillator(along(values, 0.02), period, damping)
			np.testing.assert_allclose(displacement[:, 0], states[:, 0], atol=1e-9 * np.abs(states[:, 0]).max())
			np.testing.assert_allclose(velocity[:, 0], states[:, 1], atol=1e-9 * np.abs(states[:, 1]).max())


class ResponseSpectrumTest(FileCase):

	def test_step_doubles_the_acceleration_without_damping(self):
		found = spectrum.responseSpectrum(along(np.full(501, 2.0), 0.02), [0.05, 0.25, 2.0], damping=0)  # 10 s are whole periods: it ends at rest
		# Largest value of 1 - cos: 2, found within 0.3 % by 40 looks a period.
		np.testing.assert_allclose(found.of("x"), 4.0, rtol=3.1e-3)
		np.testing.assert_allclose(found.of("x", "velocity"), 2.0 / (2 * math.pi / found.periods), rtol=3.1e-3)
		np.testing.assert_array_equal(found.of("y"), 0)

	def test_short_pulse_is_followed_beyond_its_end(self):
		# A pulse much shorter than the period gives the velocity v = A D at once: u = v / w afterwards, a quarter of a period later.
		found = spectrum.responseSpectrum(along([5.0, 5.0], 0.01), [2.0], damping=0)
		self.assertAlmostEqual(found.displacement[0, 0] / (0.05 * 2.0 / (2 * math.pi)), 1, delta=3.1e-3)

	def test_limits_of_short_and_long_periods(self):
		times = np.arange(801) * 0.005
		shake = along(np.sin(2 * math.pi * times) * np.sin(math.pi * times / 4)**2, 0.005)
		found = spectrum.responseSpectrum(shake, [0, 0.01, 1000.0])
		peak, moved = shake.peak()[0], np.abs(shake.displacement()[:, 0]).max()
		self.assertEqual(found.acceleration[0, 0], peak)
		self.assertEqual(found.of("x")[0], peak)
		self.assertAlmostEqual(found.of("x")[1] / peak, 1, delta=1e-3)  # a stiff one goes with the ground
		self.assertAlmostEqual(found.displacement[2, 0] / moved, 1, delta=5e-3)  # a soft one stays where it is, but for 2 zeta w u'

	def test_pseudo_values_are_the_displacement_times_powers_of_the_frequency(self):
		found = spectrum.responseSpectrum(along(np.sin(np.arange(300) * 0.1), 0.02), [0.2, 1.0])
		w = 2 * math.pi / found.periods
		np.testing.assert_allclose(found.of("x", "pseudoVelocity"), w * found.displacement[:, 0], rtol=1e-15)
		np.testing.assert_allclose(found.of("x"), w**2 * found.displacement[:, 0], rtol=1e-15)
		np.testing.assert_array_equal(found.of("geometricMean"), 0)

	def test_wrong_periods_and_damping_are_refused(self):
		shake = along([0, 1, 0], 0.1)
		for wrong in ([], [-1], [float("nan")], "x", 3, [[1]]):
			self.refused(lambda: spectrum.responseSpectrum(shake, wrong), "periods is")
		for wrong in (-0.1, 1, "x", None):
			self.refused(lambda: spectrum.responseSpectrum(shake, [1], wrong), "damping is")
		self.refused(lambda: spectrum.oscillator(shake, 0), "period is 0")


class IntensityTest(FileCase):

	def test_triangle_has_the_measures_of_a_triangle(self):
		# From -2 to 2 and back within 1 s each, by hand: integral of the square 8/3, of the absolute value 2.
		found = intensity.intensity(along([-2, 2, -2], 1.0, axis=1))
		np.testing.assert_allclose(found.arias, [0, math.pi / (2 * g) * 8 / 3, 0], rtol=1e-14)
		np.testing.assert_allclose(found.cav, [0, 2, 0], rtol=1e-14)
		np.testing.assert_allclose(found.pga, [0, 2, 0])

	def test_sine_has_the_measures_of_a_sine(self):
		times = np.arange(100001) * 1e-4
		found = intensity.intensity(along(3 * np.sin(2 * math.pi * times), 1e-4))
		# Ten periods; linear between 10000 samples a period, 1e-7 of the peak.
		self.assertAlmostEqual(found.arias[0], math.pi / (2 * g) * 9 / 2 * 10, delta=1e-5)
		self.assertAlmostEqual(found.cav[0], 3 * 2 / math.pi * 10, delta=1e-5)
		self.assertAlmostEqual(found.pgv[0], 3 / math.pi, delta=1e-6)  # A/w (1 - cos): twice the amplitude
		self.assertAlmostEqual(found.pgd[0], 3 * 10 / (2 * math.pi), delta=1e-5)  # its mean velocity, for 10 s
		# sin^2 has 5 % at the half period after 0.5 s, and is symmetric
		self.assertAlmostEqual(found.significantDuration[0], 9, delta=1e-3)

	def test_significant_duration_of_a_constant_is_nine_tenths(self):
		found = intensity.intensity(along(np.ones(101), 0.1))
		self.assertAlmostEqual(found.significantDuration[0], 9.0, places=12)
		self.assertAlmostEqual(found.significantBegin[0], 0.5, places=12)
		self.assertAlmostEqual(intensity.intensity(along(np.ones(101), 0.1), 0.25, 0.75).significantDuration[0], 5.0, places=12)
		self.assertEqual(found.significantDuration[2], 0)
		self.refused(lambda: intensity.intensity(along(np.ones(3), 0.1), 0.9, 0.1), "0.9")

	def test_text_has_the_axes_that_move(self):
		lines = str(intensity.intensity(along(np.ones(11) * g, 0.1, axis=2))).splitlines()
		self.assertEqual([line.split()[0] for line in lines[1:]], ["z"])
		self.assertEqual(lines[1].split()[1], "1")


class DesignSpectrumTest(FileCase):

	def test_docstring_example_holds(self):
		self.assertEqual(doctest.testmod(designSpectrum).failed, 0)

	def test_corners_have_the_values_of_the_code(self):
		# By hand from EN 1998-1: ground C, type 1: S = 1.15, T_B = 0.2, T_C = 0.6, T_D = 2 s
		expected = {0: 1.15, 0.1: 1.15 * 1.75, 0.2: 1.15 * 2.5, 0.6: 1.15 * 2.5, 1.2: 1.15 * 1.25, 2.0: 1.15 * 0.75, 4.0: 1.15 * 0.1875}
		np.testing.assert_allclose(designSpectrum.elasticSpectrum(list(expected), 1.0, "C"), list(expected.values()), rtol=1e-12)

	def test_damping_lowers_the_plateau_but_not_the_ground(self):
		# eta = sqrt(10 / 15), never below 0.55
		np.testing.assert_allclose(designSpectrum.elasticSpectrum([0, 0.3], 1.0, "A", damping=0.1), [1, 2.5 * math.sqrt(10 / 15)], rtol=1e-12)
		np.testing.assert_allclose(designSpectrum.elasticSpectrum([0.3], 1.0, "A", damping=0.5), [2.5 * 0.55], rtol=1e-12)

	def test_all_grounds_are_continuous(self):
		for type in (1, 2):
			for ground in "ABCDE":
				soil = designSpectrum.soils[type][ground]
				for corner in soil[1:]:
					below, above = designSpectrum.elasticSpectrum([corner * (1 - 1e-9), corner * (1 + 1e-9)], 1.0, ground, type)
					self.assertAlmostEqual(below, above, places=7)

	def test_what_the_code_does_not_have_is_refused(self):
		self.refused(lambda: designSpectrum.elasticSpectrum([5], 1.0), "5 s", "4")
		self.refused(lambda: designSpectrum.elasticSpectrum([1], 1.0, "F"), "'F'")
		self.refused(lambda: designSpectrum.elasticSpectrum([1], 1.0, type=3), "type is 3")
		self.refused(lambda: designSpectrum.elasticSpectrum([1], 0), "groundAcceleration is 0")


if __name__ == "__main__":
	unittest.main()
