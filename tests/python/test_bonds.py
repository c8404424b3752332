# SPDX-License-Identifier: GPL-2.0-or-later
# How courses are laid: the textbook's order of headers, stretchers and closers, and the rules that hold whatever is cut.
"""Tests of yade_brick.bonds; no YADE needed."""

import doctest
import random
import unittest

import standalone

bonds = standalone.load("bonds")

size = (0.2, 0.1, 0.05)
half = 0.1  # width of a header: lengths below are in this unit


def course(name, number, length, avoided=(), **options):
	"""Joints and ends of a course, in widths of a header."""
	laid = bonds.bond(name, size, **options).course(number, 0, half * length, [half * place for place in avoided])
	return [round(place / half, 9) for place in laid]


class BondTest(unittest.TestCase):

	def test_docstrings_hold(self):
		self.assertEqual(doctest.testmod(bonds).failed, 0)

	def test_stack_bond_has_its_joints_above_each_other(self):
		for number in range(3):
			self.assertEqual(course("stack", number, 7), [0, 2, 4, 6, 7])

	def test_running_bond_begins_every_other_course_with_a_half_brick(self):
		self.assertEqual(course("running", 0, 6), [0, 2, 4, 6])
		self.assertEqual(course("running", 1, 6), [0, 1, 3, 5, 6])

	def test_offset_of_running_bond_can_be_chosen(self):
		self.assertEqual(course("running", 1, 6, offset=0.25), [0, 0.5, 2.5, 4.5, 6])
		self.assertEqual([course("running", number, 4, offset=(0, 0.25, 0.5))[1] for number in range(4)], [2, 0.5, 1, 2])

	def test_english_bond_has_a_closer_beside_the_first_header(self):
		self.assertEqual(course("English", 0, 6), [0, 1, 1.5, 2.5, 3.5, 4.5, 5, 6])
		self.assertEqual(course("English", 1, 6), [0, 2, 4, 6])

	def test_flemish_headers_lie_over_the_middles_of_stretchers(self):
		self.assertEqual(course("Flemish", 0, 8), [0, 1, 1.5, 3.5, 4.5, 6.5, 7, 8])
		self.assertEqual(course("Flemish", 1, 8), [0, 2, 3, 5, 6, 8])

	def test_sliver_and_its_neighbour_become_two_pieces_or_one(self):
		self.assertEqual(course("running", 0, 6.2), [0, 2, 4, 5.1, 6.2])  # 2.2 is too long for one brick
		self.assertEqual(course("running", 1, 6.2), [0, 1, 3, 5, 6.2])
		self.assertEqual(course("running", 1, 5.2), [0, 1, 3, 4.1, 5.2])
		self.assertEqual(course("running", 0, 2.5, smallest=0.25), [0, 2, 2.5])  # a quarter is allowed

	def test_joint_over_a_joint_moves_or_goes_or_becomes_two(self):
		self.assertEqual(course("running", 1, 6, avoided=[1]), [0, 2, 3, 5, 6])  # half a brick, the lap of the bond, away
		self.assertEqual(course("English", 1, 3, avoided=[1, 1.5]), [0, 2, 3])
		self.assertEqual(course("running", 0, 2.5, avoided=[2]), [0, 1, 2.5])
		self.assertEqual(course("running", 0, 4, avoided=[2]), [0, 1, 3, 4])  # two whole bricks leave it no room

	def test_rules_hold_for_any_length_and_beginning(self):
		"""No piece longer than a brick or shorter than a quarter; a lap of an eighth at least: the class says so. 0.2 m bricks, round-off of 1e-6 of them."""
		chance = random.Random(5)
		for name in ("stack", "running", "English", "Flemish"):
			for _ in range(1500):
				laying = bonds.bond(name, size, offset=chance.choice((0.5, 1 / 3, 0.25, (0, 1 / 3, 2 / 3))))
				begin, length = chance.choice((0, chance.uniform(0, 2))), chance.uniform(0.05, 1.5)
				below = []
				for number in range(5):
					joints = laying.course(number, begin, begin + length, below)
					pieces = [other - one for one, other in zip(joints, joints[1:])]
					self.assertAlmostEqual(sum(pieces), length, delta=1e-12)
					self.assertTrue(0.05 - 1e-6 <= min(pieces) and max(pieces) <= 0.2 + 1e-6, (name, begin, length, joints))
					if name != "stack":
						lap = min((abs(one - other) for one in joints[1:-1] for other in below), default=1)
						self.assertGreaterEqual(lap, 0.025 - 1e-6, (name, begin, length, joints, below))
					below = joints[1:-1]

	def test_too_little_room_is_refused(self):
		with self.assertRaisesRegex(ValueError, "0.049 m is left.*0.05 m"):
			course("running", 0, 0.49)

	def test_bad_arguments_are_refused_with_the_value(self):
		for words, arguments in (
		        ("bond is 'Dutch'.*Flemish", dict(name="Dutch")), ("size is .*three", dict(size=(1, 2))), ("size is .*three", dict(size=(1, 0, 1))),
		        ("size is .*twice as long", dict(name="English", size=(0.2, 0.15, 0.1))), ("smallest is 0.3", dict(smallest=0.3)),
		        ("smallest is 0", dict(smallest=0)), ("offset is 1", dict(offset=1)), ("offset is .*at least two", dict(offset=(0.5,))),
		        ("offset is .*same shift", dict(offset=(0, 0.5, 0.5))), ("offset is 'a'", dict(offset="a"))
		):
			with self.assertRaisesRegex(ValueError, words):
				bonds.bond(**arguments)


if __name__ == "__main__":
	unittest.main()
