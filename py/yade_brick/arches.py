# SPDX-License-Identifier: GPL-2.0-or-later
# Arches and barrel vaults of voussoirs: where a line is cut into joints, and the bricks between them. A voussoir is a prism across the arch, so
# all its faces are planar whatever the line; joints are found once and their corners shared, so that neighbours touch to round-off (MortarJoints).
# The plane of an arch is x, z: x along the span with 0 in its middle, z up with 0 at the springing.
"""Builders of arches and barrel vaults. Lengths in metres, angles in radians; wrong arguments raise ValueError before anything is added to the scene."""

import math
from dataclasses import dataclass
from typing import Callable, NamedTuple

import numpy as np

from .build import brick
from .checks import isFinite

# Lines: at(count, offset) gives the points (count + 1, 2) where joints that cut the line into equal lengths meet the curve at a distance outside of it


class CircularLine(NamedTuple):
	"""A circle's arc over a span: `semicircularLine`, `segmentalLine`.

	:param radius: [m]
	:param halfAngle: between the vertical and the springing joint, which is half the angle that the arch embraces [rad]
	"""

	radius: float
	halfAngle: float

	def at(self, count, offset=0.0):
		angles = self.halfAngle * _places(count)
		return np.column_stack([(self.radius + offset) * np.sin(angles), (self.radius + offset) * np.cos(angles) - self.radius * math.cos(self.halfAngle)])


class PointedLine(NamedTuple):
	"""Two equal arcs that meet in a point, their centres at the height of the springing: `pointedLine`.

	:param radius: of both arcs [m]
	:param eccentricity: how far a centre lies beyond the middle of the span [m]
	"""

	radius: float
	eccentricity: float

	def at(self, count, offset=0.0):
		place = _places(count)
		angle = math.acos(self.eccentricity / self.radius) * (1 - np.abs(place))
		radius = self.radius + offset
		x, z = radius * np.cos(angle) - self.eccentricity, radius * np.sin(angle)
		x[place == 0], z[place == 0] = 0.0, math.sqrt(radius**2 - self.eccentricity**2)  # the joint of both arcs is upright
		return np.column_stack([np.sign(place) * x, z])


class CurvedLine(NamedTuple):
	"""Any curve, cut at equal lengths to eight digits; joints are square to it (in a kink they halve its angle).

	:param point: function of one number from 0 (left end) to 1 (right end) that gives (x, z) [m]
	"""

	point: Callable

	def at(self, count, offset=0.0):
		fine = np.linspace(0, 1, max(20000, 200 * count) + 1)
		along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(self._points(fine), axis=0), axis=1))])
		onCurve = lambda lengths: self._points(np.interp(lengths, along, fine))
		lengths = along[-1] * np.linspace(0, 1, count + 1)
		tangents = _tangents(onCurve, lengths, 1e-5 * along[-1])
		return onCurve(lengths) + offset * np.column_stack([-tangents[:, 1], tangents[:, 0]])

	def _points(self, places):
		points = np.array([tuple(self.point(float(place))) for place in places], dtype=float)
		if points.shape != (len(places), 2) or not np.isfinite(points).all():
			raise ValueError("line gives something else than two finite coordinates (x, z) somewhere from 0 to 1")
		return points


def _tangents(onCurve, lengths, step):
	"""Unit tangents of a curve given by its length: those of the circle through three points; at the ends the points are inside."""
	middle = np.clip(lengths, step, lengths[-1] - step)
	before, at, after = (onCurve(middle + way) for way in (-step, 0, step))
	ways = at - before, after - at
	one, other = (np.linalg.norm(way, axis=1, keepdims=True) for way in ways)
	into, out = ways[0] / one, ways[1] / other
	slope = (into * other + out * one) / (one + other) + (lengths - middle)[:, None] * (out - into) * 2 / (one + other)
	return slope / np.linalg.norm(slope, axis=1, keepdims=True)


def semicircularLine(span):
	"""Half a circle.

	:param span: between the springings [m], > 0
	:returns: line for `arch` and `barrelVault`

	>>> semicircularLine(2).at(2).round(12).tolist()
	[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]
	"""
	return CircularLine(0.5 * _length(span, "span"), 0.5 * math.pi)


def segmentalLine(span, rise=None, embrace=None):
	"""An arc of less than half a circle, by its rise or by the angle that it embraces.

	:param span: between the springings [m], > 0
	:param rise: of the middle above the springings [m], > 0, at most half the span; or
	:param embrace: angle between the springing joints [rad], > 0, at most pi; rise = span / 2 tan(embrace / 4)
	:returns: line for `arch` and `barrelVault`

	>>> segmentalLine(2, rise=1) == semicircularLine(2), round(segmentalLine(1, embrace=math.pi / 3).radius, 12)
	(True, 1.0)
	"""
	half = 0.5 * _length(span, "span")
	if (rise is None) == (embrace is None):
		raise ValueError(f"rise is {rise} and embrace is {embrace}; allowed is exactly one of them")
	if rise is not None:
		if _length(rise, "rise") > half:
			raise ValueError(f"rise is {rise}; allowed are at most {half} m, half the span (a pointed or elliptical line may rise more)")
		return CircularLine((half**2 + rise**2) / (2 * rise), 2 * math.atan2(rise, half))
	if not (isFinite(embrace) and 0 < embrace <= math.pi):
		raise ValueError(f"embrace is {embrace!r}; allowed is an angle > 0 and at most pi rad")
	return CircularLine(half / math.sin(0.5 * embrace), 0.5 * embrace)


def pointedLine(span, rise=None):
	"""Two arcs that meet in a point; both begin upright.

	:param span: between the springings [m], > 0
	:param rise: of the point above the springings [m], more than half the span; None: the equilateral arch, whose arcs have the span as radius
	:returns: line for `arch` and `barrelVault`

	>>> pointedLine(2).radius, round(pointedLine(2, math.sqrt(3)).radius, 12)
	(2.0, 2.0)
	"""
	half = 0.5 * _length(span, "span")
	if rise is None:
		return PointedLine(2 * half, half)
	if _length(rise, "rise") <= half:
		raise ValueError(f"rise is {rise}; allowed are more than {half} m, half the span (segmentalLine has arches that rise less)")
	squares = (rise / half) ** 2
	return PointedLine(0.5 * half * (squares + 1), 0.5 * half * (squares - 1))


def ellipticalLine(span, rise):
	"""Half an ellipse.

	:param span: between the springings [m], > 0
	:param rise: of the middle above them [m], > 0
	:returns: line for `arch` and `barrelVault`
	"""
	half, height = 0.5 * _length(span, "span"), _length(rise, "rise")
	return CurvedLine(lambda place: (-half * math.cos(math.pi * place), height * math.sin(math.pi * place)))


def _places(count):
	"""From -1 at the left end to 1 at the right one, symmetric to the last bit."""
	return (2 * np.arange(count + 1) - count) / count


# Arches and vaults


class Piers(NamedTuple):
	"""What an arch stands on: a pier under each springing, flush with it inside.

	:param height: from the feet to the springing inside [m], > 0; the ground is not part of it
	:param courses: of equal height, >= 1; the top one is a springer, cut to the arch and as wide as its joint
	:param width: of the other courses, in the direction of the span [m], > 0; None: that of the springer
	"""

	height: float
	courses: int = 4
	width: float = None


@dataclass(frozen=True)
class Arch:
	"""Bricks of an arch or barrel vault.

	:param courses: courses[k][j] is the Body of course k from the left springing over the crown to the right one, and place j along the axis (y)
	:param abutments: the bodies under the left and under the right springing, in courses from below: abutments[side][k][j]

	`O.bodies.append(arch.bodies)` puts them into the scene: abutments, then voussoirs.
	"""

	courses: tuple
	abutments: tuple

	@property
	def voussoirs(self):
		"""Bodies of the arch itself, course by course from the left."""
		return [body for course in self.courses for body in course]

	@property
	def bodies(self):
		"""All bodies: abutments, then voussoirs course by course."""
		return [body for side in self.abutments for course in side for body in course] + self.voussoirs

	@property
	def ids(self):
		"""Their ids, in that order; -1 each before they are in the scene."""
		return [body.id for body in self.bodies]

	@property
	def crown(self):
		"""The courses at the crown: of the keystones, or the two on either side of the joint."""
		count = len(self.courses)
		return self.courses[(count - 1) // 2:count // 2 + 1]


def arch(line, thickness, depth, voussoirs, lineAt="intrados", abutments="fixed", origin=(0, 0, 0), azimuth=0.0, **brickOptions):
	"""An arch of voussoirs of equal length, whose joints are square to its line.

	:param line: semicircularLine(...), segmentalLine(...), pointedLine(...), ellipticalLine(...), or a function of one number from 0 (left) to 1 (right)
		that gives (x, z) [m]
	:param thickness: of the ring, along the joints [m], > 0
	:param depth: through the arch [m], > 0
	:param voussoirs: their number, >= 1: odd for a keystone, even for a joint at the crown. Voussoirs are straight between joints.
	:param lineAt: what the line is: 'intrados' (span and rise are those of the opening) or 'centre' (of the ring)
	:param abutments: 'fixed' (a fixed brick that continues the ring beyond each end), Piers, or None
	:param origin: where x = 0 and z = 0 of the line go, on the side of the lowest y [m]
	:param azimuth: angle about the vertical through the origin, from x towards y [rad]
	:param brickOptions: material and the other arguments of `brick`, except size, corners, center, orientation, fixed; segments are 4 or, in a ring that is
		thin against its bricks' depth, as many as make 3 rows across the thickness: a joint of one row would be a hinge
	:returns: Arch, one brick in each course
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	depth = _length(depth, "depth")
	return _built(line, thickness, [[(0.0, depth)]], voussoirs, lineAt, abutments, origin, azimuth, brickOptions)


def barrelVault(
        line, thickness, length, voussoirs, brickLength, bond="running", lineAt="intrados", abutments="fixed", origin=(0, 0, 0), azimuth=0.0, **brickOptions
):
	"""A barrel vault: an arch whose courses run along the axis (y), in bricks of a length; the last one in a course is cut.

	:param length: of the vault [m], > 0
	:param brickLength: of a brick along the axis [m], > 0
	:param bond: 'running' (every other course begins with half a brick) or 'stack' (head joints go through)
	:param line, thickness, voussoirs, lineAt, abutments, origin, azimuth, brickOptions: as in `arch`; piers and fixed abutments are in the same bond
	:returns: Arch
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	length, brickLength = _length(length, "length"), _length(brickLength, "brickLength")
	_choice(bond, "bond", ("running", "stack"))
	patterns = [_pieces(length, brickLength, first) for first in ((brickLength, 0.5 * brickLength) if bond == "running" else (brickLength, ))]
	return _built(line, thickness, patterns, voussoirs, lineAt, abutments, origin, azimuth, brickOptions)


def _built(line, thickness, patterns, voussoirs, lineAt, abutments, origin, azimuth, brickOptions):
	"""Courses have the patterns by turns; those under the springings go on with the next one downwards."""
	thickness, count = _length(thickness, "thickness"), _count(voussoirs, "voussoirs")
	_choice(lineAt, "lineAt", ("intrados", "centre"))
	taken = {"size", "corners", "center", "orientation", "fixed"} & set(brickOptions)
	if taken:
		raise ValueError(f"{', '.join(sorted(taken))} given for an arch; the arch chooses it for each brick")
	inside = 0.0 if lineAt == "intrados" else -0.5 * thickness
	line = _line(line)
	inner, outer = line.at(count, inside), line.at(count, inside + thickness)
	longest = max(back - front for pattern in patterns for front, back in pattern)
	place = _Placing(patterns, origin, azimuth, dict(brickOptions, segments=_segments(brickOptions, thickness, max(longest, thickness))))
	courses = [
	        place.course(f"voussoir {k}", k, (inner[k], inner[k + 1], outer[k + 1], outer[k])) for k in range(count)
	]
	left, right = _abutmentSections(abutments, inner, outer, thickness)
	fixed = abutments == "fixed"
	under = (
	        [place.course(f"left abutment, course {k}", k - len(left), section, fixed) for k, section in enumerate(left)],
	        [place.course(f"right abutment, course {k}", count - 1 + len(right) - k, section, fixed) for k, section in enumerate(right)]
	)
	return Arch(tuple(courses), tuple(tuple(side) for side in under))


def _segments(options, thickness, longest):
	"""Segments along the longest edge of a joint, from which the library finds their size in both directions."""
	given = options.get("segments")
	if given is None:
		cells = options.get("cells", 2 if options.get("deformation") == "refined" else 1)
		if not isinstance(cells, int) or cells < 1:
			return 4  # which brick() refuses, as the cells
		return cells * math.ceil(max(4, 3 * longest / thickness) / cells - 1e-9)
	if isFinite(given) and given * thickness / longest < 1.5:
		needed = math.ceil(1.5 * longest / thickness)
		raise ValueError(
		        f"segments is {given} for joints of {thickness:g} m by {longest:g} m; allowed are at least {needed}, as one row across the ring is a hinge"
		)
	return given


class _Placing:
	"""Makes the bricks of a course from its section in the plane of the arch."""

	def __init__(self, patterns, origin, azimuth, options):
		from yade import Quaternion, Vector3
		if not isFinite(azimuth):
			raise ValueError(f"azimuth is {azimuth!r}; allowed is a finite angle [rad]")
		self.patterns = patterns
		self.options = dict(options, center=origin, orientation=Quaternion(Vector3(0, 0, 1), azimuth))

	def course(self, name, number, section, fixed=False):
		"""
		:param number: of the course from the left springing, which chooses its pattern
		:param section: corners (x, z): left below, right below, right above, left above, as seen along y; below is inside
		"""
		bodies = []
		for front, back in self.patterns[number % len(self.patterns)]:
			corners = [(x, y, z) for side in (section[:2], section[2:][::-1]) for x, y, z in _ring(side, front, back)]
			try:
				bodies.append(brick(corners=corners, fixed=fixed, **self.options))
			except ValueError as problem:
				raise ValueError(f"{name}: {problem}") from None
		return tuple(bodies)


def _ring(side, front, back):
	"""Four corners on one side of a brick in the order of Brick.corners."""
	(leftX, leftZ), (rightX, rightZ) = ((float(x), float(z)) for x, z in side)
	return (leftX, front, leftZ), (rightX, front, rightZ), (rightX, back, rightZ), (leftX, back, leftZ)


def _abutmentSections(abutments, inner, outer, thickness):
	"""Sections under the left and the right springing, from below; those of the right are the left's of the mirrored arch."""
	if abutments is None:
		return [], []
	if isinstance(abutments, str) and abutments == "fixed":
		make = lambda end, over: [_continued(end, over, thickness)]
	elif isinstance(abutments, Piers):
		height, width = _length(abutments.height, "height of piers"), abutments.width
		if width is not None:
			_length(width, "width of piers")
		courses = _count(abutments.courses, "courses of piers")
		make = lambda end, over: _pier(end, over, height, courses, width)
	else:
		raise ValueError(f"abutments is {abutments!r}; allowed are 'fixed', Piers(...) and None")
	mirror = np.array([-1, 1])
	return make(inner[0], outer[0]), [_mirrored(section) for section in make(inner[-1] * mirror, outer[-1] * mirror)]


def _mirrored(section):
	leftBelow, rightBelow, rightAbove, leftAbove = ((-x, z) for x, z in section)
	return rightBelow, leftBelow, leftAbove, rightAbove


def _continued(end, over, length):
	"""A rectangle beyond the joint from `end` (inside) to `over` (outside) of the left springing."""
	across = (over - end) / np.linalg.norm(over - end)
	back = -length * np.array([across[1], -across[0]])
	return end + back, end, over, over + back


def _pier(end, over, height, courses, width):
	"""Rectangles, and on top the springer, left of the inner face."""
	springer = end[0] - over[0]
	if not (springer > 0 and over[1] >= end[1] - 1e-6 * springer):
		raise ValueError(f"abutments are Piers, but the springing joint goes from {tuple(end)} to {tuple(over)} (x, z); allowed are joints that rise outwards")
	each, outside = height / courses, end[0] - (springer if width is None else width)
	levels = [end[1] - height + k * each for k in range(courses - 1)] + [end[1] - each]
	sections = [((outside, low), (end[0], low), (end[0], high), (outside, high)) for low, high in zip(levels[:-1], levels[1:])]
	return sections + [((over[0], levels[-1]), (end[0], levels[-1]), tuple(end), tuple(over))]


def _pieces(length, each, first):
	"""(begin, end) of the bricks of a course: the first one, whole ones, and what is left; a rest of round-off is not left."""
	rest = 1e-6 * each
	cuts = [0.0] + [cut for k in range(math.ceil((length - first) / each) + 1) if (cut := first + k * each) < length - rest] + [length]
	return list(zip(cuts[:-1], cuts[1:]))


def _line(line):
	if hasattr(line, "at"):
		return line
	if not callable(line):
		raise ValueError(f"line is {line!r}; allowed are semicircularLine(...) and its like, or a function of one number that gives (x, z)")
	return CurvedLine(line)


def _length(value, name):
	if not (isFinite(value) and value > 0):
		raise ValueError(f"{name} is {value!r}; allowed is a finite length > 0 m")
	return float(value)


def _count(value, name):
	if not isinstance(value, int) or isinstance(value, bool) or value < 1:
		raise ValueError(f"{name} is {value!r}; allowed is a whole number >= 1")
	return value


def _choice(value, name, allowed):
	if value not in allowed:
		raise ValueError(f"{name} is {value!r}; allowed are {', '.join(map(repr, allowed))}")
