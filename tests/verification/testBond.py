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
		"""Two rigid cubes are pulled apart. Expected: the joint carries ft times its area, and opens by ft/kn, with kn of eq. (3) for two half bricks."""
		self.couplet()
		self.move()
		opening, force = self.pull(Vector3(0, 0, 1), self.expected['u_t_rigid'], self.normalForce)
		self.judge('largest force [N]', force, self.expected['tension_N'], 2 * STEP, REASON)
		self.judge('opening at failure [m]', opening, self.expected['u_t_rigid'], 2 * STEP, REASON)
		self.judge('segments that fail', self.failures()['tension'], 16, 0, 'all alike')
		O.step()
		self.judge('force afterwards [N]', O.forces.f(self.lower.id).norm(), 0, 0, 'open')

	def test_springs(self):
		"""Constants of the joint's springs, from the force at a given small opening and slip. Expected: eq. (3), l = 0.1 m for rigid and r = 1 mm for deformable
		cubes, whose contact parts alone give way when the bricks' centres are held and no time is left for them to deform.
		"""
		for level, normal, shear in (('rigid', 'kn_rigid', 'ks_rigid'), ('trilinear', 'kn_r1', 'ks_r1')):
			for direction, name, force in ((Vector3(0, 0, 1), normal, self.normalForce), (Vector3(1, 0, 0), shear, self.shearForce)):
				O.reset()
				self.couplet(level)
				self.move()
				self.upper.state.pos += 1e-9 * direction
				O.step()
				self.judge('%s: %s [N/m3]' % (level, name), force() / AREA / 1e-9, self.expected[name], 1e-6, '1e-9 m of a coordinate of 0.1 m to its digits')

	def openingAtFailure(self, strength, direction, component):
		"""Mean displacement between the two faces of a joint of deformable bricks when the first segment fails."""
		self.couplet('trilinear', **strength)
		self.move()
		corners = lambda b, top: sum((x for x in b.shape.worldCorners(b.state)[4 * top:4 * top + 4]), Vector3.Zero) / 4
		self.upper.state.vel = direction * 1e-8 / O.dt
		while sum(self.failures().values()) == 0:
			opening = (corners(self.upper, 0) - corners(self.lower, 1))[component]
			O.step()
			if O.iter > 5000: self.fail('no failure')
		return opening

	def test_opening_of_deformable_bricks(self):
		"""Two deformable cubes are pulled apart and sheared with their centres held. When the joint fails, its faces are apart by ft/kn, or shifted by c/ks, with
		the springs of two contact parts of 1 mm; the bricks give way a hundred times as much.
		"""
		opening = self.openingAtFailure({}, Vector3(0, 0, 1), 2)
		self.judge('opening at failure [m]', opening, self.expected['u_t_r1mm'], .012, 'a step moves 1e-8 m, 1.1 % of it')
		O.reset()
		slip = self.openingAtFailure(dict(tensileStrength=1e15), Vector3(1, 0, 0), 0)
		self.judge('slip at failure [m]', slip, self.expected['u_s_r1mm'], .007, 'a step moves 1e-8 m, 0.7 % of it')

	def test_tension_of_deformable_bricks(self):
		"""Two deformable cubes are pulled apart slowly with their centres held. Expected: the joint carries ft times its area all the same."""
		self.couplet('trilinear')
		self.move()
		# the bricks give way too: loaded on one face against their own inertia, so slowly that it is statics
		opening, force = self.pull(Vector3(0, 0, 1), 1e-5, self.normalForce, limit=100)
		self.judge('largest force [N]', force, self.expected['tension_N'], .012, 'a step moves 1e-8 m, 1.1 % of the opening of the joint at failure')

	def test_compression(self):
		"""Two rigid cubes are pressed together, cohesion out of reach. Expected: the cap, eq. (8): fm times the area."""
		self.couplet(cohesion=1e15)
		self.move()
		_, force = self.pull(Vector3(0, 0, -1), FM / self.expected['kn_rigid'], self.normalForce)
		self.judge('largest force [N]', force, self.expected['comp_N'], 2 * STEP, REASON)
		self.judge('segments that fail', self.failures()['compression'], 16, 0, 'all alike')

	def test_shear_under_pressure(self):
		"""Two rigid cubes are pressed by a given amount and then sheared, the cap out of reach. Expected: Coulomb's line, eq. (7), c + pressure tan(phi), and after
		failure friction alone, eq. (9).
		"""
		figure, largest, afterwards = 'Shear strength against pressure', [], []
		pressures = [float(pressure) for pressure in self.expected['shear']]
		self.curve(figure, 'Coulomb\'s line', pressures, [COHESION + p * self.expected['tan_phi'] for p in pressures], 'pressure [Pa]', 'shear stress [Pa]')
		self.curve(figure, 'friction alone', pressures, [p * self.expected['tan_phi'] for p in pressures])
		for pressure, expected in self.expected['shear'].items():
			O.reset()
			self.couplet(compressiveStrength=1e15)
			self.move()
			self.upper.state.pos -= Vector3(0, 0, float(pressure) / self.expected['kn_rigid'])
			slip, force = self.pull(Vector3(1, 0, 0), expected / AREA / self.expected['ks_rigid'], self.shearForce)
			self.judge('largest force at %s Pa [N]' % pressure, force, expected, 2 * STEP, REASON)
			self.judge('segments that fail at %s Pa' % pressure, self.failures()['shear'], 16, 0, 'all alike')
			for _ in range(10): O.step()
			overlap = AREA - SIDE * (self.upper.state.pos - self.upper.state.refPos)[0]
			residual = float(pressure) * overlap * self.expected['tan_phi']
			after = O.forces.f(self.lower.id)
			friction = math.hypot(after[0], after[1])
			self.judge('force afterwards at %s Pa [N]' % pressure, friction, residual, 1e-4, 'friction alone, eq. (9), on what is still in contact')
			largest.append(force / AREA)
			afterwards.append(friction / overlap)
		self.curve(figure, 'largest stress', pressures, largest, line=False)
		self.curve(figure, 'stress after failure', pressures, afterwards, line=False)

	def test_cap(self):
		"""Two rigid cubes are pressed a little less and a little more than where Coulomb's line meets the cap, eq. (8), and sheared. Expected: below, they fail in
		shear on the line; above, in compression on the cap.
		"""
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
				label = 'Cs=%g, %g of the corner: segments that fail in %s' % (Cs, factor, mode)
				self.judge(label, self.failures()[mode], 16, 0, 'on either side of the corner another mode')

	def test_cap_alone(self):
		"""The same with cohesion out of reach, at several pressures. Expected: eq. (8) alone, an ellipse of half axes fm and fm / sqrt(Cs)."""
		for name, Cs in (('cap_Cs1', 1), ('cap_Cs9', 9)):
			points = []
			for share in (.25, .5, .75, .9):
				O.reset()
				self.couplet(Cs=Cs, cohesion=1e15)
				self.move()
				self.upper.state.pos -= Vector3(0, 0, share * FM / self.expected['kn_rigid'])
				limit = FM * math.sqrt((1 - share**2) / Cs)
				_, force = self.pull(Vector3(0, 1, 0), limit / self.expected['ks_rigid'], self.shearForce)
				wanted = self.expected[name]['tau_at_half_fm'] if share == .5 else limit
				self.judge('Cs=%g, %g of fm: largest force [N]' % (Cs, share), force, wanted * AREA, 2 * STEP, REASON)
				points.append((share * FM, force / AREA))
			figure = 'Compression cap'
			angles = [math.pi / 2 * k / 60 for k in range(61)]
			ellipse = [FM * math.sin(a) for a in angles], [FM * math.cos(a) / math.sqrt(Cs) for a in angles]
			self.curve(figure, 'Cs = %g, exact' % Cs, *ellipse, 'pressure [Pa]', 'shear stress [Pa]')
			self.curve(figure, 'Cs = %g, ours' % Cs, *zip(*points), line=False)

	def test_bond_wrench(self):
		"""The upper of two rigid cubes is turned about the middle of the joint. Expected: the first segment fails at M = ft A L (1 + 1/n) / 6 for n segments along
		an edge, which take the stress in their middles; by refinement this goes to the moment of a continuous joint.
		"""
		moments = {}
		for segments in (2, 4, 8, 16, 32):
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
			moments[segments] = moment
			if segments <= 8:
				wanted = self.expected['wrench_M_first_crack']['n=%d' % segments]
				self.judge('%d segments: first crack at [N m]' % segments, moment, wanted, 2 * STEP, REASON)
		limit = self.expected['wrench_M_first_crack']['n=None']
		for segments, moment in moments.items():
			self.compare('%d segments: first crack at [N m]' % segments, moment, limit, 'the method: stress is taken in the middle of a segment')
		self.judge('extrapolated to a continuous joint [N m]', 2 * moments[32] - moments[16], limit, 6 * STEP, 'error goes with 1/n; each moment is known to 2e-3')
		figure = 'Bond wrench: first crack'
		self.curve(figure, 'ours', moments.keys(), moments.values(), 'segments along an edge', 'moment [N m]', True, line=False)
		self.curve(figure, 'exact for segments', moments.keys(), [limit * (1 + 1 / n) for n in moments])
		self.curve(figure, 'continuous joint', moments.keys(), [limit] * len(moments))
