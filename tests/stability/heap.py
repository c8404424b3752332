# SPDX-License-Identifier: GPL-2.0-or-later
# Bricks fall into a pit, on each other, and come to rest: what testHeap.py (30 bricks of all levels) and slowHeap.py (300 rigid ones) share.
#
# Criteria. The ledger closes, and what of it can still become motion (kinetic, elastic, of the heights) only falls, but for what contact of edges and corners
# askew makes: it is not conservative (doc/stability.md), and a step of half the length changes the drift by a hundredth of itself only.
# After the fall kinetic energy goes to zero without a floor, as dashpots have it: jitter would keep it up. Nothing sinks: the mean height of the
# bricks stays, within what the remaining velocity moves in the period of the slowest rocking. Nobody has left the pit.
#
# No local damping, nothing put to sleep: the dashpots of contact, friction and the modes' own damping alone. They act slowly on a brick that rocks on a corner:
# how long it takes hangs on how the last one happens to lie, so the time has room, and the run ends when there is rest.
import random

from hardCase import *

GROUP = 'A heap of fallen bricks comes to rest'
SIZES = ((.2, .12, .1), (.16, .16, .1), (.12, .12, .12))
EVERY = .05  # between looks at the energy [s]
HN = .3  # damping ratio of contact
TAKEN = 1 - math.exp(-2 * math.pi * HN / math.sqrt(1 - HN**2))  # of an impact's energy, by its dashpots


class Heap(Case):

	def build(self, count, across, levels):
		"""`count` bricks in layers of across x across above a pit of walls, turned at random; a soft material, whose step is large."""
		m = material(young=3e6, hn=HN, hs=HN, dampingRatio=.1)
		ground(m)
		self.half = .145 * across + .05
		for axis in (0, 1):
			for side in (-1, 1):
				O.bodies.append(utils.wall(side * self.half, axis=axis, sense=-side, material=m))
		chance = random.Random(3)
		for i in range(count):
			column, row, layer = i % across, i // across % across, i // across**2
			turn = Quaternion(Vector3(*[chance.gauss(0, 1) for _ in range(3)]).normalized(), chance.uniform(0, math.pi))
			place = (.29 * (column - (across - 1) / 2), .29 * (row - (across - 1) / 2), .16 + .27 * layer)
			add(SIZES[i % 3], center=place, orientation=turn, material=m, deformation=levels[i % len(levels)], contactThickness=.02, segments=2)
		engines()
		engine(InsertionSortCollider).verletDist = .01

	def fall(self, seconds, kineticLeft):
		"""Looks at [time, mechanical energy, kinetic energy, mean height] every now and then, until there is rest."""
		looks = []
		O.step()
		self.ledger = Ledger()
		while O.time < seconds and not self.isAtRest(looks, kineticLeft):
			O.run(round(EVERY / O.dt), True)
			shapes = [b.shape for b in bricks()]
			kinetic = O.energy['kinetic'] + O.energy['deformKinetic']
			self.ledger.drift()
			height = sum(b.state.pos[2] for b in bricks()) / len(shapes)
			looks.append((O.time, mechanicalEnergy(), kinetic, height))
			self.assertTrue(math.isfinite(looks[-1][1]), 'energy is not finite')
		return looks

	def isAtRest(self, looks, kineticLeft):
		"""Whether kinetic energy has been below that share of what was lost for a second."""
		if not looks or looks[-1][0] < 2: return False
		return max(k for t, _, k, _ in looks if t > looks[-1][0] - 1) < kineticLeft * (looks[0][1] - looks[-1][1])

	def check(self, seconds, kineticLeft):
		"""
		:param seconds: within which it has to come to rest
		:param kineticLeft: kinetic energy below which it is at rest, of all that was lost
		"""
		looks = self.fall(seconds, kineticLeft)
		lost, end = looks[0][1] - looks[-1][1], looks[-1][0]
		rise = max(b[1] - a[1] for a, b in zip(looks, looks[1:]))
		reason = 'edges and corners askew make up to 5 %% of an impact (testImpact), half the step as much; dashpots take %.0f %% of one' % (100 * TAKEN)
		self.atMost('largest drift of the ledger, of all that is lost', self.ledger.largest() / lost, .05 / TAKEN, reason)
		reason = 'it falls; impacts between two steps are not exact'
		self.atMost('largest rise of energy in %g s, of all that is lost' % EVERY, rise / lost, 1e-3, reason)
		late = [k for t, _, k, _ in looks if t > end - 1]
		early = [k for t, _, k, _ in looks if abs(t - (end + 1) / 2) < .5]
		reason = 'speeds of less than a thousandth of those of the fall, within %g s' % seconds
		self.atMost('kinetic energy in the last second, of all energy lost', max(late) / lost, kineticLeft, reason)
		self.atMost('the same, of that around half the time', max(late) / max(early), .5, 'it goes on to fall: jitter would give 1')
		heights = [h for t, _, _, h in looks if t > end - 1]
		moved = math.sqrt(2 * max(late) / sum(b.state.mass for b in bricks())) * .5
		reason = 'the velocity that is left, for half a second: a rocking'
		self.atMost('change of the mean height in the last second [m]', max(heights) - min(heights), moved, reason)
		self.atMost('mean sinking in the last second [m]', heights[0] - heights[-1], moved, 'likewise')
		out = max(max(abs(b.state.pos[0]), abs(b.state.pos[1])) / self.half for b in bricks())
		self.atMost('farthest brick from the middle, of half the width', out, 1, 'the pit holds them')
		self.atMost('minus least height of a middle, over half the least size', -min(b.state.pos[2] for b in bricks()) / .05, -.9, 'nobody is in the ground')
		times, energies = [l[0] for l in looks], [l[2] for l in looks]
		self.curve(type(self).__name__, 'kinetic', times, energies, 'time [s]', 'kinetic energy [J]', logY=True)
