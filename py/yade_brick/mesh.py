# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks from a mesh file of hexahedra, and back: any format that meshio knows. One cell is one brick; neighbours that share nodes share faces, so
# MortarJoints joins them. A hexahedron of meshio, as of VTK, has its nodes in the order of Brick.corners.
"""Bricks from a mesh file: `readBricks`, `writeBricks`. Lengths in metres."""

import os
from dataclasses import dataclass

import numpy as np

from .build import brick
from .checks import isFinite


@dataclass(frozen=True)
class MeshBricks:
	"""Bricks of a mesh.

	:param bodies: in the order of the cells
	:param cells: number of the cell of each, counted from 0 over all cells of the file
	:param groups: dict from each value of the cell data to a tuple of its bodies; empty without `groupBy`
	"""

	bodies: tuple
	cells: tuple
	groups: dict

	@property
	def ids(self):
		"""Ids of the bodies, in that order; -1 each before they are in the scene."""
		return [body.id for body in self.bodies]


def readBricks(mesh, material, groupBy=None, fixed=(), scale=1.0, others="refuse", **brickOptions):
	"""A brick for each hexahedron of a mesh.

	:param mesh: file in a format that meshio reads (.vtu, .vtk, .msh, .inp, .xdmf, ...), or a meshio.Mesh
	:param material: BrickMat, or its id or label; or a dict from each value of the cell data to one
	:param groupBy: name of the cell data, whole numbers or texts, by which bricks are grouped, such as 'gmsh:physical'; 'sets' for the names of the sets of
		cells that a file has instead, such as ELSETs of Abaqus; None: no groups
	:param fixed: values of that cell data whose bricks are supports that do not move; True: all are
	:param scale: metres in a unit of the file, > 0: 0.001 for millimetres
	:param others: 'refuse' a mesh with cells that are no hexahedra, or 'skip' them, as the points, lines and faces that mesh generators leave
	:param brickOptions: other arguments of `brick`, except size, corners, center, orientation
	:returns: MeshBricks
	:raises ValueError: naming the argument, its value and what is allowed, or the cell, its number and what is wrong with it: no hexahedron, inverted, faces
		that are not planar, not convex
	:raises OSError: when the file cannot be read
	"""
	if not (isFinite(scale) and scale > 0):
		raise ValueError(f"scale is {scale!r}; allowed is a finite number > 0")
	if others not in ("refuse", "skip"):
		raise ValueError(f"others is {others!r}; allowed are 'refuse' and 'skip'")
	taken = {"size", "corners", "center", "orientation"} & set(brickOptions)
	if taken:
		raise ValueError(f"{', '.join(sorted(taken))} given for bricks of a mesh; the mesh chooses it for each brick")
	mesh = _mesh(mesh)
	corners, cells = _hexahedra(mesh, scale, others)
	values = _groupValues(mesh, groupBy, cells)
	_checkValues("material", set(material) if isinstance(material, dict) else set(), values, all=isinstance(material, dict))
	everywhere = isinstance(fixed, bool)
	_checkValues("fixed", set() if everywhere else set(fixed), values)
	bodies, groups = [], {}
	for number, points, value in zip(cells, corners, values or [None] * len(cells)):
		options = dict(brickOptions, material=material[value] if isinstance(material, dict) else material, fixed=fixed if everywhere else value in fixed)
		try:
			bodies.append(brick(corners=points, **options))
		except ValueError as problem:
			raise ValueError(f"cell {number}: {problem}") from None
		if values:
			groups.setdefault(value, []).append(bodies[-1])
	return MeshBricks(tuple(bodies), tuple(cells), {value: tuple(group) for value, group in sorted(groups.items())})


def writeBricks(path, bodies, scale=1.0, **cellData):
	"""Writes bricks as a mesh of hexahedra, as they are now; corners that bricks share become one node where they are equal to nine digits of the mesh.

	:param path: file, whose ending chooses one of meshio's formats
	:param bodies: bodies; what is no Brick is left out
	:param scale: metres in a unit of the file, > 0
	:param cellData: further values for each brick by name, such as course=[0, 0, 1]; the ids of the bodies are there as 'id'
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	import meshio
	from yade import Brick
	from .snapshot import worldCorners
	if not (isFinite(scale) and scale > 0):
		raise ValueError(f"scale is {scale!r}; allowed is a finite number > 0")
	bodies = [body for body in bodies if body is not None and isinstance(body.shape, Brick)]
	if not bodies:
		raise ValueError("there are no bricks among the bodies; at least one is needed")
	for name, values in cellData.items():
		if len(values) != len(bodies):
			raise ValueError(f"{name} has {len(values)} values; allowed is one for each of the {len(bodies)} bricks")
	points, cells = _shared(np.concatenate([worldCorners(body) for body in bodies]) / scale)
	data = {"id": [np.array([body.id for body in bodies])], **{name: [np.asarray(values)] for name, values in cellData.items()}}
	os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
	meshio.write(path, meshio.Mesh(points, [("hexahedron", cells.reshape(-1, 8))], cell_data=data))


def _shared(points):
	"""Points without repetition, and the index of each in them; points that differ in round-off are one."""
	size = max(np.ptp(points, axis=0).max(), 1e-300)
	cells = np.round((points - points.min(axis=0)) / (1e-9 * size) + 0.2071)  # no round coordinate is on the edge of a cell
	_, first, index = np.unique(cells, axis=0, return_index=True, return_inverse=True)
	return points[first], index.ravel()


def _mesh(mesh):
	import meshio
	if isinstance(mesh, meshio.Mesh):
		return mesh
	if not isinstance(mesh, (str, os.PathLike)):
		raise ValueError(f"mesh is {mesh!r}; allowed is the name of a file or a meshio.Mesh")
	with open(mesh, "rb"):
		pass  # a file that is not there is an OSError; meshio may end the process
	try:
		return meshio.read(mesh)
	except (Exception, SystemExit) as problem:
		raise ValueError(f"mesh is {os.fspath(mesh)!r}, which meshio cannot read: {problem or type(problem).__name__}") from problem


def _hexahedra(mesh, scale, others):
	"""Corners of the cells, as lists of tuples [m], and their numbers."""
	points = np.asarray(mesh.points, dtype=float) * scale
	if points.ndim != 2 or points.shape[1] != 3:
		raise ValueError(f"points of the mesh have {points.shape[-1]} coordinates; allowed are 3")
	corners, numbers, first = [], [], 0
	for block in mesh.cells:
		if block.type == "hexahedron":
			corners += [[tuple(point) for point in cell] for cell in points[np.asarray(block.data)].tolist()]
			numbers += range(first, first + len(block.data))
		elif others == "refuse" and len(block.data):
			which = f"cell {first} is a {block.type}" if len(block.data) == 1 else f"cells {first} to {first + len(block.data) - 1} are of type {block.type}"
			raise ValueError(f"{which}; allowed are hexahedra of 8 nodes (others='skip' leaves out what is none)")
		first += len(block.data)
	if not numbers:
		raise ValueError(f"the mesh has {first} cells and no hexahedra of 8 nodes; at least one is needed")
	return corners, numbers


def _groupValues(mesh, groupBy, cells):
	"""Value of each of the cells, or None."""
	if groupBy is None:
		return None
	if groupBy not in mesh.cell_data and groupBy == "sets" and mesh.cell_sets:
		return _setNames(mesh, cells)
	if groupBy not in mesh.cell_data:
		there = list(mesh.cell_data) + (["sets"] if mesh.cell_sets else [])
		allowed = f"the cell data {', '.join(map(repr, there))}" if there else "neither cell data nor sets of cells"
		raise ValueError(f"groupBy is {groupBy!r}; the mesh has {allowed}")
	values = [value for block in mesh.cell_data[groupBy] for value in np.asarray(block).tolist()]
	values = [int(value) if isinstance(value, float) and value.is_integer() else value for value in values]
	chosen = [values[cell] for cell in cells]
	wrong = [value for value in chosen if not isinstance(value, (int, str))]
	if wrong:
		raise ValueError(f"cell data {groupBy!r} has the value {wrong[0]!r}; allowed are whole numbers and texts")
	return chosen


def _setNames(mesh, cells):
	"""Name of the set of each of the cells."""
	names, first = {}, 0
	for block, data in enumerate(mesh.cells):
		for name, members in mesh.cell_sets.items():
			for cell in np.asarray(members[block] if members[block] is not None else [], dtype=int).tolist():
				names.setdefault(first + cell, []).append(name)
		first += len(data.data)
	for cell in cells:
		if len(names.get(cell, ())) != 1:
			found = f"the sets {', '.join(map(repr, names[cell]))}" if cell in names else "no set"
			raise ValueError(f"cell {cell} is in {found}; allowed with groupBy='sets' is one")
	return [names[cell][0] for cell in cells]


def _checkValues(name, given, values, all=False):
	"""That values are those of the cell data, and if asked all of them."""
	present = set(values or ())
	missing, unknown = sorted(present - given) if all else [], sorted(given - present, key=str)
	if (given or all) and values is None:
		raise ValueError(f"{name} is given for values of cell data, but groupBy is None; allowed with it is the name of the cell data")
	if missing:
		raise ValueError(f"{name} lacks {', '.join(map(repr, missing))}; needed is one for each value of the cell data")
	if unknown:
		raise ValueError(f"{name} has {', '.join(map(repr, unknown))}; the cell data has {', '.join(map(repr, sorted(present)))}")
