# SPDX-License-Identifier: GPL-2.0-or-later
# A brick slides at 6 m/s over the ground and over a row of bricks with tops of equal height, straight and turned against the axes. A search that
# took the ends of the row's bricks for obstacles would throw it up or stop it at the joints.
#
# Criteria: without friction it keeps its height and its velocity. With friction its velocity follows what the supports press, since the impulses of
# Coulomb's friction and of the normal forces are in the ratio tan(phi) whatever happens meanwhile:  vx = v0 - tan(phi) (g t + vz);  any push by the
# end of a brick would be seen in it. (On a row half of the pressure is normal to the foot, which pitches by some 1e-4: that part of it is counted
# with the pitch.) The brick is flat enough for its foot to stay closed under twice the static moment of friction
# (2 tan(phi) h/2 < length/6), so that its middle neither rises nor sinks as it pitches.
#
# Why not to the last digit: a strip narrower than twice its depth is nearer to the end of the row's brick than to its top and is not pressed for as
# long as it lasts (kernel test area_shrinks_continuously...). At a settlement d that is 2 d at either side of a joint. And where a step ends with the
# front within d of a joint, by a chance of d over the way of a step, the end of the row's brick does push back for that step: its spring by nothing,
# its dashpot by c v on the strip of height d.
import unittest

from hardCase import *

GROUP = 'A brick pushed sideways at 6 m/s'
SPEED, TIME = 6., .3  # [m/s], [s]
LENGTH, WIDTH, HEIGHT = .4, .2, .1  # of the brick that slides [m]
SIDE, BRICKS = .2, 14  # of the row
DASHPOTS, SEGMENTS = .3, 4
EDGES = 4 * (math.ceil(SPEED * TIME / SIDE) + 1)  # of joints, passed by either end; each has two sides
TURNED = Quaternion((0, 0, 1), math.radians(30))


def dashpot(m):
	"""Of one rigid face against another, eqs. (3) and (4): the lengths of their springs drop out [Pa s/m]."""
	return 2 * m.hn * math.sqrt(m.density * m.young / (1 - m.poisson**2))


class Sideways(Case):

	def slide(self, level, friction, on, turn=Quaternion.Identity):
		"""Settles the brick, pushes it along the row, and keeps what happened: lift [m], settlement, errors of the velocity [m/s]."""
		O.reset()
		m = material(frictionAngle=friction, hn=DASHPOTS, hs=DASHPOTS, dampingRatio=.05)
		along, across = turn * Vector3(1, 0, 0), turn * Vector3(0, 1, 0)
		top = 0
		if on == 'ground': ground(m)
		else:
			top = SIDE
			for i in range(BRICKS):
				add(3 * [SIDE], center=along * (SIDE * (i - 1)) + Vector3(0, 0, SIDE / 2), orientation=turn, material=m, deformation=on, fixed=True)
		b = add((LENGTH, WIDTH, HEIGHT), center=along * .03 + Vector3(0, 0, top + HEIGHT / 2), orientation=turn, material=m, deformation=level)
		engines()
		untilRest(.5)
		at = b.state.pos[2]
		self.settlement = top + HEIGHT / 2 - at
		self.step = O.dt
		self.caught = dashpot(m) * SPEED * WIDTH * self.settlement / b.state.mass * self.step
		b.state.vel = SPEED * along
		began, self.lift, self.off, self.drift, self.strayed, tilted = O.time, 0, 0, 0, 0, 0
		tangent = math.tan(friction)
		while O.time - began < TIME:
			O.step()
			v = b.state.vel
			self.lift, self.off = max(self.lift, b.state.pos[2] - at), max(self.off, abs(b.state.pos[2] - at))
			if on != 'ground': tilted += O.dt * GRAVITY * along.dot(b.state.ori * b.state.refOri.conjugate() * Vector3(0, 0, 1)) / 2
			expected = SPEED - tangent * (GRAVITY * (O.time - began) + v[2]) + (1 + tangent**2) * tilted
			self.drift, self.strayed = max(self.drift, abs(along.dot(v) - expected)), max(self.strayed, abs(across.dot(v)))
		self.assertGreater(along.dot(b.state.pos), SIDE * 7, 'it was to pass joints')

	def check(self, on, turn=Quaternion.Identity):
		"""Rigid bodies: heights and velocities by the strips that are not pressed."""
		for friction, named in ((0., 'no friction'), (FRICTION, 'friction')):
			name = 'rigid on %s%s, %s: ' % (on, ', turned' if turn != Quaternion.Identity else '', named)
			self.slide('rigid', friction, on, turn)
			# what a strip of 2 d misses of the weight for a step, at each passing
			missed = EDGES * 2 * self.settlement / LENGTH * GRAVITY * self.step if on != 'ground' else 0
			tilt = 12 * math.tan(friction) * HEIGHT * self.settlement / LENGTH**2
			# dashpots act where the pressure of their segment does, off its middle by this, and so lift a brick that pitches
			middle = tilt / self.settlement * (LENGTH / SEGMENTS)**2 / 12
			height = 1e-13 + missed * math.sqrt(self.settlement / GRAVITY) + HEIGHT * tilt**2 + 2 * DASHPOTS * tilt * middle
			reason = 'digits of a slab of 20 m; at joints strips of two settlements press for no step, at most one a passing; dashpots at pressed points of segments'
			self.atMost(name + 'lift [m]', self.lift, height, reason)
			if not friction: self.judge(name + 'change of height [m]', self.off, 0, height, reason)
			caught = self.caught if on != 'ground' else 0
			reason = 'round-off of some hundred steps; strips at joints, likewise; one step of a dashpot at the end of a brick; the square of the pitch'
			self.judge(name + 'velocity against impulse [m/s]', self.drift, 0, 1e-11 + missed + caught + GRAVITY * TIME * tilt**2, reason)
			self.judge(name + 'velocity across [m/s]', self.strayed, 0, 1e-11 + missed, reason)

	def test_rigid(self):
		"""A rigid brick over the ground and over a row of rigid bricks."""
		self.check('ground')
		self.check('rigid')

	def test_rigid_turned(self):
		"""The same, turned by 30 degrees: places of joints and ends are round-off apart."""
		self.check('ground', TURNED)
		self.check('rigid', TURNED)

	def test_deformable(self):
		"""A deformable brick over a row of deformable bricks of each level: the loaded brick of the row has sunk, the next one stands higher by as much.
		The slider's middle must never come above its height on a row without load. (Without any damping of the modes friction at this speed excites those of
		refined bricks, as real dry friction does: 5 % of damping here.)
		"""
		for level in ('uniform', 'trilinear', 'refined'):
			for turn, named in ((Quaternion.Identity, ''), (TURNED, ', turned')):
				self.slide(level, FRICTION, level, turn)
				name = '%s on %s%s: ' % (level, level, named)
				self.atMost(name + 'lift over settlement', self.lift / self.settlement, 1, 'the row without load is the highest that there is to slide on')
				reason = 'the foot meets an edge that stands higher by the settlement: its normal tilts by twice that over a segment'
				tilt = 2 * self.settlement / (SIDE / 4)
				self.judge(name + 'velocity against impulse [m/s]', self.drift, 0, GRAVITY * TIME * tilt, reason)
				self.judge(name + 'velocity across over along', self.strayed / SPEED, 0, 1e-7, 'symmetry; round-off grows for some thousand steps of sliding')

