# SPDX-License-Identifier: GPL-2.0-or-later
# Walls, houses, piers and columns as bodies: what they weigh, where they are when moved and turned, how many joints they get, and that they stand. Which bricks
# a wall has is tested without YADE in tests/python/test_bonds.py and test_walls.py.
import math
import unittest

import yade_brick
from yade import O, Vector3, utils
from yade_brick import BrickMat, Floor, Mortar, MortarJoints, Opening, StaticEquilibrium, bondedWall, column, house, isAtRest, pier, restState, wallsAlong

from buildCase import BuildCase

size = (.2, .1, .05)
gravity, density = 9.81, 1800
bondNames = ('stack', 'running', 'English', 'Flemish')


def clay(density=density):
	mortar = Mortar(tensileStrength=1e5, cohesion=1.5e5, frictionAngle=.56, compressiveStrength=5e6)
	return BrickMat(young=2e9, poisson=.2, density=density, frictionAngle=.56, mortar=mortar)


class WallCase(BuildCase):

	def joints(self, masonry):
		"""Number of joints between the bricks; there is no ground."""
		O.reset()
		O.bodies.append(masonry.bodies)
		laying = MortarJoints()
		laying()
		return laying.made


class Bodies(WallCase):

	def test_wall_weighs_its_outline_less_its_openings(self):
		for bond in bondNames:
			window = Opening(at=.53, width=.37, sill=.1, height=.1)
			wall = bondedWall(1.63, .3, bond, size, [window], material=clay())
			thickness = .1 if bond in ('stack', 'running') else .2
			expected = density * thickness * (1.63 * .3 - .37 * .1)
			self.assertAlmostEqual(sum(b.state.mass for b in wall.bodies), expected, delta=1e-9 * expected)  # sizes are rounded to 1e-12 m

	def test_bodies_are_courses_then_lintels_then_floors(self):
		home = house((1.3, 1.1), .4, 1, 'running', size, dict(south=[Opening(.5, .3, .2, name='door')]), Floor('planks', .05, count=3), material=clay())
		self.assertEqual([len(home.lintels), [len(floor) for floor in home.floors], len(home.courses)], [1, [3], 8])
		O.bodies.append(home.bodies)
		self.assertEqual(home.ids, list(range(len(home.bodies))))
		self.assertEqual([b.id for b in home.floors[0]], home.ids[-3:])
		self.assertEqual(home.groups['door'], home.lintels)
		walls = sum(len(home.groups[name]) for name in ('south', 'east', 'north', 'west'))
		self.assertEqual(walls, len(home.bodies) - 3)
		self.assertEqual(len(home.groups['storey 0']), len(home.bodies))

	def test_walls_can_be_moved_and_turned(self):
		plan, turn, start = [(0, 0), (1, 0), (1, .8)], .3, Vector3(1, 2, 3)
		still = wallsAlong(plan, .2, 'Flemish', size, {0: [Opening(.3, .2, .1)]}, material=clay())
		moved = wallsAlong(plan, .2, 'Flemish', size, {0: [Opening(.3, .2, .1)]}, origin=start, direction=turn, material=clay())
		c, s = math.cos(turn), math.sin(turn)
		self.assertEqual(len(still.bodies), len(moved.bodies))
		for one, other in zip(still.bodies, moved.bodies):
			for before, after in zip(one.shape.worldCorners(one.state), other.shape.worldCorners(other.state)):
				x, y, z = before
				self.close(after, start + Vector3(c * x - s * y, s * x + c * y, z), 1e-14)
		self.assertEqual(self.joints(still), self.joints(moved))

	def test_lintels_and_floors_have_their_own_material(self):
		concrete, oak = clay(2400), clay(700)
		home = house(
		        (1.3, 1.1), .4, 1, 'running', size, dict(south=[Opening(.5, .3, .2)]), Floor('slab', .05, options=dict(material=oak, color=(0, 0, 1))),
		        lintels=dict(material=concrete, deformation='uniform'), material=clay()
		)
		lintel, (slab, ) = home.lintels[0], home.floors[0]
		self.assertEqual((lintel.material.density, lintel.shape.deformation), (2400, 'uniform'))
		self.assertAlmostEqual(slab.state.mass, 700 * 1.3 * 1.1 * .05, delta=1e-9)
		self.assertEqual((slab.shape.deformation, tuple(slab.shape.color)), ('rigid', (0, 0, 1)))
		self.assertEqual(home.courses[0][0].shape.deformation, 'trilinear')

	def test_contact_part_is_that_of_a_whole_brick_also_where_it_is_cut(self):
		for body in bondedWall(1.03, .1, 'English', size, material=clay()).bodies:
			self.assertAlmostEqual(body.shape.contactThickness, .0005, delta=1e-15)
		for body in bondedWall(1.03, .1, 'English', size, material=clay(), contactThickness=.002).bodies:
			self.assertEqual(body.shape.contactThickness, .002)

	def test_bad_arguments_are_refused_with_the_value(self):
		m = clay()
		for words, call in (
		        ('length is -1', lambda: bondedWall(-1, 1, material=m)), ('height is 0', lambda: bondedWall(1, 0, material=m)),
		        ('height is 0.07 m; allowed are whole courses', lambda: bondedWall(1, .07, size=size, material=m)),
		        ("bond is 'Dutch'", lambda: bondedWall(1, .3, 'Dutch', material=m)), ('center given for a wall', lambda: bondedWall(1, .3, material=m, center=(0, 0, 0))),
		        ('corners given for a wall', lambda: bondedWall(1, .3, material=m, lintels=dict(corners=[]))),
		        ('lintels is 3', lambda: bondedWall(1, .3, material=m, lintels=3)),
		        ('material is None', lambda: bondedWall(1, .3)), ('origin is', lambda: bondedWall(1, .3, material=m, origin=(0, 0))),
		        ('direction is nan', lambda: bondedWall(1, .3, material=m, direction=math.nan)),
		        ('openings has the leg 1', lambda: wallsAlong([(0, 0), (1, 0)], .3, openings={1: []}, material=m)),
		        ('openings is', lambda: wallsAlong([(0, 0), (1, 0)], .3, openings=[], material=m)),
		        ('options of a floor is 1', lambda: house(material=m, floors=Floor(options=1)))
		):
			self.refused(words, call)


class Joints(WallCase):
	"""Closed forms, of a wall of n bricks or m periods in two courses: head joints of the even and of the odd course, bed joints, joints between wythes."""

	def test_stack_and_running_bond(self):
		for n in (2, 5):
			self.assertEqual(self.joints(bondedWall(n * .2, .1, 'stack', size, material=clay())), 2 * (n - 1) + n)
			self.assertEqual(self.joints(bondedWall(n * .2, .1, 'running', size, material=clay())), (n - 1) + n + 2 * n)

	def test_english_bond(self):
		for n in (2, 4):  # 2n + 1 headers and closers; two wythes of n stretchers; each of 2n + 1 + n - 1 pieces of plan has a joint to either wythe
			self.assertEqual(self.joints(bondedWall(n * .2, .1, 'English', size, material=clay())), 2 * n + 2 * (n - 1) + n + 6 * n)

	def test_flemish_bond(self):
		for m in (1, 3):  # a header meets two stretchers end to end, and a closer one header; m or m + 1 pairs of stretchers
			even, odd = 4 * m + 2 + m, 4 * m + (m + 1)
			self.assertEqual(self.joints(bondedWall((3 * m + 2) * .1, .1, 'Flemish', size, material=clay())), even + odd + 2 * (4 * m + 3))

	def test_every_brick_of_a_house_is_joined(self):
		home = house((1.3, 1.1), .3, 1, 'English', size, dict(south=[Opening(.45, .3, .15)]), Floor('joists', .1, count=2, width=.1), material=clay())
		self.joints(home)
		joined = {id for i in O.interactions if i.phys.jointed for id in (i.id1, i.id2)}
		self.assertEqual(joined, set(home.ids))


class PiersAndColumns(WallCase):

	def test_pier_of_one_brick_has_two_bricks_crosswise_in_a_course(self):
		one = pier((1, 1), .15, size, material=clay())
		self.assertEqual([len(course) for course in one.courses], [2, 2, 2])
		self.assertEqual(self.joints(one), 3 + 2 * 4)

	def test_piers_fill_their_section_without_joints_above_joints(self):
		for units in ((1, 1), (1.5, 1.5), (2, 1), (2, 3), (.5, 1)):
			made = pier(units, .15, size, material=clay())
			volume = units[0] * units[1] * .04 * .15
			self.assertAlmostEqual(sum(b.state.mass for b in made.bodies), density * volume, delta=1e-9)
			for below, above in zip(made.courses, made.courses[1:]):
				self.assertFalse(self.faces(below) & self.faces(above), units)

	def faces(self, course):
		"""Vertical faces inside a course, in pieces of a quarter of a brick, as (axis, place, piece) in whole numbers."""
		found = {}
		for body in course:
			corners = [[round(x / .05) for x in corner] for corner in body.shape.worldCorners(body.state)]
			low, high = ([end(corner[axis] for corner in corners) for axis in range(2)] for end in (min, max))
			for axis in range(2):
				for place in (low[axis], high[axis]):
					for piece in range(low[1 - axis], high[1 - axis]):
						found[axis, place, piece] = found.get((axis, place, piece), 0) + 1
		return {face for face, bricks in found.items() if bricks == 2}

	def test_column_of_drums_has_the_volume_of_its_frustum(self):
		made = column(5, 1.5, (.4, .3), (.2, .25), origin=(1, 2, 0), direction=.4, material=clay())
		# sides linear in height: integral of (.4 - .2 s)(.3 - .05 s) over s in (0, 1), times the height
		volume = 1.5 * (.12 - .5 * (.02 + .06) + .01 / 3)
		self.assertAlmostEqual(sum(b.state.mass for b in made.bodies), density * volume, delta=1e-9)
		self.assertEqual(self.joints(made), 4)
		corners = [c for b in made.bodies for c in b.shape.worldCorners(b.state)]
		self.assertAlmostEqual(max((c - Vector3(1, 2, c[2])).norm() for c in corners), .25, delta=1e-12)  # half the diagonal of the foot

	def test_drums_can_have_different_heights(self):
		made = column([.2, .5, .3], 2, material=clay())
		self.assertEqual([round(b.state.pos[2], 12) for (b, ) in made.courses], [.2, .9, 1.7])

	def test_bad_piers_and_columns_are_refused_with_the_value(self):
		m = clay()
		for words, call in (
		        ('units is', lambda: pier((1, .7), material=m)), ('units is', lambda: pier(2, material=m)),
		        ('height is 1 m', lambda: pier(height=1, size=(.2, .1, .06), material=m)),
		        ('twice as long', lambda: pier(size=(.2, .2, .1), material=m)), ('drums is 0', lambda: column(0, material=m)),
		        ('drums is .*add up', lambda: column([.5, .4], material=m)),
		        ('base is', lambda: column(base=(1, 0), material=m)), ('top is .*no larger', lambda: column(top=(1, 1), material=m)),
		        ('height is nan', lambda: column(height=math.nan, material=m)),
		        ('size given', lambda: column(material=m, size=(1, 1, 1)))
		):
			self.refused(words, call)


class Standing(WallCase):

	def stands(self, build):
		"""At rest by statics, whole, carried by the ground, and still at rest 200 steps later."""
		O.reset()
		material = clay()
		ground = O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
		masonry = build(material)
		O.bodies.append(masonry.bodies)
		O.engines = yade_brick.engines(gravity=(0, 0, -gravity))
		MortarJoints()()
		rest = StaticEquilibrium()
		rest()
		self.assertEqual(rest.overloaded, 0)
		O.step()
		weight = gravity * sum(b.state.mass for b in masonry.bodies)
		# round-off of lengths (1e-16 m) times the stiffness of the ground's springs (1e11 N/m here) on some 1e3 N
		self.assertAlmostEqual(-O.forces.f(ground)[2] / weight, 1, delta=1e-5)
		before, elastic = [b.state.pos for b in masonry.bodies], restState().elastic
		O.run(200, True)
		self.assertTrue(isAtRest())
		self.assertAlmostEqual(restState().elastic / elastic, 1, delta=1e-6)
		self.assertLess(max((b.state.pos - x).norm() for b, x in zip(masonry.bodies, before)), 1e-10)  # of settlements of 1e-6 m

	def test_walls_of_all_bonds_with_an_opening(self):
		for bond in bondNames:
			self.stands(lambda material: bondedWall(1.03, .45, bond, size, [Opening(.33, .37, .2, .1)], material=material))

	def test_small_house_with_door_window_and_floor(self):
		rooms = dict(south=[Opening(.45, .3, .3)], east=[Opening(.3, .3, .2, .1)])
		for floor in (Floor('planks', .05, count=4), Floor('joists', .1, count=2, width=.1)):
			self.stands(lambda material: house((1.2, .9), .45, 1, 'running', size, rooms, floor, material=material))

	def test_pier_and_column(self):
		self.stands(lambda material: pier((1.5, 1.5), .3, size, material=material))
		self.stands(lambda material: column(4, 1, (.3, .3), (.2, .2), material=material))


if __name__ == '__main__':
	unittest.main()
