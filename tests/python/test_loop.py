# SPDX-License-Identifier: GPL-2.0-or-later
# The engine loop as a list whose parts have names, and how effects are shown, on engines that are made up: no YADE needed. The rest is tested in YADE
# (tests/yade/testEngines.py).
"""Tests of yade_brick.loop."""

import types
import unittest

import standalone

loop = standalone.load("loop")


def kind(name, *bases):
	return type(name, bases or (object, ), {"__init__": lambda self, **attributes: vars(self).update(attributes)})


Functor = kind("Functor")
BoundFunctor, LawFunctor = kind("BoundFunctor", Functor), kind("LawFunctor", Functor)
Collider, TimeStepper, InteractionLoop = kind("Collider"), kind("TimeStepper"), kind("InteractionLoop")
Mortar, OtherLaw = kind("Law2_BrickGeom_BrickPhys_Mortar", LawFunctor), kind("Law2_ScGeom_FrictPhys_CundallStrack", LawFunctor)
Bound = kind("Bo1_Brick_Aabb", BoundFunctor)
InsertionSortCollider, BrickTimeStepper = kind("InsertionSortCollider", Collider), kind("BrickTimeStepper", TimeStepper)


def dispatcher(*functors):
	return types.SimpleNamespace(functors=functors)


class Parts(unittest.TestCase):

	def test_each_is_the_first_of_its_class_in_the_list_as_it_is_now(self):
		first, second = BrickTimeStepper(), BrickTimeStepper()
		engines = loop.Loop([first, second])
		self.assertIs(engines.stepper, first)
		engines.pop(0)
		self.assertIs(engines.stepper, second)
		self.assertIsNone(engines.newton)

	def test_functors_are_those_of_collider_and_interaction_loop(self):
		bound, other, law = Bound(), OtherLaw(), Mortar()
		interaction = InteractionLoop(geomDispatcher=dispatcher(), physDispatcher=dispatcher(), lawDispatcher=dispatcher(other, law))
		engines = loop.Loop([InsertionSortCollider(boundDispatcher=dispatcher(bound)), interaction])
		self.assertEqual(engines.functors, [bound, other, law])
		self.assertIs(engines.law, law)
		engines.remove(interaction)
		self.assertEqual(engines.functors, [bound])
		self.assertIsNone(engines.law)


class FunctorsGiven(unittest.TestCase):

	def test_they_are_sorted_by_kind(self):
		bound, law = Bound(bases=["Brick"]), Mortar(bases=["BrickGeom", "BrickPhys"])
		found = loop._byKind((law, bound))
		self.assertEqual(found, {"BoundFunctor": [bound], "IGeomFunctor": [], "IPhysFunctor": [], "LawFunctor": [law]})

	def test_one_for_the_same_types_in_any_order_replaces_ours(self):
		wall, brick = kind("Ig2", Functor)(bases=["Wall", "Brick"]), kind("Ig2", Functor)(bases=["Brick", "Brick"])
		given = kind("Other", Functor)(bases=["Brick", "Wall"])
		self.assertEqual(loop._merged([brick, wall], [given]), [brick, given])

	def test_two_for_the_same_types_are_refused(self):
		with self.assertRaisesRegex(ValueError, "2 of the kind BoundFunctor for Brick"):
			loop._byKind([Bound(bases=["Brick"]), Bound(bases=["Brick"])])


class Shown(unittest.TestCase):
	effects = loop.Effects([loop.Effect("gravity", True, "9.8"), loop.Effect("energy ledger", False, "not asked for")])

	def test_one_line_each_aligned(self):
		self.assertEqual(str(self.effects), "gravity        on   9.8\nenergy ledger  off  not asked for")

	def test_by_place_and_by_name(self):
		self.assertIs(self.effects[1], self.effects["energy ledger"])
		self.assertEqual(self.effects[:1], (self.effects["gravity"], ))
		with self.assertRaisesRegex(KeyError, "'colour'; effects are gravity, energy ledger"):
			self.effects["colour"]

	def test_ranges_and_counts(self):
		self.assertEqual(loop._range([.1, .1]), "0.1")
		self.assertEqual(loop._range([32.0000001, 0]), "0 to 32")
		self.assertEqual([loop._counted(n, "body", "bodies") for n in (0, 1, 2)], ["0 bodies", "1 body", "2 bodies"])
		self.assertEqual(loop._counted(2, "brick"), "2 bricks")


if __name__ == "__main__":
	unittest.main()
