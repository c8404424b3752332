# SPDX-License-Identifier: GPL-2.0-or-later
# Walls as boxes, before YADE makes bodies of them: they fill their outline but for openings, never overlap, interlock at corners, and have no head joint over
# another. Overlaps and joints are found here from all pairs of boxes, not by the checks of the package.
"""Tests of yade_brick.walls, openings, blocks and houses; no YADE needed."""

import itertools
import math
import random
import unittest

import numpy as np

import standalone

blocks, bonds, houses, openings, walls = (standalone.load(name) for name in ("blocks", "bonds", "houses", "openings", "walls"))
Opening, Block = openings.Opening, blocks.Block

size = (0.2, 0.1, 0.05)
bondNames = tuple(bonds.wythesOf)
rectangle = [(0, 0), (1.4, 0), (1.4, 1.0), (0, 1.0), (0, 0)]
plans = {
        "straight": [(0, 0), (1.4, 0)],
        "L": [(0, 0), (1.2, 0), (1.2, 0.9)],
        "U": [(0.9, 0), (0, 0), (0, -0.8), (0.7, -0.8)],
        "T": [[(0, 0), (1.3, 0)], [(0.6, 0), (0.6, 0.9)]],
        "cross": [[(0, 0), (1.3, 0)], [(0.65, -0.7), (0.65, 0.8)]],
        "rectangle": rectangle,
}
# length of middle lines less half a thickness for each meeting end that is counted twice, in thicknesses t: outline = length * t + these * t^2
squaresOf = {"straight": 0, "L": 0, "U": 0, "T": -0.5, "cross": -1, "rectangle": 0}


def laid(plan, bond="running", courses=6, byLeg=None, **options):
	"""Blocks of walls along a plan."""
	laying = bonds.bond(bond, size, **options)
	legs = walls.legsOf(plan, laying)
	fixtures = [openings.fixturesOf((byLeg or {}).get(index, []), laying, courses, wall=leg.label) for index, leg in enumerate(legs)]
	return walls.laidWalls(legs, laying, courses, fixtures)


def volume(found):
	return sum(math.prod(high - low for low, high in zip(block.low, block.high)) for block in found)


def middleLength(plan):
	lines = [plan] if isinstance(plan[0][0], (int, float)) else plan
	return sum(math.dist(one, other) for line in lines for one, other in zip(line, line[1:]))


def shared(one, other):
	"""Lengths that two boxes have in common along x, y, z; negative: apart."""
	return [min(a, b) - max(c, d) for a, b, c, d in zip(one.high, other.high, one.low, other.low)]


def allShared(found):
	"""Lengths that all pairs of boxes have in common, (n, n, 3)."""
	low, high = (np.array([getattr(block, end) for block in found]) for end in ("low", "high"))
	return np.minimum(high[:, None], high[None]) - np.maximum(low[:, None], low[None])


def headJoints(found):
	"""By course: vertical faces between bricks as (axis across, place, begin, end), but those between wythes."""
	joints = {}
	bricks = [block for block in found if block.kind == "brick"]
	axes = {name: axisOf(name, bricks) for name in {block.name for block in bricks}}
	common = allShared(bricks)
	for across in (0, 1):
		facing = (np.abs(common[:, :, across]) < 1e-9) & (common[:, :, 1 - across] > 1e-9)
		for one, other in zip(*np.nonzero(np.triu(facing, 1))):
			first, second = bricks[one], bricks[other]
			betweenWythes = first.name == second.name and across != axes[first.name]
			if first.course == second.course and not betweenWythes:
				begin = max(first.low[1 - across], second.low[1 - across])
				joint = (across, max(first.low[across], second.low[across]), begin, begin + common[one, other, 1 - across])
				joints.setdefault(first.course, []).append(joint)
	return joints


def axisOf(name, found):
	"""0 or 1: along which axis a leg lies."""
	ofLeg = [block for block in found if block.name == name]
	return max(range(2), key=lambda axis: max(block.high[axis] for block in ofLeg) - min(block.low[axis] for block in ofLeg))


def smallestLap(found):
	"""Distance in plan between parallel head joints of neighbouring courses that face each other [m]."""
	joints, least = headJoints(found), math.inf
	for course in set(joints) & {course - 1 for course in joints}:
		below, above = (np.array(joints[number])[:, None] for number in (course, course + 1))
		above = above.transpose(1, 0, 2)
		facing = (below[..., 0] == above[..., 0]) & (np.minimum(below[..., 3], above[..., 3]) - np.maximum(below[..., 2], above[..., 2]) > 1e-9)
		least = min(least, np.abs(below[..., 1] - above[..., 1])[facing].min(initial=math.inf))
	return least


class WallCase(unittest.TestCase):

	def checkSolid(self, found):
		over = np.triu(allShared(found).min(axis=2) > 1e-9, 1)
		self.assertFalse(over.any(), [found[index] for index in np.argwhere(over).ravel()[:2]])

	def refused(self, words, *arguments, **more):
		with self.assertRaisesRegex(ValueError, words):
			laid(*arguments, **more)


class PlanTest(WallCase):

	def test_walls_fill_their_outline_in_every_bond_and_plan(self):
		for name, bond in itertools.product(plans, bondNames):
			thickness = bonds.bond(bond, size).thickness
			found = laid(plans[name], bond, 4)
			# each corner is counted half by either leg, and its outer quarter makes up for the inner one
			expected = (middleLength(plans[name]) * thickness + squaresOf[name] * thickness**2) * 4 * size[2]
			self.assertAlmostEqual(volume(found), expected, delta=1e-12, msg=f"{name}, {bond}")
			self.checkSolid(found)

	def test_no_head_joint_is_above_another_also_at_corners_and_junctions(self):
		for name, bond in itertools.product(plans, ("running", "English", "Flemish")):
			self.assertGreaterEqual(smallestLap(laid(plans[name], bond, 4)), 0.025 - 1e-9, f"{name}, {bond}")  # an eighth of a brick

	def test_quoins_belong_to_one_wall_and_the_other_course_by_course(self):
		for bond in bondNames:
			found = laid(rectangle, bond, 4)
			for corner in rectangle[:-1]:
				owners = [{block.name for block in found if block.course == course and self.covers(block, corner)} for course in range(4)]
				self.assertTrue(all(len(owner) == 1 for owner in owners))
				self.assertEqual(owners[0], owners[2])
				self.assertNotEqual(owners[0], owners[1])

	def test_courses_of_headers_go_through_at_corners(self):
		for bond, (course, quoin) in itertools.product(("English", "Flemish"), enumerate([(-0.05, -0.05), (1.45, -0.05)])):
			found = [block for block in laid(rectangle, bond, 2) if block.course == course]
			owner, = [block for block in found if self.covers(block, quoin)]  # at the beginning of leg 0, of leg 1
			along = course
			self.assertEqual(owner.name, f"leg {along}")
			self.assertAlmostEqual(owner.high[along] - owner.low[along], 0.1, delta=1e-12)
			self.assertAlmostEqual(owner.high[1 - along] - owner.low[1 - along], 0.2, delta=1e-12)

	@staticmethod
	def covers(block, point):
		"""Whether a point, moved a little towards +x and +y as it may be on a joint, is in a block."""
		return all(low < x + 1e-3 < high for low, high, x in zip(block.low, block.high, point))

	def test_walls_have_the_units_of_the_textbook(self):
		for bond, lengths in (("English", {0.1, 0.05}), ("Flemish", {0.1, 0.05, 0.2})):
			course = [block for block in laid([(0, 0), (1.6, 0)], bond, 2) if block.course == 0]
			self.assertEqual({round(block.high[0] - block.low[0], 9) for block in course}, lengths)

	def test_bad_plans_are_refused_with_the_value(self):
		self.refused("leg 1 of the plan goes from .*allowed are legs along x or y", [(0, 0), (1, 0), (2, 1)])
		self.refused("leg 0 and leg 1 of the plan go along one line", [(0, 0), (1, 0), (2, 0)])
		self.refused("plan is 'L'", "L")
		self.refused("at least two points", [[(0, 0)]])
		self.refused("plan is .*inf", [(math.inf, 0), (0, 0)])
		self.refused("goes from .* to", [(0, 0), (0, 0)])

	def test_walls_in_each_others_way_are_refused(self):
		for plan in ([[(0, 0), (1, 0)], [(0, 0.05), (1, 0.05)]], [[(0, 0), (1, 0)], [(0.5, 0.02), (0.5, 1)]]):
			with self.assertRaisesRegex(ValueError, "leg 0 .*leg 1.* overlap"):
				blocks.checkOverlaps(laid(plan))


class OpeningTest(WallCase):
	window = Opening(at=0.53, width=0.37, sill=0.1, height=0.1, name="window")
	door = Opening(at=1.25, width=0.3, height=0.15, lintel=2, bearing=0.08, name="door")

	def test_wall_is_its_outline_less_its_openings_in_every_bond(self):
		for bond in bondNames:
			found = laid([(0, 0), (2.03, 0)], bond, 6, {0: [self.window, self.door]})
			thickness = bonds.bond(bond, size).thickness
			self.assertAlmostEqual(volume(found), (2.03 * 0.3 - 0.37 * 0.1 - 0.3 * 0.15) * thickness, delta=1e-12)
			self.checkSolid(found)
			for block in found:
				for opening in (self.window, self.door):
					inside = Block((opening.at, -1, opening.sill), (opening.at + opening.width, 1, opening.sill + opening.height))
					self.assertLess(min(shared(block, inside)), 1e-9)

	def test_lintels_have_their_bearing_and_height(self):
		found = [block for block in laid([(0, 0), (2.03, 0)], "running", 6, {0: [self.window, self.door]}) if block.kind == "lintel"]
		for block, expected in zip(found, (((0.43, 0.2), (1.0, 0.25)), ((1.17, 0.15), (1.63, 0.25)))):
			for got, place in zip((block.low, block.high), expected):
				self.assertAlmostEqual(got[0], place[0], delta=1e-12)
				self.assertAlmostEqual(got[2], place[1], delta=1e-12)
		self.assertEqual([block.groups for block in found], [("leg 0", "window"), ("leg 0", "door")])

	def test_no_slivers_and_no_head_joint_above_another_wherever_openings_are(self):
		"""Only ends of lintels count besides: a joint over a reveal is over the bricks of the sill on one side."""
		chance = random.Random(3)
		for bond in ("running", "English", "Flemish"):
			tried = 0
			while tried < 25:
				at, width, end = chance.uniform(0.2, 0.6), chance.uniform(0.2, 0.6), chance.uniform(0.2, 0.6)
				found = laid([(0, 0), (at + width + end, 0)], bond, 7, {0: [Opening(at, width, 0.1, 0.1)]})
				tried += 1
				lengths = [block.high[0] - block.low[0] for block in found if block.kind == "brick"]
				self.assertTrue(0.05 - 1e-7 <= min(lengths) and max(lengths) <= 0.2 + 1e-7)
				self.assertGreaterEqual(smallestLap([block._replace(kind="brick") for block in found]), 0.025 - 1e-7, (bond, at, width, end))

	def test_openings_that_do_not_fit_are_refused_with_what_is_allowed(self):
		for words, given in (
		        ("window in leg 0 reaches from 0.9 to 1.5 m; allowed is 0 to 1.4", Opening(0.9, 0.6, 0.1, name="window")),
		        ("height of opening 0 .*0.12 m; allowed are whole courses of 0.05 m, such as 0.1 m or 0.15", Opening(0.4, 0.4, 0.12)),
		        ("sill of opening 0 .*0.07 m", Opening(0.4, 0.4, 0.1, sill=0.07)), ("ends 0.4 m above its foot; allowed is up to 0.3", Opening(0.4, 0.4, 0.4)),
		        ("lintel of opening 0 .* would end above the wall", Opening(0.4, 0.4, 0.3)), ("lintel of opening 0 .* is 0, but", Opening(0.4, 0.4, 0.1, lintel=0)),
		        ("lintel of opening 0 .* reaches from -0.05", Opening(0.05, 0.4, 0.1)), ("at of opening 0 .* is -1", Opening(-1, 0.4, 0.1)),
		        ("width of opening 0 .* is nan", Opening(0, math.nan, 0.1)), ("height of opening 0 .* is 0", Opening(0, 1, 0)),
		        ("bearing of opening 0 .* is 0", Opening(0.4, 0.4, 0.1, bearing=0)), ("lintel of opening 0 .* is 1.5", Opening(0.4, 0.4, 0.1, lintel=1.5)),
		        ("allowed is a list of Opening", "door"),
		        ("0.03 m is left for bricks", Opening(0.03, 0.4, 0.3, lintel=0))
		):
			self.refused(words, plans["straight"], byLeg={0: [given] if isinstance(given, Opening) else given})

	def test_openings_in_each_others_way_are_refused(self):
		first = Opening(0.4, 0.4, 0.1)  # its lintel lies from 0.3 to 0.9 m
		for words, other in (
		        ("opening 0 .* and opening 1 .* overlap", Opening(0.6, 0.4, 0.1)),
		        ("the lintel of opening 0 .* and the lintel of opening 1 .* overlap", Opening(0.9, 0.3, 0.1)),
		        ("the lintel of opening 0 .* and opening 1 .* overlap", Opening(0.85, 0.3, 0.15)),
		        ("the lintel of opening 0 .* and opening 1 .* overlap", Opening(0.5, 0.2, 0.1, sill=0.1))
		):
			self.refused(words, plans["straight"], byLeg={0: [first, other]})
		laid(plans["straight"], byLeg={0: [first, Opening(1.0, 0.3, 0.1)]})  # one lintel begins where the other ends

	def test_openings_stay_clear_of_corners(self):
		self.refused("the lintel of opening 0 in leg 0 .* meets another wall", rectangle, byLeg={0: [Opening(0.15, 0.4, 0.1)]})
		found = laid(rectangle, "running", 6, {3: [Opening(0.2, 0.4, 0.1)]})  # from the outer face of the corner, down the leg from (0, 1)
		lintel, = [block for block in found if block.kind == "lintel"]
		self.assertAlmostEqual(lintel.high[1], 1.05 - 0.1, delta=1e-12)
		self.assertAlmostEqual(lintel.low[1], 1.05 - 0.7, delta=1e-12)


class HouseTest(WallCase):
	window, door = Opening(0.5, 0.3, 0.2, sill=0.15, name="window"), Opening(0.6, 0.3, 0.35, name="door")
	rooms = dict(south=[door], east=[window], west=[window])

	tall = dict(south=[Opening(0.5, 0.3, 0.5, lintel=0, name="door")])

	def blocks(self, bond="running", plan=(1.5, 1.2), height=0.5, storeys=1, **given):
		return houses.houseBlocks(plan, height, storeys, bonds.bond(bond, size), **given)[0]

	def test_walls_openings_floors_and_joists_make_up_the_volume(self):
		for bond in bondNames:
			t = bonds.bond(bond, size).thickness
			joists, slab = houses.Floor("joists", 0.1, count=3, width=0.06), houses.Floor("slab", 0.12, overhang=0.1)
			found = self.blocks(bond, storeys=2, openings=self.rooms, floors=[(joists, houses.Floor("planks", 0.03, count=4)), slab])
			ring = 1.5 * 1.2 - (1.5 - 2 * t) * (1.2 - 2 * t)
			walls_ = 2 * (ring * 0.5 - (0.3 * 0.35 + 2 * 0.3 * 0.2) * t)
			floors = 3 * 0.06 * 0.1 * (1.2 - 2 * t) + 0.03 * 1.5 * 1.2 + 0.12 * 1.7 * 1.4  # of joists what is between the walls: their ends are in them
			self.assertAlmostEqual(volume(found), walls_ + floors, delta=1e-12)
			self.checkSolid(found)
			blocks.checkSupports(found)

	def test_storeys_stand_on_the_slab_below(self):
		found = self.blocks(storeys=2, openings=[self.rooms, {}], floors=houses.Floor("slab", 0.12))
		upper = [block for block in found if "storey 1" in block.groups and block.kind == "brick"]
		self.assertAlmostEqual(min(block.low[2] for block in upper), 0.62, delta=1e-12)
		self.assertAlmostEqual(max(block.high[2] for block in found), 2 * 0.62, delta=1e-12)
		self.assertEqual([block.groups[:2] for block in found if block.kind == "lintel"], [("south", "door"), ("east", "window"), ("west", "window")])

	def test_slab_spans_an_opening_up_to_the_top(self):
		blocks.checkSupports(self.blocks(openings=self.tall, floors=houses.Floor("slab"), storeys=2))
		self.checkSolid(self.blocks(openings=self.tall))

	def test_openings_are_where_they_are_seen_from_outside(self):
		lintels = [block for block in self.blocks(openings=dict(north=[self.door], west=[self.window])) if block.kind == "lintel"]
		self.assertAlmostEqual(lintels[0].high[0], 1.5 - (0.6 - 0.1), delta=1e-12)  # the left end of the north wall is in the east
		self.assertAlmostEqual(lintels[1].high[1], 1.2 - (0.5 - 0.1), delta=1e-12)

	def test_no_head_joint_is_above_another(self):
		for bond in ("running", "English", "Flemish"):
			found = self.blocks(bond, storeys=2, openings=self.rooms, floors=houses.Floor("joists", 0.1, count=2, width=0.1))
			self.assertGreaterEqual(smallestLap(found), 0.025 - 1e-9)

	def test_gables_become_shorter_within_the_slope(self):
		found = self.blocks(gables=math.radians(45))
		gable = [block for block in found if "gables" in block.groups]
		self.assertEqual({block.groups[0] for block in gable}, {"east", "west"})
		for block in gable:
			self.assertLess(block.high[2] - 0.5, min(block.low[1], 1.2 - block.high[1]) + 1e-9)
		# 45 degrees: courses of 1.2 - 2 * 0.05 k from k = 1 on, down to 0.2
		self.assertAlmostEqual(volume(gable), 2 * 0.1 * 0.05 * sum(1.2 - 0.1 * k for k in range(1, 11)), delta=1e-12)
		self.checkSolid(found)
		blocks.checkSupports(found)

	def test_bad_houses_are_refused_with_the_value(self):
		for words, given in (
		        ("plan is .*0.2", dict(plan=(0.2, 3))), ("height .*0.51", dict(height=0.51)), ("storeys is 0", dict(storeys=0)),
		        ("openings has the wall 'left'", dict(openings=dict(left=[self.door]))), ("openings is .* one for each of 2", dict(openings=[{}], storeys=2)),
		        ("floors is .*2 storeys", dict(floors=[None], storeys=2)), ("floors has 'slab'", dict(floors=["slab"])),
		        ("kind of the floor on storey 0 is 'wood'", dict(floors=houses.Floor("wood"))), ("span .* is 'z'", dict(floors=houses.Floor(span="z"))),
		        ("thickness .* is 0", dict(floors=houses.Floor(thickness=0))), ("overhang .* is -0.1.*>= 0", dict(floors=houses.Floor(overhang=-0.1), storeys=2)),
		        ("overhang .* is -0.1; .*> -0.1", dict(floors=houses.Floor(overhang=-0.1))), ("count of the floor .* is 0", dict(floors=houses.Floor(count=0))),
		        ("thickness of the floor .* 0.12 m; allowed are whole courses", dict(floors=houses.Floor("joists", 0.12))),
		        ("9 joists with a width of 0.2 m do not fit", dict(floors=houses.Floor("joists", 0.1, count=9, width=0.2))),
		        ("the lintel of door .* and joist 1 in the south wall overlap", dict(floors=houses.Floor("joists", 0.15, count=3), openings=self.rooms)),
		        ("door in the south wall of storey 0 reaches the top", dict(openings=self.tall, storeys=2)),
		        ("door .* reaches the top", dict(openings=self.tall, floors=houses.Floor("planks"))), ("door .* reaches the top", dict(openings=self.tall, gables=0.5)),
		        ("gables is 2", dict(gables=2))
		):
			with self.assertRaisesRegex(ValueError, words):
				self.blocks(**given)


class CheckTest(WallCase):

	def test_overlapping_blocks_are_named(self):
		with self.assertRaisesRegex(ValueError, "brick of course 0 of a at .* and the lintel of b at .* overlap"):
			blocks.checkOverlaps([Block((0, 0, 0), (1, 1, 1), name="a"), Block((2, 0, 0), (3, 1, 1)), Block((0.9, 0, 0), (2, 1, 1), "lintel", name="b")])

	def test_blocks_that_touch_along_an_edge_only_hold_nothing(self):
		with self.assertRaisesRegex(ValueError, "floor of b .* and 0 others stand on nothing"):
			blocks.checkSupports([Block((0, 0, 0), (1, 1, 1)), Block((1, 0, 1), (2, 1, 2), "floor", name="b")])
		blocks.checkSupports([Block((0, 0, 0), (1, 1, 1)), Block((0.9, 0, 1), (2, 1, 2), "floor")])

	def test_checks_agree_with_all_pairs_for_random_boxes(self):
		chance = random.Random(2)
		for _ in range(200):
			boxes = []
			for _ in range(6):
				low = [chance.randrange(4) for _ in range(3)]
				boxes.append(Block(tuple(low), tuple(x + chance.randrange(1, 3) for x in low)))
			overlap = any(min(shared(one, other)) > 0 for one, other in itertools.combinations(boxes, 2))
			try:
				blocks.checkOverlaps(boxes)
				self.assertFalse(overlap)
			except ValueError:
				self.assertTrue(overlap)


if __name__ == "__main__":
	unittest.main()
