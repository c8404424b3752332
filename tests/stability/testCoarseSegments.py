# SPDX-License-Identifier: GPL-2.0-or-later
# Segments that are larger than the brick upon them, or than the elements of its face: a small deformable brick on a large one.
#
# Criterion: undamped and without friction, contact is springs: energy is kept. A force that is read from other displacements of the nodes than it acts on has
# a stiffness matrix that is not symmetric, and makes work out of a loop of deformation, the more the coarser the segments, at any time step.
import unittest

from hardCase import *

GROUP = 'Found: coarse segments'
LEVELS = 'uniform', 'trilinear', 'refined'


class CoarseSegments(Case):

	def rise(self, level, segments, share):
		"""Largest rise of the energy over its least value before, in units of that of the fall.

		:param share: of the limit of the step
		"""
		O.reset()
		smooth = material(hn=0, hs=0, frictionAngle=0)
		common = dict(material=smooth, deformation=level, contactThickness=.003, segments=segments)
		add((1.2, .5, .2), center=(.35, .02, -.1), fixed=True, **common)
		b = add((.25, .12, .1), center=(.5, .02, .0501), **common)
		b.state.vel = Vector3(.1, .05, -.4)
		engines()
		O.step()
		stepByHand(share * limit())
		fall, energy = b.state.mass * b.state.vel.squaredNorm() / 2, Energy()
		least, most = math.inf, 0.
		for _ in range(round(.03 / O.dt)):
			value = energy.step()
			least = min(least, value)
			most = max(most, value - least)
		return most / fall

	def test_energy(self):
		"""A brick of 0.25 m falls on one of 1.2 m, whose 4 segments along an edge are longer than it is; all levels, and finer segments."""
		for level in LEVELS:
			for segments in (2, 4, 16):
				label = '%s, %d segments along an edge: largest rise of energy over that of the fall' % (level, segments)
				# of a segment that is longer than the brick only the part below the brick counts, and changes as it slides
				if segments < 1.2 / .25: allowed, reason = .07, 'documented: the work of contact on edges is not conserved exactly, to 7 %'
				else: allowed, reason = .01, '(w dt)^2 / 4 of the energy read, w dt = .2'
				self.atMost(label, self.rise(level, segments, .1), allowed, reason)
