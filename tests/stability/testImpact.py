# SPDX-License-Identifier: GPL-2.0-or-later
# Two free cubes collide at 0.1 to 50 m/s, face, edge or corner first, or in any position; and a cube with the ground.
#
# Criteria:
# - momentum and angular momentum stay, to round-off, at any step and speed;
# - in short steps, without friction and dashpots, no energy is gained. What leap-frog adds when contact begins or ends between two steps is at most a share
#   1/(1 - a/4) - 1, a = (omega dt)^2: between the steps in contact v^2 + omega^2 x(n) x(n+1) is constant, and x(n) x(n+1) lies between -(v dt)^2/4 and 0
#   where one of them is outside. Left are strain, which small-strain elements neglect against 1, and two bodies' corners that meet askew: the line that divides a
#   segment among the faces that dig in moves, and their footprints, each over its own cosine, do not meet there. That makes or loses up to 5 %, the same for any
#   step and any number of segments; on the ground, and in symmetric positions, it is nothing;
# - faces give back the speed that the dashpot of eq. (4) predicts, at every speed alike;
# - in steps of BrickTimeStepper and with the dashpots as they are by default, energy falls on the average over where between two steps contact begins;
# - a brick does not pass through another. A segment that is deeper in than it is far from the side of the other brick is nearest to that side and presses
#   no more: of 4 x 4 segments the outer ones at a depth of L/8, the inner ones at 3 L/8. Work to pass rigid cubes:  K/2 [(L/8)^2 + ((3 L/8)^2 - (L/8)^2)/4].
import unittest

from hardCase import *

GROUP = 'Impacts'
SIDE, MASS = .2, DENSITY * .2**3
STIFF = 1e9  # BrickMat's default [Pa]
LEVELS = ('rigid', 'uniform', 'trilinear', 'refined')
TURNS = dict(
        face=Quaternion.Identity, edge=Quaternion((0, 1, 0), math.pi / 4), corner=Quaternion(Vector3(1, -1, 0).normalized(), math.atan(math.sqrt(2))),
        oblique=Quaternion(Vector3(1, 2, .5).normalized(), .7)
)
WAYS = tuple(TURNS)
LOOP = .05
CHANGING = 'footprints of faces that dig in askew do not meet where a segment is divided among them: limit of the method, at any step'
ROUND_OFF = 'round-off of some thousand steps'


def stiffnessOfPair(young, onGround=False):
	"""Of two rigid cubes, or of one on the ground, face to face [N/m]."""
	return young / (1 - POISSON**2) / (SIDE / (2 if onGround else 1)) * SIDE**2


def restitution(ratio):
	"""Of a linear spring and dashpot that does not pull."""
	root = math.sqrt(1 - ratio**2)
	return math.exp(-ratio / root * (math.pi - math.atan2(2 * ratio * root, 1 - 2 * ratio**2)))


class Impact(Case):

	def collide(self, level, way, speed, young=STIFF, h=0., friction=0., fraction=None, phase=.5, onGround=False, sideways=0.):
		"""Until the bodies have been apart for a while.

		:param fraction: of the limit of the step; None for BrickTimeStepper's own
		:param phase: share of a step that is left when contact begins
		"""
		O.reset()
		m = material(young=young, hn=h, hs=h, frictionAngle=friction)
		turn = TURNS[way]
		if onGround: ground(m)
		else: add(3 * [SIDE], center=(0, 0, -SIDE / 2), material=m, deformation=level)
		reach = max((turn * Vector3(x, y, z))[2] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)) * SIDE / 2
		self.struck = b = add(3 * [SIDE], center=(0, 0, reach + 1), orientation=turn, material=m, deformation=level)
		engines(gravity=(0, 0, 0))
		O.step()
		if fraction: stepByHand(fraction * limit())
		b.state.pos = Vector3(0, 0, reach + (2 + phase) * speed * O.dt)  # two steps from now
		b.state.vel = Vector3(sideways * speed, 0, -speed)
		ledger, before, turning = Ledger(), momentum(), angularMomentum()
		energy = utils.kineticEnergy()
		apart, longest = None, .02 * math.sqrt(YOUNG / young)
		while apart is None or O.time - apart < longest:
			O.step()
			if any(i.isReal for i in O.interactions): apart = O.time
			if O.iter > 1e5: self.fail('still in contact, or never')
		self.energy, self.drift = mechanicalEnergy() / energy, ledger.drift() / energy
		other = O.bodies[0].state.vel[2]
		self.back = (b.state.vel[2] - other) / speed
		self.momentum = (momentum() - before).norm() / before.norm()
		self.turning = (angularMomentum() - turning).norm() / (before.norm() * SIDE)

	def conserved(self, name):
		self.judge(name + 'change of momentum', self.momentum, 0, 1e-13, ROUND_OFF)
		self.judge(name + 'change of angular momentum', self.turning, 0, 1e-12, ROUND_OFF)

	def test_restitution(self):
		"""Rigid cubes face to face at every speed, in steps of a fiftieth of the limit: the speed that they give back."""
		for onGround in (False, True):
			for h in (.1, .3):
				for speed in (.1, 1, 10, 50):
					self.collide('rigid', 'face', speed, h=h, fraction=.02, onGround=onGround)
					name = '%s, h %g, %g m/s: speed after over before' % ('cube on ground' if onGround else 'two cubes', h, speed)
					expected = restitution(h * (math.sqrt(.5) if onGround else math.sqrt(2)))
					self.judge(name, self.back, expected, 2e-3, 'dashpots see velocities half a step late: a step of 1/50 of the limit')

	def test_no_energy_gained(self):
		"""No friction, no dashpots, steps of a fortieth of the limit, every level, way and speed."""
		gain, reason = 1 / (1 - .025**2) - 1, 'contact begins and ends between two steps: at most 1/(1 - a/4), a = (2/40)^2'
		for level in LEVELS:
			for way in WAYS:
				for speed in (1, 50):
					self.collide(level, way, speed, fraction=.025)
					name = '%s, %s, %g m/s: ' % (level, way, speed)
					self.conserved(name)
					strain = 0 if level == 'rigid' else speed / math.sqrt(STIFF / DENSITY)
					if way == 'oblique': self.judge(name + 'energy after over before', self.energy, 1, LOOP, CHANGING)
					else: self.judge(name + 'energy after over before', self.energy, 1, gain + strain, reason + '; strain, speed over wave speed')
					self.judge(name + 'drift of the ledger less what was gained', self.drift - (self.energy - 1), 0, 1e-9, 'nothing is taken: the ledger shows it all')

	def test_oblique_on_ground(self):
		"""A rigid cube falls askew on the ground: one plane, nothing to be divided."""
		for speed in (1, 50):
			self.collide('rigid', 'oblique', speed, fraction=.025, onGround=True)
			self.judge('%g m/s: energy after over before' % speed, self.energy, 1, 1 / (1 - .025**2) - 1, 'at most 1/(1 - a/4), a = (2/40)^2')

	def test_energy_in_any_position(self):
		"""The same for rigid and trilinear cubes that meet in positions all over the sphere, off the middle and from the side."""
		for level in ('rigid', 'trilinear'):
			energies = []
			for k in range(40):
				axis = Vector3(math.cos(2.4 * k) * math.sqrt(1 - (k / 20 - .975)**2), math.sin(2.4 * k) * math.sqrt(1 - (k / 20 - .975)**2), k / 20 - .975)
				TURNS['position'] = Quaternion(axis, .9 * k)
				self.collide(level, 'position', 3, fraction=.1, sideways=.3 * math.sin(k))
				self.conserved('%s, position %d: ' % (level, k))
				energies.append(self.energy)
			self.atMost(level + ': energy gained, most of 40 positions', max(energies) - 1, LOOP, CHANGING)
			self.atMost(level + ': energy lost, most of 40 positions', 1 - min(energies), LOOP, CHANGING)
			mean = sum(energies) / len(energies)
			self.judge(level + ': energy after over before, mean of 40 positions', mean, 1, LOOP / 2, CHANGING + '; gain outweighs')

	def test_steps_as_they_are(self):
		"""Steps of BrickTimeStepper, eight phases of the step at which contact begins; with and without dashpots, and from the side at 45 degrees."""
		for onGround in (False, True):
			on = 'on ground, ' if onGround else ''
			most = []
			for k in range(8):
				self.collide('rigid', 'face', 1, phase=(k + .5) / 8, onGround=onGround)
				most.append(self.energy)
			a = stiffnessOfPair(STIFF, onGround) / (MASS if onGround else MASS / 2) * O.dt**2
			self.atMost(on + 'rigid, face, no dashpots: energy after over before', max(most), 1 / (1 - a / 4), 'at most 1/(1 - a/4)')
			for level in LEVELS:
				for way in WAYS:
					energies = []
					phases = 8 if way == 'face' else 2
					for k in range(phases):
						self.collide(level, way, 3, h=.1, friction=FRICTION, phase=(k + .5) / phases, onGround=onGround, sideways=way != 'face')
						energies.append(self.energy)
						if not onGround: self.conserved('%s, %s, phase %d: ' % (level, way, k))
					reason = 'dashpots, friction: energy falls'
					self.atMost(on + '%s, %s: energy after over before, mean of phases' % (level, way), sum(energies) / len(energies), 1, reason)

	def test_no_pass_through(self):
		"""Bricks part on the side that they came from: rigid ones to nine tenths of the speed that their contact can stop, deformable ones at 50 m/s."""
		for young in (YOUNG, STIFF):
			work = stiffnessOfPair(young) / 2 * ((SIDE / 8)**2 + ((3 * SIDE / 8)**2 - (SIDE / 8)**2) / 4)
			stopped = math.sqrt(2 * work / (MASS / 2))
			came = 'to be > 0: it is where it came from'
			for way in ('face', 'edge', 'corner'):
				self.collide('rigid', way, .9 * stopped, young=young, fraction=.025)
				self.conserved('E %g Pa, rigid, %s, %.3g m/s: ' % (young, way, .9 * stopped))
				self.atMost('E %g Pa, rigid, %s, %.3g m/s: minus speed after over before' % (young, way, .9 * stopped), -self.back, 0, came)
			self.collide('rigid', 'face', 1.1 * stopped, young=young, fraction=.025)
			name = 'E %g Pa, rigid, face, %.3g m/s: speed after over before' % (young, 1.1 * stopped)
			self.compare(name, self.back, 1, 'faster rigid bricks pass: documented')
			for level in LEVELS[1:]:
				for way in WAYS:
					self.collide(level, way, 50, young=young, friction=FRICTION, h=.1)
					self.conserved('E %g Pa, %s, %s, 50 m/s: ' % (young, level, way))
					above = -(self.struck.state.pos - O.bodies[0].state.pos)[2] / SIDE
					self.atMost('E %g Pa, %s, %s, 50 m/s: minus height over the other, over its size' % (young, level, way), above, 0, came)
