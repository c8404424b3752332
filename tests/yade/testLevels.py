# SPDX-License-Identifier: GPL-2.0-or-later
# Levels of deformation that change in mid-run: without a jump of place, velocity, force or energy; on demand; and back to the longer steps of rigid bricks.
import math, os, sys, unittest

import collapse
from yade import O, Vector3, utils
from yade_brick import *
from yade_brick.build import brick, straightJointWall

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'verification'))
from cases import FRICTION, GRAVITY, POISSON, UNBREAKABLE, add, engine, engines, ground, material

WEAK = dict(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=FRICTION, compressiveStrength=4.9e5)


def standingWall(level='rigid', before=(), columns=3, courses=3, strengths=UNBREAKABLE):
	"""A jointed wall in static equilibrium under its weight; its bricks."""
	clay = material(mortar=Mortar(**strengths))
	ground(clay)
	masonry = straightJointWall(columns, courses, 3 * (.2,), material=clay, contactThickness=2e-3, deformation=level)
	O.bodies.append(masonry.bodies)
	engines(before=before)
	MortarJoints()()
	StaticEquilibrium()()
	return masonry.bodies


def setLevel(bricks, level):
	for b in bricks:
		b.shape.deformation = level


def baseForce():
	return sum(abs(i.phys.normalForce[2]) for i in O.interactions if 0 in (i.id1, i.id2))


def energies(bricks):
	kinetic = sum(b.state.mass * b.state.vel.squaredNorm() / 2 + b.shape.kineticEnergy() for b in bricks)
	return kinetic, sum(b.shape.elasticEnergy() for b in bricks) + sum(i.phys.elasticEnergy(i.geom) for i in O.interactions if i.isReal)


def whileChanging(bricks, look=lambda: None):
	"""Steps until all changes have ended; how many."""
	steps = 0
	while steps < 3 or any(b.shape.share < 1 for b in bricks):
		O.step()
		look()
		steps += 1
	return steps


class AtRest(unittest.TestCase):
	"""A wall under its weight: the forces are known at any time."""

	def setUp(self):
		O.reset()

	def change(self, bricks, level):
		"""Changes all bricks; the largest jump of a place in a step [m], and error of the force on the ground, relative."""
		weight, places, jumps, errors = sum(b.state.mass for b in bricks) * GRAVITY, [b.state.pos for b in bricks], [], []

		def look():
			jumps.extend((b.state.pos - before).norm() for b, before in zip(bricks, places))
			places[:] = [b.state.pos for b in bricks]
			errors.append(abs(baseForce() / weight - 1))

		O.step()
		setLevel(bricks, level)
		whileChanging(bricks, look)
		return max(jumps), max(errors)

	def check(self, first, other):
		bricks = standingWall(first)
		scale = .2 * baseForceOf(bricks) / (9.8e6 * .12)  # what the weight presses a brick together [m]
		jump, error = self.change(bricks, other)
		# the places of rest of the two models differ by tenths of that, and are changed over in hundreds of steps
		self.assertLess(jump, .05 * scale)
		# a wall that swings slower than the bricks change swings by what the compliances of the models differ: 1 - nu^2 in the springs of rigid bricks
		self.assertLess(error, POISSON**2)
		kinetic, elastic = energies(bricks)
		self.assertLess(kinetic, POISSON**4 * elastic)

	def test_rigid_to_trilinear(self):
		self.check('rigid', 'trilinear')

	def test_trilinear_to_rigid(self):
		self.check('trilinear', 'rigid')

	def test_rigid_to_uniform(self):
		self.check('rigid', 'uniform')

	def test_trilinear_to_uniform_by_rigid(self):
		self.check('trilinear', 'uniform')

	def test_a_single_brick_of_a_wall(self):
		bricks = standingWall('rigid')
		_, error = self.change(bricks[:1], 'trilinear')
		self.assertEqual([b.shape.deformation for b in bricks[:2]], ['trilinear', 'rigid'])
		self.assertTrue(bricks[0].shape.displacement and not bricks[1].shape.displacement)

	def test_ends_in_the_equilibrium_of_the_other_level(self):
		bricks = standingWall('rigid')
		self.change(bricks, 'trilinear')
		engine(BrickDynamics).damping = O.engines[-1].damping = .4
		for _ in range(6000): O.step()
		got = [b.state.pos for b in bricks]
		O.reset()
		rest = standingWall('trilinear')
		for place, b in zip(got, rest):
			self.assertLess((place - b.state.pos).norm(), 1e-9)  # of some 1e-4 m; what is left after so much damping

	def test_on_dry_contact(self):
		clay = material()
		ground(clay)
		b = add(3 * (.2,), center=(0, 0, .1 - 1.4e-5), material=clay, contactThickness=2e-3, deformation='rigid')
		engines(damping=.4)
		for _ in range(3000): O.step()
		weight, errors = b.state.mass * GRAVITY, []
		for level in ('trilinear', 'rigid'):
			setLevel([b], level)
			whileChanging([b], lambda: errors.append(abs(baseForce() / weight - 1)))
		self.assertLess(max(errors), POISSON**2)


def baseForceOf(bricks):
	"""The weight on a brick of the lowest course [N]."""
	return sum(b.state.mass for b in bricks) * GRAVITY / 3


class Flying(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_momentum_and_path_are_those_of_a_brick_that_does_not_change(self):
		"""Deformation is orthogonal to rigid motion: a free brick's path cannot tell."""
		paths = []
		for changes in (False, True):
			O.reset()
			b = add((.25, .12, .06), center=(0, 0, 1), material=material(), contactThickness=1e-3, deformation='rigid')
			engines(gravity=(0, 0, 0))
			b.state.vel, b.state.angVel = Vector3(1, 2, 3), Vector3(5, 3, -2)
			b.state.angMom = b.state.ori * Vector3(*(b.state.inertia[k] * (b.state.ori.conjugate() * b.state.angVel)[k] for k in range(3)))
			O.engines[3].active = False
			O.dt = 1e-4
			for step in range(600):
				if changes and step in (100, 350): b.shape.deformation = 'trilinear' if step == 100 else 'rigid'
				O.step()
			paths.append([tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.angVel), tuple(b.state.angMom), [b.state.ori[k] for k in range(4)]])
		self.assertEqual(*paths)


class BeforeTheFirstStep(unittest.TestCase):

	def setUp(self):
		O.reset()

	def states(self, made, level):
		"""States after some steps of a wall that is made with one level and given another after its joints were laid."""
		O.reset()
		clay = material(mortar=Mortar(**WEAK))
		ground(clay)
		bricks = straightJointWall(2, 3, 3 * (.2,), material=clay, contactThickness=2e-3, deformation=made).bodies
		O.bodies.append(bricks)
		engines()
		MortarJoints()()
		setLevel(bricks, level)
		StaticEquilibrium()()
		for _ in range(50): O.step()
		return [(tuple(b.state.pos), tuple(b.shape.amplitudes)) for b in bricks] + [O.dt]

	def test_a_level_given_late_is_that_level(self):
		for made, level in (('rigid', 'trilinear'), ('trilinear', 'rigid'), ('uniform', 'trilinear')):
			self.assertEqual(self.states(made, level), self.states(level, level))


class TimeStep(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_steps_are_those_of_the_level_and_grow_again(self):
		bricks = standingWall('rigid')
		O.step()
		rigid = O.dt
		setLevel(bricks, 'trilinear')
		whileChanging(bricks)
		deformable = O.dt
		setLevel(bricks, 'rigid')
		whileChanging(bricks)
		O.step()
		self.assertEqual(O.dt, rigid)
		O.reset()
		standingWall('trilinear')
		O.step()
		self.assertEqual(deformable, O.dt)

	def test_change_time(self):
		bricks = standingWall('rigid')
		engine(BrickDynamics).levelTime = .01
		O.step()
		setLevel(bricks, 'trilinear')
		O.step()
		begun = O.time
		whileChanging(bricks)
		self.assertAlmostEqual(O.time - begun, .01, delta=.01 * .3)  # begun with a step of the rigid wall
		engine(BrickDynamics).levelTime = 0
		setLevel(bricks, 'rigid')
		O.step()
		self.assertFalse(bricks[0].shape.displacement)


class Energy(unittest.TestCase):
	"""O.energy.total() stays constant through changes: what they put in and take is in levelChange."""

	def setUp(self):
		O.reset()

	def tearDown(self):
		O.trackEnergy = False

	def drift(self, bricks, level, gap=0):
		"""Largest change of the total while bricks change, at one time step, and what the changes have put in or taken [J]."""
		O.dt, O.engines[3].active = 5e-5, False
		O.trackEnergy = True
		totals = []
		for _ in range(3): O.step()
		setLevel(bricks, level)
		whileChanging(bricks, lambda: totals.append(O.energy.total()))
		for _ in range(100):
			O.step()
			totals.append(O.energy.total())
		return max(totals) - min(totals), abs(O.energy['levelChange'])

	def test_joints_that_hold(self):
		for first, other in (('rigid', 'trilinear'), ('trilinear', 'rigid')):
			O.reset()
			drift, moved = self.drift(standingWall(first), other)
			self.assertGreater(moved, 1e-3 * O.energy.total())
			self.assertLess(drift, 1e-5 * O.energy.total())  # axes that turn, as without changes

	def test_joints_that_have_cracked(self):
		"""A wall that was pushed until most of its segments had failed."""
		for first, other in (('rigid', 'trilinear'), ('trilinear', 'rigid')):
			O.reset()
			bricks = standingWall(first, strengths=WEAK)
			O.engines[-1].gravity = (3, 0, -GRAVITY)
			while O.time < .15: O.step()
			O.engines[-1].gravity = (0, 0, -GRAVITY)
			self.assertTrue(any(i.isReal and any(i.phys.segmentState) for i in O.interactions))
			drift, moved = self.drift(bricks, other)
			# segments that open and close within a step, as without changes: share of what goes through the springs
			turned = sum(abs(O.energy[name]) for name in ('plastDissip', 'dashpots', 'kinetic', 'elastPotential'))
			self.assertLess(drift, .01 * turned)

	def test_dry_contact(self):
		clay = material()
		ground(clay)
		b = add(3 * (.2,), center=(0, 0, .1 - 2e-5), material=clay, contactThickness=2e-3, deformation='rigid')
		engines()
		for _ in range(5): O.step()
		drift, moved = self.drift([b], 'trilinear')
		self.assertLess(drift, .02 * sum(abs(O.energy[name]) for name in ('kinetic', 'elastPotential', 'dashpots')))

	def test_a_brick_that_becomes_rigid_at_once(self):
		bricks = standingWall('trilinear')
		engine(BrickDynamics).levelTime = 0
		O.step()
		held = sum(b.shape.elasticEnergy() for b in bricks)
		drift, _ = self.drift(bricks, 'rigid')
		self.assertLess(drift, POISSON**2 * 2 * held)  # the loads on the faces, which jump by what the compliances of the models differ, times their way


class Refused(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_level_time(self):
		for value in (-1, math.inf):
			with self.assertRaisesRegex(ValueError, 'levelTime'): BrickDynamics(levelTime=value)

	def test_mortar_thicker_than_the_contact_parts(self):
		clay = material(mortar=Mortar(thickness=.01, **UNBREAKABLE))
		bricks = [add(3 * (.2,), center=(0, 0, .1 + .2 * k), material=clay, contactThickness=2e-3, deformation='rigid') for k in range(2)]
		engines(gravity=(0, 0, 0))
		MortarJoints()()
		O.step()
		setLevel(bricks, 'trilinear')
		with self.assertRaisesRegex(ValueError, 'mortar.*thick'):
			whileChanging(bricks)

	def test_static_equilibrium_of_bricks_that_change(self):
		bricks = standingWall('rigid')
		O.step()
		setLevel(bricks, 'trilinear')
		O.step()
		with self.assertRaisesRegex(ValueError, 'changing its level'): StaticEquilibrium()()


class OnDemand(unittest.TestCase):

	def setUp(self):
		O.reset()

	def test_wrong_attributes(self):
		for name, value in (('level', 'rigid'), ('utilisation', 0), ('stress', -1), ('release', 2), ('patience', -1), ('interval', 0)):
			with self.assertRaisesRegex(ValueError, name): DeformationOnDemand(**{name: value})
		standingWall(before=[DeformationOnDemand(ids=[99])])
		with self.assertRaisesRegex(ValueError, 'ids.*#99'): O.step()

	def levels(self, bricks):
		return [b.shape.deformation for b in bricks]

	def test_bricks_at_a_joint_that_is_used(self):
		"""A cantilever in the air bends most at its held end."""
		clay = material(mortar=Mortar(**WEAK))
		bricks = [add(3 * (.1,), center=(.1 * k, 0, 0), material=clay, contactThickness=1e-3, deformation='rigid', fixed=k == 0) for k in range(4)]
		demand = DeformationOnDemand(utilisation=.5, interval=1, patience=.02)
		engines(gravity=(0, 0, -.5), before=[demand])
		O.engines = O.engines[:4] + [demand, engine(BrickDynamics), O.engines[-1]]
		MortarJoints()()
		StaticEquilibrium()()
		O.step()
		# stress of the outermost of 4 rows of segments, at half of which the mortar is used
		moments = [sum(clay.density * .1**3 * .5 * (.1 * (k - at) - .05) for k in range(at + 1, 4)) for at in range(3)]
		used = [m * 12 / .1**4 * .0375 / WEAK['tensileStrength'] for m in moments]
		expected = ['rigid'] + ['trilinear' if max(used[max(k - 1, 0):k + 1]) > .5 else 'rigid' for k in range(1, 4)]
		self.assertEqual(self.levels(bricks), expected)
		self.assertEqual(demand.promoted, expected.count('trilinear'))
		whileChanging(bricks)
		O.engines[-1].gravity = (0, 0, 0)
		engine(BrickDynamics).damping = O.engines[-1].damping = .5
		begun = O.time
		while O.time < begun + .2: O.step()
		self.assertEqual(self.levels(bricks), 4 * ['rigid'])
		self.assertEqual(demand.demoted, demand.promoted)

	def test_stress_of_a_brick_without_mortar(self):
		clay = material()
		ground(clay)
		pile = [add(3 * (.2,), center=(0, 0, .1 + .2 * k - 1e-5 * (k + 1)), material=clay, contactThickness=2e-3, deformation='rigid') for k in range(3)]
		# mean vertical stress: weight of what is above, and half of the brick's own
		demand = DeformationOnDemand(stress=1.8e3 * GRAVITY * .2 * 2, interval=1)
		engines(damping=.4)
		for _ in range(3000): O.step()
		O.engines = O.engines[:4] + [demand] + O.engines[4:]
		O.step()
		self.assertEqual(self.levels(pile), ['trilinear', 'rigid', 'rigid'])

	def test_free_flight(self):
		"""A brick that nothing touches is rigid again after `patience`."""
		b = add(3 * (.2,), center=(0, 0, 1), material=material(), contactThickness=2e-3)
		engines()
		O.engines = O.engines[:4] + [DeformationOnDemand(patience=.05, interval=1)] + O.engines[4:]
		while O.time < .04: O.step()
		self.assertEqual(b.shape.deformation, 'trilinear')
		while O.time < .2: O.step()
		self.assertEqual((b.shape.deformation, len(b.shape.displacement)), ('rigid', 0))

	def test_asked_in_the_first_step(self):
		"""A wall that was brought to rest is loaded: what it changes to then takes its time."""
		bricks = standingWall(strengths=WEAK)
		O.engines = O.engines[:4] + [DeformationOnDemand(utilisation=1e-3, interval=1)] + O.engines[4:]
		weight = sum(b.state.mass for b in bricks) * GRAVITY
		errors = []
		for _ in range(200):
			O.step()
			errors.append(abs(baseForce() / weight - 1))
		self.assertGreater(O.engines[4].promoted, 0)
		self.assertLess(max(errors), POISSON**2)

	def test_a_brick_without_material_is_refused_by_brick_dynamics(self):
		b = add(3 * (.2,), center=(0, 0, 1), material=material(), contactThickness=2e-3, deformation='rigid')
		engines()
		O.engines = O.engines[:3] + [DeformationOnDemand(stress=1, interval=1)] + O.engines[4:]
		O.dt = 1e-5
		O.step()
		b.material = None
		with self.assertRaisesRegex(ValueError, 'BrickMat'): O.step()

	def test_without_demand_it_is_the_rigid_wall_to_the_last_bit(self):
		prints = []
		for before in ([], [DeformationOnDemand()]):
			O.reset()
			bricks = standingWall(before=before)
			for _ in range(200): O.step()
			prints.append([(tuple(b.state.pos), tuple(b.state.vel)) for b in bricks] + [O.dt])
		self.assertEqual(*prints)
