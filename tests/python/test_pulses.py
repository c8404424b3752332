# SPDX-License-Identifier: GPL-2.0-or-later
# Synthetic pulses and harmonic motions: what each formula promises of peaks, ends and frequencies.
"""Tests of yade_brick.pulses; no YADE needed."""

import math
import unittest

import numpy as np

import standalone
from motionCase import FileCase

pulses = standalone.load("pulses")


class PulseTest(FileCase):

	def test_all_say_that_they_are_synthetic_and_go_where_they_are_told(self):
		made = (
		        pulses.syntheticRicker(2, 1, "-y"), pulses.syntheticHalfSine(2, 0.5, "-y"), pulses.syntheticPulse(0.5, 1.0, direction="-y"),
		        pulses.syntheticHarmonic(2, 2, direction="-y"), pulses.syntheticSweep(2, 1, 5, 10, direction="-y")
		)
		for motion in made:
			self.assertTrue(motion.synthetic)
			self.assertTrue(motion.name.startswith("synthetic"))
			self.assertIn("-y", motion.name)
			np.testing.assert_array_equal(motion.acceleration[:, [0, 2]], 0)
		self.assertEqual(pulses.syntheticHalfSine(2, 0.5, "-y").acceleration[:, 1].max(), 0)

	def test_ricker_has_its_peak_and_ends_at_rest_where_it_began(self):
		made = pulses.syntheticRicker(3.0, 2.0, dt=0.005)
		self.assertEqual(made.duration, 2.0)
		self.assertAlmostEqual(made.peak()[0], 3.0, places=12)
		# the wavelet is the second derivative of a Gaussian of which exp(-4 pi^2) is left at the ends
		np.testing.assert_allclose(made.residual().velocity, 0, atol=1e-12)
		np.testing.assert_allclose(made.residual().displacement, 0, atol=1e-12)
		spectrum = np.abs(np.fft.rfft(made.acceleration[:, 0], 4000))
		self.assertAlmostEqual(np.fft.rfftfreq(4000, 0.005)[spectrum.argmax()], 2.0, delta=0.051)  # between two lines

	def test_half_sine_leaves_the_velocity_of_its_area(self):
		made = pulses.syntheticHalfSine(4.0, 0.5, dt=0.001)
		self.assertAlmostEqual(made.residual().velocity[0], 2 * 4.0 * 0.5 / math.pi, delta=1e-5)  # trapezoids under a sine
		self.assertAlmostEqual(made.duration, 0.5, places=14)
		self.assertLess(made.endingAtRest().residual().share, 1e-12)

	def test_velocity_pulse_reaches_its_velocity_and_ends_at_rest(self):
		made = pulses.syntheticPulse(1.2, 2.0, cycles=1.5, phase=0.0, direction=(0, 0, 2))
		self.assertAlmostEqual(np.abs(made.velocity()[:, 2]).max(), 1.2, delta=1e-4)  # nu = 0: the envelope's middle is the peak; sampled
		self.assertLess(made.residual().share, 1e-4)
		self.assertGreater(abs(made.residual().displacement[2]), 0.1)
		self.assertLess(abs(pulses.syntheticPulse(1.2, 2.0, cycles=1.5).residual().displacement[0]), 1e-4)

	def test_harmonic_neither_jumps_nor_keeps_a_velocity(self):
		made = pulses.syntheticHarmonic(2.0, 3.0, cycles=9, ramps=2.5)
		self.assertAlmostEqual(made.duration, 3.0, places=12)
		self.assertAlmostEqual(made.peak()[0], 2.0, delta=2.0 * 0.008)  # the peak falls between 66 samples a period
		self.assertLess(made.residual().share, 1e-10)  # what falls mirrors what rises
		self.assertEqual(made.acceleration[0, 0], 0)

	def test_sweep_has_its_frequencies_and_ends_at_rest_where_it_began(self):
		made = pulses.syntheticSweep(3.0, 1.0, 8.0, 20.0)
		self.assertAlmostEqual(made.peak()[0], 3.0, places=12)
		np.testing.assert_allclose(made.residual().velocity, 0, atol=1e-12)
		np.testing.assert_allclose(made.residual().displacement, 0, atol=1e-11)
		# 1 * 8^(t/20): between two crossings of zero there is half a period
		x, t = made.acceleration[:, 0], made.times()
		crossings = t[1:][x[1:] * x[:-1] < 0]
		for time in (5.0, 10.0, 15.0):
			place = np.searchsorted(crossings, time)
			frequency = 2 / (crossings[place + 2] - crossings[place - 2])
			self.assertAlmostEqual(frequency / 8**(time / 20), 1, delta=0.05)  # crossings are known to dt

	def test_wrong_parameters_are_refused_with_the_value(self):
		for call, words in (
		        (lambda: pulses.syntheticRicker(0, 1), ("peak is 0",)), (lambda: pulses.syntheticRicker(1, 10), ("dt is 0.005", "0.004")),
		        (lambda: pulses.syntheticHalfSine(1, -1), ("duration is -1",)), (lambda: pulses.syntheticPulse(1, 1, cycles=1), ("cycles is 1",)),
		        (lambda: pulses.syntheticHarmonic(1, 1, cycles=2.5), ("cycles is 2.5",)), (lambda: pulses.syntheticHarmonic(1, 1, cycles=3, ramps=2), ("ramps is 2",)),
		        (lambda: pulses.syntheticSweep(1, 1, 5, 1), ("ramps is 1.0", "1 s")), (lambda: pulses.syntheticRicker(1, 1, "w"), ("'w'",)),
		):
			self.refused(call, *words)


if __name__ == "__main__":
	unittest.main()
