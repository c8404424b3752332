# SPDX-License-Identifier: GPL-2.0-or-later
# Which faces of convex hexahedra face each other, how far apart and over which area, and which solids overlap: for all pairs at once, in arrays.
# Geometry only; what is joined is the library's finding (MortarJoints), what to make of it is in joints.py.
"""Faces of convex hexahedra that face each other, in arrays."""

from typing import NamedTuple

import numpy as np

from .picture import faceNodes

_edges = np.array([(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)])
_nodes = np.array(faceNodes)


class Facing(NamedTuple):
	"""Pairs of faces that face each other, an entry of each array for each pair of faces.

	:param pair: which pair of solids, as an index
	:param gap: between the faces in the middle of where they overlap [m]; negative: they are inside of each other
	:param angle: between the faces [rad]
	:param area: of their overlap, seen along the normal [m2]
	:param smaller: area of the smaller face [m2]
	:param normal: of the first solid's face, outwards
	:param centre: of the overlap, midway [m]
	"""

	pair: np.ndarray
	gap: np.ndarray
	angle: np.ndarray
	area: np.ndarray
	smaller: np.ndarray
	normal: np.ndarray
	centre: np.ndarray

	def where(self, chosen):
		return Facing(*(values[chosen] for values in self))

	def largestOfEachPair(self):
		"""For each pair of solids that is left, its faces of the largest overlap."""
		order = np.lexsort((-self.area, self.pair))
		_, first = np.unique(self.pair[order], return_index=True)
		return self.where(order[first])


def nearPairs(low, high):
	"""Indices (m, 2) of all boxes that overlap or touch, the lower index first, in order.

	:param low, high: (n, 3) ends of the boxes [m]

	>>> nearPairs(np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0]]), np.array([[1, 1, 1], [2, 1, 1], [4, 1, 1]])).tolist()
	[[0, 1]]
	"""
	orders = np.argsort(low, axis=0, kind="stable")
	ends = [np.searchsorted(low[order, k], high[order, k], "right") - np.arange(len(low)) - 1 for k, order in enumerate(orders.T)]
	axis = int(np.argmin([counts.sum() for counts in ends]))  # the one along which fewest come together
	counts, order = ends[axis], orders[:, axis]
	first = np.repeat(np.arange(len(low)), counts)
	second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(counts) - counts, counts)
	one, other = order[first], order[second]
	meet = ((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1)
	pairs = np.sort(np.column_stack([one[meet], other[meet]]), axis=1)
	return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def shortestEdges(corners):
	"""(n,) of solids (n, 8, 3) [m]."""
	return np.linalg.norm(corners[:, _edges[:, 0]] - corners[:, _edges[:, 1]], axis=2).min(axis=1)


def _planes(corners):
	"""Outward normals (n, 6, 3), a point (n, 6, 3) and the area (n, 6) of all faces."""
	face = corners[:, _nodes]
	cross = np.cross(face[:, :, 2] - face[:, :, 0], face[:, :, 3] - face[:, :, 1])
	length = np.linalg.norm(cross, axis=2)
	return cross / length[..., None], face.mean(axis=2), 0.5 * length


def facing(one, other, near, largestAngle):
	"""Faces of pairs of solids that face each other and overlap.

	:param one, other: corners (m, 8, 3) of the two solids of each pair, in the order of Brick.corners [m]
	:param near: (m,) largest gap, either way [m]
	:param largestAngle: between faces [rad]
	:returns: Facing
	"""
	parts = [_facing(one[some], other[some], near[some], largestAngle, some.start) for some in _portions(len(one))]
	return Facing(*(np.concatenate(values) for values in zip(*parts)))


def _portions(count, size=2000):
	"""Slices of so many pairs that their arrays stay in the processor's cache."""
	return [slice(start, start + size) for start in range(0, max(count, 1), size)]


def _facing(one, other, near, largestAngle, start):
	"""Of some pairs, numbered from `start`."""
	(normals0, points0, areas0), (normals1, points1, areas1) = _planes(one), _planes(other)
	sums = np.linalg.norm(normals0[:, :, None] + normals1[:, None], axis=3)
	between = np.einsum("mik,mijk->mij", normals0, points1[:, None] - points0[:, :, None])
	slack = largestAngle * np.sqrt(np.minimum(areas0[:, :, None], areas1[:, None]).max(axis=(1, 2)))  # of faces at an angle, beside their middles
	pair, face0, face1 = np.nonzero((sums <= largestAngle) & (np.abs(between) <= (near + slack)[:, None, None]))
	normal = normals0[pair, face0]
	first, second = one[pair[:, None], _nodes[face0]], other[pair[:, None], _nodes[face1]]
	area, centre = _overlaps(first, second, normal)
	gap = np.einsum("mk,mk->m", centre - points1[pair, face1], normals1[pair, face1])
	smaller = np.minimum(areas0[pair, face0], areas1[pair, face1])
	found = Facing(pair + start, gap, sums[pair, face0, face1], area, smaller, normal, centre + 0.5 * gap[:, None] * normal)
	return found.where((area > 0) & (np.abs(gap) <= near[pair]))


def _overlaps(first, second, normal):
	"""Area (m,) of the overlap of quadrilaterals (m, 4, 3) seen along the first one's normal, and its centroid in the plane of the first one."""
	origin, along = first[:, 0], first[:, 1] - first[:, 0]
	axis1 = along / np.linalg.norm(along, axis=1, keepdims=True)
	axes = np.stack([axis1, np.cross(normal, axis1)], axis=2)
	a, b = (np.einsum("mqk,mkd->mqd", quad - origin[:, None], axes) for quad in (first, second[:, ::-1]))
	area, centre = _commonArea(a, b)
	return area, origin + np.einsum("md,mkd->mk", centre, axes)


def _commonArea(a, b):
	"""Area and centroid of what two convex quadrilaterals (m, 4, 2), both counter-clockwise, have in common: corners of either inside the other, and
	crossings of their edges, by angle around their mean."""
	size = np.maximum(np.ptp(a, axis=1).max(axis=1), np.ptp(b, axis=1).max(axis=1))
	crossings, crossed = _crossings(a, b)
	points = np.concatenate([a, b, crossings], axis=1)
	valid = np.concatenate([_inside(a, b, size), _inside(b, a, size), crossed], axis=1)
	count = np.maximum(valid.sum(axis=1), 1)
	middle = np.where(valid[..., None], points, 0).sum(axis=1) / count[:, None]
	spokes = points - middle[:, None]
	order = np.argsort(np.where(valid, np.arctan2(spokes[..., 1], spokes[..., 0]), np.inf), axis=1, kind="stable")
	spokes, valid = np.take_along_axis(spokes, order[..., None], axis=1), np.take_along_axis(valid, order, axis=1)
	spokes = np.where(valid[..., None], spokes, spokes[:, :1])  # what is no corner repeats the first one
	following = np.roll(spokes, -1, axis=1)
	twice = _cross(spokes, following)
	area = 0.5 * twice.sum(axis=1)
	area[~valid[:, 0]] = 0
	moment = ((spokes + following) * twice[..., None]).sum(axis=1) / 6
	return area, middle + np.where(area[:, None] > 1e-12 * size[:, None]**2, moment / np.maximum(area, 1e-300)[:, None], 0)


def _cross(a, b):
	return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _inside(points, polygon, size):
	"""Whether points (m, p, 2) are inside or, to round-off, on the edge of convex polygons (m, q, 2)."""
	edges = np.roll(polygon, -1, axis=1) - polygon
	side = _cross(edges[:, None], points[:, :, None] - polygon[:, None])
	return (side >= -1e-12 * (size**2)[:, None, None]).all(axis=2)


def _crossings(a, b):
	"""Where edges of a cross edges of b (m, 16, 2), and whether they do (m, 16)."""
	alongA, alongB = np.roll(a, -1, axis=1) - a, np.roll(b, -1, axis=1) - b
	between = b[:, None] - a[:, :, None]
	turn = _cross(alongA[:, :, None], alongB[:, None])
	lengths = np.linalg.norm(alongA, axis=2)[:, :, None] * np.linalg.norm(alongB, axis=2)[:, None]
	parallel = np.abs(turn) <= 1e-9 * lengths
	safe = np.where(parallel, 1, turn)
	s, t = _cross(between, alongB[:, None]) / safe, _cross(between, alongA[:, :, None]) / safe
	crossed = ~parallel & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
	points = a[:, :, None] + np.clip(s, 0, 1)[..., None] * alongA[:, :, None]
	return points.reshape(len(a), 16, 2), crossed.reshape(len(a), 16)


def penetrations(one, other, tolerance):
	"""How far solids overlap: the shortest way that separates them (m,) [m]; 0 where it is within the tolerance (m,).

	Two convex solids are apart when a plane along a face of either, or along an edge of both, separates them.
	"""
	parts = [np.maximum(_beyondFaces(one[some], other[some]), _beyondFaces(other[some], one[some])) for some in _portions(len(one))]
	depth = -np.concatenate(parts)
	deep = np.flatnonzero(depth > tolerance)
	for some in _portions(len(deep), 200):
		chosen = deep[some]
		depth[chosen] = np.minimum(depth[chosen], -_beyondEdges(one[chosen], other[chosen]))
	return np.where(depth > tolerance, depth, 0)


def _beyondFaces(one, other):
	"""By how much all of the other solid is beyond a face of the one; the largest over its faces."""
	normals, points, _ = _planes(one)
	offsets = np.einsum("mfk,mak->mfa", normals, other) - np.einsum("mfk,mfk->mf", normals, points)[..., None]
	return offsets.min(axis=2).max(axis=1)


def _beyondEdges(one, other):
	"""The same for planes along an edge of each."""
	edges0, edges1 = (solid[:, _edges[:, 1]] - solid[:, _edges[:, 0]] for solid in (one, other))
	axes = np.cross(edges0[:, :, None], edges1[:, None]).reshape(len(one), 144, 3)
	lengths = np.linalg.norm(axes, axis=2)
	longest = (np.linalg.norm(edges0, axis=2).max(axis=1) * np.linalg.norm(edges1, axis=2).max(axis=1))[:, None]
	axes = axes / np.maximum(lengths, 1e-300)[..., None]
	along0, along1 = (np.einsum("mxk,mak->mxa", axes, solid) for solid in (one, other))
	apart = np.maximum(along0.min(axis=2) - along1.max(axis=2), along1.min(axis=2) - along0.max(axis=2))
	return np.where(lengths > 1e-6 * longest, apart, -np.inf).max(axis=1, initial=-np.inf)
