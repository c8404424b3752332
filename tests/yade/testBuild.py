# SPDX-License-Identifier: GPL-2.0-or-later
# Builders: where bricks go, what they weigh, which order walls have, and what is refused.
import math

from yade import O, Quaternion, Vector3
from yade_brick import BrickMat, build, syntheticNearFault

from buildCase import BuildCase

nan = float('nan')
# corners of a wedge: a unit cube whose upper edge at x = 1 is drawn in to x = 0.5; its volume and centre follow by hand
wedge = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (.5, 0, 1), (.5, 1, 1), (0, 1, 1)]


def adobe(**attributes):
	return BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56, **attributes)


class SingleBrick(BuildCase):

	def test_cuboid_has_mass_and_inertia_of_the_solid(self):
		b = build.brick((.1, .2, .3), center=(1, 2, 3), material=adobe())
		m = 1800 * .1 * .2 * .3
		self.assertAlmostEqual(b.state.mass, m, delta=1e-13 * m)  # round-off
		self.close(b.state.inertia, Vector3(.2**2 + .3**2, .1**2 + .3**2, .1**2 + .2**2) * m / 12, 1e-13)
		self.close(b.state.pos, (1, 2, 3), 1e-15)
		self.close(b.state.refPos, (1, 2, 3), 1e-15)
		self.assertEqual((b.aspherical, b.dynamic, b.state.blockedDOFs), (True, True, ''))

	def test_corners_stay_where_they_were_given(self):
		b = build.brick(corners=wedge, material=adobe())
		for got, expected in zip(b.shape.worldCorners(b.state), wedge):
			self.close(got, expected, 1e-14)
		# trapezium of 1 and 1/2 wide and 1 high: area 3/4, centroid 7/18 and 4/9
		self.close(b.state.pos, (7 / 18, .5, 4 / 9), 1e-14)
		self.assertAlmostEqual(b.state.mass, 1800 * .75, delta=1e-10)

	def test_orientation_and_center_move_the_axes_of_the_corners(self):
		turn = Quaternion(Vector3(1, 2, 3).normalized(), .7)
		b = build.brick(corners=wedge, center=(5, 6, 7), orientation=turn, material=adobe())
		for got, expected in zip(b.shape.worldCorners(b.state), wedge):
			self.close(got, Vector3(5, 6, 7) + turn * Vector3(*expected), 1e-14)
		self.assertEqual((b.state.refPos, b.state.refOri), (b.state.pos, b.state.ori))

	def test_options_reach_the_shape(self):
		options = dict(deformation='uniform', element='bbar', inner='full', contactThickness=.02, segments=7)
		s = build.brick((1, 1, 1), material=adobe(), color=(0, .5, 1), **options).shape
		self.assertEqual((s.deformation, s.element, s.inner, s.contactThickness, s.segments), ('uniform', 'bbar', 'full', .02, 7))
		self.close(s.color, (0, .5, 1), 1e-15)

	def test_contact_part_is_one_percent_of_the_shortest_edge(self):
		self.assertAlmostEqual(build.brick((.3, .1, .2), material=adobe()).shape.contactThickness, .001, delta=1e-16)
		self.assertAlmostEqual(build.brick(corners=wedge, material=adobe()).shape.contactThickness, .005, delta=1e-16)

	def test_fixed_brick_is_a_support(self):
		b = build.brick((1, 1, 1), material=adobe(), fixed=True)
		self.assertEqual((b.dynamic, b.state.blockedDOFs), (False, 'xyzXYZ'))
		self.close(b.shape.color, build.fixedColor, 1e-15)

	def test_material_is_found_by_id_and_label(self):
		O.materials.append(adobe(label='adobe'))
		for key in (0, 'adobe', O.materials[0]):
			self.assertEqual(build.brick((1, 1, 1), material=key).material.density, 1800)

	def test_bad_input_is_refused_with_the_value(self):
		m = adobe()
		for size in ((0, 1, 1), (1, -1, 1), (1, 1, nan), (1, 1), (1, math.inf, 1)):
			self.refused('size is .*allowed', lambda: build.brick(size, material=m))
		self.refused('missing', lambda: build.brick(material=m))
		self.refused('exactly one', lambda: build.brick((1, 1, 1), corners=wedge, material=m))
		self.refused('7 corners', lambda: build.brick(corners=wedge[:7], material=m))
		self.refused('center is .*nan', lambda: build.brick((1, 1, 1), center=(0, nan, 0), material=m))
		self.refused('unit quaternion', lambda: build.brick((1, 1, 1), orientation=Quaternion(2, 0, 0, 0), material=m))
		self.refused('material is None', lambda: build.brick((1, 1, 1)))
		self.refused('color', lambda: build.brick((1, 1, 1), material=m, color=(1, 2)))
		self.refused('.', lambda: build.brick((1, 1, 1), material=m, deformation='soft'))
		self.refused('.', lambda: build.brick((1, 1, 1), material=m, contactThickness=.6))
		self.refused('.', lambda: build.brick(corners=wedge[4:] + wedge[:4], material=m))  # inside out


class Walls(BuildCase):

	def test_straight_joint_wall_is_ordered_from_below_and_from_the_left(self):
		wall = build.straightJointWall(3, 2, (.2, .1, .3), origin=(1, 2, 3), material=adobe(), deformation='rigid')
		self.assertEqual(list(O.bodies.append(wall.bodies)), [0, 1, 2, 3, 4, 5])
		self.assertEqual(wall.ids, [0, 1, 2, 3, 4, 5])
		self.assertEqual(wall.courses[1][0].id, 3)
		for body, expected in zip(wall.bodies, [(1.1 + .2 * i, 2.05, 3.15 + .3 * j) for j in range(2) for i in range(3)]):
			self.close(body.state.pos, expected, 1e-15)
			self.assertEqual(body.shape.deformation, 'rigid')

	def test_paper_walls_fill_their_outline(self):
		for make, count in ((build.straightJointWall, 36), (build.englishBondWall, 39)):
			bodies = make(material=adobe()).bodies
			self.assertEqual(len(bodies), count)
			self.assertAlmostEqual(sum(b.state.mass for b in bodies), 1800 * 1.2 * .2 * 1.2, delta=1e-10)
			corners = [c for b in bodies for c in b.shape.worldCorners(b.state)]
			self.close([min(c[i] for c in corners) for i in range(3)], (0, 0, 0), 1e-15)
			self.close([max(c[i] for c in corners) for i in range(3)], (1.2, .2, 1.2), 1e-15)

	def test_english_bond_staggers_vertical_joints_by_half_a_brick(self):
		wall = build.englishBondWall(3, 3, material=adobe())
		self.assertEqual([len(course) for course in wall.courses], [3, 4, 3])
		widths = [round(b.shape.volume / .04, 12) for b in wall.courses[1]]
		self.assertEqual(widths, [.1, .2, .2, .1])
		self.assertEqual([len(course) for course in build.englishBondWall(3, 3, material=adobe(), halfBricksFirst=True).courses], [4, 3, 4])
		self.assertEqual([len(course) for course in build.englishBondWall(1, 2, material=adobe()).courses], [1, 2])

	def test_bad_walls_are_refused_with_the_value(self):
		m = adobe()
		for make in (build.straightJointWall, build.englishBondWall):
			for wrong in (0, -1, 1.5, True):
				self.refused('columns is %s' % wrong, lambda: make(columns=wrong, material=m))
				self.refused('courses is %s' % wrong, lambda: make(courses=wrong, material=m))
			self.refused('size is', lambda: make(size=(.2, 0, .2), material=m))
			self.refused('origin is', lambda: make(origin=(0, 0, nan), material=m))
			self.refused('center given for a wall', lambda: make(center=(0, 0, 0), material=m))


class Motion(BuildCase):

	def test_engine_has_the_samples_of_the_motion(self):
		shake = syntheticNearFault()
		engine = build.groundMotion(shake, startTime=2)
		self.assertEqual((engine.dt, engine.startTime, len(engine.acceleration)), (shake.dt, 2, len(shake)))
		# linear between samples
		self.close(engine.groundAcceleration(2 + 300.5 * shake.dt), (shake.acceleration[300] + shake.acceleration[301]) / 2, 1e-9)
