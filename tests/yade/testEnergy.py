# SPDX-License-Identifier: GPL-2.0-or-later
# The energy ledger of O.energy, and the guard that stops a run whose joints and contacts make energy.
import os, sys, tempfile, unittest

import collapse
from yade import O, Quaternion, Vector3
from yade_brick import *

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'verification'))
import cases
from cases import DENSITY, GRAVITY, engine, ground

SIDE = .2
MASS = DENSITY * SIDE**3


def scene(gravity=True, before=(), safety=.9, **attributes):
	"""Engines and a material, whose energy is tracked; the material."""
	O.reset()
	cases.engines(gravity=(0, 0, -GRAVITY * gravity), safety=safety, before=before)
	O.trackEnergy = True
	return cases.material(**{'frictionAngle': .5, 'hn': 0, 'hs': 0, **attributes})


def add(center, material, **options):
	return cases.add((SIDE, SIDE, SIDE), center=center, material=material, **options)


def run(steps):
	for _ in range(steps):
		O.step()


class Ledger(unittest.TestCase):

	def tearDown(self):
		O.reset()

	def near(self, a, b, tolerance):
		self.assertLessEqual(abs(a - b), tolerance, '%.9g, not %.9g' % (a, b))

	def test_changes_nothing_and_is_off_unless_asked_for(self):
		prints = []
		for tracked in (False, True):
			collapse.build()
			O.trackEnergy = tracked
			O.run(1500, True)
			prints.append(collapse.fingerprint())
			self.assertEqual(bool(O.energy.keys()), tracked)
		self.assertEqual(*prints)

	def test_free_fall_and_bounce(self):
		"""In the step in which contact begins its force does the work of half the step's way, for whatever part of it there is contact: an error of the square of the
		step, with which it falls."""
		errors = []
		for safety in (.1, .05):
			m = scene(safety=safety)
			ground(m)
			b = add((0, 0, .6 * SIDE), m)
			error = 0
			while b.state.vel[2] <= 0:
				O.step()
				error = max(error, abs(O.energy.total()) / -O.energy['gravWork'] if O.iter > 1 else 0)
			errors.append(error)
			self.assertAlmostEqual(O.energy['deformElastic'], b.shape.elasticEnergy(), delta=.2 * b.shape.elasticEnergy())
		self.assertLess(errors[0], (.18)**2 / 2)  # omega dt is 0.18 at most
		self.assertLess(errors[1], (.09)**2 / 2)

	def test_weight_held_by_joints(self):
		m = scene(mortar=Mortar(tensileStrength=1e9, cohesion=1e9, frictionAngle=.5, compressiveStrength=1e9))
		ground(m)
		for k in range(3):
			add((0, 0, SIDE * (k + .5)), m)
		MortarJoints()()
		O.step()
		total = O.energy.total()
		for _ in range(20):
			run(50)
			self.near(O.energy.total(), total, 1e-6 * -O.energy['gravWork'] + 1e-9)
		self.near(O.energy['elastPotential'], sum(i.phys.elasticEnergy(i.geom) for i in O.interactions if i.isReal), 1e-12)

	def test_friction_of_a_block_that_slides_to_rest(self):
		for level in ('rigid', 'trilinear'):
			m = scene(dampingRatio=.1, hn=.5, hs=.5)
			ground(m)
			b = add((0, 0, SIDE / 2), m, deformation=level)
			run(400)
			b.state.vel += Vector3(.3, 0, 0)
			O.step()
			total, slid, start = O.energy.total(), O.energy['plastDissip'], b.state.pos[0]
			run(3000)
			self.assertLess(b.state.vel.norm(), 1e-3)
			self.near(O.energy['plastDissip'] - slid, MASS * .3**2 / 2, .1 * MASS * .3**2 / 2)  # the rest: dashpots while it pitches
			self.near(O.energy.total(), total, 2e-3 * MASS * .3**2 / 2)

	def test_work_of_a_support_that_moves(self):
		"""A fixed brick under another moves sideways and takes it along: its work is that of friction and of the velocity given."""
		m = scene(hn=.5, hs=.5)
		base = add((0, 0, -SIDE / 2), m, fixed=True, deformation='rigid')
		rider = add((0, 0, SIDE / 2), m, deformation='rigid')
		run(200)
		total = O.energy.total()
		base.state.vel = Vector3(.2, 0, .05)
		run(300)
		self.assertGreater(rider.state.vel[0], .1)
		self.near(O.energy.total(), total, 5e-3 * -O.energy['supportWork'])
		risen = MASS * GRAVITY * (rider.state.pos[2] - SIDE / 2)
		self.near(-O.energy['gravWork'], -risen, .02 * risen)  # the base's own weight does not count

	def test_ground_motion_seen_from_the_ground_and_from_space(self):
		"""A column shaken either way: the ledger closes, and the work differs by that of moving the whole column with the ground."""
		pulse = [Vector3(3, 1, 0) * s for s in (0, 1, 1, -1, -1, 0)]
		for ids in ([], [0]):
			motion = GroundMotion(dt=.05, acceleration=pulse, ids=ids)
			m = scene(before=[motion], mortar=Mortar(tensileStrength=1e9, cohesion=1e9, frictionAngle=.5, compressiveStrength=1e9))
			add((0, 0, -SIDE / 2), m, fixed=True, deformation='rigid')
			for k in range(3):
				add((0, 0, SIDE * (k + .5)), m)
			MortarJoints()()
			O.step()
			total, work = O.energy.total(), 0
			while O.time < .3:
				run(50)
				name = 'supportWork' if ids else 'groundWork'
				work = max(work, abs(O.energy[name]))
				self.near(O.energy.total(), total, 1e-4 * work + 1e-6)
			self.assertGreater(work, .1)

	def test_takes_up_again(self):
		"""Switched off and on, and after loading: the ledger goes on from there."""
		collapse.build()
		O.trackEnergy = True
		O.run(1500, True)
		O.saveTmp()
		O.loadTmp()
		run(1)
		total = O.energy.total()
		O.trackEnergy = False
		run(100)
		O.trackEnergy = True
		O.energy.clear()
		run(2)
		total = O.energy.total()
		run(200)
		self.near(O.energy.total(), total, .05 * O.energy['kinetic'])


class Guard(unittest.TestCase):

	def tearDown(self):
		O.reset()

	def overlapping(self):
		"""A brick is put into another during the run."""
		m = scene(gravity=False)
		add((0, 0, 0), m)
		run(10)
		add((0, 0, .97 * SIDE), m)

	def test_stops_saves_and_names(self):
		self.overlapping()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'stopped.yade.gz')
			engine(BrickDynamics).stopFile = path
			with self.assertRaisesRegex(RuntimeError, r"energy from nothing: \S+ J of work on the bodies within \d+ steps.*bodies #(0 and #1|1 and #0) have been inside.*"
			                            r"guard = False.*saved as '" + path):
				run(500)
			stopped = O.iter
			O.load(path)
			self.assertEqual(O.iter, stopped)
			O.step()

	def test_says_that_it_could_not_save(self):
		self.overlapping()
		engine(BrickDynamics).stopFile = '/nowhere/stopped.yade.gz'
		with self.assertRaisesRegex(RuntimeError, 'energy from nothing.*could not be saved'):
			run(500)

	def test_can_be_switched_off(self):
		self.overlapping()
		engine(BrickDynamics).guard = False
		run(500)

	def test_is_silent_where_energy_comes_from_outside(self):
		"""Hard impacts at the default step, a support that starts suddenly, a collapse."""
		m = scene(gravity=False)
		ground(m)
		b = add((0, 0, SIDE), m, orientation=Quaternion(Vector3(1, 2, 0).normalized(), .7))
		b.state.vel = Vector3(0, 0, -5)
		run(3000)
		m = scene()
		base = add((0, 0, -SIDE / 2), m, fixed=True)
		add((0, 0, SIDE / 2), m)
		run(50)
		base.state.vel = Vector3(0, 0, 3)
		run(2000)
		collapse.build()
		O.run(8000, True)
