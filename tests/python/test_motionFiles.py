# SPDX-License-Identifier: GPL-2.0-or-later
# Files of ground motions: their formats, and what goes wrong in them.
"""Tests of yade_brick.motionFiles; no YADE needed."""

import os
import unittest

import numpy as np

import standalone
from motionCase import FileCase

motionFiles, synthetic = standalone.load("motionFiles"), standalone.load("synthetic")
g = standalone.load("motion").standardGravity

at2Header = "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 01/01/2000 12:00, STATION A, 090\nACCELERATION TIME HISTORY IN UNITS OF G\n"


class At2Test(FileCase):

	def test_values_are_g_along_the_axis(self):
		record = motionFiles.readAt2(self.file(at2Header + "NPTS=  6, DT= .00500 SEC\n .1 -.2 .3 .4 .5\n -.6\n"), axis="z")
		self.assertEqual(record.dt, 0.005)
		np.testing.assert_allclose(record.acceleration[:, 2], np.array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6]) * g, rtol=1e-15)
		self.assertEqual(record.peak()[0], 0)
		self.assertFalse(record.synthetic)
		self.assertIn("STATION A", record.name)

	def test_nga_header_with_trailing_comma_is_read(self):
		header = at2Header.replace("HISTORY", "SERIES")
		for line in ("NPTS=   2, DT=   .0050 SEC,", "NPTS=2,DT=.0050SEC", "npts = 2 , dt = 5.0E-03 sec"):
			self.assertEqual(motionFiles.readAt2(self.file(f"{header}{line}\n.1 .2\n")).dt, 0.005)

	def test_values_that_touch_are_separated(self):
		record = motionFiles.readAt2(self.file(at2Header + "NPTS= 5, DT= .01 SEC\n  .1200000E-02-.3600000E-01-3.6E-03 .5D-01-.25\n"))
		np.testing.assert_allclose(record.acceleration[:, 0] / g, [0.0012, -0.036, -0.0036, 0.05, -0.25], rtol=1e-14)

	def test_wrong_count_names_both_counts(self):
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "NPTS= 3, DT= .01 SEC\n.1 .2\n")), "motion.txt, line 5", "2 values", "NPTS = 3")
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "NPTS= 2, DT= .01 SEC\n.1 .2 .3\n")), "3 values", "NPTS = 2")

	def test_text_and_nan_among_the_values_are_refused_with_the_line(self):
		for text in ("NaN", "*****", "inf", "1.2.E"):
			path = self.file(f"{at2Header}NPTS= 4, DT= .01 SEC\n.1 .2\n.3 {text}\n")
			self.refused(lambda: motionFiles.readAt2(path), "line 6", "allowed are finite numbers")

	def test_older_header_with_the_numbers_first_is_read(self):
		for line in ("   2    .0050 NPTS, DT", "2 .0050 NPTS,DT", " 2, 5.0E-03, npts dt"):
			record = motionFiles.readAt2(self.file(f"{at2Header}{line}\n.1 .2\n"))
			self.assertEqual((len(record), record.dt), (2, 0.005))
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "2 0 NPTS, DT\n.1 .2\n")), "line 4", "DT is '0'")

	def test_vt2_and_dt2_files_are_refused_whatever_they_say(self):
		for extension, quantity in (("VT2", "velocity"), ("dt2", "displacement")):
			path = self.file(at2Header + "NPTS= 2, DT= .01 SEC\n.1 .2\n", "record." + extension)
			self.refused(lambda: motionFiles.readAt2(path), quantity, "AT2")

	def test_header_without_npts_or_dt_is_refused(self):
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "1192 .02\n.1 .2\n")), "line 4", "1192 .02", "NPTS=")
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "NPTS= 2, DT= 0.0 SEC\n.1 .2\n")), "line 4", "DT is '0.0'")
		self.refused(lambda: motionFiles.readAt2(self.file(at2Header + "NPTS= x, DT= 0.1 SEC\n.1 .2\n")), "line 4", "NPTS is 'x'")

	def test_velocity_file_of_the_same_layout_is_refused(self):
		header = at2Header.replace("ACCELERATION", "VELOCITY").replace("OF G", "OF CM/S")
		self.refused(lambda: motionFiles.readAt2(self.file(header + "NPTS= 2, DT= .01 SEC\n.1 .2\n")), "velocity", "acceleration")

	def test_other_unit_is_refused(self):
		header = at2Header.replace("OF G", "OF CM/S2")
		self.refused(lambda: motionFiles.readAt2(self.file(header + "NPTS= 2, DT= .01 SEC\n.1 .2\n")), "'CM/S2'", "readColumns")

	def test_empty_and_headless_files_are_refused(self):
		self.refused(lambda: motionFiles.readAt2(self.file("\n \n")), "motion.txt", "empty")
		self.refused(lambda: motionFiles.readAt2(self.file("a\nb\n")), "2 lines", "4 header lines")

	def test_missing_file_says_so(self):
		with self.assertRaises(FileNotFoundError):
			motionFiles.readAt2(os.path.join(self.folder.name, "absent.AT2"))

	def test_unknown_axis_is_refused(self):
		self.refused(lambda: motionFiles.readAt2("any", axis="w"), "'w'", "'x'")

	def test_three_files_become_one_motion(self):
		paths = [self.file(f"{at2Header}NPTS= {2 + i}, DT= .01 SEC\n" + ".1 " * (2 + i), f"{i}.AT2") for i in range(3)]
		self.refused(lambda: motionFiles.readAt2Components(x=paths[0], z=paths[1]), "2 samples", "3", "pad=True")
		record = motionFiles.readAt2Components(*paths, name="all three", pad=True)
		np.testing.assert_allclose(record.acceleration / g, [[0.1] * 3] * 2 + [[0, 0.1, 0.1], [0, 0, 0.1]], rtol=1e-15)

	def test_three_files_of_different_intervals_are_refused_or_resampled(self):
		paths = [self.file(f"{at2Header}NPTS= {count}, DT= {dt} SEC\n" + ".1 " * count, f"{count}.AT2") for count, dt in ((9, 0.005), (5, 0.01), (3, 0.02))]
		self.refused(lambda: motionFiles.readAt2Components(*paths), "dt is 0.01", "0.005", "resample")
		record = motionFiles.readAt2Components(*paths, dt=0.005)
		np.testing.assert_allclose(record.acceleration / g, 0.1, rtol=1e-12)


class ColumnsTest(FileCase):

	def test_units_are_converted(self):
		for units, factor in (("m/s2", 1), ("g", g), ("cm/s2", 0.01)):
			record = motionFiles.readColumns(self.file("0 1 2\n0.1 3 4\n"), units)
			np.testing.assert_allclose(record.acceleration, np.array([[1, 2, 0], [3, 4, 0]]) * factor, rtol=1e-15)

	def test_unknown_unit_is_refused(self):
		self.refused(lambda: motionFiles.readColumns("any", "gal"), "'gal'", "'cm/s2'")

	def test_units_are_asked_for_or_said_in_the_file_but_not_guessed(self):
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n1 2\n")), "does not say its units", "'g'")
		self.refused(lambda: motionFiles.readColumns(self.file("# units: ft/s2\n0 1\n1 2\n")), "'ft/s2'", "'cm/s2'")
		said = self.file("# Units: cm/s2\n0 1\n1 2\n")
		self.assertEqual(motionFiles.readColumns(said).peak()[0], 0.02)
		self.assertEqual(motionFiles.readColumns(said, "cm/s2").peak()[0], 0.02)
		self.refused(lambda: motionFiles.readColumns(said, "g"), "'g'", "'cm/s2'")

	def test_separators_comments_and_headings_are_understood(self):
		for text in ("% note\ntime,ax\n0,1\n0.5,2\n", "Time [s]\tax [m/s2]\n\n0\t1\n.5\t2\n", "t;a\n0 ; 1\n0.5 ; 2\n", "# c\n0, 1\n5e-1, 2 \n"):
			record = motionFiles.readColumns(self.file(text), "m/s2")
			self.assertEqual(record.dt, 0.5)
			np.testing.assert_array_equal(record.acceleration, [[1, 0, 0], [2, 0, 0]])

	def test_columns_go_to_the_axes_asked_for(self):
		record = motionFiles.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="zx")
		np.testing.assert_array_equal(record.acceleration, [[2, 0, 1], [4, 0, 3]])
		self.refused(lambda: motionFiles.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="x"), "line 1", "2 acceleration columns")
		self.refused(lambda: motionFiles.readColumns(self.file("1 2\n3 4\n"), "m/s2", dt=0.01, axes="xx"), "'xx'")

	def test_one_column_without_dt_is_refused(self):
		self.refused(lambda: motionFiles.readColumns(self.file("1\n2\n"), "m/s2"), "0 acceleration columns")

	def test_nan_text_and_decimal_comma_are_refused_with_the_line(self):
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n0.1 nan\n"), "g"), "line 2", "'nan'")
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n0.1 inf\n"), "g"), "line 2", "'inf'")
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n0.1 two\n"), "g"), "line 2", "'two'")
		self.refused(lambda: motionFiles.readColumns(self.file("0;1\n0,1;2\n"), "g"), "line 2", "'0,1'")
		self.refused(lambda: motionFiles.readColumns(self.file("0,1,1\n0.1,,1\n"), "g"), "line 2", "''")

	def test_row_of_another_length_is_refused_with_the_line(self):
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n\n0.1 1\n0.2\n"), "g"), "line 4", "1 columns", "2 of line 1")

	def test_missing_sample_is_refused_where_it_is(self):
		times = [i * 0.01 for i in range(200) if i != 120]
		self.refused(lambda: motionFiles.readColumns(self.file("".join(f"{t:.3f} 1\n" for t in times)), "g"), "line 121", "1.21 s", "equal steps")

	def test_falling_times_are_refused(self):
		self.refused(lambda: motionFiles.readColumns(self.file("0 1\n.1 1\n.1 1\n"), "g"), "line 3", "rising")

	def test_rounded_times_are_accepted(self):
		text = "".join(f"{i / 128:.3f} 1\n" for i in range(128))
		# 0.992 s over 127 steps: the last time is rounded too, by at most 0.0005 s.
		self.assertAlmostEqual(motionFiles.readColumns(self.file(text), "g").dt, 1 / 128, delta=0.0005 / 127)

	def test_too_few_rows_are_refused(self):
		self.refused(lambda: motionFiles.readColumns(self.file("# only\n0 1\n"), "g"), "1 rows")
		self.refused(lambda: motionFiles.readColumns(self.file(""), "g"), "empty")

	def test_written_motion_reads_back_with_its_label(self):
		made = synthetic.syntheticNearFault()
		path = os.path.join(self.folder.name, "out.txt")
		motionFiles.writeColumns(made, path)
		back = motionFiles.readColumns(path)
		self.assertTrue(back.synthetic)
		self.assertEqual(back.name, made.name)
		self.assertAlmostEqual(back.dt, made.dt, places=12)
		np.testing.assert_allclose(back.acceleration, made.acceleration, rtol=1e-11, atol=1e-300)  # 12 digits are written


if __name__ == "__main__":
	unittest.main()
