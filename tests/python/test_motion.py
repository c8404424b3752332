# SPDX-License-Identifier: GPL-2.0-or-later
# Ground motions: file formats with what goes wrong in them, integration, and the promises of the synthetic motion.
"""Tests of yade_brick.motion; no YADE needed."""

import doctest
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import standalone

motion = standalone.load("motion")
g = motion.standardGravity

at2Header = "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 01/01/2000 12:00, STATION A, 090\nACCELERATION TIME HISTORY IN UNITS OF G\n"


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

	def test_coarser_resampling_is_refused(self):
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), "m").resampled(0.2), "0.2", "0.1")

	def test_bad_motions_are_refused_with_the_value(self):
		self.refused(lambda: motion.Motion(0, np.zeros((4, 3)), "m"), "dt is 0")
		self.refused(lambda: motion.Motion(float("nan"), np.zeros((4, 3)), "m"), "nan")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 2)), "m"), "(4, 2)", "(n, 3)")
		self.refused(lambda: motion.Motion(0.1, [[0, 0, 0], [0, np.nan, 0]], "m"), "sample 1", "along y", "nan")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), ""), "name")
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), "Bam", synthetic=True), "'Bam'", "synthetic")

	def test_scaling_by_nan_is_refused(self):
		self.refused(lambda: motion.Motion(0.1, np.zeros((4, 3)), "m").scaled(float("nan")), "nan")


class At2Test(FileCase):

	def test_values_are_g_along_the_axis(self):
		record = motion.readAt2(self.file(at2Header + "NPTS=  6, DT= .00500 SEC\n .1 -.2 .3 .4 .5\n -.6\n"), axis="z")
		self.assertEqual(record.dt, 0.005)
		np.testing.assert_allclose(record.acceleration[:, 2], np.array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6]) * g, rtol=1e-15)
		self.assertEqual(record.peak()[0], 0)
		self.assertFalse(record.synthetic)
		self.assertIn("STATION A", record.name)

	def test_nga_header_with_trailing_comma_is_read(self):
		header = at2Header.replace("HISTORY", "SERIES")
		for line in ("NPTS=   2, DT=   .0050 SEC,", "NPTS=2,DT=.0050SEC", "npts = 2 , dt = 5.0E-03 sec"):
			self.assertEqual(motion.readAt2(self.file(f"{header}{line}\n.1 .2\n")).dt, 0.005)

	def test_values_that_touch_are_separated(self):
		record = motion.readAt2(self.file(at2Header + "NPTS= 5, DT= .01 SEC\n  .1200000E-02-.3600000E-01-3.6E-03 .5D-01-.25\n"))
		np.testing.assert_allclose(record.acceleration[:, 0] / g, [0.0012, -0.036, -0.0036, 0.05, -0.25], rtol=1e-14)

	def test_wrong_count_names_both_counts(self):
		self.refused(lambda: motion.readAt2(self.file(at2Header + "NPTS= 3, DT= .01 SEC\n.1 .2\n")), "motion.txt, line 5", "2 values", "NPTS = 3")
		self.refused(lambda: motion.readAt2(self.file(at2Header + "NPTS= 2, DT= .01 SEC\n.1 .2 .3\n")), "3 values", "NPTS = 2")

	def test_text_and_nan_among_the_values_are_refused_with_the_line(self):
		for text in ("NaN", "*****", "inf", "1.2.E"):
			path = self.file(f"{at2Header}NPTS= 4, DT= .01 SEC\n.1 .2\n.3 {text}\n")
			self.refused(lambda: motion.readAt2(path), "line 6", "allowed are finite numbers")

	def test_header_without_npts_or_dt_is_refused(self):
		self.refused(lambda: motion.readAt2(self.file(at2Header + "1192 .02\n.1 .2\n")), "line 4", "1192 .02", "NPTS=")
		self.refused(lambda: motion.readAt2(self.file(at2Header + "NPTS= 2, DT= 0.0 SEC\n.1 .2\n")), "line 4", "DT is '0.0'")
		self.refused(lambda: motion.readAt2(self.file(at2Header + "NPTS= x, DT= 0.1 SEC\n.1 .2\n")), "line 4", "NPTS is 'x'")

	def test_velocity_file_of_the_same_layout_is_refused(self):
		header = at2Header.replace("ACCELERATION", "VELOCITY").replace("OF G", "OF CM/S")
		self.refused(lambda: motion.readAt2(self.file(header + "NPTS= 2, DT= .01 SEC\n.1 .2\n")), "velocity", "acceleration")

	def test_other_unit_is_refused(self):
		header = at2Header.replace("OF G", "OF CM/S2")
		self.refused(lambda: motion.readAt2(self.file(header + "NPTS= 2, DT= .01 SEC\n.1 .2\n")), "'CM/S2'", "readColumns")

	def test_empty_and_headless_files_are_refused(self):
		self.refused(lambda: motion.readAt2(self.file("\n \n")), "motion.txt", "empty")
		self.refused(lambda: motion.readAt2(self.file("a\nb\n")), "2 lines", "4 header lines")

	def test_missing_file_says_so(self):
		with self.assertRaises(FileNotFoundError):
			motion.readAt2(os.path.join(self.folder.name, "absent.AT2"))

	def test_unknown_axis_is_refused(self):
		self.refused(lambda: motion.readAt2("any", axis="w"), "'w'", "'x'")

	def test_three_files_become_one_motion(self):
		paths = [self.file(f"{at2Header}NPTS= {2 + i}, DT= .01 SEC\n" + ".1 " * (2 + i), f"{i}.AT2") for i in range(3)]
		self.refused(lambda: motion.readAt2Components(x=paths[0], z=paths[1]), "2 samples", "3", "pad=True")
		record = motion.readAt2Components(*paths, name="all three", pad=True)
		np.testing.assert_allclose(record.acceleration / g, [[0.1] * 3] * 2 + [[0, 0.1, 0.1], [0, 0, 0.1]], rtol=1e-15)


class ColumnsTest(FileCase):

	def test_units_are_converted(self):
		for units, factor in (("m/s2", 1), ("g", g), ("cm/s2", 0.01)):
			record = motion.readColumns(self.file("0 1 2\n0.1 3 4\n"), units)
			np.testing.assert_allclose(record.acceleration, np.array([[1, 2, 0], [3, 4, 0]]) * factor, rtol=1e-15)

	def test_unknown_unit_is_refused(self):
		self.refused(lambda: motion.readColumns("any", "gal"), "'gal'", "'cm/s2'")

	def test_separators_comments_and_headings_are_understood(self):
		for text in ("% note\ntime,ax\n0,1\n0.5,2\n", "Time [s]\tax [m/s2]\n\n0\t1\n.5\t2\n", "t;a\n0 ; 1\n0.5 ; 2\n", "# c\n0, 1\n5e-1, 2 \n"):
			record = motion.readColumns(self.file(text), "m/s2")
			self.assertEqual(record.dt, 0.5)
			np.testing.assert_array_equal(record.acceleration, [[1, 0, 0], [2, 0, 0]])

	def test_columns_go_to_the_axes_asked_for(self):
		record = motion.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="zx")
		np.testing.assert_array_equal(record.acceleration, [[2, 0, 1], [4, 0, 3]])
		self.refused(lambda: motion.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="x"), "line 1", "2 acceleration columns")
		self.refused(lambda: motion.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="xx"), "'xx'")

	def test_one_column_without_dt_is_refused(self):
		self.refused(lambda: motion.readColumns(self.file("1\n2\n"), "m/s2"), "0 acceleration columns")

	def test_nan_text_and_decimal_comma_are_refused_with_the_line(self):
		self.refused(lambda: motion.readColumns(self.file("0 1\n0.1 nan\n"), "g"), "line 2", "'nan'")
		self.refused(lambda: motion.readColumns(self.file("0 1\n0.1 inf\n"), "g"), "line 2", "'inf'")
		self.refused(lambda: motion.readColumns(self.file("0 1\n0.1 two\n"), "g"), "line 2", "'two'")
		self.refused(lambda: motion.readColumns(self.file("0;1\n0,1;2\n"), "g"), "line 2", "'0,1'")
		self.refused(lambda: motion.readColumns(self.file("0,1,1\n0.1,,1\n"), "g"), "line 2", "''")

	def test_row_of_another_length_is_refused_with_the_line(self):
		self.refused(lambda: motion.readColumns(self.file("0 1\n\n0.1 1\n0.2\n"), "g"), "line 4", "1 columns", "2 of line 1")

	def test_missing_sample_is_refused_where_it_is(self):
		times = [i * 0.01 for i in range(200) if i != 120]
		self.refused(lambda: motion.readColumns(self.file("".join(f"{t:.3f} 1\n" for t in times)), "g"), "line 121", "1.21 s", "equal steps")

	def test_falling_times_are_refused(self):
		self.refused(lambda: motion.readColumns(self.file("0 1\n.1 1\n.1 1\n"), "g"), "line 3", "rising")

	def test_rounded_times_are_accepted(self):
		text = "".join(f"{i / 128:.3f} 1\n" for i in range(128))
		# 0.992 s over 127 steps: the last time is rounded too, by at most 0.0005 s.
		self.assertAlmostEqual(motion.readColumns(self.file(text), "g").dt, 1 / 128, delta=0.0005 / 127)

	def test_too_few_rows_are_refused(self):
		self.refused(lambda: motion.readColumns(self.file("# only\n0 1\n"), "g"), "1 rows")
		self.refused(lambda: motion.readColumns(self.file(""), "g"), "empty")

	def test_written_motion_reads_back_with_its_label(self):
		made = motion.syntheticNearFault()
		path = os.path.join(self.folder.name, "out.txt")
		motion.writeColumns(made, path)
		back = motion.readColumns(path, "m/s2")
		self.assertTrue(back.synthetic)
		self.assertEqual(back.name, made.name)
		self.assertAlmostEqual(back.dt, made.dt, places=12)
		np.testing.assert_allclose(back.acceleration, made.acceleration, rtol=1e-11, atol=1e-300)  # 12 digits are written


class CombineTest(FileCase):

	def test_two_motions_along_one_axis_are_refused(self):
		one = motion.Motion(0.1, [[0, 0, 0], [1, 0, 0]], "one")
		self.refused(lambda: motion.combineComponents([one, one]), "one", "along x")

	def test_different_intervals_are_refused(self):
		a, b = motion.Motion(0.1, np.eye(3)[:2], "a"), motion.Motion(0.2, np.eye(3)[1:], "b")
		self.refused(lambda: motion.combineComponents([a, b]), "b: dt is 0.2", "0.1")

	def test_none_is_refused(self):
		self.refused(lambda: motion.combineComponents([]), "empty")

	def test_a_synthetic_component_makes_the_whole_synthetic(self):
		recorded = motion.Motion(0.01, np.outer(np.ones(901), [0, 0, 1]), "recorded")
		self.assertTrue(motion.combineComponents([motion.syntheticNearFault(), recorded]).synthetic)


class SyntheticTest(FileCase):

	def test_pulse_acceleration_is_the_derivative_of_its_velocity(self):
		# 402 points miss the pulse's two ends, where its acceleration has a kink and a central difference is of first order only.
		times, step = np.linspace(0, 4, 402), 1e-5
		ahead, behind = (motion.velocityPulse(times + sign * step, 0.9, 2.0, 2.1)[0] for sign in (1, -1))
		# Central difference: error step^2 / 6 times the third derivative (about 60 m/s4 here), and round-off 1e-16 / step.
		np.testing.assert_allclose((ahead - behind) / (2 * step), motion.velocityPulse(times, 0.9, 2.0, 2.1)[1], atol=1e-8)

	def test_name_says_synthetic(self):
		made = motion.syntheticNearFault()
		self.assertTrue(made.synthetic)
		self.assertIn("synthetic", made.name)

	def test_peak_is_the_one_asked_for(self):
		# 60 bisections leave the factor exact to round-off.
		self.assertAlmostEqual(motion.syntheticNearFault().peak()[0] / (0.8 * g), 1, places=12)
		np.testing.assert_allclose(motion.syntheticNearFault(peak=6.0, ratios=(1, 0.5, 0)).peak(), [6, 3, 0], rtol=1e-12)

	def test_number_of_threads_does_not_change_a_bit(self):
		# numpy's matrix products may run on several threads and then add in another order; a collapse would go another way.
		script = "import sys; sys.path.insert(0, sys.argv[1]); import standalone; " \
		         "sys.stdout.buffer.write(standalone.load('motion').syntheticNearFault().acceleration.tobytes())"
		made = []
		for threads in "1", "2", "4":
			limits = {name: threads for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
			made.append(subprocess.run([sys.executable, "-c", script, os.path.dirname(standalone.__file__)], env={**os.environ, **limits}, capture_output=True, check=True).stdout)
		self.assertEqual(len(made[0]), 8 * 3 * 901)
		self.assertTrue(made[0] == made[1] == made[2])

	def test_ground_ends_at_rest_where_it_began(self):
		made = motion.syntheticNearFault(ratios=(1, 0.3, 0.6))
		# Round-off of 900 sums of up to 10 m/s2 times dt.
		np.testing.assert_allclose(made.velocity()[-1], 0, atol=1e-12)
		np.testing.assert_allclose(made.displacement()[-1], 0, atol=1e-12)
		np.testing.assert_array_equal(made.acceleration[[0, -1]], np.zeros((2, 3)))

	def test_first_phase_begins_between_2_and_3_s_and_the_second_before_6_s(self):
		made = motion.syntheticNearFault()
		times, x = made.times(), made.acceleration[:, 0]
		arias = np.cumsum(x ** 2) / np.sum(x ** 2)
		self.assertTrue(2 < times[np.searchsorted(arias, 0.05)] < 3)
		for begin, end in ((2.5, 4.5), (4.8, 6.0)):
			self.assertGreater(np.abs(x[(times > begin) & (times < end)]).max(), 0.4 * g)
		# Two phases, not one long one: between them it is at least twice as calm.
		self.assertLess(np.abs(x[(times > 4.4) & (times < 4.7)]).max(), 0.2 * g)

	def test_same_motion_every_time_and_at_every_interval(self):
		coarse, fine = motion.syntheticNearFault(dt=0.01), motion.syntheticNearFault(dt=0.0025)
		np.testing.assert_array_equal(coarse.acceleration, motion.syntheticNearFault(dt=0.01).acceleration)
		# The peak falls between samples and the drift is a trapezoidal sum: both see dt, by about (20 Hz dt)^2.
		self.assertLess(np.abs(coarse.acceleration - fine.acceleration[::4]).max(), 0.02 * 0.8 * g)

	def test_seed_changes_the_noise(self):
		self.assertGreater(np.abs(motion.syntheticNearFault(seed=1).acceleration - motion.syntheticNearFault(seed=2).acceleration).max(), 1)

	def test_bad_parameters_are_refused_with_the_value(self):
		for arguments, words in (
		        (dict(duration=5), ("duration is 5", "7.3")), (dict(dt=0.03), ("0.03", "0.025")), (dict(dt=-1), ("dt is -1",)),
		        (dict(peak=0), ("peak is 0",)), (dict(pulseVelocity=5), ("pulseVelocity is 5", "peak")), (dict(pulseVelocity=-1), ("-1",)),
		        (dict(phaseTimes=(4, 3)), ("(4, 3)",)), (dict(ratios=(0, 0, 0)), ("ratios",)), (dict(ratios=(2, 0, 0)), ("ratios",)),
		        (dict(seed=-1), ("seed is -1",)), (dict(seed=1.5), ("seed is 1.5",))
		):
			self.refused(lambda: motion.syntheticNearFault(**arguments), *words)


if __name__ == "__main__":
	unittest.main()
