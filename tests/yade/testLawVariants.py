# SPDX-License-Identifier: GPL-2.0-or-later
# The law without failure, friction or dashpots: the same to the last bit as with materials that have none; switched in mid-run; its energy.
import os, re, tempfile, unittest

from yade import O, utils
from yade.wrapper import ForceResetter, InsertionSortCollider, InteractionLoop, Bo1_Wall_Aabb, NewtonIntegrator
from yade_brick import *
from yade.minieigenHP import Vector3

from collapse import DENSITY, SIDE, cube, failures, law, state

TERMS = 'failure', 'friction', 'dashpots'
LEVELS = 'trilinear', 'rigid', 'refined', 'uniform'
STEPS = 900


def build(mortar={}, **attributes):
	"""A wall of 3 x 3 cubes in weak mortar under a pulse that cracks it, and a cube that drops on it from a millimetre; nothing run yet."""
	O.reset()
	strengths = dict(tensileStrength=2e3, cohesion=4e3, frictionAngle=.5, compressiveStrength=5e5)
	strengths.update(mortar)
	given = dict(young=9.8e6, poisson=.25, density=DENSITY, frictionAngle=.5, dampingRatio=.02, hn=.1, hs=.1)
	given.update(attributes)
	O.materials.append(BrickMat(mortar=Mortar(**strengths), **given))
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=O.materials[0]))
	for k in range(3):
		for i in range(3):
			O.bodies.append(cube(Vector3(SIDE * (i + .5), 0, SIDE * (k + .5)), O.materials[0], LEVELS[(i + 2 * k) % 4]))
	O.bodies.append(cube(Vector3(SIDE, 0, 3.5 * SIDE + 1e-3), O.materials[0], 'trilinear'))
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=.01),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(),
	        BrickDynamics(),
	        GroundMotion(dt=.02, acceleration=[Vector3(12, 5, 2) * s for s in (0, 1, 1, -1, -1, 1, 0)]),
	        NewtonIntegrator(gravity=(0, 0, -9.8), damping=0),
	]
	MortarJoints()()


def run(steps):
	"""dt of each step [s]."""
	out = []
	for _ in range(steps):
		O.step()
		out.append(O.dt)
	return out


def failed():
	return sum(failures()[:3])


def shear():
	"""Shear forces [N] of the pairs that are no joint or a joint without a segment that holds, and stresses [Pa] of failed segments."""
	out = []
	for i in O.interactions:
		if not i.isReal: continue
		if not i.phys.jointed: out.append(i.phys.shearForce.norm())
		else: out += [t.norm() for t, s in zip(i.phys.shearStress(i.geom), i.phys.segmentState) if s]
	return out


class Vanishing(unittest.TestCase):
	"""Each term switched off, beside the same scene with materials that have none of it."""

	def tearDown(self):
		O.reset()

	def compare(self, terms, scene, leaner, steps=STEPS):
		"""Runs both; the number of segments that failed."""
		build(**scene)
		for term in terms:
			setattr(law(), term, False)
		dts, self.touched = [], False
		while len(dts) < steps:
			dts += run(20)
			self.touched = self.touched or any(i.isReal and not i.phys.jointed for i in O.interactions)
		found, count = state(), failed()
		merged = dict(scene)
		merged.update(leaner)
		build(**merged)
		self.assertEqual(run(steps), dts)
		expected = state()
		self.assertEqual(sorted(found), sorted(expected))
		self.assertEqual([name for name in expected if found[name] != expected[name]], [])
		return count

	# a cohesion that nothing reaches, since the angle of the mortar counts in its strength, too

	def test_friction(self):
		count = self.compare(['friction'], dict(mortar=dict(cohesion=1e9)), dict(mortar=dict(cohesion=1e9, frictionAngle=0), frictionAngle=0))
		self.assertGreater(count, 0)

	def test_dashpots(self):
		self.assertGreater(self.compare(['dashpots'], {}, dict(hn=0, hs=0)), 0)

	def test_failure(self):
		huge = dict(tensileStrength=1e30, cohesion=1e30, compressiveStrength=1e30)
		self.assertEqual(self.compare(['failure'], {}, dict(mortar=huge)), 0)
		self.assertTrue(self.touched, 'the cube never touched the wall')

	def test_all(self):
		huge = dict(tensileStrength=1e30, cohesion=1e30, compressiveStrength=1e30, frictionAngle=0)
		self.compare(TERMS, {}, dict(mortar=huge, frictionAngle=0, hn=0, hs=0), 400)


class Switched(unittest.TestCase):
	"""In mid-run."""

	def setUp(self):
		build()
		run(120)
		self.assertGreater(failed(), 0)

	def tearDown(self):
		O.reset()

	def states(self):
		return {(i.id1, i.id2): list(i.phys.segmentState) for i in O.interactions if i.isReal and i.phys.jointed}

	def test_failure_off_keeps_what_has_failed_and_what_holds(self):
		self.assertTrue(any(0 < sum(map(bool, s)) < len(s) for s in self.states().values()), 'no joint is cracked in part')
		before, count = self.states(), failed()
		law().failure = False
		run(300)
		self.assertEqual((self.states(), failed()), (before, count))
		law().failure = True
		run(300)
		self.assertGreater(failed(), count)

	def test_friction_off_and_on_has_no_jump_of_shear(self):
		self.assertGreater(max(shear()), 0)
		law().friction = False
		for _ in range(50):
			run(1)
			self.assertLess(max(shear()), 1e-9)  # of contacts: round-off of the sum of normal forces
		law().friction = True
		run(1)
		# what a step of motion gives: ks dt |v| with room for the fastest
		fastest = max(b.state.vel.norm() + SIDE * b.state.angVel.norm() for b in O.bodies)
		for i in O.interactions:
			if i.isReal and not i.phys.jointed: self.assertLess(i.phys.shearForce.norm(), 3 * i.phys.ks * O.dt * fastest)
		run(100)
		self.assertGreater(max(shear()), 0)

	def test_dashpots_on_again_shorten_the_step_at_once(self):
		build()
		O.bodies.erase(10)  # the cube that falls is counted anew when it touches
		O.step()
		damped = O.dt
		build()
		O.bodies.erase(10)
		law().dashpots = False
		O.step()
		self.assertGreater(O.dt, 1.001 * damped)
		run(3)
		law().dashpots = True
		O.step()
		self.assertEqual(O.dt, damped)


class Energy(unittest.TestCase):

	def tearDown(self):
		O.reset()

	def test_total_stays_and_what_is_off_takes_nothing(self):
		entry = dict(failure='fracture', friction='plastDissip', dashpots='dashpots')
		for off in (['failure'], ['friction'], ['dashpots'], TERMS):
			build()
			for term in off:
				setattr(law(), term, False)
			O.trackEnergy = True
			run(1)
			total = O.energy.total()
			run(699)
			energy = dict(O.energy.items())
			self.assertEqual([energy[entry[term]] for term in off], [0] * len(off), off)
			self.assertTrue(all(energy[e] != 0 for t, e in entry.items() if t not in off), energy)
			turned = sum(abs(e) for e in energy.values())
			# as with the full law, see stability/testLedger.py: the step in which a joint or contact closes is not linear
			self.assertLess(abs(O.energy.total() - total), 1e-2 * turned, '%s: %s' % (off, energy))


class Kept(unittest.TestCase):

	def tearDown(self):
		O.reset()

	def test_saved_in_the_middle_of_a_lean_run(self):
		build()
		law().friction = law().dashpots = False
		run(500)
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'scene.xml.gz')
			O.save(path)
			run(500)
			expected = state()
			O.reset()
			O.load(path)
		self.assertEqual([getattr(law(), term) for term in TERMS], [True, False, False])
		run(500)
		self.assertEqual(state(), expected)

	def test_one_and_two_threads_are_the_same(self):
		from buildYade import run as runYade
		prints = []
		for threads in (1, 2):
			scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'collapse.py')
			process = runYade('-n', '-x', '-j%d' % threads, scene, '2000', '.02', '3', '3', 'friction', 'dashpots', timeout=300)
			self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
			prints.append(re.findall(r'^fingerprint (\w+)$', process.stdout, re.M))
		self.assertEqual(len(prints[0]), 1)
		self.assertEqual(prints[0], prints[1])
