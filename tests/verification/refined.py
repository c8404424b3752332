# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks that are refined: a cuboid made of smaller ones, glued face to face. As the glue gets stiff this is the conforming finite element mesh of the brick,
# so that an error which falls with refinement is that of one element a brick, not of the implementation.
import numpy as np

import mesh
from mesh import ELEMENTS
from cases import *
from yade_brick.build import cornerSigns

STIFFER = 5e5  # glue against the element behind it: gives way by some 2e-6 of what the element does, and costs about as much in round-off


def refine(size, center, divisions, **options):
	"""Adds a cuboid as a grid of equal bricks to the scene.

	:param size: of the whole (x, y, z) [m]
	:param center: of the whole [m]
	:param divisions: sub-bricks along x, y, z
	:param options: of yade_brick.build.brick; with inner='full' the parts' elements fill the whole. `glue` glues them.
	:returns: bodies, x fastest
	"""
	edge = [length / count for length, count in zip(size, divisions)]
	place = lambda k, i: center[k] - size[k] / 2 + (i + .5) * edge[k]
	return [
	        add(edge, center=(place(0, i), place(1, j), place(2, k)), **options)
	        for k in range(divisions[2])
	        for j in range(divisions[1])
	        for i in range(divisions[0])
	]


def glue(ids=(), of=None, normal=(0, 0, 0)):
	"""Glues faces that touch; to be called before the mortar of the other joints is laid.

	:param ids: only between these bodies, e.g. the parts of one brick; empty: all
	:param of: a deformable brick that is glued
	:param normal: see MortarJoints
	"""
	thickness, edge = 2 * of.shape.contactThickness, np.ptp(corners(of), axis=0).max()
	filling = Mortar(thickness=thickness, young=STIFFER * of.material.young * thickness / edge, poisson=of.material.poisson, **UNBREAKABLE)
	MortarJoints(ids=list(ids), mortar=filling, normal=normal)()


def corners(b):
	"""Corners of a body in the world (8, 3) [m]."""
	return np.array([list(x) for x in b.shape.worldCorners(b.state)])


def skew(x):
	return np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])


def cornerMap(assembly, b):
	"""Displacement of the eight corners (24) per unit coordinate of the brick (see assembled): the contact part turns with the brick and moves as its
	node does."""
	nodal = assembly.nodalMap(b.id).copy()
	if b.shape.deformation != 'rigid' and b.shape.inner == 'inset':
		away = b.shape.contactThickness * np.sign(corners(b) - b.state.pos)
		nodal[:, 3:6] -= np.concatenate([skew(x) for x in away])
	return nodal


def misorderedNodes(assembly, b):
	"""Displacement of the nodes (24) of an inset cuboid per unit coordinate as some references have it: like nodalMap, but the rotation with which a
	corner moves about its node is half the curl at the middle, and taken with the nodes in a wrong order: those counted with z fastest for those in
	the order of Brick.corners. To show that this is what sets a reference apart."""
	away = b.shape.contactThickness * np.sign(corners(b) - b.state.pos)
	nodes = corners(b) - b.state.pos - away
	counted = np.lexsort((nodes[:, 2], nodes[:, 1], nodes[:, 0]))
	taken = np.empty_like(nodes)
	taken[counted] = np.array(cornerSigns) * np.abs(nodes)
	# x / (8 x^2) of the nodes is the derivative by x at the middle
	rotation = np.concatenate([skew(1 / (16 * x)) for x in taken], axis=1)
	corner = np.eye(24) - np.concatenate([skew(x) for x in away]) @ rotation
	return np.linalg.solve(corner, cornerMap(assembly, b))


def innerStiffness(b):
	"""Of the inner hexahedron of a cuboid (24, 24), world axes [N/m]."""
	inset = b.shape.contactThickness * np.sign(corners(b) - b.state.pos) if b.shape.inner == 'inset' else 0
	return mesh.elementStiffness(corners(b) - b.state.pos - inset, b.material.young, b.material.poisson, b.shape.element)


def consistentMass(b):
	"""Of a cuboid with trilinear displacement, (24, 24) [kg]."""
	return mesh.consistentMass(corners(b) - b.state.pos, b.state.mass)
