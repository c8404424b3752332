# SPDX-License-Identifier: GPL-2.0-or-later
# The pure parts of benchmarks/pay_as_you_go: names of scenes, callgrind's files, the table.
"""Tests of benchmarks/pay_as_you_go. Nothing is counted, no YADE needed."""

import doctest
import pathlib
import sys
import unittest
from dataclasses import replace

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "pay_as_you_go"))
import counting
import effects
import payAsYouGo
from effects import Effect, Scene, minimal


def load_tests(loader, tests, pattern):
	for module in (counting, payAsYouGo):
		tests.addTests(doctest.DocTestSuite(module))
	return tests


def counts(**instructions):
	"""{name: Count} of scenes of 10 bricks with as many bytes a brick as instructions."""
	return {name: counting.Count({"bricks": 10, "bytes": 10 * number}, number) for name, number in instructions.items()}


class ScenesTest(unittest.TestCase):

	def test_a_name_says_what_differs_from_the_minimal_scene(self):
		self.assertEqual(minimal.name, "minimal")
		self.assertEqual(Scene(joints="cracked", guard=True, ended="guard").name, "joints=cracked,guard,ended=guard")

	def test_each_scene_is_counted_once_and_has_a_name_of_its_own(self):
		scenes = effects.scenesOf(effects.effects)
		self.assertEqual(len({scene.name for scene in scenes}), len(scenes))

	def test_an_effect_differs_from_the_scene_without_it_in_that_effect_only(self):
		for effect in effects.effects:
			if effect.off:
				self.assertEqual(replace(effect.off, ended=""), effect.on, effect.what)
			self.assertNotEqual(effect.on, effect.without, effect.what)


class TableTest(unittest.TestCase):

	def row(self, off=None, **instructions):
		return payAsYouGo.row(Effect("guard", Scene(guard=True), minimal, off), counts(minimal=200, **instructions))

	def test_costs_are_differences_and_shares(self):
		self.assertEqual(self.row(guard=230), ("guard", "+30 (+15.0 %)", "+30", "", "", "", ""))

	def test_nothing_is_a_plain_zero(self):
		self.assertEqual(self.row(guard=200.2)[1:3], ("0", "0"))
		self.assertEqual(self.row(guard=199.8)[1:3], ("0", "0"))

	def test_a_scene_that_has_failed_is_a_question_mark(self):
		self.assertEqual(self.row(guard=float("nan"))[1:3], ("?", "?"))


class CallgrindTest(unittest.TestCase):

	def test_costs_of_callees_are_not_counted_twice_and_names_are_given_once(self):
		step = "ob=(1) x\nfl=(1) y\nfn=(1) step()\n0 30\n* 5\ncob=(2) z\ncfn=(2) sum\ncalls=2 0\n0 12\n-1 1\n\n"
		text = "desc: Trigger: Client Request: a,b=1\n" + step + "fn=(2)\n0 10\ntotals: 46\n"
		self.assertEqual(counting.parse(text), ("a,b=1", {"step()": 36, "sum": 10}))
