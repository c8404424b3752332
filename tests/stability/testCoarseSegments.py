# SPDX-License-Identifier: GPL-2.0-or-later
# Segments that are larger than the brick upon them, or than the elements of its face: a small deformable brick on a large one.
#
# Criterion: undamped and without friction, contact is springs: energy is kept. A force that is read from other displacements of the nodes than it acts on has
# a stiffness matrix that is not symmetric, and makes work out of a loop of deformation, the more the coarser the segments, at any time step. Left are the
# strain, which small-strain elements neglect against 1, here speed over wave speed, and the step in which contact begins or ends, (w dt)^2 / 4.
import unittest

from hardCase import *

GROUP = 'Coarse segments'
LEVELS = 'rigid', 'uniform', 'trilinear', 'refined'
SHARE = .02  # of the limit of the step
VELOCITY = Vector3(.1, .05, -.4)
BENDING = .005  # share of the energy that a refined face's bending within a segment makes or loses, times segments along an edge: measured, at any stiffness


class CoarseSegments(Case):

	def drift(self, level, segments, young):
		"""Largest drift of the energy, in units of that of the fall."""
		O.reset()
		smooth = material(young=young, hn=0, hs=0, frictionAngle=0)
		common = dict(material=smooth, deformation=level, contactThickness=.003, segments=segments)
		add((1.2, .5, .2), center=(.35, .02, -.1), fixed=True, **common)
		b = add((.25, .12, .1), center=(.5, .02, .0501), **common)
		b.state.vel = VELOCITY
		engines()
		O.step()
		stepByHand(SHARE * limit())
		return Ledger().run(round(.03 / O.dt), 5) / (b.state.mass * VELOCITY.squaredNorm() / 2)

	def test_energy(self):
		"""A brick of 0.25 m falls on one of 1.2 m, whose 4 segments along an edge are longer than it is; all levels, finer segments, a stiffer material."""
		for young in (YOUNG, 100 * YOUNG):
			strain = VELOCITY.norm() / math.sqrt(young / DENSITY)
			for level in LEVELS:
				for segments in (2, 4, 16):
					label = 'E %g Pa, %s, %d segments along an edge: largest drift of energy over that of the fall' % (young, level, segments)
					allowed, reason = SHARE**2, '(w dt)^2 / 4 at the beginning and end of contact, w dt = .04'
					if level != 'rigid': allowed, reason = allowed + strain, reason + '; strain, speed over wave speed'
					if level == 'refined': allowed, reason = allowed + BENDING / segments, reason + '; depth is read at one point of a segment, within which the face bends'
					self.atMost(label, self.drift(level, segments, young), allowed, reason)
