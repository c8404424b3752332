# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks that touch nothing: the plugin must cost and change nothing.
#
# Criteria, all exact: the rigid motion is that of YADE's integrator with the plugin's engines left out, bit by bit, whatever the bricks' deformation
# does meanwhile; no interaction is kept, also after bricks have touched; no functor of contact is called (counted in calls and not in time: a call would add
# to their stopwatches, which stand at zero).
import unittest

from hardCase import *

GROUP = 'A step without contact'
LEVELS = ('rigid', 'uniform', 'trilinear', 'refined')
APART = 'all bricks are apart'


class FreeFlight(Case):

	def throw(self, b, velocity, spin):
		s = b.state
		s.vel, s.angVel = velocity, spin
		local = s.ori.conjugate() * spin
		s.angMom = s.ori * Vector3(*[s.inertia[k] * local[k] for k in range(3)])

	def motion(self):
		return [[x for v in (b.state.pos, b.state.ori, b.state.vel, b.state.angVel, b.state.angMom) for x in v] for b in bricks()]

	def secondsOfContact(self):
		"""Of all functors' stopwatches."""
		loop = engine(InteractionLoop)
		law = loop.lawDispatcher.functors[0]
		return sum(f.seconds for f in loop.geomDispatcher.functors) + law.jointSeconds + law.contactSeconds

	def check(self, name, steps, verletDist):
		"""Runs the scene from where it is, with the plugin's engines and then with YADE's alone."""
		engine(InsertionSortCollider).verletDist = verletDist
		stepByHand(O.dt)
		O.saveTmp('begin')
		before, kept = self.secondsOfContact(), 0
		O.timingEnabled = True
		for _ in range(steps // 50):
			O.run(50, True)
			kept = max(kept, len(list(O.interactions)))
		O.timingEnabled = False
		spent, got = self.secondsOfContact() - before, self.motion()
		O.loadTmp('begin')
		O.engines = [ForceResetter(), NewtonIntegrator(gravity=(0, 0, -GRAVITY), damping=0)]
		O.run(steps // 50 * 50, True)
		different = sum(x != y for a, b in zip(got, self.motion()) for x, y in zip(a, b))
		reason = 'nothing acts, so that nothing may be added, not even a zero'
		self.judge(name + 'numbers of the motion that differ from those of YADE alone', different, 0, 0, reason)
		self.judge(name + 'interactions kept', kept, 0, 0, APART)
		self.judge(name + 'time in functors of contact [s]', spent, 0, 0, APART + '; a single call would add to it')

	def test_flight(self):
		"""Bricks of every level fly and spin apart from each other, with and without strides of the collider."""
		for verletDist in (0, .05):
			O.reset()
			m = material()
			for i, level in enumerate(LEVELS):
				b = add((.2, .13, .07), center=(i, .1 * i, 0), orientation=Quaternion((1, i, 2), .4 + i), material=m, deformation=level)
				self.throw(b, Vector3(.3, -.2, 4 + .1 * i), Vector3(3, 8, -5 - i))
			engines()
			O.step()
			self.check('verletDist %g: ' % verletDist, 2000, verletDist)

	def test_after_a_collision(self):
		"""The same after pairs of each level have collided at 3 m/s and parted: they spin, and the deformable ones ring for good."""
		for verletDist in (0, .05):
			O.reset()
			m = material()
			for i, level in enumerate(LEVELS):
				for side in (-1, 1):
					b = add((.2, .13, .07), center=(i, 0, .2 * side), orientation=Quaternion((1, i, 2 * side), .4 + i), material=m, deformation=level)
					self.throw(b, Vector3(0, 0, -3 * side), Vector3(1, 2, side))
			engines()
			O.step()
			O.timingEnabled = True
			touched = set()
			while O.time < .25:
				for _ in range(max(1, round(2e-3 / O.dt))):
					O.step()
				touched |= {(i.id1, i.id2) for i in O.interactions if i.isReal}
			O.timingEnabled = False
			self.assertEqual(len(touched), len(LEVELS), 'all pairs were to collide')
			self.assertGreater(self.secondsOfContact(), 0, 'the stopwatches were to tell')
			if verletDist == 0:
				ringing = [b.shape.elasticEnergy() > 0 for b in bricks() if b.shape.deformation != 'rigid']
				self.assertTrue(all(ringing), 'deformable bricks were to ring')
			self.check('after a collision, verletDist %g: ' % verletDist, 1000, verletDist)
