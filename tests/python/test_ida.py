# SPDX-License-Identifier: GPL-2.0-or-later
# Incremental dynamic analysis on structures whose collapse is known: what is run in which order, how curves are summed up, and how an analysis goes on.
"""Tests of yade_brick.ida; no YADE needed."""

import doctest
import math
import os
import tempfile
import unittest

import numpy as np

import standalone

ida = standalone.load("ida")
Plan = ida.HuntAndFill


def analyse(collapsesAt, plan):
	"""The points of a structure that collapses from `collapsesAt` on, in the order of their runs."""
	points = []
	while (intensity := ida.nextIntensity(points, plan)) is not None:
		points.append(ida.IdaPoint(intensity, 0.01 * intensity**2, collapsesAt(intensity) if callable(collapsesAt) else intensity >= collapsesAt))
	return points


def intensities(points):
	return [point.intensity for point in points]


class Order(unittest.TestCase):

	def test_doctests(self):
		self.assertEqual(doctest.testmod(ida).failed, 0)

	def test_steps_of_the_hunt_grow(self):
		points = analyse(9.0, Plan(1.0, 1.0, limit=20.0, growth=0.5, tolerance=1.0))
		self.assertEqual(intensities(points), [1, 2, 3.5, 5.5, 8, 11])

	def test_collapse_is_found_to_the_tolerance_wherever_it_is(self):
		for capacity in (0.013, 0.9, 1.0, 3.1416, 6.99, 7.0):
			plan = Plan(1.0, 2.0, limit=7.0, tolerance=0.01)
			curve = ida.curveOf("a", analyse(capacity, plan), plan)
			self.assertLessEqual(curve.stands, capacity)
			self.assertGreaterEqual(curve.collapses, capacity)
			self.assertLessEqual(curve.collapses - curve.stands, 0.01 * curve.collapses)
			self.assertLess(abs(curve.capacity / capacity - 1), 0.01)

	def test_hunt_ends_at_the_limit(self):
		plan = Plan(1.0, 2.0, limit=6.0)
		points = analyse(math.inf, plan)
		self.assertEqual(intensities(points), [1, 3, 5, 6])
		curve = ida.curveOf("a", points, plan)
		self.assertEqual((curve.stands, curve.collapses, curve.capacity, curve.note), (6, math.inf, math.inf, "no collapse up to 6"))

	def test_widest_gaps_are_filled(self):
		points = analyse(6.0, Plan(1.0, 4.0, limit=20.0, tolerance=0.5, fill=3))
		self.assertEqual(intensities(points)[:3], [1, 5, 9])
		self.assertEqual(intensities(points)[3:], [3, 2, 4])  # 1 to 5; then 1 to 3 before 3 to 5

	def test_a_collapse_below_runs_that_stood_is_the_one_that_counts(self):
		plan = Plan(1.0, 4.0, limit=20.0, tolerance=0.5, fill=1)
		curve = ida.curveOf("a", analyse(lambda x: x == 3 or x > 6, plan), plan)
		self.assertEqual((curve.stands, curve.collapses), (1, 3))
		self.assertEqual(curve.note, "collapsed at 3 although it stood at 5")

	def test_the_next_run_depends_on_the_results_alone(self):
		plan = Plan(0.7, 0.9, limit=30.0, growth=0.2, tolerance=0.02, fill=2)
		points = analyse(7.3, plan)
		for count in range(len(points)):
			self.assertEqual(ida.nextIntensity(sorted(points[:count], reverse=True), plan), points[count].intensity)

	def test_bad_plans_are_refused_with_the_value(self):
		for plan, words in (
		        (Plan(0, 1, 2), "first is 0"), (Plan(1, -1, 2), "step is -1"), (Plan(1, 1, 0.5), "limit is 0.5"), (Plan(1, 1, 2, growth=-1), "growth"),
		        (Plan(1, 1, 2, tolerance=0), "tolerance is 0"), (Plan(1, 1, 2, fill=1.5), "fill is 1.5"), (Plan(1, 1, math.nan), "limit is nan")
		):
			with self.assertRaisesRegex(ValueError, words):
				plan.checked()


class Summary(unittest.TestCase):

	def setUp(self):
		self.plan = Plan(1.0, 1.0, limit=10.0, tolerance=0.1)
		self.curves = [ida.curveOf(str(c), analyse(c, self.plan), self.plan) for c in (2.5, 3.5, 4.5, 5.5, 6.5)]

	def test_fractiles_are_those_of_the_sorted_motions(self):
		# .16 of 5 is the lowest, .5 the third, .84 the highest; below 2 all have 0.01 x^2 at their runs 1 and 2
		np.testing.assert_allclose(ida.summary(self.curves, [1.0, 2.0]), [[0.01, 0.04]] * 3)
		low, middle, high = ida.summary(self.curves, [4.0])[:, 0]
		self.assertEqual((low, middle, high), (0.16, 0.16, math.inf))  # two of five have collapsed: the median has not
		self.assertEqual(ida.summary(self.curves, [5.0])[1, 0], math.inf)  # three have

	def test_capacity_fractiles_are_where_that_share_has_collapsed(self):
		capacities = [curve.capacity for curve in self.curves]
		self.assertEqual(ida.capacityFractiles(self.curves), [capacities[0], capacities[2], capacities[4]])
		# much damage is little capacity
		for level, capacity in zip((0.84, 0.5, 0.16), ida.capacityFractiles(self.curves)):
			(before, after), = ida.summary(self.curves, [capacity * (1 - 1e-9), capacity * (1 + 1e-9)], [level])
			self.assertTrue(math.isfinite(before) and after == math.inf)

	def test_curves_begin_at_zero_and_are_unknown_beyond_the_last_run_without_collapse(self):
		curve = ida.curveOf("a", analyse(math.inf, self.plan), self.plan)
		np.testing.assert_allclose(curve.measureAt([0, 0.5, 10]), [0, 0.005, 1])
		self.assertTrue(math.isnan(curve.measureAt(10.1)))
		self.assertTrue(np.isnan(ida.summary([*self.curves, curve], [10.5])).all())

	def test_plot(self):
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, "ida.png")
			ida.idaPlot(path, self.curves, "PGA", "drift", title="known structures")
			self.assertGreater(os.path.getsize(path), 20000)
		with self.assertRaisesRegex(ValueError, "no curve"):
			ida.idaPlot(path, [], "PGA", "drift")


class Analysis(unittest.TestCase):
	"""With a stand-in for the study that runs in this program."""

	def setUp(self):
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		self.table, self.results, self.runs, self.failing = os.path.join(folder.name, "walls.table"), {}, [], ()
		for name in ("runStudy", "resultOf", "collect"):
			self.addCleanup(setattr, ida.study, name, getattr(ida.study, name))
		ida.study.runStudy, ida.study.collect = self.runStudy, lambda table, script: self.states(table)
		ida.study.resultOf = lambda row, script: self.results.get(row.description)

	def runStudy(self, table, script):
		for row in ida.study.readTable(table):
			if row.description not in self.results and row.description not in self.failing:
				x = row.parameters["pga"]
				self.runs.append(row.description)
				self.results[row.description] = {"drift": 0.01 * x, "collapsed": x > 2 + row.parameters["seed"]}
		return ida.study.StudyReport(self.states(table), 0, 0, 0, 0.0)

	def states(self, table):
		states = []
		for row in ida.study.readTable(table):
			result = self.results.get(row.description)
			states.append({"description": row.description, "state": "finished" if result else "failed", "reason": "why", "log": "log", "result": result})
		return states

	def analyse(self):
		motions = {f"motion{seed}": {"seed": seed} for seed in range(3)}
		return ida.incrementalDynamicAnalysis(self.table, "script.py", motions, "pga", Plan(1.0, 1.0, limit=9.0, tolerance=0.1))

	def test_each_motion_is_analysed_to_its_collapse(self):
		for seed, curve in enumerate(self.analyse()):
			self.assertLessEqual(curve.stands, 2 + seed)
			self.assertGreater(curve.collapses, 2 + seed)
			self.assertIsNone(curve.note)

	def test_an_interrupted_analysis_takes_the_same_way_and_runs_nothing_twice(self):
		whole = self.analyse()
		runs, self.runs = self.runs, []
		self.results = {description: self.results[description] for description in runs[:7]}
		self.assertEqual(self.analyse(), whole)
		self.assertEqual(sorted(self.runs), sorted(runs[7:]))

	def test_a_failed_run_ends_its_motion_only(self):
		self.failing = ("motion1-pga=2",)
		curves = self.analyse()
		self.assertEqual([curve.note is None for curve in curves], [True, False, True])
		self.assertEqual(curves[1].note, "run at 2 failed: why; see log")
		self.assertEqual(intensities(curves[1].points), [1])


if __name__ == "__main__":
	unittest.main()
