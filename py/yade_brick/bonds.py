# SPDX-License-Identifier: GPL-2.0-or-later
# How the courses of a wall are laid: where head joints are in stack, running, English and Flemish bond, and how bricks are cut at the ends of a course,
# at corners and at the reveals of openings. Lengths along one course only: which walls and openings there are is the business of walls.py.
"""Bonds: `bond` makes one, `Bond.course` lays a course."""

import math
import numbers
from dataclasses import dataclass

from .checks import isFinite

#: Names of bonds, with the number of wythes (leaves, each as thick as a brick is wide) that a wall in it has.
wythesOf = {"stack": 1, "running": 1, "English": 2, "Flemish": 2}

#: Positions closer than this share of a brick's length are one.
samePlace = 1e-6

#: Head joints of neighbouring courses are at least this share of a brick's length apart where bricks had to be cut; in the undisturbed bond by more.
leastLap = 1 / 8


@dataclass(frozen=True)
class Bond:
	"""How bricks of one format are laid; made by `bond`.

	:param name: stack, running, English or Flemish
	:param size: of a brick with its share of mortar: length, width, height [m]
	:param offsets: of running bond: where courses begin, as shares of a brick's length, in turn from below
	:param smallest: length of the shortest piece [m]
	"""

	name: str
	size: tuple
	offsets: tuple
	smallest: float

	@property
	def wythes(self):
		return wythesOf[self.name]

	@property
	def thickness(self):
		"""Of a wall [m]."""
		return self.wythes * self.size[1]

	@property
	def lap(self):
		"""Distance of head joints in neighbouring courses of the undisturbed bond [m]; 0 for stack bond."""
		length = self.size[0]
		if self.name == "stack":
			return 0.0
		if self.name != "running":
			return 0.25 * length
		steps = [(after - before) % 1 for before, after in zip(self.offsets, self.offsets[1:] + self.offsets[:1])]
		return length * min(min(step, 1 - step) for step in steps)

	@property
	def leastLap(self):
		"""Lap below which head joints are moved [m]."""
		return min(self.lap, leastLap * self.size[0])

	def pattern(self, course, start, end):
		"""Head joints of the undisturbed bond between two places of a course [m], from left to right. In English and Flemish bond the even courses have
		headers where the odd ones have the middles of stretchers; the wall begins at 0."""
		length, width, _ = self.size
		first, period = {
		        "stack": ((0.0,), length),
		        "running": ((self.offsets[course % len(self.offsets)] * length,), length),
		        "English": ((0.5 * width,), width) if course % 2 == 0 else ((0.0,), length),
		        "Flemish": ((0.5 * width, 1.5 * width), 3 * width) if course % 2 == 0 else ((0.0, 2 * width), 3 * width),
		}[self.name]
		margin = samePlace * length
		turns = range(math.floor(start / period) - 1, math.ceil(end / period) + 1)
		return [place for turn in turns for place in (turn * period + one for one in first) if start + margin < place < end - margin]

	def course(self, course, start, end, avoided=()):
		"""Lays the bricks of a course between two ends: of the wall, a corner, a reveal, a lintel.

		The bond is cut at both ends. In the header courses of English and Flemish bond a header comes first and a queen closer second, where that keeps
		the lap. An end piece shorter than `smallest` and its neighbour become one piece, or two where one would be too long. A head joint that lies
		within `leastLap` of an avoided place moves to where its lap is largest, is left out, or becomes two; where
		there is no room for any of that, its lap is what it can be.

		:param course: its number from below, from 0
		:param start, end: [m]
		:param avoided: places of head joints below and of ends of lintels and corners above and below [m]
		:returns: places of all head joints and both ends [m], from left to right
		:raises ValueError: when there is less room than for the smallest piece

		>>> running = bond("running", (0.2, 0.1, 0.1))
		>>> [[round(place, 3) for place in running.course(number, 0, 0.52)] for number in (0, 1)]
		[[0, 0.2, 0.4, 0.52], [0, 0.1, 0.3, 0.41, 0.52]]
		"""
		if end - start < self.smallest - samePlace * self.size[0]:
			raise ValueError(f"{end - start:.6g} m is left for bricks; allowed is nothing, or at least {self.smallest:.6g} m, the smallest piece")
		avoided = sorted(avoided) if self.lap else []
		joints = [start, *self.pattern(course, start, end), end]
		if self.wythes == 2 and course % 2 == 0:
			joints = self._closersInside(course, joints, avoided)
		joints = self._withoutSlivers(joints, avoided)
		return self._lapped(joints, avoided)

	def pieces(self, places):
		"""Pieces between head joints, as (low, high, (side, side)) along and across the wall, across from its middle [m]; one that is no longer than a header
		goes through the wall, others lie in as many wythes as the bond has."""
		laid = []
		for low, high in zip(places, places[1:]):
			wythes = 1 if high - low <= self.size[1] * (1 + samePlace) else self.wythes
			edges = [self.thickness * (side / wythes - 0.5) for side in range(wythes + 1)]
			laid += [(low, high, sides) for sides in zip(edges, edges[1:])]
		return laid

	def _closersInside(self, course, joints, avoided):
		"""A course that ends with a closer and a header has them change places."""
		start, end, header = joints[0], joints[-1], self.size[1]
		both = sorted([*avoided, *self.pattern(course + 1, start, end)])
		for fromEnd, inward in ((start, 1), (end, -1)):
			corner = fromEnd + inward * 1.5 * header
			moved = fromEnd + inward * header
			if not start < corner < end or not self._same(_distance(corner, joints), 0) or self._distanceBelow(moved, both, self.leastLap):
				continue
			joints = sorted([place for place in joints if place == fromEnd or inward * (place - corner) > -samePlace * self.size[0]] + [moved])
		return joints

	def _withoutSlivers(self, joints, avoided):
		for last in (False, True):
			ends = [-place for place in reversed(joints)] if last else joints
			if len(ends) > 2 and ends[1] - ends[0] < self.smallest - samePlace * self.size[0]:
				ends = self._resplit(ends, [-place for place in reversed(avoided)] if last else avoided)
			joints = [-place for place in reversed(ends)] if last else ends
		return joints

	def _resplit(self, joints, avoided):
		"""The first two pieces as one, or as two others."""
		start, end = joints[0], joints[2]
		length, longest = end - start, self.size[0] * (1 + samePlace)
		alone = self.size[0] if self.wythes == 1 else self.size[1]  # up to that length one piece goes through the wall
		if length <= alone * (1 + samePlace):
			return [start, *joints[2:]]
		place = self._best(start, end, 0.5 * (start + end), avoided)
		if length <= longest and (place is None or self._distanceBelow(place, avoided, self.leastLap)):
			return [start, *joints[2:]]
		return [start, place, *joints[2:]]

	def _lapped(self, joints, avoided):
		laid = [joints[0]]
		for ideal, after in zip(joints[1:-1], joints[2:]):
			laid += [ideal] if not self._distanceBelow(ideal, avoided, self.leastLap) else self._moved(laid[-1], after, ideal, avoided)
		return [*laid, joints[-1]]

	def _moved(self, before, after, ideal, avoided):
		"""What takes the place of a joint without lap: the same joint elsewhere, none where one brick is long enough, or two where whole bricks leave no room."""
		place = self._best(before, after, ideal, avoided)
		if place is not None and not self._distanceBelow(place, avoided, self.leastLap):
			return [place]
		if after - before <= self.size[0] * (1 + samePlace):
			return []
		first = self._best(before, after, before + (after - before) / 3, avoided, rest=2)
		second = None if first is None else self._best(first, after, 0.5 * (first + after), avoided)
		if second is None or self._distanceBelow(first, avoided, self.leastLap) or self._distanceBelow(second, avoided, self.leastLap):
			return [ideal if place is None else place]
		return [first, second]

	def _best(self, before, after, ideal, avoided, rest=1):
		"""Where a joint between two others has the largest lap, which need not be larger than the bond's; of such places the one nearest to the ideal.
		None where the pieces do not fit: one before it and `rest` after it."""
		low = max(before + self.smallest, after - rest * self.size[0])
		high = min(after - rest * self.smallest, before + self.size[0])
		margin = samePlace * self.size[0]
		if low > high + margin:
			return None
		near = [place for place in avoided if before - self.size[0] < place < after + self.size[0]]
		middles = [0.5 * (one + other) for one, other in zip(near, near[1:])]
		places = [low, high, min(max(ideal, low), high), *middles, *(place + side * self.lap for place in near for side in (-1, 1))]
		allowed = [place for place in places if low - margin <= place <= high + margin]
		return min(allowed, key=lambda place: (-round(min(_distance(place, near), self.lap) / margin), abs(place - ideal), place))

	def _distanceBelow(self, place, others, distance):
		return _distance(place, others) < distance - samePlace * self.size[0]

	def _same(self, one, other):
		return abs(one - other) < samePlace * self.size[0]


def _distance(place, others):
	return min((abs(place - other) for other in others), default=math.inf)


def bond(name="running", size=(0.25, 0.125, 0.075), offset=0.5, smallest=0.25):
	"""A bond for bricks of one format.

	:param name: 'stack' (head joints above each other), 'running' (each course shifted against the one below), 'English' (courses of headers alternate
		with courses of stretchers) or 'Flemish' (header and stretcher alternate in each course); the first two make walls of one wythe, which are as
		thick as a brick is wide, the others of two, as thick as a brick is long
	:param size: length, width and height of a brick with its share of mortar [m]; English and Flemish bond need a length of twice the width
	:param offset: of running bond: by how much of a brick every other course is shifted, 0 < offset < 1; or a tuple of shifts that courses take in
		turn, such as (0, 1/3, 2/3), each 0 <= shift < 1
	:param smallest: shortest piece as a share of a brick's length, 0 < smallest <= 0.25 (a queen closer)
	:returns: Bond
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	if name not in wythesOf:
		raise ValueError(f"bond is {name!r}; allowed are {', '.join(map(repr, wythesOf))}")
	lengths = _lengths(size)
	if wythesOf[name] == 2 and abs(lengths[0] - 2 * lengths[1]) > samePlace * lengths[0]:
		raise ValueError(f"size is {size!r}; {name} bond needs bricks that are twice as long as wide, mortar included")
	if not (isFinite(smallest) and 0 < smallest <= 0.25):
		raise ValueError(f"smallest is {smallest!r}; allowed is 0 < smallest <= 0.25, a share of a brick's length")
	return Bond(name, lengths, _offsets(offset) if name == "running" else (0.0,), smallest * lengths[0])


def _lengths(size):
	if not isinstance(size, (tuple, list)) or len(size) != 3 or not all(isFinite(length) and length > 0 for length in size):
		raise ValueError(f"size is {size!r}; allowed are three finite lengths > 0 m: length, width, height of a brick")
	return tuple(map(float, size))


def _offsets(offset):
	if isinstance(offset, numbers.Real):
		if not (isFinite(offset) and 0 < offset < 1):
			raise ValueError(f"offset is {offset!r}; allowed is 0 < offset < 1, a share of a brick's length, or a tuple of shifts")
		return 0.0, float(offset)
	if not isinstance(offset, (tuple, list)) or len(offset) < 2 or not all(isFinite(shift) and 0 <= shift < 1 for shift in offset):
		raise ValueError(f"offset is {offset!r}; allowed is a number, or a tuple of at least two shifts, each 0 <= shift < 1")
	if any(abs(one - other) < samePlace for one, other in zip(offset, (*offset[1:], offset[0]))):
		raise ValueError(f"offset is {offset!r}; two neighbouring courses have the same shift, which is stack bond")
	return tuple(map(float, offset))
