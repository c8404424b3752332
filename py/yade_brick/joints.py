# SPDX-License-Identifier: GPL-2.0-or-later
# Mortar joints of a scene: laid with different mortar in bed, head and collar joints, and listed. Which bodies are joined, areas, segments and their
# states are the library's (MortarJoints, BrickPhys); where a joint is follows from faces before the first step, from the last step after it.
"""Joints: `layMortar` and `listJoints`. Lengths in metres."""

import csv
import math
import os
from dataclasses import dataclass, replace

import numpy as np

from .checks import isFinite
from .snapshot import numbers
from .solids import Solids, nearShare, touchAngle

#: Normals at most this far from the vertical or the horizontal make a joint a bed, head or collar joint; others are inclined [rad].
kindAngle = math.radians(15)

kinds = ("bed", "head", "collar", "inclined")

# List of joints


@dataclass(frozen=True)
class Joint:
	"""A mortar joint of two bodies.

	:param ids: of the bodies: a wall or box or, of two bricks, the lower id first
	:param kind: 'bed' (normal within 15 degrees of the vertical), 'head' (upright, across the wall's length), 'collar' (upright, along it: between leaves) or
		'inclined'; where the wall's direction is not given all upright joints are head joints
	:param onSupport: whether one of the bodies cannot move
	:param area: [m2]
	:param normal: from the first body to the second
	:param centre: [m]
	:param segments: their number
	:param failed: how many of them have failed
	:param mortar: Mortar; None where it is not known, since the joint was not laid by `layMortar`
	"""

	ids: tuple
	kind: str
	onSupport: bool
	area: float
	normal: tuple
	centre: tuple
	segments: int
	failed: int
	mortar: object = None

	@property
	def state(self):
		"""'intact', 'cracked' (some segments have failed) or 'failed' (all have)."""
		return "intact" if not self.failed else "cracked" if self.failed < self.segments else "failed"


class JointList(tuple):
	"""Joints in the order of their bodies' ids; `print` shows how many there are of each kind."""

	def ofKind(self, kind):
		"""JointList of one kind: 'bed', 'head', 'collar' or 'inclined'."""
		if kind not in kinds:
			raise ValueError(f"kind is {kind!r}; allowed are {', '.join(map(repr, kinds))}")
		return JointList(joint for joint in self if joint.kind == kind)

	def ofBody(self, id):
		"""JointList of one body."""
		return JointList(joint for joint in self if id in joint.ids)

	@property
	def area(self):
		"""Of all of them together [m2]."""
		return math.fsum(joint.area for joint in self)

	def now(self):
		"""The same joints with the segments that have failed by now: joints that YADE has forgotten since have failed altogether."""
		from yade import O
		return JointList(replace(joint, failed=_failedNow(O.interactions, joint)) for joint in self)

	def writeCsv(self, path):
		"""Writes a line for each joint, with units in the headings; strengths are blank where the mortar is not known.

		:param path: CSV file; its folder is made if absent
		"""
		os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
		with open(path, "w", newline="") as file:
			writer = csv.writer(file, lineterminator="\n")
			writer.writerow(
			        ["id 1", "id 2", "kind", "on support", "area [m2]"] + [f"normal {axis} [-]" for axis in "xyz"] + [f"centre {axis} [m]" for axis in "xyz"]
			        + ["segments", "failed", "state"] + [f"{name} [{unit}]" for name, unit in _mortarColumns]
			)
			for joint in self:
				strengths = ["" if joint.mortar is None else f"{getattr(joint.mortar, name):.9g}" for name, _ in _mortarColumns]
				geometry = [f"{value:.9g}" for value in (joint.area, *joint.normal, *joint.centre)]
				writer.writerow([*joint.ids, joint.kind, "yes" if joint.onSupport else "no", *geometry, joint.segments, joint.failed, joint.state, *strengths])

	def __str__(self):
		groups = [(kind + (", on supports" if onSupport else ""), kind, onSupport) for kind in kinds for onSupport in (False, True)]
		chosen = [(name, [joint for joint in self if (joint.kind, joint.onSupport) == key]) for name, *key in groups for key in [tuple(key)]]
		lines = [("joints", "number", "area [m2]", "smallest [m2]", "segments", "failed")]
		lines += [(name, *_sums(group)) for name, group in chosen if group]
		if len(lines) != 2:
			lines.append(("all", *_sums(self)))
		widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
		return "\n".join("  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(line[1:], widths[1:])]) for line in lines)


_mortarColumns = (
        ("thickness", "m"), ("tensileStrength", "Pa"), ("cohesion", "Pa"), ("frictionAngle", "rad"), ("compressiveStrength", "Pa")
)


def _sums(joints):
	"""Cells of a row of the table."""
	areas = [joint.area for joint in joints]
	smallest = f"{min(areas):.4g}" if areas else ""
	return str(len(areas)), f"{math.fsum(areas):.4g}", smallest, str(sum(joint.segments for joint in joints)), str(sum(joint.failed for joint in joints))


def _failedNow(interactions, joint):
	phys = interactions[joint.ids].phys if interactions.has(*joint.ids) else None
	return sum(1 for state in phys.segmentState if state) if phys is not None and phys.jointed else joint.segments


def layMortar(bed=None, head=None, collar=None, along=None, up=(0, 0, 1), ids=(), tolerance=None):
	"""Lays mortar wherever faces of bricks and supports touch, by MortarJoints; once all bodies are in the scene, before the first step.

	Pairs that are joined already stay as they are. Bricks whose material has no mortar get joints only where mortar is given here.

	:param bed: Mortar of the faces within 45 degrees of the vertical, either way; None: that of the bricks' materials
	:param head: Mortar of all other faces; None: that of the materials; False: none, these joints are dry
	:param collar: Mortar of upright faces along the wall, between its leaves, or False, which needs `along`; None: these are as head joints
	:param along: direction of the wall's length, to tell head from collar joints; None: upright joints are all head joints
	:param up: the vertical
	:param ids: only joints between these bodies; empty: all
	:param tolerance: largest gap or overlap of faces that touch [m]; None: 1e-6 of the smaller brick's diagonal
	:returns: JointList of the joints laid here, with their mortar
	:raises ValueError: naming the argument, its value and what is allowed; see MortarJoints for what it refuses. A refusal by it may come after some joints
		were laid
	"""
	from yade import MortarJoints
	up, along = _directions(up, along)
	for name, mortar, allowed in (("bed", bed, (None, )), ("head", head, (None, False)), ("collar", collar, (None, False))):
		_checkMortar(name, mortar, allowed)
	if collar is not None and along is None:
		raise ValueError(f"collar is {collar!r} and along is None; allowed with a mortar for collar joints is a direction of the wall's length")
	if tolerance is not None and not (isFinite(tolerance) and tolerance >= 0):
		raise ValueError(f"tolerance is {tolerance!r}; allowed is a finite length >= 0 m, or None")
	options = dict(ids=[int(id) for id in ids], tolerance=math.nan if tolerance is None else tolerance)
	calls = [(bed, dict(normal=tuple(up)))]
	if collar is not None:
		calls.append((collar, dict(normal=tuple(np.cross(up, along)))))
	calls.append((head, dict(normal=tuple(along)) if collar is False else {}))  # what is left; not the collar joints if they are to be dry
	laid, before = {}, joinedPairs()
	for mortar, direction in calls:
		if mortar is False:
			continue
		MortarJoints(mortar=mortar, **direction, **options)()
		now = joinedPairs()
		laid.update({pair: mortar for pair in now if pair not in before})
		before = now
	return _listed({pair: interaction for pair, interaction in before.items() if pair in laid}, laid, up, along)


def listJoints(along=None, up=(0, 0, 1)):
	"""All mortar joints of the scene that hold in full or in part.

	:param along: direction of the wall's length, to tell head from collar joints; None: upright joints are all head joints
	:param up: the vertical
	:returns: JointList; places and normals are those of the last step, or before it those at which the joints were laid
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	up, along = _directions(up, along)
	return _listed(joinedPairs(), {}, up, along)


def _checkMortar(name, mortar, allowed):
	from yade import Mortar
	if not any(mortar is value for value in allowed) and not isinstance(mortar, Mortar):
		raise ValueError(f"{name} is {mortar!r}; allowed are a Mortar, {' and '.join(map(str, allowed))}")


def _directions(up, along):
	"""Unit vectors, the second one level."""
	up = _direction(up, "up")
	if along is None:
		return up, None
	level = _direction(along, "along")
	level = level - (level @ up) * up
	if np.linalg.norm(level) < 1e-3:
		raise ValueError(f"along is {along!r} and up is {tuple(up)}; allowed is a direction that is not upright")
	return up, level / np.linalg.norm(level)


def _direction(values, name):
	try:
		vector = np.array([values[k] for k in range(3)], dtype=float)
	except (TypeError, ValueError, IndexError, KeyError, OverflowError):
		vector = np.zeros(3)
	length = np.linalg.norm(vector)
	if not (0 < length < math.inf):
		raise ValueError(f"{name} is {values!r}; allowed are three finite numbers, not all 0")
	return vector / length


def joinedPairs():
	"""Interactions with mortar, by the ids of their bodies in the order of Joint."""
	from yade import BrickPhys, O
	found = {}
	for interaction in O.interactions:
		phys = interaction.phys
		if isinstance(phys, BrickPhys) and phys.jointed:
			pair = interaction.id1, interaction.id2
			found[_ordered(pair, O.bodies)] = interaction
	return dict(sorted(found.items(), key=lambda item: sorted(item[0])))


def _ordered(pair, bodies):
	from yade import Brick
	low, high = sorted(pair)
	return (low, high) if isinstance(bodies[high].shape, Brick) else (high, low)


def _listed(interactions, mortars, up, along):
	"""JointList of interactions by pair.

	:param mortars: by pair, of joints that were laid with one; None there means that of the bricks' materials
	"""
	from yade import O
	joints = []
	for (pair, interaction), (normal, centre) in zip(interactions.items(), _placesOf(interactions)):
		phys, bodies = interaction.phys, [O.bodies[id] for id in pair]
		states, mortar = list(phys.segmentState), mortars.get(pair)
		if pair in mortars and mortar is None:
			mortar = bodies[1].material.mortar
		onSupport = not all(body.dynamic for body in bodies)
		failed = sum(1 for state in states if state)
		joints.append(Joint(pair, kindOf(normal, up, along), onSupport, math.fsum(phys.segmentArea), normal, centre, len(states), failed, mortar))
	return JointList(joints)


def kindOf(normal, up=(0, 0, 1), along=None):
	"""Kind of a joint by its normal, see Joint; all three are of length 1.

	>>> kindOf((0, 0, -1)), kindOf((1, 0, 0)), kindOf((0, 1, 0), along=(1, 0, 0)), kindOf((0.6, 0, 0.8))
	('bed', 'head', 'collar', 'inclined')
	"""
	upright = abs(np.dot(normal, up))
	if upright >= math.cos(kindAngle):
		return "bed"
	if upright > math.sin(kindAngle):
		return "inclined"
	return "head" if along is None or abs(np.dot(normal, along)) >= math.sqrt(0.5) * math.sqrt(1 - upright**2) else "collar"


def _placesOf(interactions):
	"""(normal, centre) of each joint: as the last step found them, or where there was none from the faces as they are."""
	places, unknown = {}, []
	for pair, interaction in interactions.items():
		geom = interaction.geom
		if geom.area > 0:
			sign = 1 if interaction.id1 == pair[0] else -1
			places[pair] = tuple(sign * value + 0.0 for value in numbers(geom.normal)), numbers(geom.contactPoint)
		else:
			unknown.append(pair)
	for share in (nearShare, 1):  # nearly always the first finds all
		unknown = [pair for pair in unknown if pair not in places]
		places.update(_placesOfFaces(unknown, share) if unknown else {})
	nowhere = (math.nan, ) * 3
	return [places.get(pair, (nowhere, nowhere)) for pair in interactions]


def _placesOfFaces(pairs, share):
	"""(normal, centre) by pair where faces are no farther apart than a share of the smaller brick's shortest edge."""
	solids = Solids()
	indices = np.array([[solids.place[id] for id in pair] for pair in pairs])
	found = solids.facing(indices, share * solids.edge[indices].min(axis=1), touchAngle).largestOfEachPair()
	return {pairs[k]: (tuple(normal), tuple(centre)) for k, normal, centre in zip(found.pair, (found.normal + 0.0).tolist(), found.centre.tolist())}
