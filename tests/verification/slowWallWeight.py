# SPDX-License-Identifier: GPL-2.0-or-later
# Self weight of the paper's walls with bricks of 4^3 glued elements each, 55 000 coordinates: minutes a wall.
import unittest

import numpy as np

import testWallWeight as walls
from cases import *
from refined import *

GROUP = 'Self weight of the walls'


class FourElementsAlongAnEdge(walls.WallCase):

	def finest(self, bond, r):
		return walls.WallModel(bond, 4, inner='full', element='incompatible', segments=2, contactThickness=r)

	def checkIndependent(self, bond, r, wall):
		reason = 'glue gives way by some 2e-6 of an element, and by edge / (STIFFER 2 r) of a joint; round-off of its stiffness'
		ids = ['wall2.%s.FE4.wilson.r%g.seg0.025' % (bond, r)]
		if r == 1e-3: ids.append('wall.brick.%s_FE_in_bricks_wilson_4^3_per_cube,_zero-thickness_layers_2r=2mm' % bond)
		for id in ids: self.check(id, wall, tolerance=5e-6, stressTolerance=walls.glueTolerance(wall), reason=reason)

	def checkElasticity(self, r, wall):
		"""Errors against elasticity with 4 elements along an edge, absolutely and against those with 2."""
		expected = walls.truth(r)
		one, two = (walls.apart(walls.quantities(walls.elasticWall(n, r)), expected) for n in (1, 2))
		four = walls.apart(walls.quantities(wall), expected)
		for key, limit in (('edge', .002), ('stress', .009), ('top', .002), ('thickening', .002)):
			label = 'r=%g mm, n=4: error of the %s' % (1e3 * r, key)
			self.atMost(label, four[key], limit, 'linear elements of 0.05 m at a clamped edge')
			self.atMost(label + ', part of that at n=2', four[key] / two[key], .5, 'at least first order: the clamped edge; second elsewhere')
			if r == 1e-3:
				errors = one[key], two[key], four[key]
				self.curve('Refinement of the straight-joint wall, r = 1 mm', key, (1, 2, 4), errors, 'elements along an edge', 'relative error', True, True)

	def test_straight_joints(self):
		"""Displacements and stresses with r = 0.1, 1 and 5 mm. Expected: finite elements of the same mesh with joints of zero thickness, solved
		independently; and, as the end of the refinement n = 1, 2, 4, three-dimensional elasticity."""
		for r in (1e-3, 1e-4, 5e-3):
			wall = self.finest('straight', r)
			self.checkIndependent('straight', r, wall)
			self.checkElasticity(r, wall)
			if r != 1e-3: continue
			got = walls.quantities(wall)
			self.curve(walls.EDGE, 'incompatible, 4^3 a brick', got['edge'], walls.COURSES, line=False)
			self.curve(walls.MIDDLE, 'incompatible, 4^3 a brick', got['stress'], walls.COURSES, line=False)

	def test_without_layers(self):
		"""The straight-joint wall with all faces glued is a continuum: against three-dimensional elasticity, as the end of the refinement n = 1,
		2, 4."""
		self.checkElasticity(0, walls.elasticWall(4, 0))

	def test_english_bond(self):
		"""The English bond wall with r = 0.1 and 1 mm, against independent finite elements of the same mesh: no tension in the beds, where one
		element a brick locks."""
		for r in (1e-3, 1e-4):
			wall = self.finest('english', r)
			self.checkIndependent('english', r, wall)
			tension = wall.strengthUse('bed')['max_tension']
			self.atMost('r=%g mm: largest tension of beds [Pa]' % (1e3 * r), tension, -3.3e3, 'the upper course weighs on its bed: 3528 Pa on a mean')
