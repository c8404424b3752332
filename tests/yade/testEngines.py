# SPDX-License-Identifier: GPL-2.0-or-later
# yade_brick.engines: what it derives from a scene and what the caller may ask, that the loop is the one that one would write by hand, to the last bit, and
# that its words (yade_brick.effects) tell what is on, what is off and why, also after edits.
import math
import unittest

import yade_brick
from yade import O, Vector3, utils, wrapper
from yade_brick import BrickMat, Law2_BrickGeom_BrickPhys_Mortar, Mortar, MortarJoints, StaticEquilibrium, effects, engines

import collapse

angle = math.radians(32)


def adobe(mortar=True, strength=4.6e3, frictionAngle=angle, **attributes):
	filling = Mortar(tensileStrength=strength, cohesion=strength, frictionAngle=frictionAngle, compressiveStrength=1e6)
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=frictionAngle, mortar=filling if mortar else None, **attributes)


def bricks(columns=2, courses=2, material=None, **options):
	masonry = yade_brick.straightJointWall(columns, courses, (.2, .2, .2), material=material or adobe(), contactThickness=2e-3, **options)
	O.bodies.append(masonry.bodies)
	return masonry


def wall(material=None, **options):
	"""Bricks on a Wall of their material, nothing joined yet."""
	material = material or adobe()
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
	return bricks(material=material, **options)


def classes(things):
	return [type(thing).__name__ for thing in things]


def functors(dispatcher):
	return classes(dispatcher.functors)


def shake(startTime=0):
	return dict(dt=.01, acceleration=[Vector3(6 * math.sin(2 * math.pi * .01 * i), 0, 0) for i in range(201)], startTime=startTime)


def motion():
	return yade_brick.Motion(.01, shake()['acceleration'], name='two cycles of 1 Hz')


class Empty(unittest.TestCase):
	"""Each test has a scene of its own."""

	def setUp(self):
		O.reset()
		O.trackEnergy = False

	tearDown = setUp


class Derived(Empty):

	def test_a_wall_on_a_wall(self):
		wall()
		loop = engines()
		self.assertEqual(
		        classes(loop), ['ForceResetter', 'InsertionSortCollider', 'InteractionLoop', 'BrickTimeStepper', 'BrickDynamics', 'NewtonIntegrator']
		)
		self.assertEqual(functors(loop.collider.boundDispatcher), ['Bo1_Brick_Aabb', 'Bo1_Wall_Aabb'])
		self.assertEqual(functors(loop.interactionLoop.geomDispatcher), ['Ig2_Brick_Brick_BrickGeom', 'Ig2_Wall_Brick_BrickGeom'])
		self.assertEqual(functors(loop.interactionLoop.physDispatcher), ['Ip2_BrickMat_BrickMat_BrickPhys'])
		self.assertEqual(functors(loop.interactionLoop.lawDispatcher), ['Law2_BrickGeom_BrickPhys_Mortar'])
		self.assertEqual(loop.newton.gravity, Vector3(0, 0, -9.81))
		self.assertEqual((loop.newton.damping, loop.dynamics.damping, loop.stepper.safety), (0, 0, .9))
		self.assertEqual((loop.law.failure, loop.law.friction, loop.law.dashpots), (True, True, True))

	def test_bricks_alone(self):
		bricks()
		loop = engines()
		self.assertEqual(functors(loop.collider.boundDispatcher), ['Bo1_Brick_Aabb'])
		self.assertEqual(functors(loop.interactionLoop.geomDispatcher), ['Ig2_Brick_Brick_BrickGeom'])

	def test_a_box_of_another_material(self):
		O.bodies.append(utils.box((0, 0, -.1), (1, 1, .1), material=wrapper.FrictMat(frictionAngle=.5), fixed=True))
		bricks()
		loop = engines()
		self.assertEqual(functors(loop.collider.boundDispatcher), ['Bo1_Brick_Aabb', 'Bo1_Box_Aabb'])
		self.assertEqual(functors(loop.interactionLoop.geomDispatcher), ['Ig2_Brick_Brick_BrickGeom', 'Ig2_Box_Brick_BrickGeom'])
		self.assertEqual(functors(loop.interactionLoop.physDispatcher), ['Ip2_BrickMat_BrickMat_BrickPhys', 'Ip2_FrictMat_BrickMat_BrickPhys'])
		O.engines = loop
		O.step()
		self.assertTrue(all(body.state.pos == body.state.refPos or body.dynamic for body in O.bodies))

	def test_the_stride_of_the_collider_is_a_twentieth_of_the_shortest_edge(self):
		wall()
		self.assertEqual(engines().collider.verletDist, .01)
		O.bodies.append(yade_brick.brick((.2, .4, .05), center=(0, 0, 2), material=adobe()))
		self.assertAlmostEqual(engines().collider.verletDist, .0025, places=15)

	def test_no_bricks(self):
		O.bodies.append(utils.sphere((0, 0, 0), 1))
		with self.assertRaisesRegex(ValueError, 'no bricks'):
			engines()

	def test_erased_bodies_and_clumps_are_no_shapes(self):
		masonry = wall()
		O.bodies.erase(masonry.bodies[0].id)
		O.bodies.clump([body.id for body in masonry.bodies[2:]])
		O.engines = engines()
		self.assertEqual(effects()['deformation'].why, '3 trilinear bricks')
		self.assertNotIn('none for', effects()['contact'].why)


class Asked(Empty):

	def test_every_choice_reaches_its_engine(self):
		wall()
		loop = engines(
		        gravity=(1, 2, 3), damping=.3, safety=.5, failure=False, friction=False, dashpots=False, guard=False, stopFile='', verletDist=.02, ledger=True
		)
		self.assertEqual(loop.newton.gravity, Vector3(1, 2, 3))
		self.assertEqual((loop.newton.damping, loop.dynamics.damping), (.3, .3))
		self.assertEqual((loop.law.failure, loop.law.friction, loop.law.dashpots), (False, False, False))
		self.assertEqual((loop.dynamics.guard, loop.dynamics.stopFile), (False, ''))
		self.assertEqual((loop.collider.verletDist, loop.stepper.safety), (.02, .5))
		self.assertTrue(O.trackEnergy)
		engines(ledger=False)
		self.assertFalse(O.trackEnergy)
		O.trackEnergy = True
		engines()
		self.assertTrue(O.trackEnergy)

	def test_no_gravity(self):
		wall()
		for none in (None, 0, (0, 0, 0)):
			self.assertEqual(engines(gravity=none).newton.gravity, Vector3.Zero)

	def test_a_fixed_step(self):
		wall()
		loop = engines(dt=1e-5)
		self.assertIsNone(loop.stepper)
		self.assertEqual(O.dt, 1e-5)

	def test_a_motion_begins_now_and_stands_before_newton(self):
		wall()
		O.engines = engines()
		O.step()
		loop = engines(motion=motion())
		self.assertIs(loop[-2], loop.ground)
		self.assertEqual(loop.ground.startTime, O.time)
		self.assertGreater(O.time, 0)
		self.assertEqual(loop.ground.acceleration, shake()['acceleration'])
		own = yade_brick.GroundMotion(ids=[0], **shake())
		self.assertIs(engines(motion=own).ground, own)

	def test_deformation_on_demand_stands_before_dynamics(self):
		wall(deformation='rigid')
		self.assertIsNone(engines(onDemand=False).onDemand)
		loop = engines(onDemand=True)
		self.assertLess(loop.index(loop.onDemand), loop.index(loop.dynamics))
		self.assertGreater(loop.index(loop.onDemand), loop.index(loop.interactionLoop))
		self.assertEqual(engines(onDemand=dict(utilisation=.25)).onDemand.utilisation, .25)
		own = yade_brick.DeformationOnDemand()
		self.assertIs(engines(onDemand=own).onDemand, own)
		O.engines = loop
		MortarJoints()()
		O.run(20, True)

	def test_functors_are_sorted_by_kind_and_replace_ours(self):
		wall()
		O.bodies.append(utils.sphere((0, 0, 2), .1, material=wrapper.FrictMat()))
		law, box = Law2_BrickGeom_BrickPhys_Mortar(label='law'), yade_brick.Bo1_Brick_Aabb()
		spheres = [wrapper.Law2_ScGeom_FrictPhys_CundallStrack(), wrapper.Ip2_FrictMat_FrictMat_FrictPhys(), wrapper.Ig2_Sphere_Sphere_ScGeom()]
		loop = engines(functors=[law, wrapper.Bo1_Sphere_Aabb(), box] + spheres, friction=False)
		self.assertIs(loop.law, law)
		self.assertFalse(law.friction)
		self.assertEqual(functors(loop.collider.boundDispatcher), ['Bo1_Wall_Aabb', 'Bo1_Sphere_Aabb', 'Bo1_Brick_Aabb'])
		self.assertIs(loop.collider.boundDispatcher.functors[2], box)
		self.assertEqual(
		        functors(loop.interactionLoop.geomDispatcher), ['Ig2_Brick_Brick_BrickGeom', 'Ig2_Wall_Brick_BrickGeom', 'Ig2_Sphere_Sphere_ScGeom']
		)
		self.assertEqual(functors(loop.interactionLoop.physDispatcher), ['Ip2_BrickMat_BrickMat_BrickPhys', 'Ip2_FrictMat_FrictMat_FrictPhys'])
		self.assertEqual(functors(loop.interactionLoop.lawDispatcher), ['Law2_BrickGeom_BrickPhys_Mortar', 'Law2_ScGeom_FrictPhys_CundallStrack'])


class AsByHand(Empty):
	"""The loop is the one of a script that lists it, to the last bit."""

	def run_(self, loop, steps, settle=True):
		"""Every number of the scene after some steps of a small wall in weak mortar, with the loop that the function makes when the bodies are there."""
		O.reset()
		wall(adobe(strength=2e3), columns=3, courses=4)
		O.engines = loop()
		MortarJoints()()
		if settle:
			StaticEquilibrium()()
		O.run(steps, True)
		return collapse.state()

	@staticmethod
	def listed():
		return [
		        wrapper.ForceResetter(),
		        wrapper.InsertionSortCollider([yade_brick.Bo1_Brick_Aabb(), wrapper.Bo1_Wall_Aabb()], verletDist=.01),
		        wrapper.InteractionLoop(
		                [yade_brick.Ig2_Brick_Brick_BrickGeom(), yade_brick.Ig2_Wall_Brick_BrickGeom()], [yade_brick.Ip2_BrickMat_BrickMat_BrickPhys()],
		                [Law2_BrickGeom_BrickPhys_Mortar()]
		        ),
		        yade_brick.BrickTimeStepper(),
		        yade_brick.BrickDynamics(),
		        yade_brick.GroundMotion(**shake()),
		        wrapper.NewtonIntegrator(damping=0, gravity=(0, 0, -9.8)),
		]

	def test_a_wall_that_falls(self):
		byHand = self.run_(self.listed, 3000)
		self.assertGreater(sum(byHand['failures'][:3]), 50)
		self.assertEqual(byHand, self.run_(lambda: engines(gravity=(0, 0, -9.8), motion=motion()), 3000))

	def test_joints_alone_are_the_whole_loop_as_long_as_nothing_cracks(self):
		for level in ('rigid', 'trilinear'):
			with self.subTest(level):
				states = []
				for contact in (True, False):
					O.reset()
					masonry = wall(adobe(strength=1e9), columns=3, courses=4, deformation=level)
					O.engines = loop = engines(contact=contact, motion=motion())
					MortarJoints()()
					O.run(1000, True)
					states.append(collapse.state())
					self.assertEqual(loop.collider is None, not contact)
					self.assertEqual(all(body.bound is None for body in masonry.bodies), not contact)
					self.assertGreater(max(abs(body.state.vel[0]) for body in masonry.bodies), 1e-4)
				self.assertEqual(*states)

	def test_a_loop_made_anew_in_mid_run_is_heeded(self):
		wall(adobe(strength=2e3), columns=3, courses=4)
		O.engines = engines()
		MortarJoints()()
		StaticEquilibrium()()
		O.run(10, True)
		self.assertEqual(collapse.state()['failures'][:3], [0, 0, 0])
		O.engines = engines(failure=False, motion=motion())
		O.run(2000, True)
		self.assertFalse(any(any(i.phys.segmentState) for i in O.interactions if i.isReal))
		O.engines = loop = engines(motion=motion())
		O.run(2000, True)
		failed = sum(map(bool, (state for i in O.interactions if i.isReal for state in i.phys.segmentState)))
		self.assertGreater(failed, 0)
		self.assertGreaterEqual(loop.law.tensionFailures + loop.law.shearFailures, failed)

	def test_joints_alone_find_no_contact(self):
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=adobe()))
		falling = yade_brick.brick((.2, .2, .2), center=(0, 0, .1001), material=adobe())
		O.bodies.append(falling)
		O.engines = engines(contact=False, dt=1e-4)
		for _ in range(200):
			O.step()
		self.assertEqual(len(O.interactions), 0)
		self.assertAlmostEqual(falling.state.vel[2], -9.81 * .02, places=9)


class Words(Empty):

	def are(self, name, on, *parts, loop=None):
		"""The effect is on or off, with these parts in its words."""
		effect = effects(loop)[name]
		self.assertIs(effect.on, on, effect)
		for part in parts:
			self.assertIn(part, effect.why)

	def test_deformation(self):
		wall()
		self.are('deformation', True, '4 trilinear bricks', loop=engines())
		bricks(1, 1, origin=(2, 0, 0), deformation='rigid')
		self.are('deformation', True, '4 trilinear and 1 rigid bricks', loop=engines())
		O.reset()
		bricks(1, 1, deformation='rigid')
		self.are('deformation', False, '1 brick, all rigid', loop=engines())
		self.are('deformation', False, 'no BrickDynamics', loop=[])
		loop = engines()
		O.bodies.clear()
		self.are('deformation', False, 'no bricks', loop=loop)

	def test_deformation_that_changes(self):
		masonry = wall(columns=1)
		O.engines = engines()
		MortarJoints()()
		O.run(20, True)
		for body in masonry.bodies:
			body.shape.deformation = 'rigid'
		O.step()
		self.are('deformation', True, '2 rigid bricks, 2 of which change')
		O.run(math.ceil(1 / O.dt), True)
		self.are('deformation', False, '2 bricks, all rigid')

	def test_deformation_on_demand(self):
		wall(deformation='rigid')
		self.are('deformation on demand', False, 'not asked for', loop=engines())
		self.are('deformation on demand', True, 'trilinear from 0.25 of', 'or 2000 Pa', '0 promoted', loop=engines(onDemand=dict(utilisation=.25, stress=2e3)))

	def test_mortar(self):
		wall()
		O.engines = engines()
		self.are('mortar', False, 'not laid', 'MortarJoints()()')
		self.are('mortar', True, 'first step', loop=[MortarJoints()] + O.engines)
		MortarJoints()()
		self.are('mortar', True, '6 joints')
		self.are('mortar', False, 'no Law2_BrickGeom_BrickPhys_Mortar', loop=[])

	def test_dry(self):
		wall(adobe(mortar=False))
		self.are('mortar', False, 'dry', loop=engines())
		self.are('mortar failure', False, 'no mortar', loop=engines())

	def test_mortar_failure(self):
		wall()
		MortarJoints()()
		self.are('mortar failure', True, '0 segments failed', loop=engines())
		self.are('mortar failure', False, 'failure of the law is False', loop=engines(failure=False))

	def test_mortar_that_has_failed(self):
		wall(adobe(strength=10), columns=1, courses=1)
		O.engines = engines(gravity=(0, 0, 50))
		MortarJoints()()
		O.run(200, True)
		self.are('mortar', False, 'all joints have failed')
		self.are('mortar failure', True, '16 segments failed')

	def test_contact(self):
		wall(columns=3, courses=3)
		O.engines = engines()
		MortarJoints()()
		self.are('contact', True, 'comes near', '10 mm')
		self.are('contact in the core', False, '9 of 9 bricks')
		self.are('contact', False, 'no collider', loop=engines(contact=False))
		self.are('contact in the core', False, 'no collider', loop=engines(contact=False))
		self.are('contact', False, 'no Law2_BrickGeom_BrickPhys_Mortar', loop=O.engines[:2])
		O.interactions.clear()
		O.step()
		self.are('contact in the core', True, 'no brick has all its joints')

	def test_shapes_that_do_not_touch(self):
		wall()
		O.bodies.append([utils.sphere((0, 0, 2), .1), utils.facet(((0, 0, 3), (1, 0, 3), (0, 1, 3)))])
		self.are('contact', True, 'none for Facet, Sphere', loop=engines())
		self.are('contact', True, 'none for Facet:', loop=engines(functors=[wrapper.Bo1_Sphere_Aabb(), wrapper.Ig2_Sphere_Sphere_ScGeom()]))

	def test_friction(self):
		wall()
		self.are('friction', True, 'angle 32 degrees', loop=engines())
		self.are('friction', False, 'friction of the law is False', loop=engines(friction=False))
		O.reset()
		wall(adobe(frictionAngle=0))
		self.are('friction', False, 'no material and no mortar', loop=engines())
		MortarJoints(mortar=adobe(frictionAngle=.5).mortar)()
		self.are('friction', True, 'angle 0 to 28.6 degrees', loop=engines())

	def test_dashpots(self):
		wall()
		self.are('dashpots', True, 'hn 0.1, hs 0.1', loop=engines())
		self.are('dashpots', False, 'dashpots of the law is False', loop=engines(dashpots=False))
		O.reset()
		wall(adobe(hn=0, hs=0))
		self.are('dashpots', False, 'are 0', loop=engines())
		bricks(1, 1, adobe(hn=.2, hs=0), origin=(2, 0, 0))
		self.are('dashpots', True, 'hn 0 to 0.2, hs 0', loop=engines())

	def test_damping(self):
		wall()
		self.are('damping', False, '0', loop=engines())
		self.are('damping', True, '0.3 of rigid motion and 0.3 of deformation', loop=engines(damping=.3))
		bricks(1, 1, adobe(dampingRatio=.05), origin=(2, 0, 0))
		self.are('damping', True, '0 to 0.05 of critical', loop=engines())

	def test_gravity(self):
		wall()
		self.are('gravity', True, '(0, 0, -9.81) m/s2', loop=engines())
		self.are('gravity', False, '(0, 0, 0)', loop=engines(gravity=None))
		self.are('gravity', False, 'no NewtonIntegrator', loop=[])

	def test_ground_motion(self):
		wall()
		self.are('ground motion', False, 'none', loop=engines())
		self.are('ground motion', True, 'pushes', '2 s from O.time = 0 s', '6 m/s2', loop=engines(motion=motion()))
		self.are('ground motion', True, 'moves 1 body;', loop=engines(motion=yade_brick.GroundMotion(ids=[0], **shake())))

	def test_ledger(self):
		wall()
		loop = engines()
		self.are('energy ledger', False, 'O.trackEnergy is False', loop=loop)
		O.trackEnergy = True
		self.are('energy ledger', True, 'O.energy', loop=loop)

	def test_guard(self):
		wall()
		self.are('guard', True, "saved as 'stopped.yade.gz'", loop=engines())
		self.are('guard', False, 'guard of BrickDynamics is False', loop=engines(guard=False))
		self.are('guard', False, 'no BrickDynamics', loop=[])

	def test_time_step(self):
		wall()
		O.engines = engines(safety=.8)
		self.are('stable time step', True, '0.8 of a proven bound')
		O.step()
		self.are('stable time step', True, 'bound of %.3g s' % O.engines[3].limit)
		O.engines[3].active = False
		self.are('stable time step', False, 'fixed')
		self.are('stable time step', False, 'O.dt = 1e-05 s', loop=engines(dt=1e-5))
		self.are('stable time step', False, 'GlobalStiffnessTimeStepper, which', loop=[wrapper.GlobalStiffnessTimeStepper()])

	def test_besides(self):
		wall()
		O.engines = engines()
		self.are('besides', False, 'no other')
		O.engines = O.engines + [wrapper.PyRunner(label='look'), wrapper.VTKRecorder()]
		self.are('besides', True, "PyRunner 'look', VTKRecorder")

	def test_text(self):
		wall()
		O.engines = loop = engines()
		lines = str(loop).splitlines()
		self.assertEqual(len(lines), len(effects()))
		self.assertEqual(str(loop), str(effects()))
		for line, (name, on, why) in zip(lines, effects()):
			self.assertEqual(line.split('  ', 1)[0].strip(), name)
			self.assertTrue(line.endswith(('on   ' if on else 'off  ') + why), line)
		self.assertEqual(len({line.index(why) for line, (_, _, why) in zip(lines, effects())}), 1)

	def test_name_that_is_none(self):
		with self.assertRaisesRegex(KeyError, "'colour'.*friction"):
			effects([])['colour']


class Edited(Empty):
	"""The loop is an ordinary list of engines, and its words follow what is done to it."""

	def test_the_engines_are_those_of_the_scene(self):
		wall()
		O.engines = loop = engines()
		self.assertEqual(O.engines, list(loop))
		loop.newton.gravity = (0, 0, -1)
		self.assertEqual(effects()['gravity'].why, '(0, 0, -1) m/s2')
		O.engines[-1].gravity = (0, 0, -2)
		self.assertEqual(loop.newton.gravity, Vector3(0, 0, -2))

	def test_engines_may_be_added_taken_and_put_to_sleep(self):
		wall()
		loop = engines()
		ground = yade_brick.GroundMotion(**shake())
		loop.insert(loop.index(loop.newton), ground)
		self.assertIs(loop.ground, ground)
		self.assertTrue(effects(loop)['ground motion'].on)
		ground.dead = True
		self.assertFalse(effects(loop)['ground motion'].on)
		loop.remove(loop.collider)
		self.assertIsNone(loop.collider)
		self.assertFalse(effects(loop)['contact'].on)
		loop.law.friction = False
		self.assertFalse(effects(loop)['friction'].on)
		O.engines = loop
		O.step()

	def test_after_saving_and_loading(self):
		wall(deformation='rigid')
		O.engines = engines(friction=False)
		said = str(effects())
		O.saveTmp()
		O.reset()
		O.loadTmp()
		self.assertEqual(str(effects()), said)


class Refused(Empty):

	def refused(self, parts, **arguments):
		"""ValueError with all parts in its message; time step and ledger of the scene are left alone."""
		before = O.dt, O.trackEnergy
		with self.assertRaises(ValueError) as caught:
			engines(**arguments)
		for part in parts:
			self.assertIn(part, str(caught.exception))
		self.assertEqual((O.dt, O.trackEnergy), before)

	def test_numbers(self):
		wall()
		nan, inf = math.nan, math.inf
		for name, wrong, allowed in (
		        ('damping', (-.1, 1, nan, '.1', True, None), '0 <= damping < 1'), ('safety', (0, 1.1, nan, None), '0 < safety <= 1'),
		        ('dt', (0, -1, nan, inf, '1', False, 10**400), '> 0'), ('verletDist', (-1, nan, inf, '0', True), '>= 0'),
		        ('gravity', (9.81, (0, 0), (0, 0, nan), (0, 0, 'down'), 'down', (0, 0, 10**400), False, {0: 1, 1: 2, 2: 3}), 'three finite numbers')
		):
			for value in wrong:
				with self.subTest(name, value=value):
					self.refused([f'{name} is {value!r}', allowed], **{'ledger': True, name: value})

	def test_choices(self):
		wall()
		for name, wrong, allowed in (
		        ('failure', (0, 1, 'no'), 'None, True or False'), ('friction', (.5, ), 'None, True or False'), ('dashpots', (.1, ), 'None, True or False'),
		        ('contact', (None, 0, 'no'), 'True or False'), ('guard', (None, 1), 'True or False'), ('ledger', (0, 'yes'), 'None, True or False'),
		        ('stopFile', (None, 3), 'name of a file')
		):
			for value in wrong:
				with self.subTest(name, value=value):
					self.refused([f'{name} is {value!r}', allowed], **{'dt': 1., name: value})

	def test_engines(self):
		wall()
		self.refused(['motion is 3', 'Motion', 'GroundMotion'], motion=3)
		self.refused(['motion is ', 'NewtonIntegrator'], motion=wrapper.NewtonIntegrator())
		self.refused(['onDemand is 3', 'True, False, a dict'], onDemand=3)
		self.refused(["onDemand is {'colour': 3}", 'attributes of DeformationOnDemand', 'colour'], onDemand=dict(colour=3))
		self.refused(["onDemand is {'level': 3}", 'attributes of DeformationOnDemand'], onDemand=dict(level=3))

	def test_effects_of_no_engines(self):
		for given in (1, [0.], 'x'):
			with self.assertRaisesRegex(ValueError, 'engines is .*list of engines'): effects(given)

	def test_functors(self):
		wall()
		self.refused(['functors is 3', 'list'], functors=3)
		self.refused(['functors has ', 'NewtonIntegrator', 'Bo1'], functors=[wrapper.NewtonIntegrator()])
		self.refused(['functors has 2', 'BoundFunctor', 'Brick'], functors=[yade_brick.Bo1_Brick_Aabb(), yade_brick.Bo1_Brick_Aabb()])
		self.refused(['functors has Bo1_Sphere_Aabb', 'contact is False'], functors=[wrapper.Bo1_Sphere_Aabb()], contact=False)

	def test_arguments_have_names(self):
		wall()
		with self.assertRaises(TypeError):
			engines((0, 0, -9.81))
