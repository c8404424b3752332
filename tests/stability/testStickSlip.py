# SPDX-License-Identifier: GPL-2.0-or-later
# A block lies on a support that is moved to and fro, and sticks and slips 1e5 times.
#
# Criteria. With the block held, the force is that of springs with Coulomb's limit that follow the relative displacement x (Jenkins' element), step by step:
#     f <- f + k dx, cut to +-F,    k = ks area,    F = tan(phi) m g;
# the work of the support in a cycle, from its force and velocity, is that of the element, near  4 F (A - F/k)  for an amplitude A (the loop is cut by
# steps), and is the same in the first cycles and after 1e5: nothing is made, nothing forgotten, nothing creeps. With the block free on a
# support that shakes harder than friction can follow, the work of the support is what slip dissipates, F times slip, plus what the block gains. Dashpots along the
# face are off, for they dissipate too; those across it bring the block to rest on its support.
import unittest

from yade.wrapper import HarmonicMotionEngine

from hardCase import *

GROUP = 'Stick and slip, 1e5 cycles'
CYCLES, STEPS = 100000, 32  # steps a cycle
SIZE = (.4, .2, .1)
LIMIT = math.tan(FRICTION) * DENSITY * .4 * .2 * .1 * GRAVITY  # of friction [N]


class StickSlip(Case):

	def build(self, held):
		"""A rigid block on a fixed brick, settled. Rotations of the block are held; `held`: its place along x too."""
		O.reset()
		m = material(hn=.3, hs=0)
		self.support = add((.8, .4, .1), center=(0, 0, -.05), material=m, deformation='rigid', segments=1, fixed=True)
		self.block = add(SIZE, center=(0, 0, .05), material=m, deformation='rigid', segments=1)
		self.block.state.blockedDOFs = 'xyXYZ' if held else 'yXYZ'
		engines()
		untilRest(.5)
		stepByHand(.45 * limit())
		self.contact, = [i for i in O.interactions if i.isReal]
		self.stiffness = self.contact.phys.ks

	def shake(self, amplitude):
		"""From now on the support moves to and fro along x."""
		frequency = 1 / (STEPS * O.dt)
		motion = HarmonicMotionEngine(A=Vector3(amplitude, 0, 0), f=Vector3(frequency, 0, 0), fi=Vector3(math.pi / 2, 0, 0), ids=[self.support.id])
		O.engines = O.engines[:-1] + [motion, O.engines[-1]]

	def cycles(self, count=2):
		"""Some cycles step by step: work of the support [J], the element's with the same motion, slip times limit, gain of the block, and how far the forces
		of contact and element differ, of the limit.
		"""
		dt, k, phys = O.dt, self.stiffness, self.contact.phys
		self.work = self.element = self.dissipated = self.differs = 0
		energy = lambda f: f * f / 2 / k + self.block.state.mass * self.block.state.vel[0]**2 / 2
		ledger = Ledger()
		booked = [O.energy[name] for name in ('plastDissip', 'supportWork')]
		force = mine = -O.forces.f(self.support.id)[0]
		before = energy(force)
		for _ in range(count * STEPS):
			velocity = self.support.state.vel[0]  # that brings the support where the next force is found
			moved = (velocity - self.block.state.vel[0]) * dt
			O.step()
			limit = math.tan(FRICTION) * phys.normalForce.norm()
			last, force = force, -O.forces.f(self.support.id)[0]
			was, mine = mine, max(-limit, min(limit, mine + k * moved))
			self.work += (last + force) / 2 * velocity * dt
			self.element += (was + mine) / 2 * velocity * dt
			self.dissipated += limit * abs(moved - (force - last) / k)
			self.differs = max(self.differs, abs(force - mine) / LIMIT)
		self.gained = energy(force) - before
		self.drift, O.trackEnergy = ledger.drift(), False
		self.slipped, self.given = O.energy['plastDissip'] - booked[0], booked[1] - O.energy['supportWork']

	def ledger(self):
		"""Of the last cycles."""
		reason = 'one spot on linear springs, no turn: round-off of a step, relative to places of 1e-4 m'
		self.judge('supportWork of the ledger against work [J]', self.given, self.work, 1e-9, reason)
		reason = 'friction is booked with the mean of tractions, exact while the normal force stays; it still swings by less than 1e-6 after settling'
		self.atMost('drift of the ledger over work', abs(self.drift) / self.work, 1e-6, reason)

	def test_held_block(self):
		"""A rigid block keeps its place; the support moves by four times what the springs bear, 1e5 times."""
		self.build(True)
		amplitude = 4 * LIMIT / self.stiffness
		self.shake(amplitude)
		O.run(500 * STEPS, True)
		self.cycles()
		early = self.work
		O.run(CYCLES * STEPS, True)
		self.cycles()
		reason = 'round-off of a step, relative to places of 1e-4 m'
		self.judge('force against that of the element, of its limit, after 1e5 cycles', self.differs, 0, 1e-9, reason)
		self.judge('work of a cycle after 1e5 cycles [J]', self.work, self.element, 1e-9, reason)
		# the sum of 3e6 steps rounds by half a digit each, which shifts the support's phase, and with it where in a step it turns back
		phase = CYCLES * STEPS * math.ulp(O.time) / 2 * 2 * math.pi / (STEPS * O.dt)
		reason = 'the phase of the support is lost to the digits of the time, as much as turning back within a step can show'
		self.judge('the same against an early cycle', self.work, early, phase * 2 * math.pi / STEPS, reason)
		# of a motion in steps the amplitude is larger: each velocity holds for a step
		angle = math.pi / STEPS
		loop = 2 * 4 * LIMIT * (amplitude * angle / math.sin(angle) - LIMIT / self.stiffness)
		reason = 'trapezoids cut the two corners of a loop by at most k dx^2/8 each, and the reversal may lie within a step (1 - cos(pi/32))'
		step = amplitude * 2 * math.pi / STEPS
		cut = 4 * self.stiffness * step**2 / 8 / loop
		self.judge('work of two cycles against 4 F (A - F/k) [J]', self.work, loop, cut + 1 - math.cos(angle), reason)
		self.judge('slip times limit against work', self.dissipated, self.work, cut, 'trapezoids, likewise')
		self.ledger()
		self.judge('plastDissip of the ledger against work [J]', self.slipped, self.work, 1e-6, 'the loop closes: all work is taken; the normal force likewise')

	def test_free_block(self):
		"""The block is free on a support that shakes at three times what friction can give it; after 1e4 cycles."""
		self.build(False)
		omega = 2 * math.pi / (STEPS * O.dt)
		self.shake(max(3 * math.tan(FRICTION) * GRAVITY / omega**2, 4 * LIMIT / self.stiffness))
		O.run(CYCLES // 10 * STEPS, True)
		self.cycles(8)
		self.judge('free: force against that of the element, of its limit', self.differs, 0, 1e-9, 'round-off of a step, relative to places of 1e-4 m')
		self.assertGreater(self.dissipated, 0)
		reason = 'trapezoids, as for the held block; velocities half a step before'
		self.judge('free: work of the support against slip times limit and gain [J]', self.work, self.dissipated + self.gained, .02, reason)
		self.ledger()
