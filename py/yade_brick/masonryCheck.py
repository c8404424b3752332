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
		return f"faces of #{self.ids[0]} and #{self.ids[1]} touch over {1e4 * self.area:.3g} cm2 only, {100 * self.share:.2g} % of the smaller one, {_at(self.centre)}"


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
	nearly touch but are too far apart for MortarJoints, faces that touch over a tiny area. Pairs that mortar joins are taken as right.

	Meant for a scene as it was built; in one that has moved, contacts under load overlap a little.

	:param nearGap: faces up to this far apart were probably meant to touch [m], > 0; None: a fifth of the smaller brick's shortest edge
	:param smallShare: an overlap of faces below this share of the smaller one is tiny, in [0, 1]
	:param tolerance: as of MortarJoints [m], >= 0; None: 1e-6 of the smaller brick's diagonal
	:returns: MasonryCheck
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	for name, value, holds, allowed in (
	        ("nearGap", nearGap, lambda gap: gap > 0, "a finite length > 0 m, or None"), ("tolerance", tolerance, lambda gap: gap >= 0, "a finite length >= 0 m, or None"),
	        ("smallShare", smallShare, lambda share: 0 <= share <= 1, "a number in [0, 1]")
	):
		if not (value is None and name != "smallShare") and not (isFinite(value) and holds(value)):
			raise ValueError(f"{name} is {value!r}; allowed is {allowed}")
	solids = Solids()
	near = nearShare * solids.edge if nearGap is None else np.full(len(solids.ids), float(nearGap))
	limit = touchShare * solids.diagonal if tolerance is None else np.full(len(solids.ids), float(tolerance))
	pairs, joined = solids.nearPairs(near), joinedPairs()
	isJoined = np.array([tuple(pair) in joined for pair in solids.ids[pairs].tolist()], dtype=bool)
	near, limit = near[pairs].min(axis=1), limit[pairs].min(axis=1)
	found, depth = solids.facing(pairs, np.maximum(near, limit), nearAngle), solids.penetrations(pairs, limit)
	closed = found.where((found.angle <= touchAngle) & (np.abs(found.gap) <= limit[found.pair]) & (found.area > limit[found.pair] * np.sqrt(found.smaller)))
	closed = closed.largestOfEachPair()
	depth = np.where(isJoined, 0, depth)
	tiny = closed.where(closed.area < smallShare * closed.smaller)
	apart = found.where((found.gap >= -limit[found.pair]) & (found.area > max(smallShare, 1e-6) * found.smaller))
	apart = apart.where(~np.isin(apart.pair, closed.pair) & ~isJoined[apart.pair] & (depth[apart.pair] == 0)).largestOfEachPair()
	touching = np.unique(np.concatenate([pairs[closed.pair], [[solids.place[id] for id in pair] for pair in joined] or np.empty((0, 2), dtype=int)]), axis=0)
	named = lambda pair: tuple(solids.ids[pairs[pair]].tolist())
	return MasonryCheck(
	        int((solids.bricks & ~solids.held).sum()), len(set(solids.ids[solids.held])), len(np.unique(np.sort(solids.ids[touching], axis=1), axis=0)), len(joined),
	        _loose(solids, touching),
	        tuple(Overlap(named(pair), float(depth[pair]), _middle(solids.corners[pairs[pair]])) for pair in np.flatnonzero(depth)),
	        tuple(
	                Gap(named(pair), float(gap), float(angle), float(limit[pair]), tuple(centre))
	                for pair, gap, angle, centre in zip(apart.pair, apart.gap, apart.angle, apart.centre.tolist())
	        ),
	        tuple(
	                TinyJoint(named(pair), float(area), float(area / smaller), tuple(centre))
	                for pair, area, smaller, centre in zip(tiny.pair, tiny.area, tiny.smaller, tiny.centre.tolist())
	        )
	)


def _loose(solids, touching):
	"""Groups of bricks without a support among them, by the lowest id in each."""
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
