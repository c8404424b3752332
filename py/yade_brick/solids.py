# SPDX-License-Identifier: GPL-2.0-or-later
# The bodies of a scene that bricks may touch, as hexahedra in arrays: bricks as they are now, boxes, and walls as slabs behind them.
"""Bodies as solids, and how near counts as touching."""

import numpy as np

from . import faces
from .build import cornerSigns
from .snapshot import numbers, worldCorners

#: Largest gap or overlap of faces that touch, as a share of the smaller brick's diagonal, and largest angle between them [rad]: those of MortarJoints.
touchShare, touchAngle = 1e-6, 1e-3

#: Faces that are no farther apart than this share of the smaller brick's shortest edge were probably meant to touch.
nearShare = 0.2


class Solids:
	"""Bricks, walls and boxes of the scene as hexahedra.

	:param ids: of the bodies; a wall whose sense is 0 is there twice, once for the bricks on either side
	:param corners: (n, 8, 3) [m]
	:param held: (n,) whether it cannot move
	:param edge: (n,) shortest edge of a brick, infinite for what is none [m]
	:param diagonal: (n,) of a brick, infinite for what is none [m]
	:param facingSide: (n, 3) for a side of such a wall: bricks it is there for; else 0
	:param place: dict from id to index (the last one of a wall)
	"""

	def __init__(self):
		from yade import Box, Brick, O, Wall
		bodies = [body for body in O.bodies if body is not None and isinstance(body.shape, (Brick, Box, Wall))]
		bricks = [body for body in bodies if isinstance(body.shape, Brick)]
		corners = [worldCorners(body) for body in bricks] + [_boxCorners(body) for body in bodies if isinstance(body.shape, Box)]
		solids = bricks + [body for body in bodies if isinstance(body.shape, Box)]
		sides = [np.zeros(3)] * len(solids)
		around = np.concatenate(corners) if corners else np.zeros((1, 3))
		for body in (body for body in bodies if isinstance(body.shape, Wall)):
			for sense in (body.shape.sense, ) if body.shape.sense else (1, -1):
				corners.append(_wallCorners(body, sense, around))
				solids.append(body)
				sides.append(np.zeros(3) if body.shape.sense else sense * np.eye(3)[body.shape.axis])
		self.ids = np.array([body.id for body in solids], dtype=int)
		self.corners = np.array(corners, dtype=float).reshape(-1, 8, 3)
		self.held = np.array([not body.dynamic for body in solids], dtype=bool)
		self.facingSide = np.array(sides, dtype=float).reshape(-1, 3)
		self.place = {int(id): index for index, id in enumerate(self.ids)}
		self.bricks = np.arange(len(solids)) < len(bricks)
		self.edge = np.where(self.bricks, faces.shortestEdges(self.corners), np.inf)
		self.diagonal = np.where(self.bricks, np.linalg.norm(self.corners[:, 6] - self.corners[:, 0], axis=1), np.inf)
		self.centre = self.corners.mean(axis=1)

	def nearPairs(self, near):
		"""Pairs of bricks with bricks and supports (m, 2) whose boxes are no farther apart than `near` (n,) of both, two that are held left out; of a pair
		with a support, that comes first, else the lower id."""
		margin = np.where(self.bricks, near, 0)[:, None]
		pairs = faces.nearPairs(self.corners.min(axis=1) - margin, self.corners.max(axis=1) + margin)
		pairs = pairs[~self.held[pairs].all(axis=1) & self.bricks[pairs].any(axis=1)]
		swapped = self.bricks[pairs[:, 0]] & (~self.bricks[pairs[:, 1]] | (self.ids[pairs[:, 0]] > self.ids[pairs[:, 1]]))
		pairs[swapped] = pairs[swapped][:, ::-1]
		side = self.facingSide[pairs[:, 0]]
		wall = np.einsum("mk,mak->ma", side, self.corners[pairs[:, 0]]).max(axis=1)
		return pairs[(np.einsum("mk,mk->m", side, self.centre[pairs[:, 1]]) > wall) | ~side.any(axis=1)]

	def facing(self, pairs, near, angle):
		"""faces.Facing of pairs (m, 2) of indices."""
		return faces.facing(self.corners[pairs[:, 0]], self.corners[pairs[:, 1]], near, angle)

	def penetrations(self, pairs, tolerance):
		"""faces.penetrations of pairs (m, 2) of indices."""
		return faces.penetrations(self.corners[pairs[:, 0]], self.corners[pairs[:, 1]], tolerance)


def _boxCorners(body):
	from yade import Vector3
	extents, state = body.shape.extents, body.state
	return [numbers(state.pos + state.ori * Vector3(*(sign * extents[k] for k, sign in enumerate(signs)))) for signs in cornerSigns]


def _wallCorners(body, sense, around):
	"""A slab behind the wall, as wide as all bricks together and as much again on either side."""
	low, high = around.min(axis=0), around.max(axis=0)
	size = max((high - low).max(), 1.0)
	low, high = low - size, high + size
	axis, at = body.shape.axis, body.state.pos[body.shape.axis]
	low[axis], high[axis] = (at - size, at) if sense > 0 else (at, at + size)
	return np.where(np.array(cornerSigns) < 0, low, high)
