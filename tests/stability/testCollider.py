# SPDX-License-Identifier: GPL-2.0-or-later
# The collider's strides watch centres only. Bricks that spin fast in their place, and soft ones that bulge strongly, reach out of boxes made with
# verletDist > 0 although their centres hardly move; no contact may be missed.
#
# Criterion: the motion with verletDist > 0 is that with verletDist = 0 (new boxes in every step) in every bit.
# Also counted: how often the collider was asked, which has to be seldom for strides to be of use.
import hashlib, struct, unittest

from hardCase import *

GROUP = 'Collider: spinning and bulging bricks'
LEVELS = ('rigid', 'uniform', 'trilinear', 'refined')
EVERY = 4  # steps between looks: a contact that begins a step late changes every later bit
EXACT = 'the same contacts, so the same forces and the same sums'


def turning(b, spin):
	b.state.angVel = spin
	local = b.state.ori.conjugate() * spin
	b.state.angMom = b.state.ori * Vector3(*[b.state.inertia[k] * local[k] for k in range(3)])


def spinners():
	"""Long bricks spin in their place and hit others that rest beside them, out of the way of their first boxes. No middle moves before."""
	m = material()
	for i, level in enumerate(LEVELS):
		turning(add((.6, .1, .1), center=(2 * i, 0, 0), material=m, deformation=level), Vector3(0, 0, 30))
		for side in (-1, 1):
			add((.1, .1, .1), center=(2 * i, .33 * side, 0), orientation=Quaternion((0, 0, 1), .2), material=m, deformation=level)
	engines(gravity=(0, 0, 0))


def bulging():
	"""Soft bricks are struck from above and below at once: their middles stay, and their sides come out to neighbours 6 mm away. The step is short
	against the strides, which the strikers pass too.
	"""
	m = material(young=3e5, poisson=.45)
	for i, level in enumerate(LEVELS[1:]):
		add((.2, .2, .2), center=(2 * i, 0, 0), material=m, deformation=level)
		for side in (-1, 1):
			add((.2, .2, .2), center=(2 * i, 0, .21 * side), material=m, deformation=level).state.vel = Vector3(0, 0, -4 * side)
			add((.2, .2, .2), center=(2 * i + .206 * side, 0, 0), material=m, deformation=level)
	engines(gravity=(0, 0, 0))
	stepByHand(1e-4)


def heap():
	"""Bricks of all levels, tumbling, fall on the ground and on each other."""
	m = material()
	ground(m)
	for i in range(8):
		turn = Quaternion(Vector3(1, .3 * i, -.2 * i * i % 3).normalized(), .7 * i)
		place = (.34 * (i % 2), .34 * (i // 2 % 2), .25 + .34 * (i // 4))  # apart in any position
		b = add((.3, .12, .08), center=place, orientation=turn, material=m, deformation=LEVELS[i % 4], contactThickness=.004)
		b.state.vel = Vector3(0, 0, -3)
		turning(b, Vector3(20 - 3 * i, 9, 2 * i))
	engines()


def thrown():
	"""Bricks of all levels, tumbling, are thrown at the ground, whose box has no room to spare: only the bricks' own tell in time."""
	m = material()
	ground(m)
	for i in range(12):
		turn = Quaternion(Vector3(1, .3 * i, -.2 * i * i % 3).normalized(), .7 * i)
		b = add((.3, .12, .08), center=(.5 * (i % 4), .5 * (i // 4), .2 + .011 * i), orientation=turn, material=m, deformation=LEVELS[i % 4], contactThickness=.004)
		b.state.vel = Vector3(0, 0, -3 - .1 * i)
		turning(b, Vector3(40 - 5 * i, 9, 2 * i))
	engines()


class Collider(Case):

	def history(self, build, verletDist, seconds):
		"""Fingerprint of the motion, pairs in contact now and then, contacts begun, and runs of the collider a step."""
		O.reset()
		build()
		engine(InsertionSortCollider).verletDist = verletDist
		motion, contacts, began, last = hashlib.sha256(), [], 0, frozenset()
		while O.time < seconds:
			for _ in range(EVERY):  # O.run would wait longer than such a step takes
				O.step()
			now = frozenset(tuple(sorted((i.id1, i.id2))) for i in O.interactions if i.isReal)
			began, last = began + len(now - last), now
			contacts.append(now)
			for b in bricks():
				values = [x for v in (b.state.pos, b.state.ori, b.state.vel, b.state.angMom, b.shape.amplitudes) for x in v]
				motion.update(struct.pack('%dd' % len(values), *values))
		return motion.hexdigest(), contacts, began, engine(InsertionSortCollider).numAction / O.iter

	def check(self, build, strides, seconds, atLeast):
		"""@param atLeast contacts that have to begin"""
		motion, contacts, began, _ = self.history(build, 0, seconds)
		self.assertGreaterEqual(began, atLeast)
		for stride in strides:
			name = 'verletDist %g m: ' % stride
			otherMotion, otherContacts, _, runs = self.history(build, stride, seconds)
			different = sum(a != b for a, b in zip(contacts, otherContacts)) + abs(len(contacts) - len(otherContacts))
			self.judge(name + 'times with other contacts', different, 0, 0, EXACT)
			self.judge(name + 'histories of the motion that differ', motion != otherMotion, 0, 0, EXACT)
			self.atMost(name + 'runs of the collider a step', runs, .5, 'or the stride would be for nothing')

	def test_spinning_bricks(self):
		"""Long bricks spin in their place at 30 rad/s and hit others at rest."""
		self.check(spinners, (.005, .05), .15, 2 * len(LEVELS))

	def test_bulging_bricks(self):
		"""Soft bricks are struck from both sides and bulge against neighbours 6 mm away."""
		self.check(bulging, (.0015, .0028), .04, 4 * len(LEVELS[1:]))

	def test_tumbling_bricks(self):
		"""Bricks of all levels spin at up to 50 rad/s as they fall on each other."""
		self.check(heap, (.003, .03), .3, 8)

	def test_thrown_bricks(self):
		"""Bricks of all levels spin at up to 40 rad/s as they are thrown at the ground with 3 to 4 m/s."""
		self.check(thrown, (.005, .01, .02), .15, 12)
