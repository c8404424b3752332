# SPDX-License-Identifier: GPL-2.0-or-later
# Results: what counts as ok, valid JSON whatever goes in, tables, and histories with units.
"""Tests of yade_brick.report; no YADE needed."""

import doctest
import json
import os
import tempfile
import unittest

import numpy as np

import standalone

report = standalone.load("report")


def strictJson(path):
	"""The content of a file, refusing NaN and Infinity, which Python's reader accepts although JSON has neither."""

	def refuse(text):
		raise AssertionError(f"{text} in {path}")

	with open(path) as file:
		return json.load(file, parse_constant=refuse)


class ReportTest(unittest.TestCase):

	def setUp(self):
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		self.out = os.path.join(folder.name, "new", "folder")

	def test_docstring_example_holds(self):
		self.assertEqual(doctest.testmod(report).failed, 0)

	def test_row_is_judged_relative_to_the_expected_value(self):
		self.assertTrue(report.judgedRow("a", -102, expected=-100, tolerance=0.021)["ok"])
		self.assertFalse(report.judgedRow("a", -102, expected=-100, tolerance=0.019)["ok"])
		self.assertTrue(report.judgedRow("zero", 1e-9, expected=0, tolerance=1e-8)["ok"])
		self.assertFalse(report.judgedRow("zero", -1e-7, expected=0, tolerance=1e-8)["ok"])

	def test_row_is_judged_against_a_limit(self):
		self.assertTrue(report.judgedRow("a", 1, limit=1)["ok"])
		self.assertFalse(report.judgedRow("a", 1.001, limit=1)["ok"])

	def test_values_that_are_not_finite_are_never_ok(self):
		for value in (float("nan"), float("inf"), -float("inf"), np.float64("nan")):
			self.assertIs(report.judgedRow("a", value, limit=1)["ok"], False)
			self.assertIs(report.judgedRow("a", value, expected=1, tolerance=1e9)["ok"], False)

	def test_unclear_rows_are_refused(self):
		for arguments in (dict(), dict(expected=1), dict(expected=1, tolerance=0, limit=1), dict(limit=float("nan")), dict(expected=1, tolerance=-1)):
			with self.assertRaisesRegex(ValueError, "'a'"):
				report.judgedRow("a", 1, **arguments)

	def test_numpy_and_nan_become_valid_json(self):
		rows = [report.judgedRow("a", np.float64(2), expected=np.float32(2), tolerance=0.1), report.judgedRow("b", np.nan, limit=1)]
		path = report.writeResult(self.out, rows, steps=np.int64(7), many=np.arange(3), nested={"inf": np.inf, "pair": (np.bool_(True), None)})
		self.assertEqual(path, os.path.join(self.out, "result.json"))
		content = strictJson(path)
		self.assertEqual(content["rows"][0], {"id": "a", "expected": 2, "tolerance": 0.1, "got": 2, "error": 0, "ok": True})
		self.assertEqual(content["rows"][1], {"id": "b", "limit": 1, "got": None, "ok": False})
		self.assertEqual(content["steps"], 7)
		self.assertEqual(content["many"], [0, 1, 2])
		self.assertEqual(content["nested"], {"inf": None, "pair": [True, None]})

	def test_a_command_that_does_not_judge_has_no_rows(self):
		self.assertEqual(strictJson(report.writeResult(self.out, steps=1)), {"steps": 1})

	def test_second_result_replaces_the_first_and_leaves_nothing_else(self):
		report.writeResult(self.out, steps=1)
		report.writeResult(self.out, steps=2)
		self.assertEqual(strictJson(os.path.join(self.out, "result.json")), {"steps": 2})
		self.assertEqual(os.listdir(self.out), ["result.json"])

	def test_bad_rows_and_facts_are_refused_and_nothing_is_written(self):
		good = report.judgedRow("a", 1, limit=1)
		for rows, words in (
		        ([{"id": "a", "got": 1, "ok": True}], "expected or limit"), ([{"id": "a", "limit": 1, "ok": True}], "lacks got"),
		        ([{**good, "ok": 1}], "ok is 1"), ([{**good, "got": float("nan")}], "never ok"), ([good, good], "two rows")
		):
			with self.assertRaisesRegex(ValueError, words):
				report.writeResult(self.out, rows)
		with self.assertRaisesRegex(ValueError, r"\['deep'\]\[1\].*object"):
			report.writeResult(self.out, deep=[1, object()])
		with self.assertRaisesRegex(ValueError, "key 3"):
			report.writeResult(self.out, deep={3: 1})
		self.assertFalse(os.path.exists(os.path.join(self.out, "result.json")))

	def test_exit_status_is_zero_only_when_all_rows_are_ok(self):
		good, bad = report.judgedRow("a", 1, limit=1), report.judgedRow("b", 2, limit=1)
		self.assertEqual(report.exitStatus([good, good]), 0)
		self.assertEqual(report.exitStatus([good, bad]), 1)

	def test_table_shows_expected_got_and_error_in_line(self):
		rows = [report.judgedRow("displacement", 6.8e-6, expected=6.804e-6, tolerance=0.01), report.judgedRow("b", 2, limit=1)]
		lines = report.table(rows, title="Table 2").splitlines()
		self.assertEqual(lines[0], "Table 2")
		self.assertEqual(lines[2].split(), ["displacement", "6.804e-06", "6.8e-06", "-0.0588", "%", "1", "%", "ok"])
		self.assertEqual(lines[3].split(), ["b", "<=", "1", "2", "NOT", "OK"])
		self.assertEqual(lines[1].index("got") + 3, lines[2].index("6.8e-06") + 7)

	def test_histories_have_headings_with_units(self):
		path = os.path.join(self.out, "histories.csv")
		report.writeHistories(path, {"time [s]": [0, 0.1], "A x [m]": np.array([1e-6, np.nan])})
		with open(path) as file:
			self.assertEqual(file.read(), "time [s],A x [m]\n0,1e-06\n0.1,nan\n")

	def test_bad_histories_are_refused(self):
		unequal = {"t [s]": [1, 2], "x [m]": [1]}
		for columns, words in (({}, "empty"), ({"time": [1]}, "'time'"), ({"a, b [m]": [1]}, "comma"), (unequal, "'x \\[m\\]'")):
			with self.assertRaisesRegex(ValueError, words):
				report.writeHistories(os.path.join(self.out, "h.csv"), columns)


if __name__ == "__main__":
	unittest.main()
