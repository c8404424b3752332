# SPDX-License-Identifier: GPL-2.0-or-later
# The pure parts of the benchmarks: ratios and verdicts, alternation, what is skipped, tables and files. Nothing is timed, no YADE needed.
"""Tests of benchmarks/."""

import doctest
import json
import os
import pathlib
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks"))
import results
import run
import sampling
import targets
from targets import Figure, Measurement, Outcome, Row


def measurement(name, package=""):
	return Measurement(name, f"{{programs}}/{name} {{seconds}}", package=package)


def figure(of, key="cpu"):
	return Figure(f"{of.name} {key}", "us", of, lambda sample: sample[key])


one, two, three, four = (measurement(name) for name in ("one", "two", "three", "four"))
faster = Row("faster", "two over one", (figure(two), figure(one)), limit=2, atLeast=True)
lean = Row("lean", "three over one", (figure(three), figure(one)), limit=1.5, profiled=(three, ))
alone = Row("alone", "four", (figure(four), ), limit=10, unit="kB", value=targets.itself)


def samples(**values):
	"""{name: [sample, ...]} from name=[cpu time of each round]."""
	return {name: [{"cpu": value} for value in each] for name, each in values.items()}


class OutcomeTest(unittest.TestCase):

	def test_value_is_the_ratio_of_medians_and_its_range_that_of_the_rounds(self):
		outcome = Outcome(faster, samples(one=[1, 2, 4], two=[30, 8, 4]))
		self.assertEqual(outcome.medians, [8, 2])
		self.assertEqual(outcome.value, 4)
		self.assertEqual(outcome.range, (1, 30))
		self.assertEqual(outcome.measured, "4 (1 to 30)")

	def test_verdict_follows_the_side_of_the_limit(self):
		for row, value, verdict in ((faster, 2, "met"), (faster, 1.99, "missed"), (lean, 1.5, "met"), (lean, 1.51, "missed"), (lean, float("nan"), "missed")):
			name = row.figures[0].measurement.name
			self.assertEqual(Outcome(row, samples(one=[1], **{name: [value]})).verdict, verdict, (row.name, value))

	def test_figures_that_are_only_shown_do_not_change_the_value(self):
		row = Row("shown", "", faster.figures + (figure(four), ), limit=2)
		outcome = Outcome(row, samples(one=[2], two=[3], four=[1234.5]))
		self.assertEqual(outcome.value, 1.5)
		self.assertEqual(outcome.figures, ["two cpu 3 us", "one cpu 2 us", "four cpu 1234 us"])

	def test_one_round_has_no_range(self):
		self.assertEqual(Outcome(alone, samples(four=[4.4444])).measured, "4.44 kB")

	def test_skipped_row_has_no_value(self):
		outcome = Outcome(faster, trouble="skipped: libx is not installed")
		self.assertEqual((outcome.verdict, outcome.measured, outcome.figures), ("skipped: libx is not installed", "-", []))


class ReadersTest(unittest.TestCase):
	sample = {"bricks": 10, "steps": 100, "simulated": 0.5, "cpu": 2.0, "wall": 3.0, "dt": 0.005, "memory": {"before": 100.0, "bodies": 150.0, "steps": 1100.0}}

	def test_units(self):
		self.assertEqual(targets.perBrickStep(self.sample), 2000)  # us
		self.assertEqual(targets.wallPerStep(self.sample), 30)  # ms
		self.assertEqual(targets.perSimulatedSecond(self.sample), 4)
		self.assertEqual(targets.stepSize(self.sample), 5)  # ms
		self.assertEqual(targets.memoryTaken(self.sample), 1)  # MB
		self.assertEqual(targets.memoryOf("bodies", "before")(self.sample), 5)  # kB a brick

	def test_memory_is_what_an_added_brick_takes(self):
		self.assertAlmostEqual(targets.perAddedBrick(40 + 0.006 * 36000, 40 + 0.006 * 9000), 6)

	def test_benchmark_counters_and_what_the_machine_cannot_run(self):
		entries = [
		        {"name": "peak/avx2", "items_per_second": 5e10}, {"name": "peak/avx512", "error_occurred": True},
		        {"name": "segmentUpdates/4", "items_per_second": 1e8, "leanFlopsPerSegment": 100}
		]
		sample = {"benchmarks": entries}
		self.assertEqual(targets.counted("peak/avx2", "items_per_second", 1e-9)(sample), 50)
		self.assertEqual(targets.counted("peak/avx512")(sample), 0)
		self.assertAlmostEqual(targets.ofRoofline(100, 50, 0, 250), 0.5)
		self.assertAlmostEqual(targets.ofLeanRoofline(sample), 0.2)


class RowsTest(unittest.TestCase):

	def test_names_are_unique(self):
		self.assertEqual(len({row.name for row in targets.rows}), len(targets.rows))
		commands = {}
		for row in targets.rows:
			for each in row.measurements:
				self.assertEqual(commands.setdefault(each.name, each.command), each.command)

	def test_profiled_scenes_are_scenes_of_the_row(self):
		for row in targets.rows:
			for each in row.profiled:
				self.assertIn(each, row.measurements)
				self.assertIn("{scenes}", each.command)

	def test_only_takes_names_and_their_beginnings(self):
		chosen = run.options(["--only", "floor,memory"])
		self.assertEqual([row.name for row in chosen.rows], ["floor-deformable", "floor-rigid", "memory"])
		self.assertEqual(len(run.options([]).rows), len(targets.rows))


class SessionsTest(unittest.TestCase):

	def test_rows_that_share_a_measurement_are_one_session(self):
		self.assertEqual(sampling.sessions([faster, alone, lean]), [[two, one, three], [four]])

	def test_a_row_can_join_two_sessions(self):
		both = Row("both", "", (figure(four), figure(one)), limit=1)
		self.assertEqual(sampling.sessions([faster, alone, both, lean]), [[two, one, four, three]])

	def test_sides_alternate_and_a_failure_stops_only_its_own(self):
		order = []

		class Fake:

			def sample(self, each):
				order.append(each.name)
				if each is three:
					raise sampling.MeasurementFailed("broken")
				return {"cpu": len(order)}

		taken, failed = sampling.measure([faster, lean], Fake(), 2, lambda message: None)
		self.assertEqual(order, ["two", "one", "three", "two", "one"])
		self.assertEqual(taken["two"], [{"cpu": 1}, {"cpu": 4}])
		self.assertEqual(failed, {"three": "broken"})

	def test_what_is_missing_or_failed_takes_its_rows_with_it(self):
		outcomes = run.outcomesOf([faster, lean, alone], {"four": "libx is not installed"}, samples(one=[1], two=[3]), {"three": "broken"})
		self.assertEqual([outcome.verdict for outcome in outcomes], ["met", "failed: broken", "skipped: libx is not installed"])

	def test_profiles_are_made_once_for_missed_rows_alone(self):
		asked = []

		class Fake:

			def profile(self, each):
				asked.append(each.name)
				return {"InteractionLoop": 1.0}

		again = Row("again", "", lean.figures, limit=1, profiled=lean.profiled)
		outcomes = run.outcomesOf([faster, lean, again], {}, samples(one=[1], two=[3], three=[3]), {})
		run.addProfiles(outcomes, Fake(), lambda message: None)
		self.assertEqual(asked, ["three"])
		self.assertEqual([outcome.profiles for outcome in outcomes], [{}, *2 * [{"three": {"InteractionLoop": 1.0}}]])


class RunnerTest(unittest.TestCase):

	def setUp(self):
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		self.folder = folder.name
		self.runner = sampling.Runner("/yade", self.folder, 0.5)

	def program(self, name, script):
		path = os.path.join(self.folder, name)
		with open(path, "w") as file:
			file.write("#!/bin/sh\n" + script)
		os.chmod(path, stat.S_IRWXU)

	def test_doctests(self):
		self.assertEqual(doctest.testmod(sampling).failed, 0)

	def test_command_is_filled_in_and_pinned_to_a_processor_a_thread(self):
		self.assertEqual(self.runner.command(one)[-2:], [os.path.join(self.folder, "one"), "0.5"])
		words = self.runner.command(targets.floor)
		self.assertIn("/yade", words)
		if words[0] == "taskset":
			self.assertEqual(words[2], str(max(os.sched_getaffinity(0))))

	def test_sample_is_what_the_program_prints_last(self):
		self.program("one", 'echo Welcome; echo "{\\"steps\\": $1}"\n')
		self.assertEqual(self.runner.sample(one), {"steps": 0.5})

	def test_failures_say_why(self):
		self.program("one", "echo no wall >&2; exit 3\n")
		self.program("two", "echo nothing of use\n")
		for each, words in ((one, "ended with 3: no wall"), (two, "no result"), (three, "three")):
			with self.assertRaisesRegex(sampling.MeasurementFailed, words):
				self.runner.sample(each)

	def test_missing_packages_and_processors_are_named(self):
		self.assertEqual(self.runner.missing(measurement("peer", "no-such-package")), "no-such-package is not installed")
		self.assertEqual(self.runner.missing(one), "")
		self.assertIn("processors are needed", self.runner.missing(Measurement("many", "x", threads=10**6)))


class ResultsTest(unittest.TestCase):

	def setUp(self):
		taken = samples(one=[1, 1, 1], two=[3, 3, 4], three=[3, 2, 3])
		self.samples = taken
		self.outcomes = run.outcomesOf([faster, lean, alone], {"four": "libx is not installed"}, taken, {})
		self.outcomes[1].profiles = {"three": {"NewtonIntegrator": 25.0, "InteractionLoop": 75.0}}

	def test_table_has_a_line_for_each_row_and_its_figures_under_it(self):
		lines = results.text(self.outcomes).splitlines()
		self.assertEqual(lines[0].split(), ["what", "target", "measured"])
		self.assertTrue(lines[1].startswith("two over one") and lines[1].endswith("met"))
		self.assertEqual(lines[2], "    two cpu 3 us; one cpu 1 us")
		self.assertTrue(lines[3].endswith("missed"))
		self.assertEqual(lines[5].split(), ["four", "<=", "10", "kB", "-", "skipped:", "libx", "is", "not", "installed"])
		self.assertEqual({line.index(word) for line, word in ((lines[0], "target"), (lines[1], ">="), (lines[3], "<="))}, {lines[0].index("target")})

	def test_markdown_has_profiles_of_missed_rows(self):
		text = results.markdown(self.outcomes, {"processor": "x", "YADE": None})
		self.assertIn("| two over one | >= 2 | 3 (3 to 4) | met | two cpu 3 us; one cpu 1 us |", text)
		self.assertIn("| three | lean | 100 us | InteractionLoop 75 (75%), NewtonIntegrator 25 (25%) |", text)
		self.assertNotIn("YADE:", text)
		self.assertNotIn("spend their steps", results.markdown(self.outcomes[:1], {}))

	def test_files_hold_all_samples(self):
		with tempfile.TemporaryDirectory() as folder:
			out = os.path.join(folder, "new", "folder")
			results.write(out, self.outcomes, {"cores": 2}, self.samples, {name: f"run {name}" for name in self.samples})
			with open(os.path.join(out, "benchmarks.json")) as file:
				content = json.load(file)
			self.assertEqual(sorted(os.listdir(out)), ["benchmarks.json", "benchmarks.md"])
		self.assertEqual(content["machine"], {"cores": 2})
		self.assertEqual(content["measurements"]["two"], {"command": "run two", "samples": [{"cpu": 3}, {"cpu": 3}, {"cpu": 4}]})
		self.assertEqual([row["verdict"] for row in content["rows"]], ["met", "missed", "skipped: libx is not installed"])
		self.assertEqual(content["rows"][0]["figures"][0], {"label": "two cpu", "unit": "us", "measurement": "two", "median": 3, "samples": [3, 3, 4]})
		self.assertNotIn("value", content["rows"][2])


if __name__ == "__main__":
	unittest.main()
