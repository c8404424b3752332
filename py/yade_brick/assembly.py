# SPDX-License-Identifier: GPL-2.0-or-later
# The jointed bricks of a scene as SciPy matrices: statics under any load, natural frequencies. The matrices come from the library.
"""Intact assemblies of bricks as linear systems: `assembled`."""

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
		"""Index of a body's first coordinate."""
		return self.source.place(id)

	def nodalMap(self, id):
		"""(24, coordinates of the body): displacement of its inner hexahedron's nodes, x0 y0 z0 x1 ..., in world axes."""
		return np.array(self.source.nodalMap(id))

	def solve(self, loads):
		"""Displacement (n,) under generalised loads (n,); zero where held.

		:raises ValueError: for loads of another shape
		"""
		from scipy.sparse.linalg import splu
		loads = np.asarray(loads, dtype=float)
		if loads.shape != (self.stiffness.shape[0],):
			raise ValueError(f"loads have the shape {loads.shape}; allowed is ({self.stiffness.shape[0]},)")
		displacement = np.zeros(len(loads))
		displacement[self.free] = splu(self._freePart(self.stiffness)).solve(loads[self.free])
		return displacement

	def frequencies(self, count=6):
		"""The lowest natural frequencies [Hz], ascending.

		:raises ValueError: unless 0 < count < the number of free coordinates
		"""
		from scipy.sparse.linalg import eigsh
		if not 0 < count < len(self.free):
			raise ValueError(f"count is {count}; allowed are 1 to {len(self.free) - 1}")
		# a fixed start vector, since SciPy's own is random
		values = eigsh(self._freePart(self.stiffness), count, self._freePart(self.mass), sigma=0, return_eigenvectors=False, v0=np.ones(len(self.free)))
		return np.sqrt(np.sort(values)) / (2 * np.pi)

	def maxFrequency(self):
		"""The largest angular frequency of the structure, all modes of the bricks included [1/s]."""
		from scipy.sparse.linalg import eigsh
		start = np.sin(1 + np.arange(len(self.free)))
		largest = eigsh(self._freePart(self.stiffness), 1, self._freePart(self.mass), which="LM", return_eigenvectors=False, v0=start)
		return float(np.sqrt(largest[0]))

	def _freePart(self, matrix):
		return matrix[self.free][:, self.free].tocsc()
