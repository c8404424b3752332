# SPDX-License-Identifier: GPL-2.0-or-later
# Reads the present state of a scene for pictures: where the corners of bricks are, and which segments of which joints have failed.
# Reading only: nothing here changes the simulation.
"""The present state of bricks and joints, as arrays for yade_brick.picture."""

import math

import numpy as np

from .build import brickColor
from .picture import Marks, Patch

#: State of a segment that was intact at the last look, and whose joint was gone by the next.
unseen = 4


def patches(bodies, colors=None):
	"""The bricks among the bodies, to draw.

	:param bodies: bodies, such as O.bodies; what is no Brick is left out
	:param colors: dict from body id to a colour or a number; others have that of their shape, or a brick tone where it was not chosen
	:returns: list of picture.Patch with the deformed corners in world axes [m]; fixed bricks are supports
	"""
	from yade import Brick
	if colors is not None and not isinstance(colors, dict):
		raise ValueError(f"colors is {colors!r}; allowed is a dict from body id to a colour or a number")
	found = []
	for body in bodies:
		if body is None or not isinstance(body.shape, Brick):
			continue
		color = (colors or {}).get(body.id)
		support = set(body.state.blockedDOFs) == set("xyzXYZ")
		if color is None and not support:
			color = _chosenColor(body.shape)
		found.append(Patch(worldCorners(body), color, support))
	return found


def worldCorners(body):
	"""Present corners of the brick that a body is, (8, 3) [m]."""
	return np.array([numbers(corner) for corner in body.shape.worldCorners(body.state)])


def numbers(vector):
	"""A vector of YADE as a tuple; tuple() and NumPy, which take it as a sequence that ends by an error, are ten times slower."""
	return vector[0], vector[1], vector[2]


def _chosenColor(shape):
	"""A shape's colour, or None for YADE's own and for that of all bricks."""
	color = tuple(shape.color)
	plain = any(all(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-8) for a, b in zip(color, other)) for other in (brickColor, (1, 1, 1)))
	return None if plain else color


class JointRecord:
	"""Where mortar joints are, and how each of their segments failed, followed through a simulation.

	YADE forgets a joint when its last segment has failed, so look (update) as often as the failure modes matter; a segment that was
	intact at the last look and whose joint is gone by the next has state 4.

	To be made when the joints exist and at least one step was done (their places are known only then). Joints that have failed altogether before are left out.

	:raises ValueError: when there is no joint
	"""

	def __init__(self):
		from yade import O
		self._states, places = {}, []
		for interaction in O.interactions:
			states = statesOf(interaction)
			if states is None or not interaction.phys.jointed:
				continue
			self._states[interaction.id1, interaction.id2] = states
			places += [numbers(point) for point in interaction.phys.segmentPoints(interaction.geom)]
		if not self._states:
			raise ValueError("no mortar joint found; make the record after MortarJoints()() and at least one step")
		# of all segments, one joint after the other: the two bodies, and the place in the axes of either
		self._bodies = np.repeat(list(self._states), [len(states) for states in self._states.values()], axis=0).T
		self._sides = [toBodies(ids, np.array(places)) for ids in self._bodies]

	def update(self):
		"""Looks which segments have failed since. Costs some microseconds a joint; needed only when the law's counts of failures have changed."""
		from yade import O
		for pair, before in self._states.items():
			if 0 not in before:
				continue
			interaction = O.interactions[pair] if O.interactions.has(*pair) else None
			now = statesOf(interaction) if interaction is not None else None
			# What failed stays failed as it was seen to; what is not known any more failed unseen.
			self._states[pair] = now if now is not None else [state or unseen for state in before]

	def marks(self, widest=0.02):
		"""The segments where they are now, midway between their two sides, as picture.Marks; `update` first.

		:param widest: segments whose sides have moved apart or slid by more [m] are left out: such a crack shows by itself
		"""
		one, other = (toWorld(ids, points) for ids, points in zip(self._bodies, self._sides))
		near = np.linalg.norm(one - other, axis=1) <= widest
		return Marks(0.5 * (one + other)[near], np.concatenate(list(self._states.values()))[near])

	def failedByMode(self):
		"""Number of failed segments as dict: tension, shear, compression, unseen."""
		every = [state for states in self._states.values() for state in states]
		return {name: every.count(state) for state, name in ((1, "tension"), (2, "shear"), (3, "compression"), (unseen, "unseen"))}

	def segmentCount(self):
		"""Number of segments of all joints."""
		return sum(len(states) for states in self._states.values())


def toBodies(ids, points, turnOnly=False):
	"""Points of the world (n, 3) in the axes of a body each [m]; with `turnOnly` directions."""
	positions, axes, w = _motion(ids)
	return _turned(points if turnOnly else points - positions, -axes, w)


def toWorld(ids, points, turnOnly=False):
	"""The reverse."""
	positions, axes, w = _motion(ids)
	turned = _turned(points, axes, w)
	return turned if turnOnly else positions + turned


def toReference(ids, points):
	"""The same to where the bodies were laid: State.refPos and State.refOri."""
	positions, axes, w = _motion(ids, lambda state: (state.refPos, state.refOri))
	return positions + _turned(points, axes, w)


def _motion(ids, read=lambda state: (state.pos, state.ori)):
	"""Positions (n, 3) [m] of bodies, which may occur often, and their orientations as vector (n, 3) and scalar (n, 1) parts of quaternions."""
	from yade import O
	different, places = np.unique(ids, return_inverse=True)
	states = [read(O.bodies[int(i)].state) for i in different]
	motions = np.array([(*numbers(position), *numbers(orientation), orientation[3]) for position, orientation in states])[places]
	return motions[:, :3], motions[:, 3:6], motions[:, 6:]


def _turned(points, axes, w):
	"""Points turned by quaternions."""
	twice = 2 * np.cross(axes, points)
	return points + w * twice + np.cross(axes, twice)


def statesOf(interaction):
	"""States of a joint's segments, or None for anything else."""
	from yade import BrickPhys
	if not interaction.isReal or not isinstance(interaction.phys, BrickPhys):
		return None
	return list(interaction.phys.segmentState) or None
