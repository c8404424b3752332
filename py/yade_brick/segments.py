# SPDX-License-Identifier: GPL-2.0-or-later
# Every segment of mortar of a scene as arrays: outline, state, stress, opening. Followed through a run, so that the segments of a joint that has failed
# altogether, which YADE forgets, are known at the place where they broke.
"""Segments of mortar joints, also of those that are gone: `SegmentRecord`."""

import numpy as np

from .snapshot import numbers, statesOf, toBodies, toReference, toWorld, unseen

#: What BrickPhys.segmentTable holds of each segment: name and numbers.
_columns = {"outline": 12, "point": 3, "opening": 1, "slip": 3, "normalStress": 1, "shearStress": 3, "utilisation": 1}


class SegmentRecord:
	"""The segments of all joints that were ever seen, in a fixed order; `update` looks at the scene, at the joints as they were in the last step.

	Side 0 of a joint is the support, or the brick with the lower id; normals point from there to side 1; opening and slip are those of side 1. Of a joint
	that is gone (all its segments have failed) the segments stay on the face of side 0: opening and slip are then those of the bodies' rigid motion,
	stresses are zero, since what acts there is ordinary contact. Where one of the two bodies was erased they stay where they were.

	n segments, all read only:

	:param bodies: (n, 2), ids of side 0 and side 1
	:param index: (n,), number of the segment in its joint
	:param area: (n,) [m2]
	:param state: (n,), 0 intact, 1 failed in tension, 2 in shear, 3 in compression, 4 failed between two looks in a way that was not seen
	:param joined: (n,), True while at least one segment of its joint holds
	:param outline: (n, 4, 3), corners in turn, world axes [m]
	:param displacement: (n, 4, 3), of these corners from where the bodies were laid (State.refPos, State.refOri) [m]
	:param normal: (n, 3), unit vectors, world axes
	:param opening: (n,), along the normal since the bodies were joined [m]
	:param slip: (n, 3), along the joint, world axes [m]
	:param normalStress: (n,), tension positive [Pa]
	:param shearStress: (n, 3), acting on side 0, world axes [Pa]
	:param utilisation: (n,), stress as a share of the mortar's strength [-]; 0 where failed
	"""

	#: Arrays of which a run that goes on needs to know what was.
	_kept = ("bodies", "index", "area", "state", "_sides", "_normalOnBody", "_laid")

	def __init__(self):
		self._slots = {}  # from pair of bodies to its place in the arrays
		self.bodies, self.index, self.state = np.empty((0, 2), dtype=int), np.empty(0, dtype=int), np.empty(0, dtype=int)
		self.area, self.joined = np.empty(0), np.empty(0, dtype=bool)
		self._sides = np.empty((2, 0, 4, 3))  # corners on either side, in the axes of its body
		self._normalOnBody, self._laid = np.empty((0, 3)), np.empty((0, 4, 3))
		self.outline = np.empty((0, 4, 3))
		self._clear()

	def __len__(self):
		return len(self.state)

	def update(self):
		"""Looks at the scene.

		:raises RuntimeError: before the first step, when the place of joints is not known yet
		"""
		joints, modes = _read()
		self._addNew(joints)
		self._markGone({pair: modes.get(pair) for pair in self._slots if pair not in joints})
		self._clear()
		if joints:
			self._takeLive(joints)
		self._followGone(np.flatnonzero(~self.joined & _exist(self.bodies)))
		self.displacement = self.outline - self._laid

	def _clear(self):
		"""Makes room for what is found anew at each look."""
		n = len(self)
		self.normal, self.slip, self.shearStress = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))
		self.opening, self.normalStress, self.utilisation = np.zeros(n), np.zeros(n), np.zeros(n)
		self.displacement = np.zeros((n, 4, 3))

	def _addNew(self, joints):
		new = {pair: joint for pair, joint in joints.items() if pair not in self._slots or _length(self._slots[pair]) != len(joint.states)}
		if not new:
			return
		place = len(self)
		for pair, joint in new.items():
			self._slots[pair] = slice(place, place + len(joint.states))
			place += len(joint.states)
		counts = [len(joint.states) for joint in new.values()]
		more = sum(counts)
		bodies, outlines = np.repeat(list(new), counts, axis=0), _tables(new)["outline"].reshape(-1, 4, 3)
		self.bodies = np.concatenate([self.bodies, bodies])
		self.index = np.concatenate([self.index, *(np.arange(count) for count in counts)])
		self.area = np.concatenate([self.area, *(joint.areas for joint in new.values())])
		self.state, self.joined = np.append(self.state, np.zeros(more, dtype=int)), np.append(self.joined, np.ones(more, dtype=bool))
		self._sides = np.concatenate([self._sides, np.zeros((2, more, 4, 3))], axis=1)
		self._normalOnBody = np.concatenate([self._normalOnBody, np.zeros((more, 3))])
		# where the segment was when the bodies were laid: midway between its places on both
		flat = outlines.reshape(-1, 3)
		laid = [toReference(ids, toBodies(ids, flat)) for ids in np.repeat(bodies, 4, axis=0).T]
		self._laid = np.concatenate([self._laid, (0.5 * (laid[0] + laid[1])).reshape(-1, 4, 3)])
		self.outline = np.concatenate([self.outline, outlines])

	def _markGone(self, gone):
		for pair, modes in gone.items():
			slot = self._slots[pair]
			if not self.joined[slot].any():
				continue
			self.joined[slot] = False
			# what failed stays failed as it was seen to; what is not known any more failed unseen
			known = modes is not None and len(modes) == _length(slot)
			self.state[slot] = modes if known else np.where(self.state[slot] == 0, unseen, self.state[slot])

	def _takeLive(self, joints):
		"""What joints that still hold in part say of their segments."""
		places = np.concatenate([np.arange(self._slots[pair].start, self._slots[pair].stop) for pair in joints])
		table, counts = _tables(joints), [len(joint.states) for joint in joints.values()]
		self.joined[places], self.state[places] = True, np.concatenate([joint.states for joint in joints.values()])
		for name in ("slip", "shearStress"):
			getattr(self, name)[places] = table[name]
		for name in ("opening", "normalStress", "utilisation"):
			getattr(self, name)[places] = table[name][:, 0]
		self.outline[places] = table["outline"].reshape(-1, 4, 3)
		self.normal[places] = np.repeat([joint.normal for joint in joints.values()], counts, axis=0)
		apart = (self.opening[places, None] * self.normal[places] + self.slip[places])[:, None]
		for side, share in ((0, -0.5), (1, 0.5)):
			corners = (self.outline[places] + share * apart).reshape(-1, 3)
			self._sides[side, places] = toBodies(np.repeat(self.bodies[places, side], 4), corners).reshape(-1, 4, 3)
		self._normalOnBody[places] = toBodies(self.bodies[places, 0], self.normal[places], turnOnly=True)

	def _followGone(self, places):
		if not len(places):
			return
		one, other = (toWorld(np.repeat(self.bodies[places, side], 4), self._sides[side, places].reshape(-1, 3)).reshape(-1, 4, 3) for side in (0, 1))
		normal = toWorld(self.bodies[places, 0], self._normalOnBody[places], turnOnly=True)
		apart = (other - one).mean(axis=1)
		opening = np.einsum("sk,sk->s", apart, normal)
		self.outline[places], self.normal[places], self.opening[places] = one, normal, opening
		self.slip[places] = apart - opening[:, None] * normal

	def save(self, path):
		"""Writes what is known to a NumPy file, from which `load` goes on in another process."""
		np.savez(path, **{name.lstrip("_"): getattr(self, name) for name in self._kept})

	@classmethod
	def load(cls, path):
		"""A record that goes on from a file of `save`; joints that the scene has count as it says at the next `update`, all others as gone."""
		record = cls()
		with np.load(path) as kept:
			for name in cls._kept:
				setattr(record, name, kept[name.lstrip("_")])
		record.joined, record.outline = np.ones(len(record), dtype=bool), record._laid.copy()
		starts = np.flatnonzero(record.index == 0)
		for start, stop in zip(starts, [*starts[1:], len(record)]):
			record._slots[tuple(record.bodies[start].tolist())] = slice(int(start), int(stop))
		record._clear()
		return record


class _Joint:
	"""A joint of the scene as it is read: bytes of its table, states and areas of its segments, normal from side 0 to side 1."""

	def __init__(self, phys, geom, reversed):
		self.table, self.states, self.areas = phys.segmentTable(geom), phys.segmentState, phys.segmentArea
		normal = numbers(geom.normal)
		self.normal = tuple(-value for value in normal) if reversed else normal


def _read():
	"""Joints of the scene, by their sides; and how segments failed of those that are ordinary contacts by now."""
	from yade import Brick, BrickPhys, O
	isBrick = [body is not None and isinstance(body.shape, Brick) for body in O.bodies]
	joints, modes = {}, {}
	for interaction in O.interactions.all(onlyReal=True):
		phys = interaction.phys
		if not isinstance(phys, BrickPhys):
			continue
		pair = interaction.id1, interaction.id2
		reversed = isBrick[pair[0]] and (pair[0] > pair[1] or not isBrick[pair[1]])
		sides = pair[::-1] if reversed else pair
		if phys.jointed:
			joints[sides] = _Joint(phys, interaction.geom, reversed)
		elif states := statesOf(interaction):
			modes[sides] = states
	return joints, modes


def _tables(joints):
	"""The tables of joints one after the other, as arrays by column."""
	table = np.frombuffer(b"".join(joint.table for joint in joints.values())).reshape(-1, sum(_columns.values()))
	ends = np.cumsum(list(_columns.values()))
	return dict(zip(_columns, np.split(table, ends[:-1], axis=1)))


def _exist(bodies):
	"""Whether both bodies of each pair are still in the scene."""
	from yade import O
	different, places = np.unique(bodies, return_inverse=True)
	return np.array([O.bodies[int(i)] is not None for i in different], dtype=bool)[places].reshape(bodies.shape).all(axis=1)


def _length(slot):
	return slot.stop - slot.start
