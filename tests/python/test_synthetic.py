# SPDX-License-Identifier: GPL-2.0-or-later
# The promises of the synthetic near-fault motion.
"""Tests of yade_brick.synthetic; no YADE needed."""

import os
import subprocess
import sys
import unittest

import numpy as np

import standalone
from motionCase import FileCase

synthetic = standalone.load("synthetic")
g = standalone.load("motion").standardGravity


class SyntheticTest(FileCase):

	def test_pulse_acceleration_is_the_derivative_of_its_velocity(self):
		# 402 points miss the pulse's two ends, where its acceleration has a kink and a central difference is of first order only.
		times, step = np.linspace(0, 4, 402), 1e-5
		ahead, behind = (synthetic.velocityPulse(times + sign * step, 0.9, 2.0, 2.1)[0] for sign in (1, -1))
		# Central difference: error step^2 / 6 times the third derivative (about 60 m/s4 here), and round-off 1e-16 / step.
		np.testing.assert_allclose((ahead - behind) / (2 * step), synthetic.velocityPulse(times, 0.9, 2.0, 2.1)[1], atol=1e-8)

	def test_name_says_synthetic(self):
		made = synthetic.syntheticNearFault()
		self.assertTrue(made.synthetic)
		self.assertIn("synthetic", made.name)

	def test_peak_is_the_one_asked_for(self):
		# 60 bisections leave the factor exact to round-off.
		self.assertAlmostEqual(synthetic.syntheticNearFault().peak()[0] / (0.8 * g), 1, places=12)
		np.testing.assert_allclose(synthetic.syntheticNearFault(peak=6.0, ratios=(1, 0.5, 0)).peak(), [6, 3, 0], rtol=1e-12)

	def test_number_of_threads_does_not_change_a_bit(self):
		# numpy's matrix products may run on several threads and then add in another order; a collapse would go another way.
		script = "import sys; sys.path.insert(0, sys.argv[1]); import standalone; " \
		         "sys.stdout.buffer.write(standalone.load('synthetic').syntheticNearFault().acceleration.tobytes())"
		made = []
		for threads in "1", "2", "4":
			limits = {name: threads for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
			made.append(subprocess.run([sys.executable, "-c", script, os.path.dirname(standalone.__file__)], env={**os.environ, **limits}, capture_output=True, check=True).stdout)
		self.assertEqual(len(made[0]), 8 * 3 * 901)
		self.assertTrue(made[0] == made[1] == made[2])

	def test_ground_ends_at_rest_where_it_began(self):
		made = synthetic.syntheticNearFault(ratios=(1, 0.3, 0.6))
		# Round-off of 900 sums of up to 10 m/s2 times dt.
		np.testing.assert_allclose(made.velocity()[-1], 0, atol=1e-12)
		np.testing.assert_allclose(made.displacement()[-1], 0, atol=1e-12)
		np.testing.assert_array_equal(made.acceleration[[0, -1]], np.zeros((2, 3)))

	def test_first_phase_begins_between_2_and_3_s_and_the_second_before_6_s(self):
		made = synthetic.syntheticNearFault()
		times, x = made.times(), made.acceleration[:, 0]
		arias = np.cumsum(x ** 2) / np.sum(x ** 2)
		self.assertTrue(2 < times[np.searchsorted(arias, 0.05)] < 3)
		for begin, end in ((2.5, 4.5), (4.8, 6.0)):
			self.assertGreater(np.abs(x[(times > begin) & (times < end)]).max(), 0.4 * g)
		# Two phases, not one long one: between them it is at least twice as calm.
		self.assertLess(np.abs(x[(times > 4.4) & (times < 4.7)]).max(), 0.2 * g)

	def test_same_motion_every_time_and_at_every_interval(self):
		coarse, fine = synthetic.syntheticNearFault(dt=0.01), synthetic.syntheticNearFault(dt=0.0025)
		np.testing.assert_array_equal(coarse.acceleration, synthetic.syntheticNearFault(dt=0.01).acceleration)
		# The peak falls between samples and the drift is a trapezoidal sum: both see dt, by about (20 Hz dt)^2.
		self.assertLess(np.abs(coarse.acceleration - fine.acceleration[::4]).max(), 0.02 * 0.8 * g)

	def test_seed_changes_the_noise(self):
		self.assertGreater(np.abs(synthetic.syntheticNearFault(seed=1).acceleration - synthetic.syntheticNearFault(seed=2).acceleration).max(), 1)

	def test_bad_parameters_are_refused_with_the_value(self):
		for arguments, words in (
		        (dict(duration=5), ("duration is 5", "7.3")), (dict(dt=0.03), ("0.03", "0.025")), (dict(dt=-1), ("dt is -1",)),
		        (dict(peak=0), ("peak is 0",)), (dict(pulseVelocity=5), ("pulseVelocity is 5", "peak")), (dict(pulseVelocity=-1), ("-1",)),
		        (dict(phaseTimes=(4, 3)), ("(4, 3)",)), (dict(ratios=(0, 0, 0)), ("ratios",)), (dict(ratios=(2, 0, 0)), ("ratios",)),
		        (dict(seed=-1), ("seed is -1",)), (dict(seed=1.5), ("seed is 1.5",))
		):
			self.refused(lambda: synthetic.syntheticNearFault(**arguments), *words)


if __name__ == "__main__":
	unittest.main()
