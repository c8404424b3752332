# SPDX-License-Identifier: GPL-2.0-or-later
# The same scene turned by any rotation, moved by up to 1e6 m, mirrored, in other units, its bricks in another order: the same answer.
#
# The scene: two staggered courses of bricks of all levels in weak mortar on a held brick, struck askew by a loose brick: joints that hold, that crack, that
# hand over to contact, friction. It is not symmetric, so that no two segments fail in the same step by chance.
# Criterion: time step, cracks and contacts are the same, and after N steps corners and velocities differ by round-off only. A step rounds places to ulp(X), X the
# largest coordinate, which moves a brick by ulp(X) a step if all errors have one sign, and its velocity by (w dt)^2 ulp(X) / dt with w dt < 1, likewise. That is
# early: later, contact and friction multiply any difference, as they do in nature, and
# which step a segment fails in, or is divided among faces in, comes to hang on round-off: the runs part, which is no error, and not judged.
# One view is more than round-off apart: renumbered, once a joint has cracked, since the slip of its segments is kept in axes that turn with one of the two
# bricks; so by the angle between them.
import unittest

import numpy as np

from hardCase import *

GROUP = '12 Same scene, seen otherwise'
STEPS, STEP = 570, 4e-5  # [s]
EXTENT = 1.5  # largest coordinate of the scene where it was thought [m]
LEVELS = 'trilinear', 'rigid', 'uniform', 'refined'
MIRRORED = 1, 0, 3, 2, 5, 4, 7, 6  # corners of a brick mirrored in x
TURN = Quaternion(Vector3(3, -2, 5).normalized(), 1.1)

# size, centre, turn (axis, angle), velocity; the first is held, the last one loose. Places are odd so that no middle of a segment is as far from two others: on
# handing over to contact it takes the traction of the nearest one, and of two equally near ones round-off would choose.
BRICKS = [((1.2, .5, .2), (.3371, .0213, -.1), None, None)]
BRICKS += [((.25, .12, .1), (x, .01 * k, .05), None, None) for k, x in enumerate((0., .25, .5))]
BRICKS += [((.25, .13, .11), (x, .005 * k, .155), None, None) for k, x in enumerate((.1037, .3537))]
BRICKS += [((.18, .1, .09), (.52, .09, .27), ((1, 2, .5), .4), (-1.2, -1.5, -1.))]


class View:
	"""How the scene is placed and counted.

	:param turn: Quaternion, then `shift` [m]   :param mirrored: in x, first of all   :param unit: of length, in metres   :param order: of the bricks
	"""

	def __init__(self, turn=Quaternion.Identity, shift=(0, 0, 0), mirrored=False, unit=1., order=None):
		self.turn, self.shift, self.mirrored, self.scale = turn, Vector3(*shift), mirrored, 1 / unit
		self.order = order or list(range(len(BRICKS)))

	def vector(self, v):
		v = Vector3(*v)
		if self.mirrored: v[0] = -v[0]
		return self.turn * v * self.scale

	def place(self, x):
		return self.vector(x) + self.shift

	def orientation(self, axis, angle):
		axis = Vector3(*axis).normalized()
		if self.mirrored: axis = Vector3(axis[0], -axis[1], -axis[2])
		return self.turn * Quaternion(axis, angle)

	def back(self, v):
		v = self.turn.conjugate() * v / self.scale
		return np.array([-v[0] if self.mirrored else v[0], v[1], v[2]])

	def corners(self, b):
		got = [self.back(x - self.shift) for x in b.shape.worldCorners(b.state)]
		return np.array([got[MIRRORED[k]] for k in range(8)] if self.mirrored else got)


class Invariance(Case):

	def scene(self, view):
		"""Bricks in the order of BRICKS."""
		O.reset()
		s = view.scale
		# kg / (m s2) and kg / m3 in the unit of length; mass and time stay
		mortar = Mortar(tensileStrength=6e3 / s, cohesion=4e3 / s, frictionAngle=FRICTION, compressiveStrength=5e5 / s)
		adobe = material(young=YOUNG / s, density=DENSITY / s**3, mortar=mortar)
		made = {}
		for k in view.order:
			size, center, turn, velocity = BRICKS[k]
			b = add(
			        [s * x for x in size], center=view.place(center), orientation=view.orientation(*turn) if turn else view.turn, material=adobe,
			        deformation=LEVELS[k % len(LEVELS)], contactThickness=.003 * s, fixed=k == 0
			)
			if velocity: b.state.vel = view.vector(velocity)
			made[k] = b
		MortarJoints()()
		engines(gravity=view.vector((0, 0, -GRAVITY)))
		stepByHand(STEP)
		return [made[k] for k in range(len(BRICKS))]

	def law(self):
		return engine(InteractionLoop).lawDispatcher.functors[0]

	def answer(self, view, count=STEPS):
		"""Corners, velocities, counts, limit of the step."""
		made = self.scene(view)
		steps(count)
		law = self.law()
		counts = [law.tensionFailures, law.shearFailures, law.compressionFailures, sum(i.isReal and not i.phys.jointed for i in O.interactions)]
		corners, velocities = np.array([view.corners(b) for b in made]), np.array([view.back(b.state.vel) for b in made])
		self.turned = max((b.state.ori * b.state.refOri.conjugate()).toAxisAngle()[1] for b in made[:-1])
		engine(BrickTimeStepper).active = True
		O.step()
		return corners, velocities, counts, limit()

	def check(self, views, count=STEPS, cracked=True, noise=lambda ulp: (ulp, ulp / STEP, 'N ulp; over dt for the velocity')):
		"""Answers of all views [(name, View, largest coordinate)] against that of the scene as it was thought."""
		wanted = self.answer(View(), count)
		if cracked:
			self.atMost('inverse of the segments failed', 1 / max(sum(wanted[2][:3]), 1), .1, 'the scene cracks')
			self.atMost('inverse of the contacts', 1 / max(wanted[2][3], 1), .5, 'and touches')
		else: self.judge('segments failed', sum(wanted[2][:3]), 0, 0, 'not yet')
		for name, view, extent in views:
			got = self.answer(view, count)
			apart, faster, reason = noise(count * float(np.spacing(extent)))
			for k, what in enumerate(('tension', 'shear', 'compression')):
				self.judge('%s: segments failed in %s' % (name, what), got[2][k], wanted[2][k], 0, 'the same')
			self.judge(name + ': contacts', got[2][3], wanted[2][3], 0, 'the same')
			self.judge(name + ': limit of the step [s]', got[3], wanted[3], 1e-9, 'the same bricks; it is taken in steps of the area')
			self.atMost(name + ': largest difference of a corner [m]', np.abs(got[0] - wanted[0]).max(), apart, reason)
			self.atMost(name + ': largest difference of a velocity [m/s]', np.abs(got[1] - wanted[1]).max(), faster, reason)

	def test_turned(self):
		"""By a quarter and by 63 degrees about a skew axis."""
		quarter = Quaternion(Vector3(1, 0, 0), math.pi / 2)
		self.check([('a quarter turn', View(quarter), EXTENT), ('turned askew', View(TURN), EXTENT)])

	def test_moved(self):
		"""By 1 km and 1000 km."""
		self.check([('moved by %g m' % far, View(shift=(far, -.7 * far, .4 * far)), far) for far in (1e3, 1e6)])

	def test_units(self):
		"""Lengths in decimetres, decametres and millimetres."""
		self.check([('unit of %g m' % unit, View(unit=unit), EXTENT) for unit in (.1, 10., .001)])

	def renumbered(self):
		last = len(BRICKS) - 1
		return [('backwards', View(order=list(range(last, -1, -1))), EXTENT), ('shuffled', View(order=[3, 0, 6, 2, 5, 1, 4]), EXTENT)]

	def test_renumbered(self):
		"""Backwards and shuffled, until the first segment fails."""
		self.check(self.renumbered(), 250, cracked=False)

	def test_renumbered_with_cracks(self):
		"""The same with cracks and contact."""
		speed = .2  # of bricks that are struck [m/s]: the loose one is a tenth of their mass, at 2.2 m/s

		def noise(ulp):
			reason = 'the shear of joints that have cracked is turned by the angle that bricks have turned by: no more than that of their motion'
			return speed * STEPS * STEP * self.turned, speed * self.turned, reason

		self.check(self.renumbered(), noise=noise)

	def test_mirrored(self):
		"""In x, and that turned, until the first segment fails."""
		self.check([('mirrored', View(mirrored=True), EXTENT), ('mirrored and turned', View(TURN, mirrored=True), EXTENT)], 250, cracked=False)

	def sliding(self, level, segments, view):
		"""Corners of a brick that has been thrown on another, without friction and damping."""
		O.reset()
		smooth = material(hn=0, hs=0, frictionAngle=0)
		common = dict(material=smooth, contactThickness=.003, segments=segments)
		add((1., .5, .2), center=view.place((.05, .02, -.1)), orientation=view.turn, deformation='rigid', fixed=True, **common)
		b = add((.25, .12, .1), center=view.place((0, 0, .05)), orientation=view.turn, deformation=level, **common)
		thrown = add((.22, .11, .08), center=view.place((.03, .013, .14)), orientation=view.turn, deformation=level, **common)
		thrown.state.vel = view.vector((.1, .05, -.3))
		engines(gravity=view.vector((0, 0, -GRAVITY)))
		stepByHand(STEP)
		steps(300)
		return np.array([view.corners(b), view.corners(thrown)])

	def test_mirrored_contact(self):
		"""A brick is thrown on another, dry, and mirrored; all levels, fine and coarse segments."""
		for level in ('rigid', 'uniform', 'trilinear', 'refined'):
			for segments in (4, 16):
				apart = np.abs(self.sliding(level, segments, View()) - self.sliding(level, segments, View(mirrored=True))).max()
				label = '%s, %d segments along an edge: largest difference of a corner [m]' % (level, segments)
				self.atMost(label, apart, 300 * float(np.spacing(EXTENT)), 'N ulp')
