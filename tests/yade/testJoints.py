# SPDX-License-Identifier: GPL-2.0-or-later
# Joints laid with different mortar, listed and written; planted mistakes that the check has to find, and good masonry that it has to leave alone.
import csv, math, os, tempfile, time, unittest

import numpy as np

import yade_brick
from yade import O, Quaternion, Vector3, utils
from yade.wrapper import FrictMat
from yade_brick import *
from yade_brick import faces

SIDE = .2


def mortar(strength=1e9):
	return Mortar(tensileStrength=strength, cohesion=strength, frictionAngle=.6, compressiveStrength=1e9)


def adobe(filling=None, **attributes):
	return BrickMat(**{**dict(young=1e9, poisson=.2, density=1800, frictionAngle=.6, mortar=filling), **attributes})


class Scene(unittest.TestCase):

	def setUp(self):
		O.reset()
		self.clay = adobe(mortar())

	def ground(self):
		return O.bodies.append(utils.wall(0, axis=2, sense=1, material=FrictMat(frictionAngle=.6)))

	def wall(self, columns=3, courses=3, **options):
		made = englishBondWall(columns, courses, (SIDE, SIDE, SIDE), material=self.clay, deformation='rigid', **options)
		O.bodies.append(made.bodies)
		return made

	def cube(self, x, y, z, **options):
		return O.bodies.append(brick((SIDE, SIDE, SIDE), center=(x, y, z), **{**dict(material=self.clay, deformation='rigid'), **options}))

	def refused(self, words, call):
		with self.assertRaisesRegex(ValueError, words):
			call()


class Laying(Scene):

	def test_bed_and_head_joints_get_their_mortar(self):
		self.ground()
		self.wall()
		bed, head = mortar(2), mortar(3)
		laid = layMortar(bed=bed, head=head)
		# English bond of 3, 4, 3: 2 + 3 + 2 head joints; 3 beds on the ground, and each of the 6 places between courses where two overlap, twice
		self.assertEqual((len(laid.ofKind('head')), len(laid.ofKind('bed')), len(laid)), (7, 3 + 12, 22))
		self.assertEqual({joint.mortar.tensileStrength for joint in laid.ofKind('bed')}, {2})
		self.assertEqual({joint.mortar.tensileStrength for joint in laid.ofKind('head')}, {3})
		self.assertEqual([joint.ids for joint in listJoints()], [joint.ids for joint in laid])
		self.assertEqual({joint.mortar for joint in listJoints()}, {None})
		self.assertEqual(len(layMortar()), 0)  # what is joined stays

	def test_mortar_that_is_laid_is_the_one_that_fails(self):
		self.ground()
		self.wall(3, 2)
		O.engines = yade_brick.engines(gravity=(0, 0, 9.8))  # pulls beds apart
		laid = layMortar(bed=mortar(1))
		StaticEquilibrium()()
		O.step()
		now = laid.now()
		self.assertEqual({joint.state for joint in now.ofKind('head')}, {'intact'})
		self.assertEqual({joint.state for joint in now.ofKind('bed')}, {'failed'})
		self.assertEqual({joint.failed - joint.segments for joint in now.ofKind('bed')}, {0})
		self.assertEqual({joint.kind for joint in listJoints()}, {'head'})

	def test_collar_joints_are_those_between_leaves(self):
		for y in (0, SIDE):
			O.bodies.append(straightJointWall(3, 2, (SIDE, SIDE, SIDE), origin=(0, y, 0), material=self.clay, deformation='rigid').bodies)
		laid = layMortar(collar=mortar(5), along=(1, 0, 0))
		self.assertEqual([len(laid.ofKind(kind)) for kind in ('bed', 'head', 'collar', 'inclined')], [6, 8, 6, 0])
		for kind, strength in (('bed', 1e9), ('head', 1e9), ('collar', 5)):
			self.assertEqual({joint.mortar.tensileStrength for joint in laid.ofKind(kind)}, {strength})
		self.assertEqual(len(listJoints().ofKind('head')), 14)
		self.assertEqual(len(listJoints(along=(0, 3, 0)).ofKind('head')), 6)

	def test_head_and_collar_joints_may_be_dry(self):
		for given, expected in (
		        (dict(head=False), [6, 0, 0]), (dict(head=False, along=(1, 0, 0)), [6, 0, 0]), (dict(head=False, collar=mortar(2), along=(1, 0, 0)), [6, 0, 6]),
		        (dict(collar=False, along=(1, 0, 0)), [6, 8, 0]), (dict(head=mortar(3), collar=False, along=(0, -2, 0)), [6, 6, 0])
		):
			O.reset()
			for y in (0, SIDE):
				O.bodies.append(straightJointWall(3, 2, (SIDE, SIDE, SIDE), origin=(0, y, 0), material=self.clay, deformation='rigid').bodies)
			laid = layMortar(**given)
			self.assertEqual([len(laid.ofKind(kind)) for kind in ('bed', 'head', 'collar')], expected)
			self.assertEqual(len(listJoints()), sum(expected))

	def test_a_wide_gap_that_counts_as_closed_has_a_place(self):
		self.cube(0, 0, 0), self.cube(0, 0, 1.4 * SIDE)
		joint, = layMortar(tolerance=.5 * SIDE)
		self.assertEqual((joint.kind, joint.normal), ('bed', (0, 0, 1)))
		self.assertAlmostEqual(joint.centre[2], .7 * SIDE, delta=1e-14)
		self.assertEqual(checkMasonry(tolerance=.5 * SIDE).gaps, ())

	def test_up_and_ids_and_tolerance_reach_mortar_joints(self):
		self.cube(0, 0, 0), self.cube(SIDE, 0, 0), self.cube(2 * SIDE + 1e-5, 0, 0)
		self.assertEqual([joint.kind for joint in layMortar(up=(1, 0, 0), ids=[0, 1])], ['bed'])
		self.assertEqual([joint.ids for joint in layMortar(tolerance=2e-5)], [(1, 2)])

	def test_wrong_arguments_are_refused(self):
		self.wall(2, 1)
		self.refused('bed is 5', lambda: layMortar(bed=5))
		self.refused('bed is False', lambda: layMortar(bed=False))
		self.refused('tolerance is -1', lambda: layMortar(tolerance=-1))
		self.refused('along is None', lambda: layMortar(collar=mortar()))
		self.refused('not upright', lambda: layMortar(along=(0, 0, 1)))
		self.refused('up is', lambda: layMortar(up=(0, 0, 0)))
		self.refused('up is', lambda: listJoints(up='z'))
		self.refused("kind is 'perpend'", lambda: listJoints().ofKind('perpend'))
		self.assertEqual(len(listJoints()), 0)


class Listing(Scene):

	def test_joints_have_area_normal_centre_and_segments(self):
		self.ground()
		self.cube(0, 0, SIDE / 2), self.cube(SIDE, SIDE / 4, SIDE / 2)
		joints = layMortar()
		self.assertEqual([joint.ids for joint in joints], [(0, 1), (0, 2), (1, 2)])
		head = joints[2]
		self.assertEqual((head.kind, head.onSupport, head.segments, head.failed, head.state), ('head', False, 12, 0, 'intact'))
		self.assertAlmostEqual(head.area, .75 * SIDE**2, delta=1e-15)
		self.assertLess(np.abs(np.subtract(head.normal, (1, 0, 0))).max(), 1e-14)
		self.assertLess(np.abs(np.subtract(head.centre, (SIDE / 2, SIDE / 8, SIDE / 2))).max(), 1e-14)
		self.assertEqual({(joint.kind, joint.onSupport) for joint in joints[:2]}, {('bed', True)})
		self.assertEqual({joint.normal for joint in joints[:2]}, {(0, 0, 1)})
		self.assertAlmostEqual(joints.area, 2.75 * SIDE**2, delta=1e-15)
		self.assertEqual([joint.ids for joint in joints.ofBody(2)], [(0, 2), (1, 2)])

	def test_faces_and_the_first_step_find_joints_at_the_same_place(self):
		made = barrelVault(segmentalLine(2, .6), .2, 1.1, 8, .4, abutments=Piers(.6, 2, .3), azimuth=.4, material=self.clay, deformation='rigid')
		O.bodies.append(made.bodies)
		self.ground()
		O.bodies.append(utils.box((0, .5, -.1), (2, 2, .1), fixed=True, material=FrictMat()))
		for body in made.bodies:
			body.state.pos += Vector3(0, 0, .6)
		O.engines = yade_brick.engines()
		before = layMortar()
		StaticEquilibrium()()
		O.step()
		after = listJoints()
		self.assertEqual([joint.ids for joint in after], [joint.ids for joint in before])
		for one, other in zip(before, after):
			self.assertEqual((one.kind, one.area, one.segments), (other.kind, other.area, other.segments))
			# under the weight the piers lean by 0.2 mrad, and the crown sinks by 0.2 mm
			self.assertLess(np.abs(np.subtract(one.centre, other.centre)).max(), 1e-3)
			self.assertLess(np.abs(np.subtract(one.normal, other.normal)).max(), 1e-3)

	def test_areas_of_faces_are_those_of_the_segments(self):
		made = arch(pointedLine(2), .2, .3, 8, abutments=Piers(.6, 3, .35), material=self.clay, deformation='rigid')
		O.bodies.append(made.bodies + [brick((.3, .3, .3), center=(5, 0, 0), material=self.clay)])
		O.bodies.append(brick((.3, .3, .3), center=(5.05, .07, .3), orientation=Quaternion(Vector3(0, 0, 1), .5), material=self.clay))
		laid = layMortar()
		solids = yade_brick.solids.Solids()
		pairs = np.array([[solids.place[id] for id in joint.ids] for joint in laid])
		found = solids.facing(pairs, np.full(len(pairs), 1e-6), 1e-3).largestOfEachPair()
		self.assertEqual(list(found.pair), list(range(len(laid))))
		for area, centre, joint in zip(found.area, found.centre, laid):
			self.assertAlmostEqual(area / joint.area, 1, delta=1e-9)  # the kernel leaves out slivers of 1e-9 of a segment

	def test_summary_counts_by_kind(self):
		self.ground()
		self.wall()
		lines = str(layMortar()).splitlines()
		self.assertEqual([line.split()[0] for line in lines[1:]], ['bed', 'bed,', 'head', 'all'])
		self.assertEqual([line.split()[-5:][0] for line in lines[1:]], ['12', '3', '7', '22'])
		self.assertEqual(str(JointList()).splitlines()[1].split()[:2], ['all', '0'])

	def test_csv_has_a_line_for_each_joint(self):
		self.ground()
		self.wall()
		laid = layMortar()
		with tempfile.TemporaryDirectory() as folder:
			path = os.path.join(folder, 'new', 'joints.csv')
			laid.writeCsv(path)
			with open(path, newline='') as file:
				rows = list(csv.DictReader(file))
			self.assertEqual(len(rows), len(laid))
			for row, joint in zip(rows, laid):
				self.assertEqual((int(row['id 1']), int(row['id 2']), int(row['segments'])), (*joint.ids, joint.segments))
				self.assertEqual((row['kind'], row['state']), (joint.kind, 'intact'))
				self.assertAlmostEqual(float(row['area [m2]']), joint.area, delta=1e-9)
				self.assertEqual(float(row['tensileStrength [Pa]']), 1e9)
			listJoints().writeCsv(path)
			with open(path, newline='') as file:
				self.assertEqual({row['cohesion [Pa]'] for row in csv.DictReader(file)}, {''})


class Checking(Scene):

	def test_good_masonry_is_left_alone(self):
		makes = (
		        lambda: straightJointWall(4, 4, material=self.clay), lambda: englishBondWall(4, 4, (.25, .12, .065), material=self.clay),
		        lambda: arch(pointedLine(2), .2, .3, 9, material=self.clay), lambda: arch(segmentalLine(3, .4), .25, .3, 22, azimuth=1, material=self.clay),
		        lambda: barrelVault(semicircularLine(2), .2, 1.3, 15, .4, abutments=Piers(1, 4), origin=(0, 0, 1), material=self.clay)
		)
		for make in makes:
			for laid in (False, True):
				O.reset()
				self.ground()
				O.bodies.append(make().bodies)
				if laid: MortarJoints()()
				check = checkMasonry()
				self.assertTrue(check.ok, str(check))
				self.assertIn('nothing to object to', str(check))
				self.assertEqual(check.joined, len(listJoints()))
				# all that the library joins was seen to touch before
				if laid: self.assertEqual(check.touching, check.joined)

	def test_a_brick_that_touches_nothing_is_named(self):
		self.ground()
		self.wall()
		loose = self.cube(0, 0, 3)
		check = checkMasonry()
		self.assertEqual([found.ids for found in check.loose], [(loose, )])
		self.assertEqual((check.overlaps, check.gaps, check.tinyJoints), ((), (), ()))
		self.assertIn('brick #%d touches nothing, at (0, 0, 3)' % loose, str(check))

	def test_bricks_that_touch_each_other_but_no_support_are_named(self):
		self.wall(2, 2)
		check = checkMasonry()
		self.assertEqual([found.ids for found in check.loose], [tuple(range(5))])
		self.assertIn('there is no support', str(check))
		self.assertIn('5 bricks, #0, #1, #2, #3, #4,', str(check))
		self.ground()
		self.assertTrue(checkMasonry().ok)

	def test_a_brick_at_an_edge_does_not_touch(self):
		self.ground()
		self.cube(0, 0, SIDE / 2)
		edge = self.cube(SIDE, 0, 1.5 * SIDE)
		self.assertEqual([found.ids for found in checkMasonry().loose], [(edge, )])

	def test_a_gap_is_named_with_its_width(self):
		self.ground()
		self.wall()
		for width in (1e-6, 1e-4, .01):
			O.bodies.append(brick((SIDE, SIDE, SIDE), center=(.5 * SIDE, .5 * SIDE, 3.5 * SIDE + width), material=self.clay, deformation='rigid'))
			check = checkMasonry()
			gap, = check.gaps
			self.assertAlmostEqual(gap.gap, width, delta=1e-13)
			self.assertAlmostEqual(gap.tolerance, 1e-6 * SIDE * math.sqrt(3), delta=1e-15)
			self.assertEqual((gap.ids, [found.ids for found in check.loose]), ((7 + 1, len(O.bodies) - 1), [(len(O.bodies) - 1, )]))
			self.assertIn({1e-6: '1 um', 1e-4: '0.1 mm', .01: '10 mm'}[width] + ' apart', str(check))
			self.assertEqual(checkMasonry(nearGap=width / 2).gaps, ())
			MortarJoints(tolerance=2 * width)()
			self.assertTrue(checkMasonry().ok)
			O.bodies.erase(len(O.bodies) - 1)

	def test_faces_at_an_angle_are_named(self):
		self.ground()
		self.cube(0, 0, SIDE / 2)
		tilt = .01
		self.cube(0, 0, 1.5 * SIDE + SIDE / 2 * math.sin(tilt), orientation=Quaternion(Vector3(1, 0, 0), tilt))
		check = checkMasonry()
		gap, = check.gaps
		self.assertAlmostEqual(gap.angle, tilt, delta=1e-5)
		self.assertIn('0.57 degrees', str(check))

	def test_an_overlap_is_named_with_its_depth(self):
		for depth in (1e-6, 1e-4, .05):
			O.reset()
			self.ground()
			self.cube(0, 0, SIDE / 2), self.cube(.03, 0, 1.5 * SIDE - depth)
			check = checkMasonry()
			overlap, = check.overlaps
			self.assertEqual(overlap.ids, (1, 2))
			self.assertAlmostEqual(overlap.depth, depth, delta=1e-13)
			self.assertEqual((check.gaps, check.loose), ((), ()))
			self.assertIn('overlap by', str(check))
		# a wall and a box are met like bricks; so are bricks whose edges cross
		O.reset()
		self.ground()
		self.cube(0, 0, SIDE / 2 - .001)
		self.assertAlmostEqual(checkMasonry().overlaps[0].depth, .001, delta=1e-13)
		O.reset()
		turned = [Quaternion(Vector3(*axis), math.pi / 4) for axis in ((1, 0, 0), (0, 1, 0))]
		reach = SIDE * math.sqrt(2)
		for way, found in ((1e-3, 1), (-1e-3, 0)):
			O.reset()
			self.cube(0, 0, 0, orientation=turned[0]), self.cube(0, 0, reach - way, orientation=turned[1])
			self.assertEqual(len(checkMasonry().overlaps), found)
			if found: self.assertAlmostEqual(checkMasonry().overlaps[0].depth, way, delta=1e-13)

	def test_a_brick_laid_twice_overlaps_itself(self):
		self.ground()
		self.cube(0, 0, SIDE / 2), self.cube(0, 0, SIDE / 2)
		overlap, = checkMasonry().overlaps
		self.assertAlmostEqual(overlap.depth, SIDE, delta=1e-13)

	def test_a_tiny_joint_is_named(self):
		self.ground()
		self.cube(0, 0, SIDE / 2), self.cube(.99 * SIDE, 0, 1.5 * SIDE)
		check = checkMasonry()
		tiny, = check.tinyJoints
		self.assertEqual(tiny.ids, (1, 2))
		self.assertAlmostEqual(tiny.share, .01, delta=1e-12)
		self.assertAlmostEqual(tiny.area, .01 * SIDE**2, delta=1e-15)
		self.assertTrue(checkMasonry(smallShare=.005).ok)
		self.assertIn('1 % of the smaller one', str(check))

	def test_supports_of_all_kinds_hold(self):
		O.bodies.append(utils.box((0, 0, -.1), (.5, .5, .1), fixed=True, material=FrictMat()))
		self.cube(0, 0, SIDE / 2)
		self.cube(3, 0, -SIDE / 2, fixed=True)
		self.cube(3, 0, SIDE / 2)
		O.bodies.append(utils.wall(5, axis=0, sense=0, material=FrictMat()))  # bricks on either side
		self.cube(5 + SIDE / 2, 0, 7), self.cube(5 - SIDE / 2, 0, 8)
		check = checkMasonry()
		self.assertEqual((check.ok, check.bricks, check.supports, check.touching), (True, 4, 3, 4), str(check))

	def test_many_findings_are_said_briefly(self):
		for k in range(30):
			self.cube(k, 0, 0)
		check = checkMasonry()
		self.assertEqual(len(check.loose), 30)
		self.assertIn('and 10 more', str(check))

	def test_scenes_without_bricks(self):
		self.assertTrue(checkMasonry().ok)
		self.ground()
		self.assertEqual((checkMasonry().bricks, len(listJoints()), len(layMortar())), (0, 0, 0))

	def test_wrong_arguments_are_refused(self):
		self.refused('nearGap is 0', lambda: checkMasonry(nearGap=0))
		self.refused('tolerance is -1', lambda: checkMasonry(tolerance=-1))
		self.refused('smallShare is None', lambda: checkMasonry(smallShare=None))
		self.refused('smallShare is 2', lambda: checkMasonry(smallShare=2))

	def test_thousands_of_bricks_take_seconds(self):
		self.ground()
		self.wall(44, 44)
		began = time.process_time()
		check = checkMasonry()
		took = time.process_time() - began
		self.assertTrue(check.ok)
		self.assertEqual(check.bricks, 44 * 44 + 22)
		self.assertLess(took, 5)  # some 0.3 ms a brick here; what compares all pairs takes minutes


class Polygons(unittest.TestCase):

	def test_common_area_of_quadrilaterals(self):
		square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
		turned = (square - .5) @ (np.array([(1, 1), (-1, 1)]) / math.sqrt(2)) + .5
		others = {
		        'itself': (square, 1, (.5, .5)), 'half': (square + (.5, 0), .5, (.75, .5)),
		        'beside': (square + (1, 0), 0, None), 'apart': (square + 3, 0, None),
		        'inside': (.5 * square + .1, .25, (.35, .35)), 'around': (3 * square - 1, 1, (.5, .5)), 'octagon': (turned, 2 * math.sqrt(2) - 2, (.5, .5))
		}
		for name, (other, area, centre) in others.items():
			got, at = faces._commonArea(square[None], other[None])
			self.assertAlmostEqual(got[0], area, delta=1e-12, msg=name)
			if centre: self.assertLess(np.abs(at[0] - centre).max(), 1e-12, name)

	def test_boxes_that_meet_are_all_found(self):
		random = np.random.default_rng(1)
		low = random.uniform(0, 5, (200, 3))
		high = low + random.uniform(0, 1, (200, 3))
		expected = [[i, j] for i in range(200) for j in range(i + 1, 200) if (low[i] <= high[j]).all() and (low[j] <= high[i]).all()]
		self.assertEqual(faces.nearPairs(low, high).tolist(), expected)
