# SPDX-License-Identifier: GPL-2.0-or-later
# Masonry that stands alone: rectangular piers of bricks in alternating bond, and columns of drums (blocks over the whole section), which may taper.
"""Builders of piers and columns. Lengths in metres; every wrong argument raises ValueError, before anything is made."""

import math

from .blocks import Block, masonry, turned
from .bonds import bond, samePlace
from .build import Masonry, _count, _vector, brick, checkWallOptions
from .checks import checkPositive, isFinite
from .walls import courseCount, wholeOptions


def pier(units=(1, 1), height=1.5, size=(0.25, 0.125, 0.075), origin=(0, 0, 0), direction=0.0, **brickOptions):
	"""A rectangular pier of solid brickwork. In even courses all bricks lie along x, in odd ones along y; rows of more than one brick have their joints in
	the middle of the bricks below and above, and are staggered against the row beside, with quarter and three-quarter bricks at their ends.

	:param units: section in bricks along x and along y, each a multiple of 1/2, >= 1/2
	:param height: [m], a whole number of courses
	:param size: length, width and height of a brick with its share of mortar [m]; the length is twice the width
	:param origin: corner of the pier with lowest x, y and z where direction is 0 [m]
	:param direction: by how much it is turned about its origin, from x towards y [rad]
	:param brickOptions: material and the other arguments of `brick`, as in bondedWall
	:returns: Masonry
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	laying = bond("English", size)
	halves = _halves(units)
	length, width, course = laying.size
	laid = []
	for number in range(courseCount(height, laying)):
		axis = number % 2
		for row in range(halves[1 - axis]):
			places = _rowOfPier(halves[axis], row % 2)
			for one, other in zip(places, places[1:]):
				along, across = (one * width, other * width), (row * width, (row + 1) * width)
				plan = (along, across) if axis == 0 else (across, along)
				low, high = zip(*plan, (number * course, (number + 1) * course))
				laid.append(Block(low, high, course=number, name="pier"))
	return masonry(laid, origin, direction, wholeOptions(brickOptions, laying))


def _halves(units):
	counts = [2 * unit if isFinite(unit) else math.nan for unit in units] if isinstance(units, (tuple, list)) and len(units) == 2 else []
	if not counts or not all(count >= 1 and count == round(count) for count in counts):
		raise ValueError(f"units is {units!r}; allowed are two numbers of bricks, each a multiple of 1/2, at least 1/2")
	return [round(count) for count in counts]


def _rowOfPier(halves, staggered):
	"""Ends of the bricks of a row, in half bricks."""
	inner = [] if halves <= 2 else [place for turn in range(halves) if (place := 2 * turn + (0.5 if staggered else 1.5)) < halves]
	return [0, *inner, halves]


def column(drums=6, height=1.5, base=(0.4, 0.4), top=None, origin=(0, 0, 0), direction=0.0, **brickOptions):
	"""A column of drums on top of each other, each a block over the whole rectangular section, which may become smaller upwards.

	:param drums: their number, >= 1, all of one height; or a list of heights as shares of the column's, from below
	:param height: of the column [m]
	:param base: its section at the foot, along x and y [m]
	:param top: its section at the top, no larger than at the foot, with straight edges between [m]; None: as at the foot
	:param origin: middle of its foot [m]
	:param direction: by how much it is turned about its axis, from x towards y [rad]
	:param brickOptions: material and the other arguments of `brick`, except size, corners, center, orientation
	:returns: Masonry with a drum a course
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	checkWallOptions(brickOptions)
	checkPositive(height, "height", "m")
	foot, head = _section(base, "base"), _section(base if top is None else top, "top")
	if any(upper > lower for lower, upper in zip(foot, head)):
		raise ValueError(f"top is {top!r} and base is {base!r}; allowed is a top that is no larger than the base")
	start, turn = _vector(origin, "origin"), turned(direction)
	levels = _levels(drums)
	courses = []
	for low, high in zip(levels, levels[1:]):
		sections = [[wide + share * (narrow - wide) for wide, narrow in zip(foot, head)] for share in (low, high)]
		if foot == head:
			shape = dict(size=(*foot, (high - low) * height), center=start + _vector((0, 0, 0.5 * (low + high) * height), "center"))
		else:
			shape = dict(corners=_frustum(sections, low * height, high * height), center=start)
		courses.append((brick(**shape, orientation=turn, **brickOptions),))
	return Masonry(tuple(courses))


def _section(values, name):
	if not isinstance(values, (tuple, list)) or len(values) != 2 or not all(isFinite(length) and length > 0 for length in values):
		raise ValueError(f"{name} is {values!r}; allowed are two finite lengths > 0 m")
	return tuple(map(float, values))


def _levels(drums):
	"""Ends of drums as shares of the height, from 0 to 1."""
	if not isinstance(drums, (tuple, list)):
		count = _count(drums, "drums")
		return [index / count for index in range(count + 1)]
	if not drums or not all(isFinite(share) and share > 0 for share in drums) or abs(sum(drums) - 1) > samePlace:
		raise ValueError(f"drums is {drums!r}; allowed is a whole number >= 1, or a list of shares of the height that are > 0 and add up to 1")
	return [sum(drums[:index]) for index in range(len(drums))] + [1.0]


def _frustum(sections, low, high):
	"""Corners in the order of Brick.corners."""
	return [
	        (0.5 * sx * x, 0.5 * sy * y, z) for (x, y), z in zip(sections, (low, high)) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
	]
