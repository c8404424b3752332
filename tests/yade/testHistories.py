# SPDX-License-Identifier: GPL-2.0-or-later
# Histories against what they measure: momentum balance for the base shear, prescribed motion for displacement and drift, the law's counters, the energy ledger.
import math, os, tempfile, unittest

from yade import *
from yade import plot, Quaternion, Vector3
import numpy as np
from yade_brick import build, engines, histories, loop, motion, Histories, wallHistories

phi = math.radians(32)


def laidWall(columns=2, courses=3, strong=True, ground=None, dt=2e-4, floor=True, **options):
	"""A wall of rigid bricks on the floor (body 0) with its mortar, which does not fail here where it is strong. The step is stable with some margin."""
	O.reset()
	plot.resetData()
	scale = 1e3 if strong else 1
	mortar = Mortar(tensileStrength=4.6e3 * scale, cohesion=2.9e3 * scale, frictionAngle=phi, compressiveStrength=4.9e5 * scale)
	adobe = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=phi, mortar=mortar)
	if floor:
		O.bodies.append(utils.wall(0, axis=2, sense=1, material=adobe))
	wall = build.straightJointWall(columns, courses, material=adobe, deformation='rigid', segments=2)
	O.bodies.append(wall.bodies)
	O.engines = engines(gravity=(0, 0, -9.8), dt=dt, motion=ground, **options)
	MortarJoints()()
	return wall


def momentum(bodies):
	return np.array(sum((body.state.mass * body.state.vel for body in bodies), Vector3.Zero))


def rateOfMomentum(bodies):
	"""Sum of mass times acceleration in the next step [N]: of leap-frog, exactly the forces of that step."""
	before = momentum(bodies)
	O.step()
	return (momentum(bodies) - before) / O.dt


class BaseShear(unittest.TestCase):

	def balance(self, wall, steps, ground=0):
		"""Largest |sum m (a + z'') + V| and of the vertical balance, by the weight; and the largest base shear by the weight."""
		floor = O.bodies[0]
		shears = [histories.baseShear(floor, axis) for axis in 'xy']
		axial, mass = histories.axialLoad(floor), sum(body.state.mass for body in wall.bodies)
		weight, worst, largest = mass * 9.8, 0, 0
		acceleration = histories.groundAcceleration('x')
		for _ in range(steps):
			z = acceleration()  # of the step to be done
			rate = rateOfMomentum(wall.bodies)
			worst = max(worst, abs(rate[0] + mass * z + shears[0]()), abs(rate[1] + shears[1]()), abs(rate[2] - axial() + weight))
			largest = max(largest, abs(shears[0]()))
		return worst / weight, largest / weight

	def test_balances_the_momentum_of_a_wall_that_swings_freely(self):
		wall = laidWall()
		for course, bodies in enumerate(wall.courses):
			for body in bodies:
				body.state.vel = Vector3(.05 * (course + 1), .01 * course, 0)
		worst, largest = self.balance(wall, 200)
		self.assertGreater(largest, .1)  # it is a test of something
		# differences of momenta of some 10 kg m/s by a step of 2e-4 s: round-off of 1e-15 * 10 / 2e-4 = 1e-10 N of 850 N
		self.assertLess(worst, 1e-10)

	def test_balances_the_ground_acceleration_as_inertia(self):
		wall = laidWall(ground=motion.Motion(.01, [(3 * math.sin(.2 * i), 0, 0) for i in range(100)], 'sine'))
		worst, largest = self.balance(wall, 300)
		self.assertGreater(largest, .05)
		self.assertLess(worst, 1e-10)  # as above

	def test_balances_while_joints_crack_and_bricks_fall(self):
		wall = laidWall(strong=False)
		for body in wall.bodies:
			body.state.vel = Vector3(1.5, .2, 0)
		worst, largest = self.balance(wall, 1500)
		self.assertGreater(sum(histories.cracks(mode)() for mode in ('tension', 'shear', 'compression')), 4)
		self.assertLess(worst, 1e-9)  # momenta are ten times as large

	def test_is_the_load_of_a_static_pushover(self):
		wall = laidWall()
		for body in wall.bodies:
			O.forces.setPermF(body.id, (100, 0, 0))
		StaticEquilibrium()()
		O.step()
		shear, axial = histories.baseShear(O.bodies[0]), histories.axialLoad(O.bodies[0])
		weight = 9.8 * sum(body.state.mass for body in wall.bodies)
		# the statics is that of small displacements: the bricks turn by 1e-3, whose square is what remains of 850 N
		self.assertAlmostEqual(shear(), 600, delta=2e-3)
		self.assertAlmostEqual(axial(), weight, delta=2e-3)

	def test_forces_on_several_supports_add_up(self):
		wall = laidWall()
		for body in wall.courses[0]:
			body.dynamic = False
		O.step()
		one = sum(histories.baseShear(body, 'z')() for body in (O.bodies[0], *wall.courses[0]))
		both = histories.baseShear([O.bodies[0], *wall.courses[0]], 'z')()
		alone = histories.baseShear(list(wall.courses[0]), 'z')()
		self.assertAlmostEqual(one, both, places=9)
		self.assertAlmostEqual(alone + histories.baseShear(O.bodies[0], 'z')(), both, places=9)

	def test_directions_may_be_oblique(self):
		wall = laidWall()
		for body in wall.bodies:
			body.state.vel = Vector3(.1, .05, 0)
		O.run(20, True)
		x, y, oblique = (histories.baseShear(O.bodies[0], along)() for along in ('x', 'y', (3, 4, 0)))
		self.assertAlmostEqual(oblique, .6 * x + .8 * y, places=9)


class Motions(unittest.TestCase):

	def test_displacement_and_drift_of_a_prescribed_shear(self):
		wall = laidWall()
		for body in wall.bodies:
			body.state.pos += Vector3(.02 * body.state.refPos[2], .001, 0)
		self.assertAlmostEqual(histories.displacement(list(wall.courses[2]))(), .02 * .5, places=12)
		self.assertAlmostEqual(histories.displacement(wall.bodies[0], 'y')(), .001, places=12)
		self.assertAlmostEqual(histories.drift(list(wall.courses[2]), list(wall.courses[0]))(), .02, places=12)
		both = wallHistories(wall, storeys=wall.courses)
		both()
		self.assertTrue(math.isnan(both['elastic energy'][0]))  # no step has been done
		# the floor is at 0, the top course at 0.5 m
		self.assertAlmostEqual(both['drift'][0], .02, places=12)
		self.assertAlmostEqual(both['drift 2'][0], .02, places=12)
		self.assertAlmostEqual(both['top displacement'][0], .01, places=12)

	def test_corner_turns_with_its_brick(self):
		wall = laidWall()
		body = wall.bodies[0]
		corner = histories.displacement(body, 'x', corner=6)
		body.state.ori = Quaternion((0, 0, 1), math.pi / 2)
		# (+, +, +) goes to (-, +, +): by a whole edge of 0.2 m
		self.assertAlmostEqual(corner(), -.2, places=12)

	def test_what_moves_with_the_ground_is_no_displacement(self):
		shake = motion.Motion(.01, [(3 * math.sin(.2 * i), 0, 0) for i in range(100)], 'sine')
		wall = laidWall(ground=build.groundMotion(shake, ids=[0]))
		record = wallHistories(wall)
		O.run(400, True)
		record()
		absolute = histories.displacement(list(wall.courses[-1]))()
		ground = O.bodies[0].state.pos[0]
		self.assertGreater(abs(ground), 1e-3)
		self.assertAlmostEqual(record['top displacement'][0], absolute - ground, places=12)

	def test_bricks_have_fallen_that_came_down_by_half_their_height(self):
		wall = laidWall()
		down = histories.fallen(wall.bodies)
		wall.bodies[5].state.pos -= Vector3(0, 0, .099)
		self.assertEqual(down(), 0)
		wall.bodies[5].state.pos -= Vector3(0, 0, .002)
		self.assertEqual((down(), histories.fallen(wall.bodies, depth=.2)()), (1, 0))


class CountsAndEnergies(unittest.TestCase):

	def test_cracks_are_those_of_the_law(self):
		wall = laidWall(strong=False)
		wall.bodies[-1].state.vel = Vector3(0, 0, 3)
		O.run(300, True)
		law = loop.Loop(O.engines).law
		self.assertGreater(law.tensionFailures, 0)
		self.assertEqual([histories.cracks(mode)() for mode in ('tension', 'shear', 'compression')],
		                 [law.tensionFailures, law.shearFailures, law.compressionFailures])

	def test_energies_and_dissipation_close_the_balance(self):
		wall = laidWall(strong=False, ledger=True)
		for body in wall.bodies:
			body.state.vel = Vector3(.8, 0, 0)
		O.step()
		O.step()
		kinetic, elastic, lost = histories.storedEnergy('kinetic', wall.bodies), histories.storedEnergy('elastic', wall.bodies), histories.dissipated()
		weights = [9.8 * body.state.mass for body in wall.bodies]

		def total():
			return kinetic() + elastic() + lost() + sum(weight * body.state.pos[2] for weight, body in zip(weights, wall.bodies))

		before, least = total(), lost()
		O.run(800, True)
		self.assertGreater(lost() - least, 1)
		# velocities are of half a step before: 9.8 m/s2 * 1e-4 s against 0.8 m/s, of some 100 J
		self.assertAlmostEqual(total(), before, delta=.02 * lost())

	def test_dissipation_is_unknown_unless_energy_is_tracked(self):
		wall = laidWall()
		self.assertTrue(math.isnan(histories.dissipated()()))
		self.assertNotIn('dissipated energy [J]', wallHistories(wall).columns)


class Columns(unittest.TestCase):

	def test_samples_are_in_yades_plot_and_its_text_file(self):
		wall = laidWall()
		record = wallHistories(wall)
		O.engines = O.engines + [PyRunner(command='record()', iterPeriod=5)]
		import __main__
		__main__.record = record
		for _ in range(20):
			O.step()
		self.assertGreater(len(record), 2)
		self.assertEqual(plot.data['baseShearCoefficient'], record['base shear coefficient'].tolist())
		self.assertEqual(plot.data['t'], record.time.tolist())
		self.assertEqual(plot.labels['axialLoad'], 'axial load [N]')
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'plot.txt')
			plot.saveDataTxt(path, vars=('t', 'axialLoad'))
			np.testing.assert_allclose(np.loadtxt(path), np.column_stack([record.time, record['axial load']]), rtol=1e-12)

	def test_csv_is_read_back_and_a_continued_run_goes_on_with_it(self):
		wall = laidWall()
		record, again = wallHistories(wall), wallHistories(wall, plot=False)
		for _ in range(4):
			O.step()
			record()
		O.step()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'new', 'histories.csv')
			record.write(path)
			columns = histories.readHistories(path)
			self.assertEqual(list(columns), list(record.columns))
			for heading, values in record.columns.items():
				np.testing.assert_allclose(columns[heading], values, rtol=1e-8, err_msg=heading)  # nine digits
			again.readBack(path)
			again()
			self.assertEqual(len(again), 5)
			with self.assertRaisesRegex(ValueError, '5 samples already'):
				again.readBack(path)

	def test_reading_back_leaves_out_what_is_yet_to_come(self):
		wall = laidWall()
		first = wallHistories(wall)
		times = []
		for step in range(4):
			O.step()
			times.append(O.time)
			first()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'histories.csv')
			first.write(path)
			wall = laidWall()
			second = wallHistories(wall)
			O.step(), O.step(), O.step()
			second.readBack(path)
			np.testing.assert_allclose(second.time, times[:2])
			self.assertEqual(len(plot.data['t']), 2)

	def test_second_sample_of_a_time_replaces_the_first(self):
		laidWall()
		values = iter((1, 2, 3))
		record = Histories({'number [-]': lambda: next(values)})
		record(), record()
		self.assertEqual((record['number'].tolist(), plot.data['number']), ([2], [2]))
		O.step()
		record()
		self.assertEqual((record['number [-]'].tolist(), plot.data['number']), ([2, 3], [2, 3]))

	def test_column_that_comes_later_is_nan_before(self):
		laidWall()
		record = Histories({'one [-]': lambda: 1})
		record()
		record['two [m]'] = lambda: 2
		O.step()
		record()
		np.testing.assert_array_equal(record['two'], [math.nan, 2])
		np.testing.assert_array_equal(plot.data['two'], [math.nan, 2])

	def test_figure_has_a_panel_for_each_unit_that_is_asked_for(self):
		wall = laidWall()
		record = wallHistories(wall)
		O.step()
		record()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'histories.png')
			record.figure(path)
			self.assertGreater(os.path.getsize(path), 5000)
			with self.assertRaisesRegex(ValueError, 'the units'):
				record.figure(path, panels=[['drift', 'base shear']])
			with self.assertRaisesRegex(KeyError, 'shear force'):
				record.figure(path, panels=[['shear force']])


class Refusals(unittest.TestCase):

	def test_wrong_arguments_are_told(self):
		wall = laidWall()
		for call, text in (
		        (lambda: Histories({'drift': lambda: 0}), 'unit in brackets'), (lambda: Histories({'drift [-]': 3}), 'function without arguments'),
		        (lambda: Histories({'a b [m]': min, 'aB [m]': min}), 'has the name aB'), (lambda: Histories([1]), 'columns is'),
		        (lambda: Histories({'drift [-]': lambda: 'x'})(), 'has returned'), (lambda: histories.baseShear([], 'x'), 'at least one'),
		        (lambda: histories.baseShear(wall.bodies, 'w'), "direction is 'w'"), (lambda: histories.displacement(wall.bodies, (0, 0, 0)), 'direction is'),
		        (lambda: histories.displacement(wall.bodies, corner=8), 'corner is 8'), (lambda: histories.cracks('bending'), "mode is 'bending'"),
		        (lambda: histories.drift(wall.bodies[0], wall.bodies[1]), 'height > 0'), (lambda: histories.fallen(wall.bodies, 0), 'depth is 0'),
		        (lambda: wallHistories(wall, gravity=-1), 'gravity is -1'), (lambda: histories.storedEnergy('potential', wall.bodies), "kind is 'potential'"),
		):
			with self.assertRaisesRegex(ValueError, text):
				call()

	def test_wall_without_support_is_refused(self):
		wall = laidWall(floor=False)
		with self.assertRaisesRegex(ValueError, 'no fixed body'):
			wallHistories(wall)
