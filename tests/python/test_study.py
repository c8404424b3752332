# SPDX-License-Identifier: GPL-2.0-or-later
# Studies: tables, which rows count as finished, and the runner with rows that finish, crash, are killed, hang and are interrupted. Runs are python3 itself
# in place of YADE: the runner does not know the difference. tests/yade/testStudy.py runs YADE.
"""Tests of yade_brick.study; no YADE needed."""

import csv
import doctest
import io
import json
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

import standalone

study = standalone.load("study")
here = os.path.dirname(os.path.abspath(__file__))

# In place of YADE: runs the script after -x with its name in sys.argv.
launcher = "import sys; sys.argv = sys.argv[sys.argv.index('-x') + 1:]; exec(compile(open(sys.argv[0]).read(), sys.argv[0], 'exec'))"
executable = [sys.executable, "-c", launcher]

script = """
import os, sys, time
sys.path[:0] = [os.path.dirname(os.path.abspath(sys.argv[0])), {here!r}]
import standalone
study = standalone.load("study")
row = study.row()
with open("runs.txt", "a") as file: file.write(row.description + chr(10))
what = row.parameters["what"]
if what == "raise": raise ValueError("a bad brick")
if what == "kill": os.kill(os.getpid(), 9)
if what == "hang": time.sleep(600)
if what == "nothing": sys.exit(0)
if what == "slow": time.sleep(1.5)
study.record({{"twice": 2 * row.parameters["x"], "list": [1, 2]}})
"""


class InFolder(unittest.TestCase):

	def setUp(self):
		folder, before = tempfile.TemporaryDirectory(), os.getcwd()
		os.chdir(folder.name)
		self.addCleanup(folder.cleanup)
		self.addCleanup(os.chdir, before)
		self.shown = io.StringIO()

	def write(self, path, text):
		with open(path, "w") as file:
			file.write(textwrap.dedent(text))
		return path


class Tables(InFolder):

	def test_doctests(self):
		self.assertEqual(doctest.testmod(study).failed, 0)

	def test_values_come_back_as_they_were(self):
		values = {"a": 0.1 + 0.2, "b": -3, "c": True, "d": None, "e": "text_with.dots/and-more", "f": 1e-300}
		row, = study.readTable(study.writeTable("a.table", [values]))
		self.assertEqual(row.parameters, values)
		self.assertEqual(row.line, 2)
		self.assertEqual(row.folder, os.path.join("a.results", row.description))

	def test_repeated_default_and_described_values(self):
		self.write("a.table", """
			# a comment
			pga!  seed  model    # columns
			pi/2  1     'rigid'

			=     2     *        # another
			""")
		first, second = study.readTable("a.table")
		self.assertAlmostEqual(first.parameters["pga"], 1.5707963267948966)
		self.assertEqual(second.parameters, {"pga": first.parameters["pga"], "seed": 2})
		self.assertEqual((first.line, second.line), (4, 6))
		self.assertEqual((first.description, first.folder), ("pga=pi/2", os.path.join("a.results", "pga=pi_2")))

	def test_bad_tables_are_refused_with_line_and_value(self):
		for text, words in (
		        ("", "0 lines found"), ("a b\n1\n", "line 2: 1 values found; allowed are 2"), ("a b\n= 1\n", "line 2: = found in the first row"),
		        ("a b\n1 ]\n", r"line 2: b is '\]', which is no value"), ("description a\nx/y 1\nx_y 2\n", "'x_y' names the same folder as that of line 2"),
		        ("a\n1\n2", "the last line has no end")
		):
			self.write("bad.table", text)
			with self.assertRaisesRegex(ValueError, "bad.table.*" + words):
				study.readTable("bad.table")
		with self.assertRaisesRegex(ValueError, "colon"):
			study.readTable("a:b")

	def test_rows_that_a_table_cannot_hold_are_refused(self):
		for rows, words in (
		        ([], "rows is empty"), ([{"a": 1}, {"b": 1}], "row 2 has the columns"), ([{"a b": 1}], "columns are"), ([{"a": "x y"}], "row 1, a is 'x y'"),
		        ([{"a": [1]}], "row 1, a is"), ([{"a": float("nan")}], "nan"), ([{"a": "#"}], "#"), ([{"a": 1}, {"a": 1}], "that of row 1")
		):
			with self.assertRaisesRegex(ValueError, words):
				study.writeTable("bad.table", rows)
		self.assertFalse(os.path.exists("bad.table"))


class WithRows(InFolder):

	def setUp(self):
		super().setUp()
		self.write("row.py", script.format(here=here))

	def table(self, **whats):
		"""A table with a row for each name, which does what is said."""
		return study.writeTable("a.table", [{"what": what, "x": x} for x, what in enumerate(whats.values())], lambda row: list(whats)[row["x"]])

	def run_(self, **options):
		return study.runStudy("a.table", "row.py", **{"executable": executable, "stream": self.shown, "jobs": 2, **options})

	def runs(self):
		"""Descriptions of the rows that were run since the last call, sorted."""
		with open("runs.txt") as file:
			found = sorted(file.read().split())
		os.remove("runs.txt")
		return found


class Runs(WithRows):

	def test_failures_are_recorded_and_the_others_finish(self):
		self.table(a="well", b="raise", c="kill", d="nothing", e="hang", f="well")
		report = self.run_(timeout=3, jobs=4)
		states = {row["description"]: (row["state"], row["reason"]) for row in report.rows}
		self.assertEqual([name for name in "abcdef" if states[name][0] == "finished"], ["a", "f"])
		self.assertEqual((report.finished, report.failed, report.run, report.exitStatus), (2, 4, 6, 1))
		for name, reason in (("b", "exit status 1: ValueError: a bad brick"), ("c", "ended by SIGKILL"), ("d", "recorded no result"), ("e", "longer than 3 s")):
			self.assertEqual(states[name][0], "failed")
			self.assertIn(reason, states[name][1])
			self.assertIn(f"  {name}: failed, ", self.shown.getvalue())
		with open(report.rows[1]["log"]) as log:
			self.assertIn("ValueError: a bad brick", log.read())

	def test_results_are_collected(self):
		self.table(a="well", b="raise")
		self.run_()
		with open("a.csv", newline="") as file:
			rows = list(csv.DictReader(file))
		self.assertEqual([(row["state"], row["x"], row["twice"]) for row in rows], [("finished", "0", "0"), ("failed", "1", "")])
		with open("a.json") as file:
			self.assertEqual(json.load(file)["rows"][0]["result"], {"twice": 0, "list": [1, 2]})

	def test_only_what_is_missing_or_changed_is_run_again(self):
		self.table(a="well", b="raise", c="well")
		self.run_()
		self.assertEqual(self.runs(), ["a", "b", "c"])
		self.run_()
		self.assertEqual(self.runs(), ["b"])  # failed
		study.writeTable("a.table", [{"what": "well", "x": x} for x in (0, 1, 5)], lambda row: {0: "a", 1: "b", 5: "c"}[row["x"]])
		report = self.run_()
		self.assertEqual(self.runs(), ["b", "c"])
		self.assertEqual(report.rows[2]["result"]["twice"], 10)
		self.run_(rerun=True)
		self.assertEqual(self.runs(), ["a", "b", "c"])

	def test_a_changed_script_module_or_file_makes_all_rows_run_again(self):
		self.write("helper.py", "value = 1\n")
		self.write("motion.txt", "1")
		self.write("row.py", script.format(here=here).replace("study.record(", "import helper\nstudy.record(dependsOn=['motion.txt'], result="))
		self.table(a="well")
		for path, text in (("helper.py", "value = 2\n"), ("motion.txt", "2"), ("row.py", None)):
			self.run_()
			self.runs()
			self.assertEqual(self.run_().run, 0)
			with open(path, "a") as file:
				file.write("# changed\n" if text is None else text)
			self.assertEqual(self.run_().run, 1, path)

	def test_a_run_finds_its_own_checkpoints_and_not_those_of_another_script(self):
		self.write("row.py", script.format(here=here).replace("study.record(", "os.makedirs(study.checkpointFolder(), exist_ok=True)\nstudy.record("))
		self.table(a="well")
		found = []
		for change in ("", "", "# changed\n"):
			with open("row.py", "a") as file:
				file.write(change)
			self.run_(rerun=True)
			found.append([name for name in os.listdir("a.results/a") if name.startswith("run-")])
			self.assertEqual(len(found[-1]), 1)
		self.assertEqual(found[0], found[1])
		self.assertNotEqual(found[1], found[2])

	def test_a_study_that_is_moved_as_a_whole_stays_finished(self):
		os.mkdir("before")
		os.chdir("before")
		self.write("row.py", script.format(here=here))
		self.table(a="well")
		self.run_()
		os.chdir("..")
		os.rename("before", "after")
		os.chdir("after")
		self.assertEqual(self.run_().run, 0)
		os.chdir("..")

	def test_a_result_that_is_cut_off_is_none(self):
		self.table(a="well")
		path = os.path.join(self.run_().rows[0]["log"], "..", "result.json")
		with open(os.path.normpath(path), "r+") as file:
			file.truncate(40)
		self.assertEqual(self.run_().run, 1)

	def test_progress_has_time_left(self):
		self.table(a="well", b="well", c="well")
		self.run_(jobs=1)
		self.assertRegex(self.shown.getvalue(), r"a.table: 1 of 3 rows, 0:0\d elapsed, 0:\d\d left: a finished\n")
		self.assertIn("a.table: 3 of 3 rows finished (3 runs now", self.shown.getvalue())

	def test_bad_arguments_are_refused_before_anything_is_run(self):
		self.table(a="well")
		for options, words in (
		        (dict(jobs=0), "jobs is 0"), (dict(timeout=-1), "timeout is -1"), (dict(threads=True), "threads is True"), (dict(executable="yade"), "executable")
		):
			with self.assertRaisesRegex(ValueError, words):
				self.run_(**options)
		with self.assertRaisesRegex(ValueError, "no such file"):
			study.runStudy("a.table", "nowhere.py", executable=executable)
		self.write("b.table", "a !THREADS\n1 2\n")
		with self.assertRaisesRegex(ValueError, "!THREADS"):
			study.runStudy("b.table", "row.py", executable=executable)
		self.assertFalse(os.path.exists("a.results"))


class Interruption(WithRows):
	"""The runner itself as a program of its own."""

	def start(self):
		driver = f"import sys; sys.path.insert(0, {here!r}); import standalone; study = standalone.load('study'); "
		driver += f"study.runStudy('a.table', 'row.py', executable={executable!r}, jobs=2)"
		process = subprocess.Popen([sys.executable, "-c", driver], stderr=subprocess.DEVNULL)
		deadline = time.time() + 60
		while not os.path.exists("runs.txt") and time.time() < deadline:
			time.sleep(0.02)
		return process

	def test_terminated_runner_ends_its_runs_and_goes_on_later(self):
		self.table(a="slow", b="slow", c="well")
		process = self.start()
		process.send_signal(signal.SIGTERM)
		self.assertEqual(process.wait(timeout=60), 128 + signal.SIGTERM)
		self.assertFalse(os.path.exists("a.results/a/result.json"))
		report = self.run_()
		self.assertEqual((report.finished, report.exitStatus), (3, 0))

	def test_runs_that_outlive_a_killed_runner_are_waited_for_and_not_run_twice(self):
		self.table(a="slow", b="well")
		process = self.start()
		process.kill()
		process.wait()
		report = self.run_()
		self.assertEqual(report.finished, 2)
		self.assertLessEqual(self.runs().count("a"), 1 + ("a is being run by another program" not in self.shown.getvalue()))

	def test_two_runners_share_a_table(self):
		self.table(**{name: "slow" for name in "abcd"})
		other = self.start()
		report = self.run_()
		other.wait(timeout=60)
		self.assertEqual(report.finished, 4)
		self.assertEqual(self.runs(), list("abcd"))


if __name__ == "__main__":
	unittest.main()
