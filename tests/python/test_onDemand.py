# SPDX-License-Identifier: GPL-2.0-or-later
# Measures of example 07 on runs that are made up: no YADE needed.
"""Tests of examples/onDemand.py."""

import math
import pathlib
import sys
import types
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
import onDemand


def run(times, moves, deformable=None):
	"""Arrays of two bricks, one on the other, that move along x: the lower by half as much as the upper."""
	displacement = np.zeros((len(times), 2, 3))
	displacement[:, 1, 0], displacement[:, 0, 0] = moves, 0.5 * np.asarray(moves)
	failed = np.zeros((len(times), 3), dtype=int)
	failed[-1] = 3, 2, 1
	deformable = [0] * len(times) if deformable is None else deformable
	return {
	        "time": np.array(times), "displacement": displacement, "course": np.array([0, 1]), "step": np.arange(len(times)) * 10, "deformable": deformable,
	        "failed": failed
	}


class DifferencesTest(unittest.TestCase):

	def test_of_a_run_from_itself_is_none(self):
		same = run([0, 1, 2], [0, 3, 4])
		self.assertEqual(onDemand.difference(same, same, 2), (0, 0, 0))

	def test_top_all_and_most(self):
		found = onDemand.difference(run([0, 1], [0, 2]), run([0, 1], [0, 0]), 1)
		# the upper brick is 0 and 2 away, the lower one 0 and 1
		self.assertAlmostEqual(found.top, math.sqrt(4 / 2))
		self.assertAlmostEqual(found.all, math.sqrt(5 / 4))
		self.assertAlmostEqual(found.most, 2)

	def test_only_up_to_the_end_that_is_asked_for(self):
		self.assertEqual(onDemand.difference(run([0, 1, 2], [0, 0, 5]), run([0, 1, 2], [0, 0, 0]), 1).most, 0)

	def test_samples_at_other_times(self):
		self.assertLess(onDemand.difference(run([0, 0.4, 2], [0, 0.8, 4]), run([0, 1, 2], [0, 2, 4]), 2).most, 1e-12)  # round-off

	def test_own_motion_is_counted_from_the_start(self):
		self.assertAlmostEqual(onDemand.motionSize(run([0, 1], [7, 9]), 1).most, 2)

	def test_worst_of_each_number(self):
		self.assertEqual(onDemand.worst([onDemand.Difference(1, 5, 2), onDemand.Difference(3, 4, 1)]), (3, 5, 2))


class MeasuredTest(unittest.TestCase):

	def test_facts_of_a_run(self):
		result = {"processorSeconds": 3.0, "shakingSteps": 20, "levelChanges": [2, 1], "collapse": None, "bricksFallen": 0, "energyGained": 0.1}
		found = onDemand.measured(result, run([0, 1, 2], [0, 0, 0], deformable=[0, 2, 2]))
		self.assertEqual((found.dt, found.share, found.changes, found.firstFailed, found.failed), (0.1, 0.75, (2, 1), 2.0, (3, 2, 1)))

	def test_never_failed(self):
		arrays = run([0, 1], [0, 0])
		arrays["failed"][:] = 0
		result = {"processorSeconds": 3.0, "shakingSteps": 10, "levelChanges": [0, 0], "collapse": None, "bricksFallen": 0, "energyGained": 0}
		self.assertIsNone(onDemand.measured(result, arrays).firstFailed)

	def test_unchanged_until_the_first_change(self):
		self.assertEqual(onDemand.unchanged({"asked": [2, 2, 1, 2]}).tolist(), [True, True, False, False])

	def test_use_of_strength(self):
		mortar = types.SimpleNamespace(tensileStrength=4.0, cohesion=3.0, frictionAngle=math.pi / 4)
		found = onDemand.use(np.array([2.0, -3.0, 0.0]), np.array([0.0, 3.0, 6.0]), mortar)
		np.testing.assert_allclose(found, [0.5, 0.5, 2.0])


class TextsTest(unittest.TestCase):

	def test_two_digits_of_millimetres(self):
		self.assertEqual([onDemand.millimetres(length) for length in (0, 1.234e-6, 0.0123, 0.34)], ["0", "0.0012", "12", "340"])

	def test_times(self):
		self.assertEqual([onDemand.timeText(2.346), onDemand.timeText(None)], ["2.35", "-"])


if __name__ == "__main__":
	unittest.main()
