# SPDX-License-Identifier: GPL-2.0-or-later
# Doors and windows, and the lintels over them: what they are, and whether they fit a wall. In places along the wall [m] and numbers of courses; walls.py
# lays bricks around them.
"""Openings in walls: `Opening`."""

from dataclasses import dataclass
from typing import NamedTuple

from .bonds import samePlace
from .checks import isFinite


@dataclass(frozen=True)
class Opening:
	"""A door, a window or a gap in a wall.

	:param at: from the beginning of the wall, outer face of a corner included, to the opening [m]
	:param width: [m]
	:param height: [m], a whole number of courses
	:param sill: height of its lower edge above the foot of the wall [m], a whole number of courses; 0 for a door
	:param lintel: height of the lintel in courses, >= 1; 0 for none, which an opening up to the top of the wall has
	:param bearing: length on which the lintel lies on the wall at each end [m]; None: half a brick
	:param name: for errors and for Masonry.groups, where its lintel is found
	"""

	at: float
	width: float
	height: float
	sill: float = 0.0
	lintel: int = 1
	bearing: float = None
	name: str = None


class Fixture(NamedTuple):
	"""What takes the place of bricks in a wall: an opening, a lintel, the end of a joist.

	:param low, high: ends [m], from the beginning of the wall
	:param first, last: courses, the last one not included
	:param kind: opening, lintel or joist
	:param name: for errors
	:param group: name of the opening in Masonry.groups
	"""

	low: float
	high: float
	first: int
	last: int
	kind: str
	name: str
	group: str = None

	def isIn(self, course):
		return self.first <= course < self.last


def fixturesOf(openings, bond, courses, base=0, wall="the wall"):
	"""Openings of a wall as fixtures, each followed by its lintel.

	:param openings: list of Opening
	:param courses: of the wall, or of the storey
	:param base: number of the lowest of these courses
	:param wall: what to call the wall in errors
	:raises ValueError: for numbers out of their range, and for openings that do not fit courses
	"""
	if not isinstance(openings, (list, tuple)) or not all(isinstance(opening, Opening) for opening in openings):
		raise ValueError(f"openings of {wall} are {openings!r}; allowed is a list of Opening")
	found = []
	for index, opening in enumerate(openings):
		group = opening.name or f"opening {index}"
		name = f"{group} in {wall}"
		_checkNumbers(opening, name)
		first = base + wholeCourses(opening.sill, bond, f"sill of {name}")
		last = first + wholeCourses(opening.height, bond, f"height of {name}")
		top = base + courses
		if last > top:
			raise ValueError(f"{name} ends {opening.sill + opening.height:g} m above its foot; allowed is up to {courses * bond.size[2]:g} m, the top")
		found.append(Fixture(opening.at, opening.at + opening.width, first, last, "opening", name, group))
		if opening.lintel == 0:
			if last < top:
				raise ValueError(f"lintel of {name} is 0, but bricks lie above it; allowed is 0 only for an opening up to the top of the wall")
			continue
		if last + opening.lintel > top:
			raise ValueError(f"the lintel of {name} would end above the wall; allowed is an opening that ends {opening.lintel} courses below, or lintel=0")
		bearing = 0.5 * bond.size[0] if opening.bearing is None else opening.bearing
		found.append(Fixture(opening.at - bearing, opening.at + opening.width + bearing, last, last + opening.lintel, "lintel", name, group))
	return found


def _checkNumbers(opening, name):
	for what, value, holds, allowed in (
	        ("at", opening.at, lambda x: x >= 0, "a number >= 0 m"), ("width", opening.width, lambda x: x > 0, "a number > 0 m"),
	        ("height", opening.height, lambda x: x > 0, "a number > 0 m"), ("sill", opening.sill, lambda x: x >= 0, "a number >= 0 m"),
	        ("bearing", 1 if opening.bearing is None else opening.bearing, lambda x: x > 0, "a number > 0 m, or None")
	):
		if not (isFinite(value) and holds(value)):
			raise ValueError(f"{what} of {name} is {value!r}; allowed is {allowed}")
	if not isinstance(opening.lintel, int) or isinstance(opening.lintel, bool) or opening.lintel < 0:
		raise ValueError(f"lintel of {name} is {opening.lintel!r}; allowed is a whole number of courses >= 0")


def wholeCourses(height, bond, name):
	"""A height as a number of courses.

	:raises ValueError: when it is none, with the nearest heights that are
	"""
	course = bond.size[2]
	if not (isFinite(height) and height >= 0):
		raise ValueError(f"{name} is {height!r}; allowed is a finite height >= 0 m")
	count = round(height / course)
	if abs(count * course - height) > samePlace * course * max(1, count):
		lower = int(height // course)
		raise ValueError(f"{name} is {height:g} m; allowed are whole courses of {course:g} m, such as {lower * course:g} m or {(lower + 1) * course:g} m")
	return count


def checkFixtures(fixtures, length, squares, wall):
	"""Whether all fit a wall and leave room for each other. Lintels and joists then lie on masonry: no opening is below them, since it has its own lintel there.

	:param length: of the wall [m]
	:param squares: (low, high) of the places where other walls meet or cross it [m]
	:param wall: what to call it in errors
	:raises ValueError: naming what does not fit
	"""
	margin = samePlace * length
	for index, fixture in enumerate(fixtures):
		if fixture.low < -margin or fixture.high > length + margin:
			raise ValueError(f"{_words(fixture)} reaches from {fixture.low:g} to {fixture.high:g} m; allowed is 0 to {length:g} m, the length of {wall}")
		for low, high in squares:
			if fixture.low < high - margin and fixture.high > low + margin:
				raise ValueError(
				        f"{_words(fixture)} reaches from {fixture.low:g} to {fixture.high:g} m; from {low:g} to {high:g} m {wall} meets another wall"
				)
		for other in fixtures[:index]:
			if fixture.low < other.high - margin and fixture.high > other.low + margin and fixture.first < other.last and other.first < fixture.last:
				raise ValueError(f"{_words(other)} and {_words(fixture)} overlap; allowed are openings with room between them for the bearings of their lintels, and for joists")


def _words(fixture):
	return f"the lintel of {fixture.name}" if fixture.kind == "lintel" else fixture.name
