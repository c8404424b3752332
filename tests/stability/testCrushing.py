# SPDX-License-Identifier: GPL-2.0-or-later
# A brick is pressed by two platens, straight or tilted, far beyond its contact part and its own size, until the platens have passed each other, and released.
#
# Small strain on springs: nothing in the equations stops at a thickness of zero, so that the faces of the element cross; where a platen made of a brick
# comes deeper in than about a quarter of the brick, contact lets go. Both are outside the method. What has to hold: every number stays finite; bricks with a
# contact part are counted as crushed; the bodies never have more energy than the platens have given them: their forces times their velocities, summed over the
# steps. Energy is made by changing areas at edges, to 7 % of the work (documented); where contact lets go, by as much as it held.
import unittest

from hardCase import *
from yade.wrapper import Bo1_Box_Aabb

GROUP = 'Crushing'
SIDE, SPEED = .2, 1.
LEVELS = ('rigid', 'uniform', 'trilinear', 'refined')
ALLOWED = .07
LETTING_GO = 'likewise; where contact lets go, what it held may come back to a brick that has deformed otherwise: at most the share of contact in the work'
REASON = 'documented: at edges contact makes or loses up to 7 % of its work'


class Crushing(Case):

	def press(self, kind, level, tilt, least):
		"""Platens of bricks or boxes come together until they are `least` apart, and go back."""
		O.reset()
		m = material()
		turn = Quaternion(Vector3(1, .3, 0).normalized(), tilt)
		reach = max((turn * Vector3(x, y, z))[2] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)) * SIDE / 2
		platens = []
		for side in (-1, 1):
			centre = Vector3(0, 0, side * (reach + .1))
			if kind == 'brick': platens.append(add((.3, .3, .2), center=centre, material=m, deformation='rigid', fixed=True))
			else: platens.append(O.bodies[O.bodies.append(utils.box(center=centre, extents=(.15, .15, .1), material=m, fixed=True))])
		b = add(3 * [SIDE], center=(.003, .001, 0), orientation=turn, material=m, deformation=level)
		engines(gravity=(0, 0, 0))
		engine(InsertionSortCollider).boundDispatcher.functors = [Bo1_Brick_Aabb(), Bo1_Box_Aabb()]
		engine(InteractionLoop).geomDispatcher.functors = [Ig2_Brick_Brick_BrickGeom(), Ig2_Box_Brick_BrickGeom()]
		O.step()
		self.work, self.most, self.excess, self.held, self.strain = 0, 0, 0, 0, 0
		force = lambda: [Vector3(O.forces.f(p.id)) for p in platens]
		velocities = lambda: [Vector3(p.state.vel) for p in platens]
		last, moved, dt = force(), velocities(), O.dt
		gap = lambda: (platens[1].state.pos - platens[0].state.pos)[2] - .2
		for direction in (1, -1):
			for platen, side in zip(platens, (-1, 1)):
				platen.state.vel = Vector3(0, 0, -side * direction * SPEED)
			while gap() > least if direction == 1 else gap() < 2 * reach + .01:
				before = O.iter
				O.step()
				self.assertEqual(O.iter, before + 1, 'the run has stopped')
				now = force()  # at the places before this step's motion; the platens came there with the mean of these and the last
				self.work -= sum((f + g).dot(v) for f, g, v in zip(last, now, moved)) / 2 * dt
				last, moved, dt = now, velocities(), O.dt
				energy = mechanicalEnergy(0)
				self.assertTrue(math.isfinite(energy), 'energy is not finite')
				self.most, self.excess = max(self.most, self.work), max(self.excess, energy - self.work)
				self.held = max(self.held, sum(i.phys.elasticEnergy(i.geom) for i in O.interactions if i.isReal))
				if level != 'rigid': self.strain = max(self.strain, (b.shape.displacement[0] - b.shape.displacement[4])[2] / SIDE)
		self.crushed = engine(InteractionLoop).lawDispatcher.functors[0].crushedContacts
		numbers = [x for v in (b.state.pos, b.state.vel, b.state.angVel) for x in v] + [x for u in b.shape.displacement for x in u]
		self.assertTrue(all(math.isfinite(x) for x in numbers), 'the state is not finite')

	def check(self, kind):
		for level in LEVELS:
			for tilt in (0, .3):
				for least in (.15, .08, -.02):
					self.press(kind, level, tilt, least)
					name = '%s between platens (%s), tilt %g, pressed to %g of its size: ' % (level, kind, tilt, least / SIDE)
					passed = kind == 'brick' and least < 0
					allowed, reason = (ALLOWED + self.held / self.most, LETTING_GO) if passed else (ALLOWED, REASON)
					self.atMost(name + 'energy beyond the work, over the most work', self.excess / self.most, allowed, reason)
					if level != 'rigid' and kind == 'brick': self.atMost(name + 'minus contacts crushed', -self.crushed, -1, 'beyond the contact part')
					if level != 'rigid' and kind == 'box' and tilt == 0 and least < 0:
						self.atMost(name + 'minus largest strain', -self.strain, -1, 'the faces of the element were to cross')

	def test_between_bricks(self):
		"""Platens are fixed bricks: contact lets go where they are deeper in than a quarter."""
		self.check('brick')

	def test_between_boxes(self):
		"""Platens are boxes, which press on: the element turns inside out."""
		self.check('box')
