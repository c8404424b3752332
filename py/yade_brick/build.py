# SPDX-License-Identifier: GPL-2.0-or-later
# Makes bodies for a scene: single bricks, walls in the paper's two bonds, and the engine for a ground motion. Only places things: volume,
# mass and inertia come from the library, which also refuses corners that are no brick.
"""Builders of bricks and walls. Lengths in metres; every wrong argument raises ValueError, before anything is added to the scene."""

import functools
import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field

#: Colours (red, green, blue) of bricks and of fixed bricks.
brickColor, fixedColor = (0.71, 0.47, 0.37), (0.64, 0.63, 0.61)

#: Signs of a brick's corners in the order of Brick.corners.
cornerSigns = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))

#: Corners at the ends of each edge of a brick.
edgeNodes = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))

#: Contact part of a brick for which no thickness is asked, as a share of its shortest edge: the paper's 1 mm in 0.1 m.
defaultContactShare = 0.01


def brick(
        size=None, corners=None, center=(0, 0, 0), orientation=None, material=None, deformation="trilinear", element="full", inner="inset",
        contactThickness=None, segments=4, cells=None, fixed=False, color=None
):
	"""A body that is one brick, ready for O.bodies.append.

	:param size: (lx, ly, lz) of a cuboid [m], each > 0; or
	:param corners: eight corners of a convex hexahedron with planar faces [m], in the order of Brick.corners
	:param center: where the origin of the brick's own axes goes: the middle of a cuboid; for corners (0, 0, 0) leaves them in place [m]
	:param orientation: Quaternion that turns the brick's own axes into the world's; by default they are parallel
	:param material: BrickMat, or its id or label in O.materials
	:param deformation: 'rigid', 'uniform', 'trilinear' or 'refined'
	:param element: 'full', 'incompatible' or 'bbar'
	:param inner: 'inset' or 'full'
	:param contactThickness: r [m]; by default 1 % of the shortest edge
	:param segments: along each edge of a face, see Brick
	:param cells: elements along each edge of the inner part of a refined brick, of which segments is a multiple; 2 unless given
	:param fixed: True for a support that does not move
	:param color: (red, green, blue), each in [0, 1]
	:returns: Body with the solid's mass and principal inertia; its axes are principal axes of inertia
	:raises ValueError: naming the argument, its value and what is allowed; see Brick for those that are passed on to it
	"""
	from yade import Body, Brick
	material = _material(material)
	if size is None and corners is None:
		raise ValueError("size and corners are both missing; one of them is needed")
	if size is not None and corners is not None:
		raise ValueError(f"size is {size} and corners is {corners}; allowed is exactly one of them")
	if cells is not None and deformation != "refined":
		raise ValueError(f"cells is {cells} and deformation is {deformation!r}; only bricks with deformation='refined' have cells")
	solid = _cuboidProperties(_lengths(size)) if corners is None else Brick.solidProperties(_points(corners))
	thickness = defaultContactShare * shortestEdge(solid["corners"]) if contactThickness is None else contactThickness
	body = Body()
	body.shape = Brick(
	        corners=solid["corners"], deformation=deformation, element=element, inner=inner, contactThickness=thickness, segments=segments,
	        cells=2 if cells is None else cells, color=_vector(color if color is not None else fixedColor if fixed else brickColor, "color")
	)
	body.material = material
	_place(body, solid, material.density, _vector(center, "center"), _unitQuaternion(orientation))
	body.dynamic = not fixed
	return body


def _place(body, solid, density, center, orientation):
	state = body.state
	state.pos = state.refPos = center + orientation * solid["centroid"]
	state.ori = state.refOri = orientation * solid["orientation"]
	state.mass = density * solid["volume"]
	state.inertia = density * solid["inertia"]
	body.aspherical = True


def _material(material):
	from yade import BrickMat, O
	try:
		found = O.materials[material] if isinstance(material, (int, str)) else material
	except (IndexError, KeyError, OverflowError):
		raise ValueError(f"material is {material!r}; O.materials has no such id or label") from None
	if not isinstance(found, BrickMat):
		raise ValueError(f"material is {material!r}; allowed is a BrickMat, or the id or label of one")
	if not (math.isfinite(found.density) and found.density > 0):
		raise ValueError(f"density of the material is {found.density}; allowed is a finite number > 0 kg/m3")
	return found


def _cuboid(lengths):
	"""Corners of a cuboid around the origin."""
	return [_vector([0.5 * sign * length for sign, length in zip(signs, lengths)], "size") for signs in cornerSigns]


@functools.lru_cache(maxsize=64)
def _cuboidProperties(lengths):
	"""Of bricks alike found once: besides the time, YADE keeps a reference to every vector that it is given in a list, a kilobyte and more a brick."""
	from yade import Brick
	return Brick.solidProperties(_cuboid(lengths))


def _lengths(size):
	lengths = _numbers(size)
	if len(lengths) != 3 or not all(math.isfinite(length) and length > 0 for length in lengths):
		raise ValueError(f"size is {size!r}; allowed are three finite lengths > 0 m")
	return lengths


def _numbers(values):
	"""Any sequence of numbers as a tuple of floats; empty for anything else."""
	try:
		return tuple(float(value) for value in values) if not isinstance(values, (str, dict)) else ()
	except (TypeError, ValueError, OverflowError):
		return ()


def _points(corners):
	if not isinstance(corners, Sequence):
		raise ValueError(f"corners is {corners!r}; allowed are eight points")
	corners = [_vector(corner, "corner") for corner in corners]
	if len(corners) != 8:
		raise ValueError(f"{len(corners)} corners given; a brick has 8")
	return corners


def _vector(values, name):
	from yade import Vector3
	numbers = _numbers(values)
	if len(numbers) != 3 or not all(math.isfinite(number) for number in numbers):
		raise ValueError(f"{name} is {values!r}; allowed are three finite numbers")
	return Vector3(*numbers)


def _unitQuaternion(orientation):
	from yade import Quaternion
	if orientation is None:
		return Quaternion.Identity
	if not isinstance(orientation, Quaternion):
		raise ValueError(f"orientation is {orientation!r}; allowed is a unit Quaternion")
	length = orientation.norm()
	if not abs(length - 1) < 1e-6:
		raise ValueError(f"orientation has the length {length}; allowed is a unit quaternion")
	return orientation.normalized()


def shortestEdge(corners):
	return min((corners[i] - corners[j]).norm() for i, j in edgeNodes)


# Walls


@dataclass(frozen=True)
class Masonry:
	"""Bricks of walls, by course, and what they carry.

	:param courses: courses[i][j] is the Body of course i from below and place j from the left (along x); where there are several walls, one after the other
	:param lintels: Bodies, from below
	:param floors: floors[i] are the Bodies of floor i from below: a slab, planks or joists
	:param groups: dict from a name, such as that of a wall of a house, to its Bodies

	`O.bodies.append(wall.bodies)` puts them into the scene, course by course from below, each from the left, then lintels and floors.
	"""

	courses: tuple
	lintels: tuple = ()
	floors: tuple = ()
	groups: dict = field(default_factory=dict, compare=False)

	@property
	def bodies(self):
		"""All bodies, in that order."""
		return [body for row in (*self.courses, self.lintels, *self.floors) for body in row]

	@property
	def ids(self):
		"""Their ids, in that order; -1 each before they are in the scene."""
		return [body.id for body in self.bodies]


def straightJointWall(columns=6, courses=6, size=(0.2, 0.2, 0.2), origin=(0, 0, 0), **brickOptions):
	"""Wall of equal bricks whose vertical joints are straight [Furukawa et al. 2014, Fig. 7 (a)]; bricks touch, see MortarJoints.

	:param columns: bricks in a course, >= 1
	:param courses: courses, >= 1
	:param size: of a brick together with its share of mortar: along the wall (x), through it (y), height (z) [m]
	:param origin: corner of the wall with the lowest x, y and z [m]
	:param brickOptions: material and the other arguments of `brick`, except size, corners, center, orientation
	:returns: Masonry
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	lengths = _lengths(size)
	return _masonry([[lengths[0]] * _count(columns, "columns")] * _count(courses, "courses"), lengths, origin, brickOptions)


def englishBondWall(columns=6, courses=6, size=(0.2, 0.2, 0.2), origin=(0, 0, 0), halfBricksFirst=False, **brickOptions):
	"""Wall whose every other course begins and ends with a half brick, so that vertical joints are staggered by half a brick
	[what Furukawa et al. 2014, Fig. 7 (b), call English bond]. Bed joints are partial: each brick lies on two.

	:param columns: length of the wall in whole bricks, >= 1; a course with half bricks has columns + 1 bricks
	:param halfBricksFirst: True for half bricks in the lowest course, False for the one above it
	:param courses, size, origin, brickOptions: as in straightJointWall
	:returns: Masonry
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	length, count = _lengths(size)[0], _count(columns, "columns")
	whole, staggered = [length] * count, [0.5 * length] + [length] * (count - 1) + [0.5 * length]
	lengths = [staggered if (course % 2 == 0) == bool(halfBricksFirst) else whole for course in range(_count(courses, "courses"))]
	return _masonry(lengths, _lengths(size), origin, brickOptions)


def _count(value, name):
	if not isinstance(value, int) or isinstance(value, bool) or value < 1:
		raise ValueError(f"{name} is {value!r}; allowed is a whole number >= 1")
	return value


def _masonry(lengthsByCourse, size, origin, brickOptions):
	"""Bricks of given lengths, course by course."""
	checkWallOptions(brickOptions)
	start = _vector(origin, "origin")
	_, depth, height = size
	courses = []
	for course, lengths in enumerate(lengthsByCourse):
		bodies = []
		for place, length in enumerate(lengths):
			middle = (sum(lengths[:place]) + 0.5 * length, 0.5 * depth, (course + 0.5) * height)
			bodies.append(brick((length, depth, height), center=start + _vector(middle, "center"), **brickOptions))
		courses.append(tuple(bodies))
	return Masonry(tuple(courses))


def checkWallOptions(brickOptions):
	"""Arguments of `brick` that are given for all bricks of a wall."""
	taken = {"size", "corners", "center", "orientation"} & set(brickOptions)
	if taken:
		raise ValueError(f"{', '.join(sorted(taken))} given for a wall; the wall chooses it for each brick")


# Ground motion


def groundMotion(motion, startTime=0.0, **options):
	"""The engine that applies a motion (see yade_brick.motion) to the scene, to be put before NewtonIntegrator.

	After the last sample the acceleration is zero. Bodies that are moved (`ids`) then go on at the velocity that the motion ended with: where that is more than
	1 % of its largest a UserWarning says so.

	:param motion: Motion
	:param startTime: simulated time of its first sample [s]
	:param options: further attributes of GroundMotion, such as ids=[...] for a base that is moved
	"""
	from yade import GroundMotion, Vector3
	if options.get("ids"):
		_warnOfDrift(motion)
	return GroundMotion(dt=motion.dt, acceleration=[Vector3(*map(float, row)) for row in motion.acceleration], startTime=startTime, **options)


def _warnOfDrift(motion):
	from .motion import allowedResidual
	left = motion.residual()
	if left.share > allowedResidual:
		speeds = ", ".join(f"{value:.3g}" for value in left.velocity)
		warnings.warn(
		        f"{motion.name}: ends with a velocity of ({speeds}) m/s, {100 * left.share:.2g} % of its largest, at which the moved bodies will go on; "
		        "baselineCorrected(), highPassed() or endingAtRest() give a motion that ends at rest", stacklevel=3
		)
