# SPDX-License-Identifier: GPL-2.0-or-later
# Dry walls of rigid bricks on a tilting table, in plane and out of plane: see testTilting.py, which also shows what the references of walls are of.
#
# Frictionless head joints: friction belongs to materials, and a brick has one for its beds and its heads, so neighbours of a course are laid half a
# millimetre apart. Linear programs without any head joints give the same tilts as with frictionless ones (testTilting.py): it is the same mechanism.
import unittest

from tilting import *
from limitAnalysis import courses, leastOpening
from yade_brick.build import englishBondWall, straightJointWall

GROUP = 'Tilting table'
SIDE, ROWS, SEGMENTS, GAP, MOVED = .2, 6, 2, 5e-4, .02
HEIGHT, ONE_BRICK = ROWS * SIDE, (.2, .2, .2)
NO_SLIDING = math.radians(89.9)
TURNED = 'the table turns while the bricks lean: they are always a little late'
SOFTER = 'the method: springs need an area to press on, so the edge about which it turns lies inside the brick\'s, by the inverse cubic root of the stiffness'
BOUND = 'a linear program lets sliding open the joints, as if grains had to climb over each other: an upper bound for friction that does not'
WEDGE = 'a wedge of bricks at the lower end turns over about the corner of a half brick; its joints to the rest open, and friction no longer holds it'


def dryWall(bond, friction, young, gap):
	"""The top course of a wall on the ground."""
	O.reset()
	dry = material(young=young, frictionAngle=friction)
	ground(dry)
	builder = {'straight': straightJointWall, 'english': englishBondWall}[bond]
	laid = builder(material=dry, deformation='rigid', segments=SEGMENTS)
	for course in laid.courses:
		for place, b in enumerate(course):
			b.state.pos = b.state.refPos = b.state.pos + Vector3(gap * place, 0, 0)
	O.bodies.append(laid.bodies)
	engines()
	return laid.courses[-1]


def frictionOf(text):
	return NO_SLIDING if text == 'None' else math.atan(float(text))


class TiltingWalls(Case):

	def follow(self, figure, series, tops, start, far, rate=.6, axis=0):
		path = Path(tops, start, far, HEIGHT, rate, axis)
		self.curve(figure, series, *path.shown(), 'lean of the top [m]', 'tilt of the table [degrees]')
		return path

	def falls(self, label, tops, degrees, reason):
		self.judge(label + ': stands', int(standsAt(tops, degrees, MOVED)), 0, 0, reason)

	def stands(self, label, tops, degrees, reason, axis=0):
		self.judge(label + ': stands', int(standsAt(tops, degrees, MOVED, axis)), 1, 0, reason)

	def test_column_of_stiff_bricks(self):
		"""The column of testTilting.py with bricks ten and a hundred times as stiff: the largest tilt comes nearer to that of rigid blocks as exact statics says."""
		limit, young, tilts = reference('dyn.tilting')['column 6 mu=None']['deg'], (9.8e9, 9.8e10), []
		for E in young:
			O.reset()
			dry = material(young=E, frictionAngle=FRICTION)
			ground(dry)
			bricks = [add(ONE_BRICK, center=(0, 0, SIDE * (k + .5)), material=dry, deformation='rigid', segments=SEGMENTS) for k in range(ROWS)]
			engines()
			leans, exact = stackPath(ROWS, ONE_BRICK, E)
			path = self.follow('Stiff columns on a tilting table', 'E = %g Pa' % E, bricks[-1:], .97 * max(exact), 2 * leans[exact.index(max(exact))], .3)
			self.judge('E = %g Pa: largest tilt [degrees]' % E, path.peak(), max(exact), 1e-2, TURNED)
			self.compare('E = %g Pa: largest tilt [degrees]' % E, path.peak(), limit, SOFTER)
			tilts.append(path.peak())
		self.judge('extrapolated to rigid bricks [degrees]', withoutCompliance(young, tilts), limit, 1e-2, 'half a percent of being late in each')

	def test_out_of_plane(self):
		"""The straight-joint wall, 6 x 6 cubes, tilted about its foot. Neighbours lean alike and do not slide on each other, so it falls as a column of six does."""
		expected, young = reference('dyn.out_of_plane')['deg'], 9.8e8
		leans, tilts = stackPath(ROWS, ONE_BRICK, young)
		exact = max(tilts)
		path = self.follow('Wall tilted out of plane', 'wall', dryWall('straight', FRICTION, young, 0), .95 * exact, 2 * leans[tilts.index(exact)], .3, axis=1)
		self.judge('largest tilt [degrees]', path.peak(), exact, 1e-2, TURNED)
		self.compare('largest tilt [degrees]', path.peak(), expected, SOFTER)
		shown = thinned([k for k in range(len(leans)) if leans[k] < path.leans[-1]])
		self.curve('Wall tilted out of plane', 'column, exact statics', [leans[k] for k in shown], [tilts[k] for k in shown])

	def test_straight_joints_without_friction_in_heads(self):
		"""The same wall tilted in plane, bricks of a course half a millimetre apart. Each column turns over alone: exact statics of a column of six, whatever the
		friction.
		"""
		young, figure = 9.8e8, 'Straight joints, tilted in plane'
		exact = stackAngle(ROWS, ONE_BRICK, young)
		path = self.follow(figure, 'no friction in heads', dryWall('straight', FRICTION, young, GAP), .95 * exact, .012, .3)
		self.judge('largest tilt [degrees]', path.peak(), exact, 1e-2, TURNED)
		for bed in ('None', str(math.tan(FRICTION))):
			limit = reference('dyn.tilting')['straight 6x6 mu=(%s, 0.0)' % bed]['deg']
			self.compare('beds %s: largest tilt [degrees]' % bed, path.peak(), limit, SOFTER)
		for bed in (str(math.tan(FRICTION)), '1.0', '2.0', '10.0', '100.0', 'None'):
			if bed != 'None': self.assertAlmostEqual(reference('dyn.tilting_frictionless_heads.straight_(%s,_0.0)' % bed), 1 / ROWS, 7)
			self.stands('beds %s, 2 %% below exact statics' % bed, dryWall('straight', frictionOf(bed), young, GAP), .98 * exact, 'yes')
			self.falls('beds %s, 2 %% above' % bed, dryWall('straight', frictionOf(bed), young, GAP), 1.02 * exact, 'no')

	def test_straight_joints_with_friction_in_heads(self):
		"""The same with bricks that touch. In a linear program the heads' friction carries much, because sliding would press them apart; real friction meets hardly
		any pressure there. Judged: not below columns without friction (but for what the rate gives), not above the bound.
		"""
		young, figure = 9.8e8, 'Straight joints, tilted in plane'
		exact = stackAngle(ROWS, ONE_BRICK, young)
		expected = reference('dyn.tilting')
		path = self.follow(figure, 'friction in heads, 32 degrees', dryWall('straight', FRICTION, young, 0), .95 * exact, .012, .3)
		bound = expected['straight 6x6 mu=%s' % math.tan(FRICTION)]['deg']
		self.atMost('columns alone over largest tilt', exact / path.peak(), 1, 'friction in heads only helps')
		self.atMost('largest tilt [degrees]', path.peak(), bound, 'an upper bound')
		self.compare('largest tilt [degrees]', path.peak(), bound, BOUND)
		for bed in (str(math.tan(FRICTION)), '0.6', '0.8', 'None'):
			bound = expected['straight 6x6 mu=%s' % bed]['deg']
			self.falls('all joints %s, at the bound' % bed, dryWall('straight', frictionOf(bed), young, 0), bound, 'an upper bound')

	def test_english_bond_without_friction_in_heads(self):
		"""English bond, beds of 32 degrees, bricks of a course half a millimetre apart. A wedge of ten bricks at the lower end turns over about the corner of a
		half brick when tan = 11/38 (16.1 degrees), see leastOpening: below the reference, which counts on friction in joints that open. Judged: the limit for stiff
		bricks of the largest tilts of two stiffnesses is that of the wedge; and the wall falls at every reference, which are upper bounds.
		"""
		expected, heads = reference('dyn.tilting'), 'english 6x6 mu=(%s, 0.0)'
		wedge = math.degrees(math.atan(leastOpening(courses('english', 6, ROWS, SIDE), SIDE)))
		young, tilts = (9.8e8, 9.8e9), []
		for E, start, far in zip(young, (14, 15), (.012, .003)):
			path = self.follow('English bond, tilted in plane', 'beds of 32 degrees, E = %g Pa' % E, dryWall('english', FRICTION, E, GAP), start, far)
			tilts.append(path.peak())
			self.atMost('E = %g Pa: largest tilt [degrees]' % E, path.peak(), expected[heads % math.tan(FRICTION)]['deg'], 'an upper bound')
			self.compare('E = %g Pa: largest tilt [degrees]' % E, path.peak(), expected[heads % math.tan(FRICTION)]['deg'], BOUND + '; ' + WEDGE)
			self.compare('E = %g Pa: largest tilt, against the wedge [degrees]' % E, path.peak(), wedge, SOFTER)
		self.judge('extrapolated to rigid bricks [degrees]', withoutCompliance(young, tilts), wedge, 3e-2, 'two stiffnesses, and a percent of being late')
		for bed in (str(math.tan(FRICTION)), '1.0', '2.0', '10.0', '100.0', 'None'):
			bound = expected[heads % bed]['lam'] if bed == 'None' else reference('dyn.tilting_frictionless_heads.english_(%s,_0.0)' % bed)
			self.falls('beds %s, at the bound' % bed, dryWall('english', frictionOf(bed), young[0], GAP), math.degrees(math.atan(bound)), 'an upper bound')

	def test_english_bond_that_cannot_slide(self):
		"""English bond with friction of 89.9 degrees, heads apart. Friction jams the wedge's stepped joints as long as they are pressed at all; it lets go at once,
		and may jam again. Judged: the largest tilt lies between that of the free wedge and the bound.
		"""
		bound = reference('dyn.tilting')['english 6x6 mu=(None, 0.0)']['deg']
		wedge = math.degrees(math.atan(leastOpening(courses('english', 6, ROWS, SIDE), SIDE)))
		path = self.follow('English bond, tilted in plane', 'beds that cannot slide, E = 9.8e+08 Pa', dryWall('english', NO_SLIDING, 9.8e8, GAP), 14, .015)
		self.atMost('largest tilt [degrees]', path.peak(), bound, 'an upper bound')
		self.atMost('wedge over largest tilt', wedge / path.peak(), 1, 'friction only helps')
		self.compare('largest tilt [degrees]', path.peak(), bound, 'the states of equilibrium near the bound press joints that open; ' + WEDGE)

	def test_english_bond_with_friction_in_heads(self):
		"""English bond with bricks that touch, friction of 32 degrees in all joints: the same wedge, whose heads open. It falls at every reference: upper bounds."""
		expected = reference('dyn.tilting')
		bound = expected['english 6x6 mu=%s' % math.tan(FRICTION)]['deg']
		path = self.follow('English bond, tilted in plane', 'friction in heads, E = 9.8e+08 Pa', dryWall('english', FRICTION, 9.8e8, 0), 14, .012)
		self.atMost('largest tilt [degrees]', path.peak(), bound, 'an upper bound')
		self.compare('largest tilt [degrees]', path.peak(), bound, BOUND + '; ' + WEDGE)
		self.stands('14 degrees', dryWall('english', FRICTION, 9.8e8, 0), 14, 'a degree below')
		for bed in (str(math.tan(FRICTION)), '0.6', '0.8', 'None'):
			bound = expected['english 6x6 mu=%s' % bed]['deg']
			self.falls('all joints %s, at the bound' % bed, dryWall('english', frictionOf(bed), 9.8e8, 0), bound, 'an upper bound')
