# SPDX-License-Identifier: GPL-2.0-or-later
# Dials, errors, Pareto front and reading of example 05 on numbers that are made up: no YADE needed.
"""Tests of examples/accuracy.py."""

import math
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
import accuracy
from accuracy import Point, Row, Setting, better, defaults

panels = {name: name for name in (*accuracy.cases, "collapse")}


def result(row, **measured):
	"""What a run leaves, with numbers where none are given."""
	found = {"row": row, "error": 0.1, "secondsPerSimulatedSecond": 2.0, "dt": 1e-4, "limitText": "trilinear brick 3", "memoryPerBrick": 5120, "collapse": None}
	return {**found, **measured}


class DialsTest(unittest.TestCase):

	def test_every_value_of_the_sweeps_is_known_and_possible(self):
		for settings in (accuracy.sweep(), accuracy.quickSweep(), accuracy.everyCombination(), [accuracy.finest()]):
			self.assertEqual(len(settings), len(set(settings)))
			for setting in settings:
				for name, known in accuracy.values.items():
					self.assertIn(accuracy.dial(setting, name), known)
				self.assertEqual(setting.segments % setting.cells, 0, setting)
				self.assertEqual(setting.cells > 1, setting.level == "refined")
				self.assertEqual(setting, accuracy.usual(setting))
			self.assertTrue(any(setting.level == "refined" for setting in settings))

	def test_defaults_and_base_are_in_the_sweeps(self):
		for settings in (accuracy.sweep(), accuracy.quickSweep()):
			self.assertIn(defaults, settings)
			self.assertIn(better, settings)

	def test_dials_that_do_not_matter_make_no_difference(self):
		rigid = Setting("rigid")
		self.assertEqual(accuracy.difference(rigid, better), ["level"])
		self.assertEqual(accuracy.difference(rigid, better._replace(segments=8)), ["level", "segments"])
		self.assertEqual(accuracy.difference(better, defaults), ["element", "inner"])
		self.assertEqual(accuracy.dialTexts(rigid), ["rigid", "-", "-", "-", "4 x 4", "0.9"])

	def test_titles_say_what_matters(self):
		self.assertEqual(accuracy.title(Setting("rigid", safety=0.45)), "rigid, 4 x 4 segments, dt factor 0.45")
		refined = better._replace(level="refined", cells=2)
		self.assertEqual(accuracy.title(refined), "2 x 2 x 2, element incompatible, inner part full, r = L/100, 4 x 4 segments")
		self.assertEqual(accuracy.shortTitle(refined._replace(thinness=400)), "2 x 2 x 2, L/400")
		self.assertEqual((accuracy.shortTitle(better), accuracy.shortTitle(defaults)), ("base", "full, inset"))


class PlanTest(unittest.TestCase):

	def test_shaken_wall_has_one_reference_and_repetitions(self):
		rows = accuracy.plan(("seismic",), accuracy.sweep(), quick=False)
		self.assertEqual([row.reference for row in rows].index(True), 0)
		self.assertEqual(sum(row.reference for row in rows), 1)
		self.assertEqual(sorted(row.scale for row in rows if row.scale != 1), [1 - accuracy.roundOff, 1 + accuracy.roundOff])
		finest = accuracy.finest()
		for row in rows:
			self.assertLessEqual((row.setting.cells, row.setting.thinness, row.setting.segments), (finest.cells, finest.thinness, finest.segments))

	def test_only_chosen_cases_are_run(self):
		rows = accuracy.plan(("weight", "cube"), accuracy.quickSweep(), quick=True)
		self.assertEqual([row.case for row in rows], ["cube"] * 6 + ["weight"] * 6)

	def test_table_is_read_back_as_it_was(self):
		rows = accuracy.plan(accuracy.cases, accuracy.sweep(), quick=False)
		lines = accuracy.tableText(rows).splitlines()
		headings = lines[accuracy.firstLine - 2].split()
		for row, line in zip(rows, lines[accuracy.firstLine - 1:]):
			entries = line.split()
			self.assertEqual(len(entries), len(headings))
			self.assertEqual(accuracy.rowOf({name: eval(entry) for name, entry in list(zip(headings, entries))[1:]}), row)
		self.assertEqual(len(lines), len(rows) + accuracy.firstLine - 1)


class ErrorsTest(unittest.TestCase):

	def test_errors_are_root_mean_squares(self):
		self.assertAlmostEqual(accuracy.meanSquare([3, -4]), math.sqrt(12.5))
		self.assertAlmostEqual(accuracy.relative([1, -8], np.array([1, -10])), math.sqrt(2) / 10)

	def test_histories_are_compared_where_they_were_sampled(self):
		times = np.linspace(0, 1, 101)
		self.assertAlmostEqual(accuracy.historyError(times, 3 * times, times[::7], 2 * times[::7], 1), 0.5)
		# what comes after the end does not count
		later = np.where(times > 0.5, 9.0, 2 * times)
		self.assertAlmostEqual(accuracy.historyError(times, later, times, 2 * times, 0.5), 0)

	def shaken(self, setting, collapse, factor=1.0, **row):
		times = [0.0, 1.0, 2.0, 3.0]
		moved = [0.0, factor, -factor, 100.0]
		return {"row": Row("seismic", setting, **row), "times": times, "displacements": moved, "firstCrack": 3.0, "collapse": collapse}

	def test_shaken_walls_are_judged_against_the_reference(self):
		fine = accuracy.finest()
		found = [self.shaken(fine, 4.0, reference=True), self.shaken(better, 5.0, 1.1), self.shaken(defaults, None)]
		self.assertAlmostEqual(accuracy.judgeShaking(found), accuracy.sampleEvery / 4)
		np.testing.assert_allclose([entry["error"] for entry in found], [0, 0.1, 0], atol=1e-12)
		self.assertEqual([entry["collapseError"] for entry in found], [accuracy.sampleEvery / 4, 0.25, None])
		for entry in found:
			entry["collapse"] = None
		self.assertIsNone(accuracy.judgeShaking(found))

	def test_repetitions_give_the_least_error_of_collapse(self):
		fine = accuracy.finest()
		found = [self.shaken(fine, 4.0, reference=True), self.shaken(defaults, 1.0)]
		found += [self.shaken(better, collapse, scale=scale) for collapse, scale in ((5.0, 1.0), (5.2, 1 + 1e-6), (4.8, 1 - 1e-6))]
		found.append(self.shaken(better._replace(segments=8), 4.1))
		self.assertAlmostEqual(accuracy.judgeShaking(found), 0.1)
		np.testing.assert_allclose([entry["collapseError"] for entry in found], [0.1, 0.75, 0.25, 0.3, 0.2, 0.1])


class ReadingTest(unittest.TestCase):

	cheap = Point(Setting("rigid"), 0.5, 1.0)
	usual = Point(defaults, 0.2, 4.0)
	element = Point(defaults._replace(element="incompatible"), 0.05, 4.1)
	segments = Point(defaults._replace(segments=8), 0.199, 8.0)
	thin = Point(defaults._replace(element="incompatible", thinness=200), 0.02, 6.0)

	@property
	def points(self):
		return [self.cheap, self.usual, self.element, self.segments, self.thin]

	def test_front_has_what_nothing_beats(self):
		self.assertEqual(accuracy.front(self.points), [self.cheap, self.usual, self.element, self.thin])
		self.assertEqual(accuracy.front([self.usual, self.usual._replace(time=5.0)]), [self.usual])

	def test_neighbours_differ_in_one_dial_by_one_notch(self):
		far = Point(defaults._replace(segments=16), 0.198, 20.0)
		found = {(name, before, after) for name, before, after in accuracy.neighbours(self.points + [far])}
		expected = {
		        ("level", self.cheap, self.usual), ("element", self.usual, self.element), ("segments", self.usual, self.segments),
		        ("segments", self.segments, far), ("thinness", self.element, self.thin)
		}
		self.assertEqual(found, expected)

	def test_effects_go_towards_cost_and_else_towards_accuracy(self):
		slow, wrong = Point(defaults._replace(safety=0.45), 0.2, 8.0), Point(defaults._replace(inner="full"), 0.3, 4.0)
		found = {effect.dial: (effect.before, effect.after) for effect in accuracy.effects([self.usual, slow, wrong])}
		self.assertEqual(found, {"safety": (self.usual, slow), "inner": (wrong, self.usual)})

	def test_waste_costs_time_and_helps_nothing(self):
		effect, = accuracy.wasted(self.points)
		self.assertEqual((effect.dial, effect.timeFactor), ("segments", 2.0))
		self.assertAlmostEqual(effect.errorFactor, 0.995)

	def test_costliest_waste_of_each_dial_is_said(self):
		slow = [Point(defaults._replace(segments=16), 0.2, 30.0), Point(defaults._replace(safety=0.45), 0.2, 8.2)]
		found = [(effect.dial, round(effect.timeFactor, 2)) for effect in accuracy.worstWaste(self.points + slow)]
		self.assertEqual(found, [("segments", 3.75), ("safety", 2.05)])

	def test_turns_go_from_the_defaults_each_by_another_dial(self):
		self.assertEqual([(turn.dial, turn.after) for turn in accuracy.turns(self.points)], [("element", self.element), ("thinness", self.thin)])
		self.assertEqual(accuracy.turns([self.cheap, self.usual]), [])
		self.assertEqual(accuracy.turns([self.cheap]), [])

	def test_reading_follows_from_the_points(self):
		lines = accuracy.reading("cube", self.points, scatter=0.01)
		self.assertEqual(lines[0], "**cube.**")
		text = "\n".join(lines)
		for words in (
		        "error at most 10 %: trilinear, element incompatible, inner part inset, r = L/100, 4 x 4 segments (5 %, 4.1 s",
		        "smallest error: trilinear, element incompatible, inner part inset, r = L/200, 4 x 4 segments (2 %, 6 s",
		        "from the defaults, turn first: element full -> element incompatible: error 20 % -> 5 %, time x 1",
		        "wasted: 4 x 4 segments -> 8 x 8 segments: error 20 % -> 20 %, time x 2", "1 % is what runs scatter"
		):
			self.assertIn(words, text)
		# the setting of 2 % does for 'at most 3 %' too, and is said once
		self.assertNotIn("at most 3 %", text)
		self.assertNotIn("at most 1 %", text)

	def test_percent_has_the_digits_that_count(self):
		self.assertEqual([accuracy.percent(value) for value in (0.00123, 0.0456, 0.5, 1.234, None, math.inf)], ["0.12 %", "4.6 %", "50 %", "123 %", "-", "-"])


class TablesTest(unittest.TestCase):

	def results(self):
		fine = accuracy.finest()
		found = [result(Row("weight", defaults), limitText="trilinear brick 3, face -z to Wall 0"), result(Row("weight", better), error=0.05)]
		found += [result(Row("seismic", fine, reference=True), error=0.0, collapseError=0.0, collapse=4.0)]
		return found + [result(Row("seismic", defaults), collapseError=0.25, collapse=5.0), result(Row("seismic", better, 1 + 1e-6), collapseError=0.2)]

	def test_reference_and_repetitions_are_no_points(self):
		points = accuracy.pointsOf(self.results(), panels)
		self.assertEqual({name: len(members) for name, members in points.items()}, {"weight": 2, "seismic": 1, "collapse": 1})
		self.assertEqual(points["collapse"][0], Point(defaults, 0.25, 2.0))

	def test_full_table_has_a_row_for_each_run(self):
		headings, rows = accuracy.fullTable(self.results())
		self.assertEqual({len(row) for row in rows}, {len(headings)})
		self.assertEqual([row[0] for row in rows], ["weight", "weight", "seismic (reference)", "seismic", "seismic x 1.000001"])
		self.assertEqual(rows[3][7:], ["0.1", "5.00", "2", "100", "trilinear brick 3", "5.0"])
		self.assertEqual(rows[4][8], "stands")

	def test_page_table_has_a_row_for_each_setting(self):
		results = self.results()
		lines = accuracy.pageTable(results, accuracy.pointsOf(results, panels)).splitlines()
		self.assertEqual(len(lines), 2 + 2)
		self.assertIn("| 10 %, 2 | **10 %, 2** | **25 %, 2** | 100 | trilinear brick 3, face -z to Wall 0 | 5.0 |", lines[2])
		self.assertIn("| **5 %, 2** | - | - |", lines[3])

	def test_notches_are_medians_over_panels(self):
		points = {"a": [Point(defaults, 0.4, 1.0), Point(defaults._replace(segments=8), 0.2, 2.0)]}
		points["b"] = [Point(defaults, 0.1, 1.0), Point(defaults._replace(segments=8), 0.1, 4.0)]
		self.assertEqual(accuracy.notchTable(points).splitlines()[2], "| 4 x 4 segments -> 8 x 8 segments | 0.75 | 0.5 to 1 | 3 | 2 |")

	def test_part_of_a_page_is_replaced(self):
		page = "before\n<!-- table: begin -->\nold\n<!-- table: end -->\nafter\n"
		self.assertEqual(accuracy.withinMarks(page, "table", "new\n"), page.replace("old", "new"))
		for wrong in ("no marks", page + page, "<!-- table: end -->\n<!-- table: begin -->\n"):
			with self.assertRaisesRegex(ValueError, "table: begin"):
				accuracy.withinMarks(wrong, "table", "new\n")


if __name__ == "__main__":
	unittest.main()
