# SPDX-License-Identifier: GPL-2.0-or-later
# Houses: four interlocked walls, storey by storey, with openings, and floors that lie on the walls. Walls are laid by walls.py as one plan over all storeys;
# what is added here is the height of the courses over slabs, joists that take the place of bricks, and gables.
"""Builder of houses. Lengths in metres; every wrong argument raises ValueError, before anything is made."""

import math
from dataclasses import dataclass, field

from .blocks import Block, masonry
from .bonds import bond as makeBond, samePlace
from .build import _count
from .checks import checkPositive, isFinite
from .openings import Fixture, fixturesOf, wholeCourses
from .walls import courseCount, laidWalls, legsOf, wholeOptions

#: The walls of a house in the order in which they are laid: round it, so that each begins at the left as seen from outside.
wallNames = ("south", "east", "north", "west")


@dataclass(frozen=True)
class Floor:
	"""A floor or a flat roof on the walls of a storey.

	:param kind: 'slab' (one brick over the whole plan), 'planks' (side by side over the whole plan) or 'joists' (apart from each other, their ends in the walls)
	:param thickness: [m]; of joists their height, a whole number of courses, which ends with the top of the walls
	:param count: of planks or joists, >= 1
	:param width: of a joist [m]
	:param span: 'x' or 'y', the direction of planks and joists; None: the shorter one of the house
	:param overhang: of a slab or planks beyond the outer faces of the walls [m]; < 0 on the topmost walls only: they lie on so much less than the whole
		thickness. Joists lie on the whole thickness
	:param options: arguments of `brick` where they differ from those of bricks, such as material; floors are rigid unless deformation is given here, since
		one hexahedron does not bend as a plate does
	"""

	kind: str = "slab"
	thickness: float = 0.15
	count: int = 1
	width: float = 0.1
	span: str = None
	overhang: float = 0.0
	options: dict = field(default_factory=dict)


def house(
        plan=(4.0, 3.0), storeyHeight=2.4, storeys=1, bond="English", size=(0.25, 0.125, 0.075), openings=None, floors=None, gables=None, offset=0.5,
        smallest=0.25, lintels=None, origin=(0, 0, 0), direction=0.0, **brickOptions
):
	"""A house of four walls with interlocked corners, with doors, windows and floors.

	:param plan: lengths of its outer faces along x and y [m]
	:param storeyHeight: height of the walls from floor to floor [m], a whole number of courses
	:param storeys: >= 1
	:param openings: dict from 'south', 'east', 'north', 'west' to a list of Opening, the same in every storey; or a list with such a dict for each storey. `at` is
		from the left outer corner as seen from outside, `sill` from the foot of the storey's walls
	:param floors: Floor on the walls of every storey, the topmost included; or a list with a Floor, a tuple of them (joists, then what lies on them) or None
		for each storey
	:param gables: slope of the roof [rad], in (0, pi/2), for stepped gables on the two shorter walls (on east and west where all are of one length); None: none
	:param origin: lower south-west corner of the house, its outer corner with lowest x and y where direction is 0 [m]
	:param direction: by how much it is turned about that corner, from x towards y [rad]
	:returns: Masonry; its groups are 'south' and so on, 'storey 0' and so on, 'gables', and the names of openings (their lintels). In a course the walls come
		in that order
	:raises ValueError: naming the argument, its value and what is allowed

	bond, size, offset, smallest, lintels, brickOptions: as in bondedWall.

	>>> window, door = Opening(at=1, width=1, sill=0.9, height=1.05), Opening(at=1.5, width=0.9, height=2.1)
	>>> home = house((4, 3), 2.4, openings=dict(south=[door], north=[window]), floors=Floor("slab", 0.15), material=adobe)
	"""
	laying = makeBond(bond, size, offset, smallest)
	laid, floorOptions = houseBlocks(plan, storeyHeight, storeys, laying, openings, floors, gables)
	return masonry(laid, origin, direction, wholeOptions(brickOptions, laying), lintels, floorOptions)


def houseBlocks(plan, storeyHeight, storeys, laying, openings=None, floors=None, gables=None):
	"""The blocks of a house, see `house`, and the brick options of its floors in their order."""
	lengths = _plan(plan, laying)
	inStorey, count = courseCount(storeyHeight, laying), _count(storeys, "storeys")
	levelFloors = _floorsByStorey(floors, count)
	for storey, stack in enumerate(levelFloors):
		for floor in stack:
			_checkFloor(floor, f"floor on storey {storey}", laying, inStorey, topmost=storey == count - 1 and gables is None)
	half, (x, y) = 0.5 * laying.thickness, lengths
	legs = legsOf([(half, half), (x - half, half), (x - half, y - half), (half, y - half), (half, half)], laying, wallNames)
	fixtures = _openingFixtures(openings, laying, inStorey, [_needsLintels(storey, levelFloors, gables) for storey in range(count)])
	for storey, floor in ((storey, floor) for storey, stack in enumerate(levelFloors) for floor in stack if floor.kind == "joists"):
		_addJoistEnds(fixtures, floor, (storey + 1) * inStorey, lengths, laying)
	feet = [sum(_above(stack) for stack in levelFloors[:storey]) for storey in range(count + 1)]  # what slabs add below each storey, and below gables
	levels = [course * laying.size[2] + feet[course // inStorey] for course in range(count * inStorey)]
	laid = laidWalls(legs, laying, count * inStorey, fixtures, levels, names=lambda leg, course: (f"storey {course // inStorey}",))
	laid += _laidFloors(levelFloors, lengths, laying, inStorey, feet)
	if gables is not None:
		laid += _laidGables(gables, legs, lengths, laying, count * inStorey, feet[-1])
	return laid, [floor.options for stack in levelFloors for floor in stack]


# What is given


def _plan(plan, laying):
	if not isinstance(plan, (tuple, list)) or len(plan) != 2 or not all(isFinite(length) and length > 2 * laying.thickness for length in plan):
		raise ValueError(f"plan is {plan!r}; allowed are two finite lengths > {2 * laying.thickness:g} m, twice the thickness of the walls")
	return tuple(map(float, plan))


def _floorsByStorey(floors, count):
	"""A tuple of Floor for each storey."""
	if floors is None or isinstance(floors, Floor):
		floors = [floors] * count
	if not isinstance(floors, list) or len(floors) != count:
		raise ValueError(f"floors is {floors!r}; allowed is a Floor, or a list with an entry for each of the {count} storeys")
	stacks = [entry if isinstance(entry, tuple) else () if entry is None else (entry,) for entry in floors]
	for floor in (floor for stack in stacks for floor in stack):
		if not isinstance(floor, Floor):
			raise ValueError(f"floors has {floor!r}; allowed are a Floor, a tuple of them, and None")
	return stacks


def _checkFloor(floor, name, laying, inStorey, topmost):
	if floor.kind not in ("slab", "planks", "joists"):
		raise ValueError(f"kind of the {name} is {floor.kind!r}; allowed are 'slab', 'planks' and 'joists'")
	if floor.span not in (None, "x", "y"):
		raise ValueError(f"span of the {name} is {floor.span!r}; allowed are 'x', 'y' and None")
	for what, value in (("thickness", floor.thickness), ("width", floor.width)):
		checkPositive(value, f"{what} of the {name}", "m")
	_count(floor.count, f"count of the {name}")
	least = -laying.thickness if topmost else 0.0
	if not (isFinite(floor.overhang) and (floor.overhang > least or floor.overhang == 0)):
		raise ValueError(f"overhang of the {name} is {floor.overhang!r}; allowed is a finite number {'>' if topmost else '>='} {least:g} m")
	if floor.kind == "joists" and not 1 <= wholeCourses(floor.thickness, laying, f"thickness of the {name}") < inStorey:
		raise ValueError(f"thickness of the {name} is {floor.thickness:g} m; allowed is at least a course and less than the walls' height")


def _needsLintels(storey, levelFloors, gables):
	"""Whether something lies on the walls of a storey that an opening up to their top does not carry; a slab spans it."""
	stack = levelFloors[storey]
	return not any(floor.kind == "slab" for floor in stack) and (bool(stack) or storey + 1 < len(levelFloors) or gables is not None)


def _openingFixtures(openings, laying, inStorey, needsLintels):
	"""For each wall its openings and lintels in all storeys.

	:param needsLintels: for each storey whether no opening may reach its top
	"""
	count = len(needsLintels)
	byStorey = openings if isinstance(openings, (list, tuple)) else [openings or {}] * count
	if len(byStorey) != count or not all(isinstance(entry, dict) for entry in byStorey):
		raise ValueError(f"openings is {openings!r}; allowed is a dict from the name of a wall to a list of Opening, or a list with one for each of {count} storeys")
	fixtures = [[] for _ in wallNames]
	for storey, entry in enumerate(byStorey):
		for name, given in entry.items():
			if name not in wallNames:
				raise ValueError(f"openings has the wall {name!r}; allowed are {', '.join(map(repr, wallNames))}")
			where = f"the {name} wall of storey {storey}"
			found = fixturesOf(given, laying, inStorey, storey * inStorey, where)
			for one in found if needsLintels[storey] else ():
				if one.kind == "opening" and one.last == (storey + 1) * inStorey:
					raise ValueError(f"{one.name} reaches the top of the storey, where planks, joists, walls or a gable lie over it; only a slab may: a lintel is needed")
			fixtures[wallNames.index(name)] += found
	return fixtures


# Floors and gables


def _above(stack):
	"""By how much a storey's floors end above its walls [m]."""
	return sum(floor.thickness for floor in stack if floor.kind != "joists")


def _spanAxis(floor, lengths):
	return {"x": 0, "y": 1, None: 0 if lengths[0] < lengths[1] else 1}[floor.span]


def _joistPlaces(floor, lengths, laying):
	"""(low, high) of each joist across its span [m]; the clear distances between them and to the walls are equal."""
	inner = lengths[1 - _spanAxis(floor, lengths)] - 2 * laying.thickness
	gap = (inner - floor.count * floor.width) / (floor.count + 1)
	if not gap > 0:
		raise ValueError(f"{floor.count} joists with a width of {floor.width:g} m do not fit between walls that are {inner:g} m apart")
	lows = [laying.thickness + gap + index * (gap + floor.width) for index in range(floor.count)]
	return [(low, low + floor.width) for low in lows]


def _addJoistEnds(fixtures, floor, top, lengths, laying):
	"""Joists take the place of bricks in the two walls that they lie on."""
	axis = _spanAxis(floor, lengths)
	courses = wholeCourses(floor.thickness, laying, "thickness of joists")
	total = lengths[1 - axis]
	for index, (low, high) in enumerate(_joistPlaces(floor, lengths, laying)):
		# walls along the joists' row: south and north for joists along y, east and west for those along x; the second of each runs back
		for wall, ends in (("south" if axis == 1 else "east", (low, high)), ("north" if axis == 1 else "west", (total - high, total - low))):
			fixtures[wallNames.index(wall)].append(Fixture(*ends, top - courses, top, "joist", f"joist {index} in the {wall} wall"))


def _laidFloors(levelFloors, lengths, laying, inStorey, feet):
	laid, number = [], 0
	for storey, stack in enumerate(levelFloors):
		foot = (storey + 1) * inStorey * laying.size[2] + feet[storey]
		for floor in stack:
			axis = _spanAxis(floor, lengths)
			if floor.kind == "joists":
				rows, ends = _joistPlaces(floor, lengths, laying), (0.0, lengths[axis])
				low, high = foot - floor.thickness, foot
			else:
				whole = [(-floor.overhang, length + floor.overhang) for length in lengths]
				rows, ends = _inRows(whole[1 - axis], floor.count if floor.kind == "planks" else 1), whole[axis]
				low, high = foot, foot + floor.thickness
				foot = high
			for row in rows:
				plan = (ends, row) if axis == 0 else (row, ends)
				lowest, highest = zip(*plan, (low, high))
				laid.append(Block(lowest, highest, "floor", number, f"storey {storey}", (f"storey {storey}",)))
			number += 1
	return laid


def _inRows(ends, count):
	low, high = ends
	places = [low + (high - low) * index / count for index in range(count + 1)]
	return list(zip(places, places[1:]))


def _laidGables(slope, legs, lengths, laying, first, foot):
	"""Courses that become shorter with height, within the roof's slope, down to the length of a brick."""
	if not (isFinite(slope) and 0 < slope < 0.5 * math.pi):
		raise ValueError(f"gables is {slope!r}; allowed is a slope in (0, pi/2) rad, or None")
	laid, height = [], laying.size[2]
	for leg in legs:
		if leg.axis != (1 if lengths[1] <= lengths[0] else 0):
			continue
		below, course = [], first
		while leg.length - 2 * (inset := (course + 1 - first) * height / math.tan(slope)) > laying.size[0] * (1 - samePlace):
			places = laying.course(course + leg.axis, inset, leg.length - inset, below)
			level = foot + course * height
			for piece in laying.pieces(places):
				(x0, y0), (x1, y1) = leg.across(*piece)
				laid.append(Block((x0, y0, level), (x1, y1, level + height), "brick", course, leg.label, (leg.name, "gables")))
			below, course = places[1:-1], course + 1
	return laid
