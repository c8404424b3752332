# SPDX-License-Identifier: GPL-2.0-or-later
# Stages: where they stop, when callbacks are called, what is shown. A stand-in scene counts steps and time as YADE's O does.
"""Tests of yade_brick.progress; no YADE needed."""

import io
import math
import re
import unittest

import standalone

progress = standalone.load("progress")


class Scene:
	"""The part of YADE's O that a stage uses; `dts` gives the time step after a number of steps."""

	def __init__(self, dts=lambda steps: 1e-3):
		self.time, self.iter, self.dts, self.dt = 0.0, 0, dts, dts(0)

	def step(self):
		self.time += self.dt
		self.iter += 1
		self.dt = self.dts(self.iter)


class ProgressTest(unittest.TestCase):

	def setUp(self):
		self.shown = io.StringIO()
		for name in ("_lineSeconds", "_lookSeconds"):
			self.addCleanup(setattr, progress, name, getattr(progress, name))

	def run_(self, scene, **arguments):
		return progress.runWithProgress(scene=scene, stream=self.shown, label="stage", **arguments)

	def test_stage_takes_exactly_its_steps_in_spite_of_round_off(self):
		scene = Scene()
		self.assertEqual(self.run_(scene, duration=20.0).steps, 20000)
		self.assertEqual(self.run_(scene, until=100.0).steps, 80000)

	def test_stage_stops_at_the_first_step_past_the_time(self):
		scene = Scene()
		report = self.run_(scene, until=0.0105)
		self.assertEqual((report.steps, scene.iter, report.finished), (11, 11, True))
		self.assertAlmostEqual(report.simulated, 0.011)
		self.assertAlmostEqual(report.secondsPerSimulatedSecond, report.wallSeconds / 0.011)

	def test_callbacks_come_at_the_multiples_and_at_the_end(self):
		scene, steps = Scene(), []
		self.run_(scene, duration=0.025, every=0.01, callback=lambda: steps.append(scene.iter))
		self.assertEqual(steps, [10, 20, 25])
		del steps[:]
		self.run_(scene, until=0.045, every=0.01, callback=lambda: steps.append(scene.iter))
		self.assertEqual(steps, [35, 45])

	def test_callback_finer_than_a_step_comes_once_for_each_time_asked_for(self):
		scene, times = Scene(), []
		self.run_(scene, duration=0.002, every=0.0005, callback=lambda: times.append(scene.iter))
		self.assertEqual(times, [1, 1, 2, 2])

	def test_display_does_not_change_where_a_changing_time_step_stops(self):
		ends = []
		for progress._lookSeconds, progress._lineSeconds in ((0, 0), (1e9, 1e9)):
			scene, seen = Scene(lambda steps: 1e-3 * (1 + 0.5 * math.sin(0.1 * steps))), []
			self.run_(scene, duration=0.5, every=0.1, callback=lambda: seen.append((scene.iter, scene.time)))
			ends.append(seen)
		self.assertEqual(ends[0], ends[1])

	def test_callback_ends_the_stage_with_true_only(self):
		scene = Scene()
		self.assertEqual(self.run_(scene, duration=0.1, every=0.01, callback=lambda: 1).finished, True)
		report = self.run_(scene, duration=0.1, every=0.01, callback=lambda: scene.time > 0.155)
		self.assertEqual((report.finished, report.steps), (False, 60))

	def test_error_of_an_engine_comes_through_and_the_display_is_closed(self):
		scene = Scene()
		scene.step = lambda: 1 / 0
		with self.assertRaises(ZeroDivisionError):
			self.run_(scene, duration=1)
		self.assertIn("stage: 0.000 of 1.000 s (0 %), 0 steps", self.shown.getvalue())

	def test_log_has_lines_with_time_left_and_a_last_one(self):
		progress._lookSeconds = progress._lineSeconds = 0
		self.run_(Scene(), duration=0.004)
		lines = self.shown.getvalue().splitlines()
		self.assertRegex(lines[0], r"^stage: 0.001 of 0.004 s \(25 %\), 1 steps, 0:00 elapsed, 0:00 left$")
		self.assertRegex(lines[-1], r"^stage: 0.004 of 0.004 s \(100 %\), 4 steps, 0:00 elapsed$")
		self.assertNotIn("\r", self.shown.getvalue())

	def test_stage_that_goes_on_shows_its_share_of_the_whole_and_the_time_its_own_speed_needs(self):
		progress._lookSeconds = progress._lineSeconds = 0
		scene, clock = Scene(), iter(range(1000))
		scene.time = 0.006
		self.addCleanup(setattr, progress.time, "perf_counter", progress.time.perf_counter)
		progress.time.perf_counter = lambda: next(clock)
		report = progress.runStage(scene, 0.008, [(0.008, None)], label="stage", stream=self.shown, begin=0.0)
		elapsed, left = re.search(r"^stage: 0.007 of 0.008 s \(88 %\), 1 steps, 0:(\d+) elapsed, 0:(\d+) left$", self.shown.getvalue(), re.M).groups()
		self.assertEqual(int(left), int(elapsed))  # one of two steps is done, whatever came before
		self.assertEqual((report.steps, report.finished), (2, True))

	def test_clock_shows_hours_only_when_there_are_any(self):
		self.assertEqual([progress.clock(seconds) for seconds in (0, 59.6, 3599, 3661)], ["0:00", "1:00", "59:59", "1:01:01"])

	def test_bad_stages_are_refused_with_the_value(self):
		scene = Scene()
		scene.time = 2.0
		for arguments, words in (
		        (dict(), "exactly one"), (dict(duration=1, until=3), "exactly one"), (dict(duration=0), "duration is 0"),
		        (dict(duration=float("nan")), "nan"), (dict(until=2.0), "later than the present 2 s"), (dict(until=float("inf")), "inf"),
		        (dict(duration=1, every=0.1), "callback"), (dict(duration=1, callback=print), "every"),
		        (dict(duration=1, every=0, callback=print), "every is 0")
		):
			with self.assertRaisesRegex(ValueError, words):
				self.run_(scene, **arguments)
		scene.dt = float("nan")
		with self.assertRaisesRegex(ValueError, "O.dt is nan"):
			self.run_(scene, duration=1)


if __name__ == "__main__":
	unittest.main()
