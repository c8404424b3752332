# SPDX-License-Identifier: GPL-2.0-or-later
# Reads the present state of a scene for pictures: where the corners of bricks are, and which segments of which joints have failed.
# Reading only: nothing here changes the simulation.
"""The present state of bricks and joints, as arrays for yade_brick.picture."""

import numpy as np

from .build import brickColor
from .picture import Marks, Patch


def patches(bodies, colors=None):
	"""The bricks among the bodies, to draw.

	:param bodies: bodies, such as O.bodies; what is no Brick is left out
	:param colors: dict from body id to a colour or a number; others have that of their shape, or a brick tone where it was not chosen
	:returns: list of picture.Patch with the deformed corners in world axes [m]; fixed bricks are supports
	"""
	from yade import Brick
	found = []
	for body in bodies:
		if body is None or not isinstance(body.shape, Brick):
			continue
		corners = np.array([tuple(corner) for corner in body.shape.worldCorners(body.state)])
		color = (colors or {}).get(body.id)
		support = set(body.state.blockedDOFs) == set("xyzXYZ")
		if color is None and not support and not any(np.allclose(body.shape.color, plain) for plain in (brickColor, (1, 1, 1))):
			color = tuple(body.shape.color)
		found.append(Patch(corners, color, support))
	return found


class JointRecord:
	"""Where mortar joints are, and how each of their segments failed, followed through a simulation.

	YADE forgets a joint when its last segment has failed, so look (update) as often as the failure modes matter; a segment that was
	intact at the last look and whose joint is gone by the next has state 4.

	To be made when the joints exist and at least one step was done (their places are known only then).

	:raises ValueError: when there is no joint
	"""

	def __init__(self):
		from yade import O
		self._states, self._sides = {}, {}
		for interaction in O.interactions:
			states = _statesOf(interaction)
			if states is None:
				continue
			pair = (interaction.id1, interaction.id2)
			world = interaction.phys.segmentPoints(interaction.geom)
			self._states[pair] = states
			self._sides[pair] = [[_toBody(O.bodies[i].state, point) for point in world] for i in pair]
		if not self._states:
			raise ValueError("no mortar joint found; make the record after MortarJoints()() and at least one step")

	def update(self):
		"""Looks which segments have failed since."""
		from yade import O
		for pair, before in self._states.items():
			if 0 not in before:
				continue
			interaction = O.interactions[pair] if O.interactions.has(*pair) else None
			now = _statesOf(interaction) if interaction is not None else None
			# What failed stays failed as it was seen to; what is not known any more failed unseen.
			self._states[pair] = now if now is not None else [state or 4 for state in before]

	def marks(self, widest=0.02):
		"""The segments where they are now, midway between their two sides, as picture.Marks; `update` first.

		:param widest: segments whose sides have moved apart or slid by more [m] are left out: such a crack shows by itself
		"""
		from yade import O
		points, states = [], []
		for pair, sides in self._sides.items():
			first, second = ([_toWorld(O.bodies[i].state, point) for point in side] for i, side in zip(pair, sides))
			for one, other, state in zip(first, second, self._states[pair]):
				if (one - other).norm() <= widest:
					points.append(tuple(0.5 * (one + other)))
					states.append(state)
		return Marks(np.array(points).reshape(-1, 3), np.array(states, dtype=int))

	def failedByMode(self):
		"""Number of failed segments as dict: tension, shear, compression, unseen."""
		every = [state for states in self._states.values() for state in states]
		return {name: every.count(state) for state, name in ((1, "tension"), (2, "shear"), (3, "compression"), (4, "unseen"))}

	def segmentCount(self):
		"""Number of segments of all joints."""
		return sum(len(states) for states in self._states.values())


def _toBody(state, point):
	"""A point of the world in the axes of a body [m]."""
	return state.ori.conjugate() * (point - state.pos)


def _toWorld(state, point):
	"""The reverse."""
	return state.pos + state.ori * point


def _statesOf(interaction):
	"""States of a joint's segments, or None for anything else."""
	from yade import BrickPhys
	if not interaction.isReal or not isinstance(interaction.phys, BrickPhys):
		return None
	return list(interaction.phys.segmentState) or None
