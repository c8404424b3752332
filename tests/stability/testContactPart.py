# SPDX-License-Identifier: GPL-2.0-or-later
# Contact parts from a tenth of a brick to a two-thousandth of it: r/L = 0.1 to 0.0005.
#
# Criterion: as r falls, what a column does under a smooth shaking tends to a limit, in proportion to r (the contact part is a layer in series with the
# element); the time step is that of springs E/((1-nu^2) 2 r) on the same masses, so it goes with sqrt(r), times sqrt(1+xi^2) - xi for dashpots of xi
# that goes with sqrt(r) as well; and nothing makes energy: a column that was struck keeps it, and so does a cube that falls askew.
import unittest

from hardCase import *

GROUP = '1 Thin contact part'
SIDE = .2
SHARES = .1, .03, .01, .003, .001, .0005
LEVELS = 'uniform', 'trilinear', 'refined'
PULSE, TOP = .06, 6.  # duration [s] and largest acceleration [m/s2] of a smooth shaking


class ThinContactPart(Case):

	def column(self, level, share, count=3, **attributes):
		"""Undamped cubes on the ground in mortar that never fails."""
		O.reset()
		adobe = material(mortar=Mortar(**UNBREAKABLE), **dict(dict(hn=0, hs=0), **attributes))
		ground(adobe)
		# full: the element does not shrink with the contact part, so that this is all that r changes
		given = dict(material=adobe, deformation=level, contactThickness=share * SIDE, inner='full')
		column = [add([SIDE] * 3, center=(0, 0, SIDE * (k + .5)), **given) for k in range(count)]
		MortarJoints()()
		return column

	def test_shaken_column_tends_to_a_limit(self):
		"""A column of 3 is shaken sideways by sin^2 over 0.06 s, then left alone for as long: how far its top comes, for r/L = 0.03 to 0.0005."""
		count = 120
		wave = [Vector3(TOP * math.sin(math.pi * k / count)**2, 0, 0) for k in range(count + 1)]
		for level in LEVELS:
			moved = []
			for share in SHARES[1:]:
				top = self.column(level, share)[-1]
				engines(gravity=(0, 0, 0), before=[GroundMotion(dt=PULSE / count, acceleration=wave)])
				# one step for all thicknesses, so that its own error is no part of what is compared
				stepByHand(2 * PULSE / 3000)
				most = 0.
				for _ in range(3000):
					O.step()
					most = max(most, abs(top.state.pos[0]))
				moved.append(most)
				step = O.dt
				engine(BrickTimeStepper).active = True
				O.step()
				self.atMost('%s, r/L=%g: step over limit' % (level, share), step / limit(), 1, 'the run is stable')
			slopes = [(a - b) / (p - q) for a, b, p, q in zip(moved, moved[1:], SHARES[1:], SHARES[2:])]
			limitAtZero = moved[-1] - slopes[-1] * SHARES[-1]
			self.atMost(level + ': inverse of what the top moves [1/m]', 1 / abs(limitAtZero), 1e4, 'there is something to compare')
			coarser = moved[-2] - slopes[-2] * SHARES[-2]
			reason = 'in proportion to r: the next term is its square, here r/L = .002 times some ten'
			self.judge(level + ': slope by r, from .001 to .0005 over that from .003 to .001', slopes[-1] / slopes[-2], 1, .02, reason)
			self.judge(level + ': limit for r = 0 from .001 and .0005 over that from .003 and .001', limitAtZero / coarser, 1, 1e-3, 'the same')

	def test_time_step(self):
		"""Steps of one column for all thicknesses, without and with the default dashpots."""
		for level in LEVELS:
			limits = []
			for share in SHARES:
				self.column(level, share)
				engines()
				O.step()
				limits.append(limit())
				bare = limits[-1]
				self.column(level, share, hn=.1, hs=.1)
				engines()
				O.step()
				# c/k = 2 h sqrt(m/k), m = 2 rho r, k = E/((1-nu^2) 2 r) or E/(4 (1+nu) r): the softer, tangential one is later
				lag = 2 * .1 * math.sqrt(2 * DENSITY * share * SIDE * 4 * (1 + POISSON) * share * SIDE / YOUNG)
				xi = lag / bare
				self.judge('%s, r/L=%g: limit with dashpots over that without' % (level, share), limit() / bare, math.sqrt(1 + xi**2) - xi, 1e-9, 'closed form')
			for share, got in zip(SHARES, limits):
				wanted = limits[-1] * math.sqrt(share / SHARES[-1])
				self.judge('%s, r/L=%g: limit without dashpots [s]' % (level, share), got, wanted, 1e-9, 'springs go with 1/r, on the same masses')

	def test_struck_column_keeps_its_energy(self):
		"""The bricks of a column of 3 get velocities of 1 cm/s in all directions; 20000 steps."""
		for level in LEVELS:
			for share in (.1, .01, .0005):
				column = self.column(level, share)
				engines(gravity=(0, 0, 0))
				O.step()
				stepByHand(.2 * limit())
				for k, b in enumerate(column): b.state.vel = Vector3(.01, -.007 * k, .005) * (-1)**k
				struck = utils.kineticEnergy()
				drift = Ledger().run(20000, 10)
				reason = 'springs are linear, and leap-frog keeps their energy; what is left comes of axes that turn, by 1e-3 at most'
				self.atMost('%s, r/L=%g: largest drift of energy over that of the blow' % (level, share), drift / struck, 1e-3, reason)

	def test_cube_falling_askew(self):
		"""A cube falls on the ground, turned by some degrees about two axes, undamped and without friction, at 0.5 m/s: it keeps its energy."""
		for young in (YOUNG, 100 * YOUNG):
			for level in LEVELS:
				for share in (.1, .01, .001):
					O.reset()
					adobe = material(young=young, hn=0, hs=0, frictionAngle=0)
					ground(adobe)
					turn = Quaternion(Vector3(1, 0, 0), .1) * Quaternion(Vector3(0, 1, 0), .06)
					b = add([SIDE] * 3, center=(0, 0, .116), orientation=turn, material=adobe, deformation=level, contactThickness=share * SIDE)
					b.state.vel = Vector3(0, 0, -.5)
					engines()
					O.step()
					stepByHand(.05 * limit())
					fall = utils.kineticEnergy()
					drift = Ledger().run(round(.15 * math.sqrt(YOUNG / young) / O.dt), 5)
					# the corner that comes first has an eighth of the element, or of its cell, to take up the energy
					corner = 8 * (b.shape.cells**3 if level == 'refined' else 1)
					strain = math.sqrt(corner) * .5 / math.sqrt(young / DENSITY)
					reason = '(w dt)^2 / 4 where contact begins and ends between two steps, w dt = 0.1; strain of an element\'s corner that takes up all energy'
					name = 'E %g Pa, %s, r/L=%g: largest drift of energy over that of the fall' % (young, level, share)
					self.atMost(name, drift / fall, .0025 + strain, reason)
