# SPDX-License-Identifier: GPL-2.0-or-later
# Masonry as boxes, before it becomes bodies: parallel to the axes, so that overlaps and gaps are found exactly and cheaply. Builders of walls, houses and
# piers lay blocks; `masonry` checks them, turns and moves them, and makes the bodies.
"""Blocks: boxes that become bricks."""

from collections import defaultdict
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from .build import Masonry, _vector, brick, checkWallOptions
from .checks import isFinite

#: Colours of lintels and floors for which none is chosen.
lintelColor, floorColor = (0.80, 0.77, 0.70), (0.72, 0.58, 0.38)


class Block(NamedTuple):
	"""A box that becomes a brick.

	:param low, high: its corners with the lowest and the highest coordinates, in the axes of the plan [m]
	:param kind: brick, lintel or floor
	:param course: number of the course from below; of the floor for a floor
	:param name: what to call it in errors: the wall, opening or floor that it belongs to
	:param groups: names of the groups of Masonry that it is in
	"""

	low: tuple
	high: tuple
	kind: str = "brick"
	course: int = 0
	name: str = "wall"
	groups: tuple = ()

	@property
	def size(self):
		"""Lengths of the box, the same for equal boxes wherever they are [m]."""
		return tuple(round(high - low, 12) for low, high in zip(self.low, self.high))


def masonry(blocks, origin, direction, brickOptions, lintelOptions=None, floorOptions=None):
	"""Makes the bodies.

	:param blocks: list of Block; those of a course in the order of the course
	:param origin: where the origin of the plan goes [m]
	:param direction: by how much the plan is turned about the vertical through its origin, counter-clockwise seen from above [rad]
	:param brickOptions: arguments of build.brick for all bricks
	:param lintelOptions: arguments of build.brick for lintels where they differ
	:param floorOptions: a dict for each floor, likewise
	:returns: Masonry
	:raises ValueError: for blocks that overlap or that nothing connects to the ground, and for wrong arguments
	"""
	start, turn = _vector(origin, "origin"), turned(direction)
	options = _optionsByKind(brickOptions, lintelOptions, floorOptions)
	checkOverlaps(blocks)
	checkSupports(blocks)
	courses, groups = defaultdict(list), defaultdict(list)
	for block in blocks:
		middle = _vector([0.5 * (low + high) for low, high in zip(block.low, block.high)], "center")
		chosen = options[block.kind] if block.kind != "floor" else options["floor"][block.course]
		body = brick(block.size, center=start + turn * middle, orientation=turn, **chosen)
		courses[block.kind, block.course].append(body)
		for name in block.groups:
			groups[name].append(body)
	return Masonry(
	        courses=_byNumber(courses, "brick"), lintels=tuple(body for course in _byNumber(courses, "lintel") for body in course),
	        floors=_byNumber(courses, "floor"), groups={name: tuple(bodies) for name, bodies in groups.items()}
	)


def _byNumber(courses, kind):
	return tuple(tuple(courses[key]) for key in sorted(key for key in courses if key[0] == kind))


def turned(direction):
	"""The orientation of what is turned in plan by an angle [rad]."""
	from yade import Quaternion, Vector3
	if not isFinite(direction):
		raise ValueError(f"direction is {direction!r}; allowed is a finite angle [rad]")
	return Quaternion(Vector3(0, 0, 1), direction) if direction else Quaternion.Identity


def _optionsByKind(brickOptions, lintelOptions, floorOptions):
	for name, given in (("lintels", lintelOptions), *(("options of a floor", floor) for floor in floorOptions or ())):
		if given is not None and not isinstance(given, dict):
			raise ValueError(f"{name} is {given!r}; allowed is a dict of arguments of brick")
		checkWallOptions(given or {})
	checkWallOptions(brickOptions)
	lintels = {**brickOptions, "color": lintelColor, **(lintelOptions or {})}
	floors = [{**brickOptions, "deformation": "rigid", "color": floorColor, **(floor or {})} for floor in floorOptions or ()]
	for floor in floors:
		if floor["deformation"] != "refined":
			floor.pop("cells", None)
	return {"brick": brickOptions, "lintel": lintels, "floor": floors}


# Checks


def checkOverlaps(blocks):
	"""
	:raises ValueError: naming the first two blocks that overlap by more than round-off
	"""
	low, high, margin = _boxes(blocks)
	for one, others in _near(low, high, margin):
		over = np.all((low[others] < high[one] - margin) & (high[others] > low[one] + margin), axis=1)
		if over.any():
			first, second = blocks[one], blocks[others[over.argmax()]]
			raise ValueError(f"{described(first)} and {described(second)} overlap; allowed are walls, openings and floors that leave room for each other")


def checkSupports(blocks):
	"""
	:raises ValueError: naming a block that is connected to the ground by no face of it or of others
	"""
	low, high, margin = _boxes(blocks)
	pairs = []
	for one, others in _near(low, high, margin):
		shared = np.minimum(high[one], high[others]) - np.maximum(low[one], low[others])
		# a common face: no room between them along one axis, a length > 0 along the two others
		touching = (np.sum(shared > margin, axis=1) == 2) & np.all(shared > -margin, axis=1)
		pairs += [(one, other) for other in others[touching]]
	ground = len(blocks)
	pairs += [(index, ground) for index in np.flatnonzero(low[:, 2] < margin)]
	first, second = np.array(pairs).reshape(-1, 2).T
	_, part = connected_components(coo_matrix((np.ones(len(first)), (first, second)), shape=(ground + 1,) * 2), directed=False)
	loose = np.flatnonzero(part[:-1] != part[-1])
	if loose.size:
		raise ValueError(f"{described(blocks[loose[0]])} and {loose.size - 1} others stand on nothing; every brick has to be held by others or the ground")


def _boxes(blocks):
	"""Corners of all blocks, and below which length they touch [m]."""
	low, high = (np.array(points) for points in zip(*((block.low, block.high) for block in blocks)))
	return low, high, 1e-7 * (high - low).min()


def _near(low, high, margin):
	"""Of each block in turn from below: its index, and those of the later ones that begin no higher than it ends."""
	order = np.argsort(low[:, 2], kind="stable")
	ends = np.searchsorted(low[order, 2], high[order, 2] + margin)
	for place, index in enumerate(order):
		yield index, order[place + 1:ends[place]]


def described(block):
	"""Words for an error."""
	middle = ", ".join(f"{0.5 * (low + high):.4g}" for low, high in zip(block.low, block.high))
	kind = f"the {block.kind} of {block.name}" if block.kind != "brick" else f"a brick of course {block.course} of {block.name}"
	return f"{kind} at ({middle}) m"
