# SPDX-License-Identifier: GPL-2.0-or-later
# The jointed bricks of a scene as SciPy matrices: statics under any load, natural frequencies. The matrices come from the library.
"""Intact assemblies of bricks as linear systems: `assembled`."""

import numbers
from dataclasses import dataclass

import numpy as np


def assembled():
	"""The bricks and mortar joints of the scene as they are now, as one structure.

	:returns: Assembly
	:raises ValueError: when a joint has failed in part, or bricks touch without mortar
	"""
	from scipy import sparse
	from yade import IntactAssembly
	source = IntactAssembly()
	source.gather()

	def matrix(entries):
		rows, columns, values = (np.frombuffer(data, dtype) for data, dtype in zip(entries, (np.int32, np.int32, np.float64)))
		return sparse.csc_matrix((values, (rows, columns)), shape=(source.size, source.size))

	free = np.setdiff1d(np.arange(source.size), source.held)
	return Assembly(matrix(source.stiffnessEntries()), matrix(source.massEntries()), free, source)


@dataclass(frozen=True)
class Assembly:
	"""Small motion of jointed bricks about the state in which they were assembled. n coordinates: see IntactAssembly.

	:param stiffness: (n, n), scipy.sparse
	:param mass: (n, n), scipy.sparse: exact mass and inertia of the solids, lumped mass of the deformation
	:param free: indices of the coordinates that are not held by blocked degrees of freedom
	:param source: the IntactAssembly
	"""

	stiffness: object
	mass: object
	free: np.ndarray
	source: object

	def place(self, id):
		"""Index of the first coordinate of the body with this id."""
		return self.source.place(id)

	def nodalMap(self, id):
		"""Displacement of the nodes on the surface of a brick's inner part for a unit of each coordinate of that body.

		:param id: of the body
		:returns: (3 nodes, coordinates of the body): x0 y0 z0 x1 ..., in world axes [m]
		"""
		return np.array(self.source.nodalMap(id))

	def solve(self, loads):
		"""Displacement (n,) under generalised loads (n,); zero where held.

		:raises ValueError: for loads of another shape or not finite
		"""
		from scipy.sparse.linalg import splu
		try:
			loads = np.asarray(loads, dtype=float)
		except (TypeError, ValueError):
			raise ValueError(f"loads are {loads!r}; allowed are {self.stiffness.shape[0]} finite numbers") from None
		if loads.shape != (self.stiffness.shape[0],):
			raise ValueError(f"loads have the shape {loads.shape}; allowed is ({self.stiffness.shape[0]},)")
		if not np.isfinite(loads).all():
			raise ValueError(f"load {np.flatnonzero(~np.isfinite(loads))[0]} is not finite; allowed are finite numbers")
		displacement, stiffness, free = np.zeros(len(loads)), self._freePart(self.stiffness), loads[self.free]
		factor = splu(stiffness)
		found = factor.solve(free)
		# once more for what is left: joints much stiffer than bricks cost digits
		displacement[self.free] = found + factor.solve(free - stiffness @ found)
		return displacement

	def frequencies(self, count=6):
		"""The lowest natural frequencies [Hz], ascending; 0 for free motion of what nothing holds.

		:raises ValueError: unless 0 < count < the number of free coordinates
		"""
		from scipy.linalg import eigh
		from scipy.sparse.linalg import eigsh
		if not isinstance(count, numbers.Integral) or not 0 < count < len(self.free):
			raise ValueError(f"count is {count!r}; allowed are 1 to {len(self.free) - 1}")
		stiffness, mass = self._freePart(self.stiffness), self._freePart(self.mass)
		if self._isSmall():
			values = eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)[:count]
		else:
			# from below zero (1 rad/s), so that free motion is no obstacle; a fixed start vector, since SciPy's own is random
			values = eigsh(stiffness, count, mass, sigma=-1.0, return_eigenvectors=False, v0=np.ones(len(self.free)))
		return np.sqrt(np.maximum(np.sort(values), 0)) / (2 * np.pi)

	def maxFrequency(self):
		"""The largest angular frequency of the structure, all modes of the bricks included [1/s]."""
		from scipy.linalg import eigh
		from scipy.sparse.linalg import eigsh
		stiffness, mass = self._freePart(self.stiffness), self._freePart(self.mass)
		if self._isSmall():
			largest = eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)[-1]
		else:
			start = np.sin(1 + np.arange(len(self.free)))
			largest = eigsh(stiffness, 1, mass, which="LM", return_eigenvectors=False, v0=start)[0]
		return float(np.sqrt(largest))

	def _isSmall(self):
		"""Whether dense matrices do, which ARPACK's iteration does not always for a brick or two."""
		return len(self.free) <= 200

	def _freePart(self, matrix):
		return matrix[self.free][:, self.free].tocsc()
