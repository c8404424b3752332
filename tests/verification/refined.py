# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks that are refined: a cuboid made of smaller ones, glued face to face. As the glue gets stiff this is the conforming finite element mesh of the brick,
# so that an error which falls with refinement is that of one element a brick, not of the implementation.
import numpy as np

from cases import *

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


def cornerMap(assembly, b):
	"""Displacement of the eight corners (24) per unit coordinate of the brick (see assembled): the contact part turns with the brick and moves as its node does."""
	nodal = assembly.nodalMap(b.id).copy()
	if b.shape.deformation != 'rigid' and b.shape.inner == 'inset':
		away = b.shape.contactThickness * np.sign(corners(b) - np.array(list(b.state.pos)))
		for a, (x, y, z) in enumerate(away):
			nodal[3 * a:3 * a + 3, 3:6] += [[0, z, -y], [-z, 0, x], [y, -x, 0]]
	return nodal


def consistentMass(b):
	"""Of a cuboid with trilinear displacement, (24, 24) [kg]."""
	sign = np.sign(corners(b) - np.array(list(b.state.pos)))
	same = (1 + (sign[:, None, :] == sign[None, :, :])) / 6
	return b.state.mass * np.kron(same.prod(axis=2), np.eye(3))
