# SPDX-License-Identifier: GPL-2.0-or-later
# The ledger of energy over scenes with everything in them: a wall of bricks of all levels that collapses, and a wall in English bond that is shaken.
#
# Criteria. O.energy.total() stays: what steps make or lose is at most 1 % of the energy that was turned over, which is all that came in (from heights, and
# through the ground) and the largest kinetic energy. What was taken never comes back: fracture, friction, dashpots and the damping of deformation only grow; of
# these contactArea is the one that may fall. Work of the ground on a scene seen from the ground is that of its inertia forces, -m z'' v, summed here by hand,
# and momentum is what gravity, the supports' forces and these have given.
import os, sys, unittest

from hardCase import *

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'yade'))
import collapse
from yade_brick import englishBondWall

GROUP = 'Ledger of energy'
TAKEN = 'fracture', 'plastDissip', 'dashpots', 'deformDamping'


class EnergyLedger(Case):

	def watch(self, name, seconds, every):
		"""Runs a scene that is ready, and judges its ledger."""
		O.step()
		ledger, ground = Ledger(), engine(GroundMotion)
		impulse, before, began = Vector3.Zero, momentum(), O.iter
		support = [b.id for b in O.bodies if not b.dynamic]
		most, fell, taken = 0., dict.fromkeys(TAKEN, 0.), dict.fromkeys(TAKEN, 0.)
		mass, turned, work, byHand = sum(b.state.mass for b in moving()), 0., O.energy['groundWork'], 0.
		while O.time < seconds:
			last, z = momentum(), ground.groundAcceleration(O.time)
			O.step()
			dt = O.dt  # that BrickTimeStepper has just set
			pushed = mass * z
			byHand -= pushed.dot(last + momentum()) / 2 / mass * dt
			impulse += dt * (Vector3(0, 0, -GRAVITY * mass) - pushed - sum((O.forces.f(k) for k in support), Vector3.Zero))
			if O.iter % every: continue
			ledger.drift()
			for entry in TAKEN:
				value = O.energy[entry]
				fell[entry] = max(fell[entry], taken[entry] - value)
				taken[entry] = max(taken[entry], value)
			most = max(most, O.energy['kinetic'])
			turned = max(turned, abs(O.energy['gravWork']) + abs(O.energy['groundWork']) + most)
		reason = 'segments open, close and fail within a step, areas change'
		self.atMost(name + ': largest drift of the total over the energy turned over', ledger.largest() / turned, .01, reason)
		for entry in TAKEN:
			allowed, reason = 0, 'taken for good'
			if entry == 'plastDissip':
				allowed, reason = .002, 'a step in which slip turns back; contact that takes over a joint starts with its shear, which is booked here'
			self.atMost('%s: largest fall of %s, of all that it took' % (name, entry), fell[entry] / max(taken[entry], 1e-9), allowed, reason)
		self.judge(name + ': groundWork against that of inertia forces [J]', work - O.energy['groundWork'], byHand, 1e-3, 'half a step more or less at the ends')
		missing = (momentum() - before - impulse).norm() / (GRAVITY * mass * seconds)
		self.atMost(name + ': momentum that no impulse accounts for, over the impulse of gravity', missing, (O.iter - began) * 2.2e-16, 'round-off, an eps a step')

	def test_collapse(self):
		"""A wall of 4 x 4 cubes of all levels in weak mortar, thrown down by a pulse in and out of its plane, for 2 s."""
		collapse.build(4, 4)
		self.watch('collapse', 2., 10)

	def test_shaken_wall(self):
		"""A wall in English bond, trilinear bricks, cracks under a motion of the ground that grows for 1 s."""
		O.reset()
		m = material(mortar=Mortar(tensileStrength=5e3, cohesion=5e3, frictionAngle=FRICTION, compressiveStrength=5e5), dampingRatio=.02)
		ground(m)
		O.bodies.append(englishBondWall(3, 4, (.25, .12, .06), material=m, deformation='trilinear', contactThickness=.003).bodies)
		wave = [Vector3(.7, 1, .3) * 12 * k / 100 * math.sin(.35 * k) for k in range(101)]
		engines(before=[GroundMotion(dt=.01, acceleration=wave)])
		MortarJoints()()
		self.watch('shaken wall', 1.2, 10)
