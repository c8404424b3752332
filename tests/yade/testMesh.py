# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks from mesh files: node order, units, groups, what is refused, and the way there and back.
import os, tempfile

import meshio
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkHexahedron

from yade import O
from yade_brick import *
from yade_brick.build import cornerSigns

from buildCase import BuildCase

unit = (np.array(cornerSigns, dtype=float) + 1) / 2  # corners of the unit cube in the order of Brick.corners


def adobe(**attributes):
	given = dict(tensileStrength=1e9, cohesion=1e9, frictionAngle=.6, compressiveStrength=1e9)
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56, mortar=Mortar(**given), **attributes)


def cubes(count, **data):
	"""A row of unit cubes along x, as a mesh."""
	points = np.concatenate([unit + (k, 0, 0) for k in range(count)])
	return meshio.Mesh(points, [('hexahedron', np.arange(8 * count).reshape(count, 8))], cell_data={name: [np.array(values)] for name, values in data.items()})


class MeshCase(BuildCase):

	def corners(self, body):
		return np.array([tuple(corner) for corner in body.shape.worldCorners(body.state)])

	def test_masonry_comes_back_as_it_was_written(self):
		vault = barrelVault(segmentalLine(2, .6), .2, 1.1, 9, .4, material=adobe())
		wall = englishBondWall(3, 3, origin=(5, 0, 0), material=adobe())
		O.bodies.append(vault.bodies + wall.bodies)
		supports = [body.id for body in vault.bodies if not body.dynamic]
		with tempfile.TemporaryDirectory() as folder:
			for name in ('masonry.msh', 'masonry.vtk', 'masonry.vtu'):
				path = os.path.join(folder, name)
				writeBricks(path, O.bodies, course=list(range(len(O.bodies))))
				keepsData = name != 'masonry.msh'  # in the format of Ansys, which has none
				back = readBricks(path, adobe(), groupBy='id' if keepsData else None, fixed=supports if keepsData else ())
				self.assertEqual((len(back.bodies), back.cells), (len(O.bodies), tuple(range(len(O.bodies)))))
				self.assertEqual(list(back.groups), list(range(len(O.bodies))) if keepsData else [])
				for old, new in zip(O.bodies, back.bodies):
					# coordinates of some metres in double precision
					self.assertLess(np.abs(self.corners(old) - self.corners(new)).max(), 1e-12)
					self.assertAlmostEqual(new.state.mass / old.state.mass, 1, delta=1e-12)
				if keepsData:
					self.assertEqual(meshio.read(path).cell_data['course'][0].tolist(), list(range(len(O.bodies))))
		joined = MortarJoints()
		joined()
		O.reset()
		O.bodies.append(back.bodies)
		again = MortarJoints()
		again()
		self.assertEqual(again.made, joined.made)

	def test_corners_that_bricks_share_become_one_node(self):
		O.bodies.append(straightJointWall(3, 2, (.1, .1, .1), material=adobe()).bodies)
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'wall.vtu')
			writeBricks(path, O.bodies, scale=.001)
			mesh = meshio.read(path)
			self.assertEqual(len(mesh.points), 4 * 2 * 3)
			self.assertAlmostEqual(mesh.points.max(), 300, delta=1e-9)  # millimetres

	def test_corners_are_the_nodes_of_the_cell_in_metres(self):
		for k, body in enumerate(readBricks(cubes(2), adobe(), scale=.5).bodies):
			self.assertLess(np.abs(self.corners(body) - (unit + (k, 0, 0)) / 2).max(), 1e-14)

	def test_nodes_of_vtk_are_ours(self):
		self.assertEqual(np.reshape(vtkHexahedron().GetParametricCoords(), (8, 3)).tolist(), unit.tolist())

	def test_cell_data_choose_material_and_supports(self):
		stone, clay = adobe(), adobe()
		stone.density = 2500
		for values, low, high in (([3, 1, 3], 1, 3), ([3., 1., 3.], 1, 3), (['up', 'low', 'up'], 'low', 'up')):
			bricks = readBricks(cubes(3, part=values), {high: clay, low: stone}, groupBy='part', fixed=[low], deformation='rigid')
			self.assertEqual([b.material.density for b in bricks.bodies], [1800, 2500, 1800])
			self.assertEqual([b.dynamic for b in bricks.bodies], [True, False, True])
			self.assertEqual({value: len(group) for value, group in bricks.groups.items()}, {low: 1, high: 2})
			self.assertEqual(bricks.bodies[0].shape.deformation, 'rigid')
		self.assertEqual([b.dynamic for b in readBricks(cubes(2), clay, fixed=True).bodies], [False, False])

	def test_physical_groups_of_gmsh_are_groups(self):
		mesh = cubes(2)
		data = {'gmsh:physical': [[9], [4, 6]], 'gmsh:geometrical': [[1], [1, 1]]}
		volumes = meshio.Mesh(mesh.points, [('quad', np.array([[0, 1, 2, 3]])), *mesh.cells], cell_data=data)
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'part.msh')
			meshio.write(path, volumes, file_format='gmsh22')
			bricks = readBricks(path, adobe(), groupBy='gmsh:physical', fixed=[4], others='skip')
		self.assertEqual((list(bricks.groups), bricks.cells, [b.dynamic for b in bricks.bodies]), ([4, 6], (1, 2), [False, True]))

	def test_sets_of_cells_are_groups(self):
		nodes = ['%d, %g, %g, %g' % (k + 1, *x) for k, x in enumerate(cubes(3).points)]
		elements = ['%d, ' % (k + 1) + ', '.join(str(8 * k + node + 1) for node in range(8)) for k in range(3)]
		lines = ['*NODE', *nodes, '*ELEMENT, TYPE=C3D8', *elements, '*ELSET, ELSET=pier', '1, 3', '*ELSET, ELSET=arch', '2']
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'part.inp')
			read = lambda: readBricks(path, {'pier': adobe(), 'arch': adobe()}, groupBy='sets', fixed=['pier'])
			for text, words in ((lines[:-2], 'cell 1 is in no set'), (lines + ['*ELSET, ELSET=all', '1, 2, 3'], 'cell 0 is in the sets'), (lines, None)):
				with open(path, 'w') as file:
					file.write('\n'.join(text) + '\n')
				if words: self.refused(words, read)
			bricks = read()
		self.assertEqual([b.dynamic for b in bricks.bodies], [False, True, False])
		self.assertEqual({name: len(group) for name, group in bricks.groups.items()}, {'arch': 1, 'pier': 2})

	def test_cells_that_are_no_hexahedra_are_refused_or_left_out(self):
		mesh = cubes(2)
		quad, tetra = ('quad', np.array([[0, 1, 2, 3]])), ('tetra', np.array([[0, 1, 2, 4], [1, 2, 3, 5]]))
		mixed = meshio.Mesh(mesh.points, [quad, mesh.cells[0], tetra], cell_data={'part': [[7], [5, 6], [8, 9]]})
		self.refused('cell 0 is a quad', lambda: readBricks(mixed, adobe()))
		tail = meshio.Mesh(mesh.points, mixed.cells[1:])
		self.refused('cells 2 to 3 are of type tetra', lambda: readBricks(tail, adobe()))
		bricks = readBricks(mixed, {5: adobe(), 6: adobe()}, groupBy='part', others='skip')
		self.assertEqual((bricks.cells, list(bricks.groups)), ((1, 2), [5, 6]))
		self.refused('no hexahedra', lambda: readBricks(meshio.Mesh(mesh.points, mixed.cells[:1]), adobe(), others='skip'))

	def test_cells_that_are_no_bricks_are_refused_with_their_number(self):
		inverted, warped, flat, nowhere = cubes(3), cubes(3), cubes(3), cubes(3)
		inverted.cells[0].data[1] = inverted.cells[0].data[1][[4, 5, 6, 7, 0, 1, 2, 3]]
		warped.points[8 + 6] += (.2, 0, 0)
		flat.points[8:16, 2] = 0
		nowhere.points[9] = np.nan
		for mesh in (inverted, warped, flat, nowhere):
			self.refused('^cell 1: ', lambda: readBricks(mesh, adobe()))
		self.refused('^cell 1: .*planar', lambda: readBricks(warped, adobe()))

	def test_wrong_arguments_are_refused(self):
		m = adobe()
		mesh = cubes(2, part=[1, 2])
		for scale in (0, -1, float('nan'), '1'):
			self.refused('scale is', lambda: readBricks(mesh, m, scale=scale))
		self.refused("others is 'keep'", lambda: readBricks(mesh, m, others='keep'))
		self.refused("groupBy is 'sets'; the mesh has neither", lambda: readBricks(cubes(1), m, groupBy='sets'))
		self.refused("groupBy is 'color'; the mesh has the cell data 'part'", lambda: readBricks(mesh, m, groupBy='color'))
		self.refused('material lacks 2', lambda: readBricks(mesh, {1: m}, groupBy='part'))
		self.refused('material has 3', lambda: readBricks(mesh, {1: m, 2: m, 3: m}, groupBy='part'))
		self.refused('groupBy is None', lambda: readBricks(mesh, {1: m}))
		self.refused('fixed has 9', lambda: readBricks(mesh, m, groupBy='part', fixed=[9]))
		self.refused('value 1.5', lambda: readBricks(cubes(2, part=[1.5, 2]), m, groupBy='part'))
		self.refused('size given', lambda: readBricks(mesh, m, size=(1, 1, 1)))
		self.refused('material is', lambda: readBricks(mesh, None))
		self.refused('mesh is 5', lambda: readBricks(5, m))
		self.refused('no such', lambda: readBricks('no such.vtu', m), OSError)
		with tempfile.TemporaryDirectory() as folder:
			for name in ('broken.vtu', 'broken.unknown'):
				path = os.path.join(folder, name)
				with open(path, 'w') as file:
					file.write('no mesh')
				self.refused('meshio cannot read', lambda: readBricks(path, m))
			self.refused('no bricks', lambda: writeBricks(os.path.join(folder, 'empty.vtu'), []))
			self.refused('course has 1 values', lambda: writeBricks(os.path.join(folder, 'a.vtu'), readBricks(mesh, m).bodies, course=[1]))
