# SPDX-License-Identifier: GPL-2.0-or-later
# Walls in a bond: straight ones, and walls along a plan whose courses interlock where they meet; with openings and lintels. Each leg of the plan is a row of
# places along which bonds.py lays courses; where two legs meet, each course belongs to one of them and the next course to the other.
"""Builders of walls. Lengths in metres; every wrong argument raises ValueError, before anything is made."""

import math
from typing import NamedTuple

from .blocks import Block, masonry
from .bonds import bond as makeBond, samePlace
from .build import checkWallOptions
from .checks import checkPositive, isFinite
from .openings import checkFixtures, fixturesOf, wholeCourses


def bondedWall(
        length, height, bond="running", size=(0.25, 0.125, 0.075), openings=(), offset=0.5, smallest=0.25, lintels=None, origin=(0, 0, 0), direction=0.0,
        **brickOptions
):
	"""A straight wall in stack, running, English or Flemish bond, with openings.

	The wall begins and ends with straight vertical edges; bricks are cut there and at the reveals of openings, see Bond.course. Head joints go straight
	through the wall; what is longer than a header lies in as many wythes as the bond has. Bricks touch, see MortarJoints.

	:param length: [m]
	:param height: [m], a whole number of courses
	:param bond: 'stack', 'running', 'English' or 'Flemish': it gives the thickness, see yade_brick.bonds.bond
	:param size: length, width and height of a brick with its share of mortar [m]
	:param openings: list of Opening; `at` is from the wall's beginning
	:param offset: shift of running bond, see yade_brick.bonds.bond
	:param smallest: shortest piece as a share of a brick's length, in (0, 0.25]
	:param lintels: dict of arguments of `brick` for lintels where they differ from those of bricks, such as material. Where their materials have another
		mortar, MortarJoints asks for the mortar of the joints between them
	:param origin: lower corner of the wall at its beginning, with lowest x and y where direction is 0 [m]
	:param direction: of the wall in plan, from x towards y [rad]
	:param brickOptions: material and the other arguments of `brick`, except size, corners, center, orientation; contactThickness is 1 % of the shortest edge
		of a whole brick unless given
	:returns: Masonry; lintels are apart from the courses, in the order of the openings by height, and each in the group of its opening's name
	:raises ValueError: naming the argument, its value and what is allowed

	>>> window = Opening(at=0.75, width=1, sill=0.75, height=0.75)
	>>> wall = bondedWall(2.5, 1.8, "Flemish", openings=[window], material=adobe, lintels=dict(material=concrete))
	"""
	laying = makeBond(bond, size, offset, smallest)
	checkPositive(length, "length", "m")
	middle = 0.5 * laying.thickness
	legs = legsOf([(0, middle), (length, middle)], laying, names=("wall",))
	return _builtWalls(legs, height, laying, {0: openings}, lintels, origin, direction, brickOptions)


def wallsAlong(
        plan, height, bond="running", size=(0.25, 0.125, 0.075), openings=None, offset=0.5, smallest=0.25, lintels=None, origin=(0, 0, 0), direction=0.0,
        **brickOptions
):
	"""Walls along a plan, interlocked where they meet: corners, closed rectangles, junctions in T and crosses.

	Where two walls meet, the even courses of walls along x go through and those along y end there; in odd courses it is the other way round. In English and
	Flemish bond the course with headers goes through.

	:param plan: points (x, y) of the middle line of a wall with corners, each leg along x or y [m]; or a list of several such lines, which may end on or cross
		each other. A line whose last point is its first is closed
	:param height: [m], a whole number of courses
	:param openings: dict from the number of a leg, counted from 0 through all lines, to a list of Opening; `at` is from the leg's beginning, which is the
		outer face where another wall meets it there
	:param origin: where the plan's (0, 0) and the foot of the walls go [m]
	:param direction: by how much the plan is turned, from x towards y [rad]
	:returns: Masonry; its groups are 'leg 0', ... and the names of openings. In a course one leg comes after the other
	:raises ValueError: naming the argument, its value and what is allowed

	bond, size, offset, smallest, lintels, brickOptions: as in bondedWall.
	"""
	laying = makeBond(bond, size, offset, smallest)
	return _builtWalls(legsOf(plan, laying), height, laying, openings, lintels, origin, direction, brickOptions)


def _builtWalls(legs, height, laying, openings, lintels, origin, direction, brickOptions):
	courses = courseCount(height, laying)
	fixtures = [[] for _ in legs]
	for index, given in _openingsByLeg(openings, len(legs)).items():
		fixtures[index] = fixturesOf(given, laying, courses, wall=legs[index].label)
	laid = laidWalls(legs, laying, courses, fixtures)
	return masonry(laid, origin, direction, wholeOptions(brickOptions, laying), lintels)


def wholeOptions(brickOptions, laying):
	"""Arguments of brick with one thickness of the contact part for whole and cut bricks."""
	checkWallOptions(brickOptions)
	return {"contactThickness": 0.01 * min(laying.size), **brickOptions}


def courseCount(height, laying):
	count = wholeCourses(height, laying, "height")
	if count < 1:
		raise ValueError(f"height is {height!r}; allowed is at least one course of {laying.size[2]:g} m")
	return count


def _openingsByLeg(openings, count):
	if openings is None:
		return {}
	if not isinstance(openings, dict):
		raise ValueError(f"openings is {openings!r}; allowed is a dict from the number of a leg to a list of Opening")
	for index in openings:
		if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < count:
			raise ValueError(f"openings has the leg {index!r}; allowed are 0 to {count - 1}, the legs of the plan")
	return openings


# The plan


class Leg(NamedTuple):
	"""A straight part of a plan.

	:param name: for errors and groups
	:param begin: (x, y) of its beginning on the middle line [m]
	:param axis: 0 along x, 1 along y
	:param sense: 1, or -1 where it runs against the axis
	:param length: [m]
	:param squares: (low, high) along the leg of the places that it shares with other legs [m]
	"""

	name: str
	begin: tuple
	axis: int
	sense: int
	length: float
	squares: tuple = ()

	@property
	def label(self):
		"""What to call it in a sentence."""
		return self.name if self.name.startswith("leg ") else f"the {self.name} wall" if self.name != "wall" else "the wall"

	def goesThrough(self, course):
		"""Whether it has the places that it shares in this course; otherwise the others have them."""
		return (course + self.axis) % 2 == 0

	def across(self, low, high, half):
		"""Corners (low, high) in plan of a piece between two places, from `half[0]` to `half[1]` off the middle line to the left [m]."""
		along = sorted(self.begin[self.axis] + self.sense * place for place in (low, high))
		off = sorted(self.begin[1 - self.axis] + (self.sense if self.axis == 0 else -self.sense) * side for side in half)
		ends = (along, off) if self.axis == 0 else (off, along)
		return tuple(zip(*ends))


def legsOf(plan, laying, names=None):
	"""The legs of a plan, from outer face to outer face.

	:raises ValueError: for a plan that is none
	"""
	lines = _lines(plan)
	legs = []
	for line in lines:
		for begin, end in zip(line, line[1:]):
			legs.append(_leg(names[len(legs)] if names else f"leg {len(legs)}", begin, end))
	for line, first in zip(lines, _firstLegs(lines)):
		for one, other in zip(legs[first:first + len(line) - 1], legs[first + 1:first + len(line) - 1]):
			if one.axis == other.axis:
				raise ValueError(f"{one.name} and {other.name} of the plan go along one line; allowed is one leg for both, or a corner between them")
	return [_withSquares(leg, legs, laying.thickness) for leg in legs]


def _lines(plan):
	try:
		lines = [[tuple(float(x) for x in point) for point in line] for line in ([plan] if _isPoint(plan[0]) else plan)]
	except (TypeError, ValueError, IndexError, KeyError):
		raise ValueError(f"plan is {plan!r}; allowed is a list of points (x, y), or a list of such lists") from None
	for line in lines:
		if len(line) < 2 or not all(len(point) == 2 and all(map(math.isfinite, point)) for point in line):
			raise ValueError(f"plan has the line {line!r}; allowed are at least two points (x, y) of finite numbers [m]")
	return lines


def _isPoint(value):
	return len(value) == 2 and all(isFinite(number) for number in value)


def _firstLegs(lines):
	return [sum(len(line) - 1 for line in lines[:index]) for index in range(len(lines))]


def _leg(name, begin, end):
	step = [b - a for a, b in zip(begin, end)]
	length = max(map(abs, step))
	if not length > 0 or min(map(abs, step)) > samePlace * length:
		raise ValueError(f"{name} of the plan goes from {begin} to {end}; allowed are legs along x or y, of some length; `direction` turns the whole plan")
	axis = 0 if abs(step[0]) == length else 1
	return Leg(name, begin, axis, 1 if step[axis] > 0 else -1, length)


def _withSquares(leg, legs, thickness):
	"""The leg with the places that it shares, longer by half a thickness at an end where it shares one."""
	margin, half = samePlace * thickness, 0.5 * thickness
	meets = sorted({round(place, 9) for other in legs if (place := _meeting(leg, other, margin)) is not None})
	before = half if any(abs(place) < margin for place in meets) else 0.0
	after = half if any(abs(place - leg.length) < margin for place in meets) else 0.0
	begin = tuple(leg.begin[axis] - (leg.sense * before if axis == leg.axis else 0.0) for axis in range(2))
	squares = tuple((place - half + before, place + half + before) for place in meets)
	return leg._replace(begin=begin, length=leg.length + before + after, squares=squares)


def _meeting(leg, other, margin):
	"""Where the middle line of another leg meets or crosses that of a leg [m]; None if nowhere."""
	if leg.axis == other.axis:
		return None
	place = leg.sense * (other.begin[leg.axis] - leg.begin[leg.axis])
	onOther = other.sense * (leg.begin[other.axis] - other.begin[other.axis])
	return place if -margin < place < leg.length + margin and -margin < onOther < other.length + margin else None


# Laying


def laidWalls(legs, laying, courses, fixtures, levels=None, names=lambda leg, course: ()):
	"""Bricks and lintels of all legs, course by course.

	:param fixtures: for each leg the list of what takes the place of bricks
	:param levels: height of the foot of each course [m]; None: one on the other from 0
	:param names: further groups of a brick of a leg in a course
	:returns: list of Block
	"""
	for leg, fixed in zip(legs, fixtures):
		checkFixtures(fixed, leg.length, leg.squares, leg.label)
	levels = [course * laying.size[2] for course in range(courses)] if levels is None else levels
	laid, below = [], [[] for _ in legs]
	for course in range(courses):
		for index, leg in enumerate(legs):
			places, below[index] = _laidCourse(leg, laying, course, fixtures[index], below[index])
			groups = (leg.name, *names(leg, course))
			laid += [_block(leg, laying, levels, course, course + 1, *place, "brick", leg.label, groups) for place in places]
	for index, leg in enumerate(legs):
		half = (-0.5 * laying.thickness, 0.5 * laying.thickness)
		for one in fixtures[index]:
			if one.kind == "lintel":
				groups = (leg.name, one.group, *names(leg, one.first))
				laid.append(_block(leg, laying, levels, one.first, one.last, one.low, one.high, half, "lintel", one.name, groups))
	return laid


def _laidCourse(leg, laying, course, fixtures, below):
	"""Pieces of a course as (low, high, (side, side)), and its head joints."""
	shared = leg.squares if leg.squares and not leg.goesThrough(course) else ()
	taken = sorted([(one.low, one.high) for one in fixtures if one.isIn(course)] + list(shared))
	avoided = below + [end for one in fixtures if one.kind != "opening" and (one.isIn(course - 1) or one.isIn(course + 1)) for end in (one.low, one.high)]
	if leg.squares and not shared:
		avoided += [end for square in leg.squares for end in square]
	pieces, joints, begin, margin = [], [], 0.0, samePlace * laying.size[0]
	for low, high in (*taken, (leg.length, leg.length)):
		if low - begin > margin:
			places = _laidBetween(leg, laying, course, begin, low, avoided)
			joints += places[1:-1]
			pieces += laying.pieces(places)
		begin = high
	return pieces, joints


def _laidBetween(leg, laying, course, begin, end, avoided):
	try:
		return laying.course(course + leg.axis, begin, end, [place for place in avoided if begin < place < end])
	except ValueError as problem:
		raise ValueError(f"course {course} of {leg.label} from {begin:g} to {end:g} m, between openings, lintels, walls or ends: {problem}") from None


def _block(leg, laying, levels, course, after, low, high, half, kind, name, groups):
	(x0, y0), (x1, y1) = leg.across(low, high, half)
	top = levels[after - 1] + laying.size[2]
	return Block((x0, y0, levels[course]), (x1, y1, top), kind, course, name, groups)
