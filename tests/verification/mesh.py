# SPDX-License-Identifier: GPL-2.0-or-later
# Meshes of hexahedra with the product's element stiffness (Brick.stiffness), assembled here with SciPy: the element apart from joints and time steps.
# Also what elements of one's own are built from: shape functions, volume, consistent mass.
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from yade import Vector3
from yade_brick import Brick
from yade_brick.build import cornerSigns

SIGNS = np.array(cornerSigns, dtype=float)  # natural coordinates of a hexahedron's nodes
GAUSS = SIGNS / np.sqrt(3)  # of weight 1 each
ELEMENTS = {'full': 'full', 'bbar': 'bbar', 'wilson': 'incompatible'}  # names in the references -> Brick.element


def elementStiffness(nodes, young, poisson, element='full'):
	"""The product's (24, 24) of one hexahedron; nodes (8, 3)."""
	return np.array(Brick.stiffness([Vector3(*map(float, x)) for x in nodes], young, poisson, element))


def weights(natural):
	"""Trilinear weights (8,) of the nodes at natural coordinates."""
	return np.prod(1 + SIGNS * natural, axis=1) / 8


def weightDerivatives(natural):
	"""(8, 3), by the natural coordinates."""
	factors = 1 + SIGNS * natural
	return np.stack([SIGNS[:, i] * factors[:, (i + 1) % 3] * factors[:, (i + 2) % 3] for i in range(3)], axis=1) / 8


def jacobian(nodes, natural):
	return nodes.T @ weightDerivatives(natural)


def volume(nodes):
	return sum(np.linalg.det(jacobian(nodes, g)) for g in GAUSS)  # det J is quadratic in each natural coordinate: exact


def consistentMass(nodes, mass):
	"""(24, 24) of a hexahedron of uniform density, scaled to a mass [kg]. Two points a direction: exact for cuboids."""
	scalar = sum(np.outer(weights(g), weights(g)) * np.linalg.det(jacobian(nodes, g)) for g in GAUSS)
	return np.kron(mass / scalar.sum() * scalar, np.eye(3))


def rigidMotions(points):
	"""Displacement (3 n, 6) of points by translations and rotations about the origin."""
	motions = np.zeros((len(points), 3, 6))
	motions[:, :, :3] = np.eye(3)
	motions[:, :, 3:] = np.stack([np.cross(axis, points) for axis in np.eye(3)], axis=2)
	return motions.reshape(-1, 6)


def degrees(nodes):
	"""Indices of the degrees of freedom of nodes, x0 y0 z0 x1 ..."""
	return (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel()


def assemble(size, parts):
	"""Sparse (size, size) from (indices, square matrix) pairs."""
	rows, columns, values = [], [], []
	for indices, matrix in parts:
		rows.append(np.repeat(indices, len(indices)))
		columns.append(np.tile(indices, len(indices)))
		values.append(np.ravel(matrix))
	return sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size))


def solve(stiffness, load, given):
	"""Displacements under a load where some are given (dict of index -> value), and the forces that hold these."""
	held = np.fromiter(given, dtype=int)
	u = np.zeros(len(load))
	u[held] = [given[i] for i in held]
	free = np.setdiff1d(np.arange(len(load)), held)
	u[free] = splu(stiffness[free][:, free].tocsc()).solve(load[free] - stiffness[free][:, held] @ u[held])
	return u, stiffness @ u - load


def singularOrder(poisson):
	"""Order in the element size at which the compliance of a meshed body converges whose worst place is an edge where a fixed face meets a free one at 90 degrees:
	twice the exponent x of the displacements there (Williams 1952, plane strain): sin^2(x pi/2) = ((k + 1)^2 - 4 x^2) / (4 k), k = 3 - 4 nu.
	"""
	k = 3 - 4 * poisson
	low, high = .5, 1.
	while high - low > 1e-12:
		x = (low + high) / 2
		if np.sin(x * np.pi / 2)**2 < ((k + 1)**2 - 4 * x**2) / (4 * k): low = x
		else: high = x
	return 2 * low


def extrapolated(coarse, fine, ratio, order):
	"""Limit of values at two element sizes in this ratio when the error falls with that order (Richardson)."""
	return fine + (fine - coarse) / (ratio**order - 1)


class Cube:
	"""[0, edge]^3 as a grid of equal hexahedra, n along each edge. Nodes run fastest in x."""

	def __init__(self, edge, n, young, poisson, element):
		self.edge, self.n = edge, n
		line = np.linspace(0, 1, n + 1)
		self.points = np.array([(x, y, z) for z in line for y in line for x in line]) * edge
		corner = ((SIGNS + 1) / 2 @ [1, n + 1, (n + 1)**2]).astype(int)
		self.hexahedra = [corner + i + (n + 1) * (j + (n + 1) * k) for k in range(n) for j in range(n) for i in range(n)]
		one = elementStiffness(self.points[self.hexahedra[0]], young, poisson, element)
		self.stiffness = assemble(3 * len(self.points), [(degrees(nodes), one) for nodes in self.hexahedra])
		# share of each node in a load spread evenly over the top
		self.topShare = np.zeros(len(self.points))
		for nodes in self.hexahedra[-n * n:]:
			self.topShare[nodes[4:]] += 1 / (4 * n * n)

	def at(self, axis, share):
		"""Nodes in the plane across an axis, at a share of the edge."""
		return np.flatnonzero(abs(self.points[:, axis] / self.edge - share) < 1e-9)

	def node(self, x, y, z):
		"""The node at shares of the edges."""
		i, j, k = (round(share * self.n) for share in (x, y, z))
		return i + (self.n + 1) * (j + (self.n + 1) * k)

	def fixed(self, axis, share):
		return {i: 0 for i in degrees(self.at(axis, share))}
