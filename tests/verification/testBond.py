# SPDX-License-Identifier: GPL-2.0-or-later
# Two bricks joined by mortar are pulled, pressed, sheared and bent apart: the largest force or moment, and where the joint stands when it fails.
#
# The lower brick is held, the upper one moves at a given velocity (as a kinematic body), so that the joint sees a given displacement.
import unittest

from yade.wrapper import RotationEngine

from cases import *

GROUP = 'Mortar strength'
SIDE, AREA = .2, .04
FT, COHESION, FM = 4.6e3, 2.9e3, 4.9e5
STEP = 1e-3  # of the displacement at failure, in each time step: the largest force is known to this
REASON = 'displacement grows by 1e-3 of that at failure in a step'


class BondOfTwoBricks(Case):

	def setUp(self):
		super().setUp()
		self.expected = reference('dyn.bond')

	def couplet(self, level='rigid', segments=4, **strength):
		given = dict(tensileStrength=FT, cohesion=COHESION, frictionAngle=FRICTION, compressiveStrength=FM)
		given.update(strength)
		jointed = material(mortar=Mortar(**given))
		self.lower, self.upper = [
		        add((SIDE, SIDE, SIDE), center=(0, 0, z), material=jointed, deformation=level, contactThickness=.001, segments=segments)
		        for z in (-SIDE / 2, SIDE / 2)
		]
		MortarJoints()()
		for b in (self.lower, self.upper):
			b.state.blockedDOFs = 'xyzXYZ'
		self.joint = O.interactions[self.lower.id, self.upper.id]

	def move(self, *mover):
		engines(gravity=(0, 0, 0), before=mover)
		engine(BrickTimeStepper).active = False
		engine(BrickDynamics).damping = .5
		O.dt = 1e-4

	def failures(self):
		counters = engine(InteractionLoop).lawDispatcher.functors[0]
		return {'tension': counters.tensionFailures, 'shear': counters.shearFailures, 'compression': counters.compressionFailures}

	def pull(self, direction, atFailure, force, limit=3.):
		"""Moves the upper brick along `direction` until a segment fails; the displacement [m] and the largest `force()` so far [N]."""
		speed = STEP * atFailure / O.dt
		self.upper.state.vel = direction * speed
		largest, start, limit = 0, self.upper.state.pos, limit * atFailure
		while sum(self.failures().values()) == 0:
			moved = (self.upper.state.pos - start).norm()
			if moved > limit: self.fail('no failure within %g m' % limit)
			O.step()
			largest = max(largest, force())
		O.step()  # segments under the same stress fail within round-off of each other
		return moved, largest

	def normalForce(self):
		return abs(self.joint.phys.normalForce[2])

	def shearForce(self):
		return self.joint.phys.shearForce.norm()

	def test_tension_of_rigid_bricks(self):
		self.couplet()
		self.move()
		opening, force = self.pull(Vector3(0, 0, 1), self.expected['u_t_rigid'], self.normalForce)
		self.judge('largest force [N]', force, self.expected['tension_N'], 2 * STEP, REASON)
		self.judge('opening at failure [m]', opening, self.expected['u_t_rigid'], 2 * STEP, REASON)
		self.judge('segments that fail', self.failures()['tension'], 16, 0, 'all alike')
		O.step()
		self.judge('force afterwards [N]', O.forces.f(self.lower.id).norm(), 0, 0, 'open')

	def test_tension_of_deformable_bricks(self):
		self.couplet('trilinear')
		self.move()
		# the bricks give way too: loaded on one face against their own inertia, so slowly that it is statics
		opening, force = self.pull(Vector3(0, 0, 1), 1e-5, self.normalForce, limit=100)
		self.judge('largest force [N]', force, self.expected['tension_N'], .012, 'a step moves 1e-8 m, 1.1 % of the opening of the joint at failure')

	def test_compression(self):
		self.couplet(cohesion=1e15)
		self.move()
		_, force = self.pull(Vector3(0, 0, -1), FM / self.expected['kn_rigid'], self.normalForce)
		self.judge('largest force [N]', force, self.expected['comp_N'], 2 * STEP, REASON)
		self.judge('segments that fail', self.failures()['compression'], 16, 0, 'all alike')

	def test_shear_under_pressure(self):
		for pressure, expected in self.expected['shear'].items():
			O.reset()
			self.couplet(compressiveStrength=1e15)
			self.move()
			self.upper.state.pos -= Vector3(0, 0, float(pressure) / self.expected['kn_rigid'])
			slip, force = self.pull(Vector3(1, 0, 0), expected / AREA / self.expected['ks_rigid'], self.shearForce)
			self.judge('largest force at %s Pa [N]' % pressure, force, expected, 2 * STEP, REASON)
			self.judge('segments that fail', self.failures()['shear'], 16, 0, 'all alike')
			for _ in range(10): O.step()
			overlap = AREA - SIDE * (self.upper.state.pos - self.upper.state.refPos)[0]
			residual = float(pressure) * overlap * self.expected['tan_phi']
			after = O.forces.f(self.lower.id)
			self.judge('force afterwards [N]', math.hypot(after[0], after[1]), residual, 1e-4, 'friction alone, eq. (9), on what is still in contact')

	def test_cap(self):
		for name, Cs in (('cap_Cs1', 1), ('cap_Cs9', 9)):
			sigma, tau = self.expected[name]['sigma'], self.expected[name]['tau']
			for factor, mode in ((.98, 'shear'), (1.02, 'compression')):
				O.reset()
				self.couplet(Cs=Cs)
				self.move()
				self.upper.state.pos -= Vector3(0, 0, factor * sigma / self.expected['kn_rigid'])
				_, force = self.pull(Vector3(0, 1, 0), tau / self.expected['ks_rigid'], self.shearForce)
				at = factor * sigma
				limit = COHESION + at * self.expected['tan_phi'] if mode == 'shear' else math.sqrt((FM**2 - at**2) / Cs)
				self.judge('Cs=%g, %g of the corner: largest force [N]' % (Cs, factor), force, limit * AREA, 2 * STEP, REASON)
				self.judge('segments that fail in ' + mode, self.failures()[mode], 16, 0, 'on either side of the corner another mode')

	def test_bond_wrench(self):
		for segments in (2, 4, 8):
			O.reset()
			self.couplet(segments=segments)
			angle = self.expected['u_t_rigid'] / (SIDE / 2 * (1 - 1 / segments))
			speed = STEP * angle / 1e-4
			self.move(RotationEngine(ids=[self.upper.id], rotateAroundZero=True, zeroPoint=(0, 0, 0), rotationAxis=(0, 1, 0), angularVelocity=speed))
			moment = 0
			while self.failures()['tension'] == 0:
				O.step()
				# about the middle of the joint, which is half a side above the lower brick's centre
				torque = O.forces.t(self.lower.id) - Vector3(0, 0, SIDE / 2).cross(O.forces.f(self.lower.id))
				moment = max(moment, abs(torque[1]))
			self.judge(
			        '%d segments: first crack at [N m]' % segments, moment, self.expected['wrench_M_first_crack']['n=%d' % segments], 2 * STEP, REASON
			)
