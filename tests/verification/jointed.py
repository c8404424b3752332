# SPDX-License-Identifier: GPL-2.0-or-later
# Cuboid bricks on springs between their faces, written down node by node apart from the product; only the stiffness of the hexahedra is the product's. To judge
# what the product assembles, and to find where references come from.
import numpy as np

from mesh import *


def modulus(young, poisson, length):
	"""Springs of joint per area [Pa/m]: normal, shear."""
	return young / ((1 - poisson**2) * length), young / (2 * (1 + poisson) * length)


class NodalBrick:
	"""A cuboid whose state is the displacement of the eight nodes of its inner hexahedron, thickness r inside the corners.

	:param turning: the contact part between node and corner turns with the brick; else a point of a face moves as the nodes interpolate
	:param order: node signs from which the rotation of the brick is taken: SIGNS; other orders are wrong, but one explains some references
	"""

	def __init__(self, size, r, density, turning=True, order=SIGNS):
		self.half, self.turning = np.array(size) / 2, turning
		self.nodes = SIGNS * (self.half - r)
		self.mass = density * np.prod(size)
		self.inertia = self.mass / 3 * (self.half @ self.half - self.half**2)
		self.motions = rigidMotions(order * (self.half - r))
		self.motion = np.linalg.solve(self.motions.T @ self.motions, self.motions.T)  # rigid motion (6, 24) of displaced nodes, by equal masses

	def point(self, natural):
		"""Displacement (3, 24) of the point of the outer brick at natural coordinates."""
		moved = np.kron(weights(natural), np.eye(3))
		if self.turning:
			away = natural * (self.half - abs(self.nodes[0]))
			moved += np.cross(np.eye(3), away).T @ self.motion[3:]
		return moved

	def lumpedMass(self):
		return np.eye(24) * self.mass / 8

	def consistentMass(self):
		return consistentMass(self.nodes, self.mass)

	def hybridMass(self):
		"""Exact mass and rotary inertia of the solid, lumped mass of the deformation: the product's."""
		part = self.mass / 8 * self.motions @ np.linalg.inv(self.mass / 8 * self.motions.T @ self.motions)
		exact = np.diag([self.mass] * 3 + list(self.inertia))
		return self.lumpedMass() - part @ (self.mass / 8 * self.motions.T @ self.motions - exact) @ part.T


def facePoints(axis, segments):
	"""Natural coordinates of the segments' middles on the faces across an axis: pairs on the + and the - face."""
	middles = (2 * np.arange(segments) + 1) / segments - 1
	for first in middles:
		for second in middles:
			upper, lower = np.empty(3), np.empty(3)
			for k in (upper, lower): k[[i for i in range(3) if i != axis]] = first, second
			upper[axis], lower[axis] = 1, -1
			yield upper, lower


class Joints:
	"""Springs between cubes that touch: what a unit displacement of the nodes on both sides stretches (segments, 3, 24)."""

	def __init__(self, brick, young, poisson, length, segments):
		normal, shear = modulus(young, poisson, length)
		self.area = (2 * brick.half[0] / segments)**2
		self.sides, self.springs = [], []
		for axis in range(3):
			points = list(facePoints(axis, segments))
			self.sides.append([np.array([brick.point(p[side]) for p in points]) for side in (0, 1)])
			self.springs.append(np.where(np.arange(3) == axis, normal, shear)[:, None] * self.area)

	def stiffness(self, axis, stretch):
		"""Of one joint (n, n), by what stretches its segments (segments, 3, n)."""
		flat = stretch.reshape(-1, stretch.shape[2])
		return flat.conj().T @ (np.tile(self.springs[axis], (len(stretch), 1)) * flat)

	def pair(self, axis):
		upper, lower = self.sides[axis]
		return self.stiffness(axis, np.concatenate([upper, -lower], axis=2))

	def wave(self, phases):
		"""Of an endless lattice in which each brick moves as its neighbour along an axis, turned by a phase (24, 24), Hermitian."""
		return sum(self.stiffness(axis, upper - np.exp(1j * phases[axis]) * lower) for axis, (upper, lower) in enumerate(self.sides))
