# SPDX-License-Identifier: GPL-2.0-or-later
# The usual mistakes of a model of masonry, found before a run: bricks that nothing holds, that overlap, that nearly touch or barely touch.
# Geometry of all pairs at once; which pairs are joined is the library's finding.
"""Checks of a scene of bricks: `checkMasonry`. Lengths in metres."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from .checks import isFinite
from .joints import joinedPairs
from .solids import Solids, nearShare, touchAngle, touchShare

#: Faces at a larger angle do not pass for faces that were meant to touch [rad].
nearAngle = math.radians(5)

#: Findings of a kind that are said in words; all are there as data.
mostLines = 20


class LooseBricks(NamedTuple):
	"""Bricks that nothing holds: one that touches nothing, or several that touch each other.

	:param ids: of the bricks
	:param centre: mean of their middles [m]
	"""

	ids: tuple
	centre: tuple

	def __str__(self):
		if len(self.ids) == 1:
			return f"brick #{self.ids[0]} touches nothing, {_at(self.centre)}"
		return f"{len(self.ids)} bricks, {_named(self.ids)}, {_at(self.centre)}, touch each other but no chain of faces leads from them to a support"


class Overlap(NamedTuple):
	"""Two bodies that are partly in the same place.

	:param ids: of the bodies
	:param depth: the shortest way by which one would have to be moved [m]
	:param centre: about the middle of the overlap [m]
	"""

	ids: tuple
	depth: float
	centre: tuple

	def __str__(self):
		return f"bodies #{self.ids[0]} and #{self.ids[1]} overlap by {_metres(self.depth)} {_at(self.centre)}"


class Gap(NamedTuple):
	"""Two faces that nearly touch, but get no mortar.

	:param ids: of the bodies
	:param gap: between the faces [m]
	:param angle: between the faces [rad]
	:param tolerance: up to which MortarJoints takes a gap as closed [m]
	:param centre: [m]
	"""

	ids: tuple
	gap: float
	angle: float
	tolerance: float
	centre: tuple

	def __str__(self):
		tilted = f" at an angle of {math.degrees(self.angle):.2g} degrees" if self.angle > touchAngle else ""
		apart = f"are {_metres(abs(self.gap))} apart{tilted}" if self.gap > self.tolerance or not tilted else f"meet{tilted}"
		reason = f"farther than the {_metres(self.tolerance)} that count as closed" if self.gap > self.tolerance else f"more than {touchAngle:g} rad"
		return f"faces of #{self.ids[0]} and #{self.ids[1]} {apart} {_at(self.centre)}: {reason}, so no mortar is laid"


class TinyJoint(NamedTuple):
	"""Faces that touch over a small part only.

	:param ids: of the bodies
	:param area: [m2]
	:param share: of the smaller face [-]
	:param centre: [m]
	"""

	ids: tuple
	area: float
	share: float
	centre: tuple

	def __str__(self):
		share = f"{100 * self.share:.2g} % of the smaller one"
		return f"faces of #{self.ids[0]} and #{self.ids[1]} touch over {1e4 * self.area:.3g} cm2 only, {share}, {_at(self.centre)}"


@dataclass(frozen=True)
class MasonryCheck:
	"""What `checkMasonry` has found; `print` says it in words.

	:param bricks: number of bricks that can move
	:param supports: number of fixed bricks, walls and boxes
	:param touching: pairs of bodies whose faces touch or that mortar joins
	:param joined: those of them that mortar joins
	:param loose: tuple of LooseBricks
	:param overlaps: tuple of Overlap
	:param gaps: tuple of Gap
	:param tinyJoints: tuple of TinyJoint
	"""

	bricks: int
	supports: int
	touching: int
	joined: int
	loose: tuple
	overlaps: tuple
	gaps: tuple
	tinyJoints: tuple

	@property
	def ok(self):
		"""Whether nothing was found."""
		return not (self.loose or self.overlaps or self.gaps or self.tinyJoints)

	def __str__(self):
		counts = f"{self.bricks} bricks and {self.supports} supports, {self.touching} pairs that touch, {self.joined} of them joined by mortar"
		lines = [counts + (": nothing to object to" if self.ok else "")]
		if self.bricks and not self.supports:
			lines.append("there is no support: no wall, box or brick that is fixed")
		for found in (self.loose, self.overlaps, self.gaps, self.tinyJoints):
			lines += [str(each) for each in found[:mostLines]]
			if len(found) > mostLines:
				lines.append(f"... and {len(found) - mostLines} more of this kind")
		return "\n".join(lines)


def checkMasonry(nearGap=None, smallShare=0.02, tolerance=None):
	"""Checks the bricks of the scene, before or after mortar was laid: bricks and groups of bricks that touch no support, bodies that overlap, faces that
	nearly touch but are too far apart for MortarJoints, faces that touch over a tiny area. Pairs that mortar joins are not
	asked for gaps and overlaps.

	Meant for a scene as it was built; in one that has moved, contacts under load overlap a little.

	:param nearGap: faces up to this far apart were probably meant to touch [m], > 0; None: a fifth of the smaller brick's shortest edge
	:param smallShare: an overlap of faces below this share of the smaller one is tiny, in [0, 1]
	:param tolerance: as of MortarJoints [m], >= 0; None: 1e-6 of the smaller brick's diagonal
	:returns: MasonryCheck
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	_checkNumber("nearGap", nearGap, lambda gap: gap is None or isFinite(gap) and gap > 0, "a finite length > 0 m, or None")
	_checkNumber("smallShare", smallShare, lambda share: isFinite(share) and 0 <= share <= 1, "a number in [0, 1]")
	_checkNumber("tolerance", tolerance, lambda gap: gap is None or isFinite(gap) and gap >= 0, "a finite length >= 0 m, or None")
	solids, joined = Solids(), joinedPairs()
	near = _Neighbours(solids, joined, nearGap, tolerance)
	touching = np.concatenate([near.pairs[near.closed.pair], np.array([[solids.place[id] for id in pair] for pair in joined], dtype=int).reshape(-1, 2)])
	return MasonryCheck(
	        bricks=int((solids.bricks & ~solids.held).sum()), supports=len(set(solids.ids[solids.held])),
	        touching=len(np.unique(np.sort(solids.ids[touching], axis=1), axis=0)), joined=len(joined),
	        loose=_loose(solids, np.concatenate([touching, near.pairs[near.depth > 0]])), overlaps=near.overlaps(), gaps=near.gaps(smallShare), tinyJoints=near.tinyJoints(smallShare)
	)


def _checkNumber(name, value, holds, allowed):
	if not holds(value):
		raise ValueError(f"{name} is {value!r}; allowed is {allowed}")


class _Neighbours:
	"""Pairs of bodies whose boxes are near each other, and what their faces do.

	:param pairs: (m, 2) indices of solids
	:param limit: (m,) largest gap or overlap of faces that touch [m]
	:param joined: (m,) whether mortar joins them
	:param facing: faces.Facing of all that are near
	:param closed: of those that touch, the largest of each pair
	:param depth: (m,) of overlaps beyond the limit of pairs that are not joined, else 0 [m]
	"""

	def __init__(self, solids, joined, nearGap, tolerance):
		near = nearShare * solids.edge if nearGap is None else np.full(len(solids.ids), float(nearGap))
		limit = touchShare * solids.diagonal if tolerance is None else np.full(len(solids.ids), float(tolerance))
		near = np.maximum(near, limit)
		self.solids, self.pairs = solids, solids.nearPairs(near)
		self.limit = limit[self.pairs].min(axis=1)
		self.joined = np.array([tuple(pair) in joined for pair in solids.ids[self.pairs].tolist()], dtype=bool)
		self.facing = found = solids.facing(self.pairs, near[self.pairs].min(axis=1), nearAngle)
		limits = self.limit[found.pair]
		touch = (found.angle <= touchAngle) & (np.abs(found.gap) <= limits) & (found.area > limits * np.sqrt(found.smaller))
		self.closed = found.where(touch).largestOfEachPair()
		self.depth = np.where(self.joined, 0, solids.penetrations(self.pairs, self.limit))

	def overlaps(self):
		return tuple(
		        Overlap(self._ids(pair), float(self.depth[pair]), _middle(self.solids.corners[self.pairs[pair]])) for pair in np.flatnonzero(self.depth)
		)

	def gaps(self, smallShare):
		found = self.facing
		apart = found.where((found.gap >= -self.limit[found.pair]) & (found.area > max(smallShare, 1e-6) * found.smaller))
		settled = self.joined | (self.depth > 0)
		settled[self.closed.pair] = True
		apart = apart.where(~settled[apart.pair]).largestOfEachPair()
		return tuple(
		        Gap(self._ids(pair), float(gap), float(angle), float(self.limit[pair]), tuple(centre))
		        for pair, gap, angle, centre in zip(apart.pair, apart.gap, apart.angle, apart.centre.tolist())
		)

	def tinyJoints(self, smallShare):
		tiny = self.closed.where(self.closed.area < smallShare * self.closed.smaller)
		return tuple(
		        TinyJoint(self._ids(pair), float(area), float(area / smaller), tuple(centre))
		        for pair, area, smaller, centre in zip(tiny.pair, tiny.area, tiny.smaller, tiny.centre.tolist())
		)

	def _ids(self, pair):
		return tuple(self.solids.ids[self.pairs[pair]].tolist())


def _loose(solids, touching):
	"""Groups of bricks without a support among them, by the lowest id in each; `touching` (k, 2) are pairs of solids."""
	count = len(solids.ids)
	_, group = connected_components(coo_matrix((np.ones(len(touching)), (touching[:, 0], touching[:, 1])), shape=(count, count)), directed=False)
	supported = np.zeros(count, dtype=bool)
	supported[group[solids.held]] = True
	free = np.flatnonzero(~supported[group] & solids.bricks)
	found = []
	for number in np.unique(group[free]):
		members = free[group[free] == number]
		found.append(LooseBricks(tuple(sorted(solids.ids[members].tolist())), tuple(solids.centre[members].mean(axis=0).tolist())))
	return tuple(sorted(found))


def _middle(corners):
	"""Middle of what the boxes of two solids (2, 8, 3) have in common."""
	return tuple((0.5 * (corners.min(axis=1).max(axis=0) + corners.max(axis=1).min(axis=0))).tolist())


def _named(ids, most=6):
	names = [f"#{id}" for id in ids]
	return ", ".join(names) if len(names) <= most else ", ".join(names[:most - 1] + ["..."] + names[-1:])


def _at(point):
	return "at (" + ", ".join(f"{value:.4g}" for value in point) + ")"


def _metres(length):
	"""A length in a unit that suits it."""
	unit, factor = ("m", 1) if length >= 1 else ("mm", 1e3) if length >= 1e-4 else ("um", 1e6)
	return f"{factor * length:.3g} {unit}"
