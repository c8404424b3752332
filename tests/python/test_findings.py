# SPDX-License-Identifier: GPL-2.0-or-later
# Measures and verdicts of example 04 on walls that are made up: no YADE needed.
"""Tests of examples/findings.py."""

import json
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples"))
import findings

side, courses = findings.side, findings.courses
signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def wallCorners(gaps=()):
	"""Corners and courses of two bricks a course, staggered, the left ones moved to the left by gaps[course] [m]."""
	corners, course = [], []
	for level in range(courses):
		for place in range(2):
			left = place == 0 and level < len(gaps)
			centre = np.array([side * (place + 0.5 * level) - (gaps[level] if left else 0), 0, side * (level + 0.5)])
			corners.append(centre + 0.5 * side * signs)
			course.append(level)
	return np.array(corners), np.array(course)


class FindingsTest(unittest.TestCase):

	def setUp(self):
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		self.folder, self.count = folder.name, 0

	def outcome(self, collapse=None, fallen=(), spread=0.0, stress=0.0, shapes=None):
		"""An Outcome of two bricks a course.

		:param fallen: bricks that are down at the end
		:param shapes: corners at 0, 1, 2, ... s; by default the intact wall at 0 s
		"""
		self.count += 1
		path = os.path.join(self.folder, str(self.count))
		os.makedirs(path)
		intact, course = wallCorners()
		displacement = np.zeros((2, len(course), 3))
		displacement[1, list(fallen), 2] = -0.6 * side
		frames = np.array([intact] if shapes is None else shapes)
		np.savez(os.path.join(path, "wall.npz"), course=course, displacement=displacement, frameTime=np.arange(len(frames)), frameCorners=frames)
		stress = stress if isinstance(stress, list) else [stress] * courses
		atRest = {"spreadX": [spread] * courses, "spreadY": [spread] * courses, "headJointStress": [[value] for value in stress], "baseThrust": 1.0}
		with open(os.path.join(path, "result.json"), "w") as file:
			json.dump({"collapse": collapse, "bricksFallen": len(fallen), "atRest": atRest}, file)
		return findings.Outcome(path)

	def verdicts(self, **changed):
		"""Verdicts of all six for walls that stand and do nothing, but for those changed: straight_rigid_x=[outcomes] and the like."""
		quiet = self.outcome()
		walls = {(bond, model, direction): [quiet] for bond in ("straight", "english") for model in ("rigid", "deform") for direction in "xy"}
		walls.update({tuple(key.split("_")): runs for key, runs in changed.items()})
		return {entry.number: entry.verdict for entry in findings.findings(walls)}

	# Cracks

	def test_head_joint_is_open_when_it_gapes_by_more_than_the_limit(self):
		intact, course = wallCorners()
		for gap, expected in ((0.5 * findings.openJoint, []), (2 * findings.openJoint, [0.5 * side])):
			places = findings.openHeadJoints(wallCorners([gap])[0], intact, course)
			np.testing.assert_allclose(places[0], expected)
			self.assertEqual(places[1:], [[]] * (courses - 1))

	def test_stair_goes_half_a_brick_aside_with_each_course_in_one_direction(self):
		self.assertEqual(findings.longestStair([[]] * courses), 0)
		self.assertEqual(findings.longestStair([[0.2], [0.3], [0.4], [], [0.6], [0.7]]), 3)
		self.assertEqual(findings.longestStair([[1.0], [0.9], [0.8, 0.2], [0.7], [0.6], [0.5]]), 6)
		# a zigzag and a straight vertical crack are no diagonals
		self.assertEqual(findings.longestStair([[0.2], [0.3], [0.2], [0.3], [0.2], [0.3]]), 2)
		self.assertEqual(findings.longestStair([[0.2]] * courses), 1)

	def test_crack_counts_only_until_the_wall_collapses(self):
		intact, cracked = wallCorners()[0], wallCorners([0.01] * 4)[0]
		self.assertEqual(self.outcome(shapes=[intact, cracked]).diagonalCrack(), (4, 1.0))
		self.assertEqual(self.outcome(shapes=[intact, cracked], collapse=0.9).diagonalCrack(), (0, None))

	# Verdicts

	def test_spread_is_seen_only_in_deform(self):
		wide, still = [self.outcome(spread=1e-4)], [self.outcome(spread=1e-17)]
		self.assertEqual(self.verdicts(straight_deform_x=wide, english_deform_x=wide)[1], "seen")
		self.assertEqual(self.verdicts(straight_deform_x=wide, english_deform_x=still, english_rigid_x=still)[1], "in part")
		self.assertEqual(self.verdicts(**{f"{bond}_{model}_x": wide for bond in ("straight", "english") for model in ("rigid", "deform")})[1], "not seen")

	def test_prestress_is_seen_when_every_course_is_pressed(self):
		for stress, expected in ((-5.0, "seen"), ([-5.0, -2.0, -1.0, 1.0, 1.0, 1.0], "in part"), (1.0, "not seen")):
			self.assertEqual(self.verdicts(straight_deform_x=[self.outcome(stress=stress)])[2], expected)

	def test_deform_is_later_when_no_repetition_contradicts(self):
		times = {2.0: [self.outcome(2.0)], 3.0: [self.outcome(3.0)], 4.0: [self.outcome(4.0)], None: [self.outcome()]}
		for rigid, deform, expected in ((2.0, 3.0, "seen"), (3.0, 2.0, "not seen"), (2.0, None, "seen"), (None, None, "not seen"), (None, 2.0, "not seen")):
			self.assertEqual(self.verdicts(straight_rigid_x=times[rigid], straight_deform_x=times[deform])[3], expected)
		self.assertEqual(self.verdicts(straight_rigid_x=times[2.0] + times[4.0], straight_deform_x=times[3.0])[3], "in part")

	def test_rigid_english_bond_has_to_crack_diagonally_and_stand(self):
		shapes = [wallCorners()[0], wallCorners([0.01] * 3)[0]]
		for collapse, cracked, expected in ((None, True, "seen"), (None, False, "in part"), (1.5, True, "in part"), (1.5, False, "not seen")):
			runs = [self.outcome(collapse, shapes=shapes if cracked else None)]
			self.assertEqual(self.verdicts(english_rigid_x=runs)[4], expected)

	def test_upper_part_of_deform_english_bond_has_to_fall(self):
		for fallen, expected in (((6, 8, 11), "seen"), ((1, 2, 11), "in part"), ((), "not seen")):
			self.assertEqual(self.verdicts(english_deform_x=[self.outcome(3.0 if fallen else None, fallen)])[5], expected)

	def test_models_agree_out_of_plane_within_a_tenth(self):
		runs = {time: [self.outcome(time, (0, 1))] for time in (3.0, 3.2, 4.0)}
		agree = {"straight_rigid_y": runs[3.0], "straight_deform_y": runs[3.2]}
		self.assertEqual(self.verdicts()[6], "seen")
		self.assertEqual(self.verdicts(**agree)[6], "seen")
		self.assertEqual(self.verdicts(**agree, english_rigid_y=runs[3.0], english_deform_y=runs[4.0])[6], "in part")
		stands = {"straight_rigid_y": runs[3.0], "english_rigid_y": runs[3.0]}
		self.assertEqual(self.verdicts(**stands)[6], "not seen")
		self.assertEqual(self.verdicts(**stands, english_deform_y=runs[4.0])[6], "not seen")

	# Texts

	def test_times_are_given_with_their_range(self):
		self.assertEqual(findings.spanText([2.0]), "2.00 s")
		self.assertEqual(findings.spanText([2.0, 1.5, float("inf")]), "2.00 s (1.50 s to stands in 3 runs)")

	def test_table_is_markdown(self):
		self.assertEqual(findings.markdown(["a", "b"], [[1, 2]]), "| a | b |\n| --- | --- |\n| 1 | 2 |\n")


if __name__ == "__main__":
	unittest.main()
