# SPDX-License-Identifier: GPL-2.0-or-later
# Dry blocks and stacks of rigid bricks on a table that is tilted slowly until they fall; what the references of walls are of. The walls: slowTilting.py.
#
# Rigid blocks need no area to stand on an edge, springs do: bricks fall a little earlier, the less the stiffer they are. The exact statics of the springs
# says how much (tilting.py), so the product is judged by that, and that by its limit.
import unittest

from tilting import *
from limitAnalysis import courses, leastOpening, wall

GROUP = 'Tilting table'
SIDE, ROWS, SEGMENTS = .2, 6, 2
ONE_BRICK, STACK = (.2, .2, .2), 'column 6'
SOFTER = 'the method: springs need an area to press on, so the edge about which it turns lies inside the brick\'s, by the inverse cubic root of the stiffness'
TURNED = 'the table turns while the bricks lean: they are always a little late'
DIGITS = 'the digits of the reference'


def stack(count, size, young, friction=FRICTION):
	"""Rigid bricks on each other on the ground."""
	O.reset()
	dry = material(young=young, frictionAngle=friction)
	ground(dry)
	bricks = [add(size, center=(0, 0, size[2] * (k + .5)), material=dry, deformation='rigid', segments=SEGMENTS) for k in range(count)]
	engines()
	return bricks


class TiltingTable(Case):

	def follow(self, figure, name, count, size, young, tolerance, rate=.6):
		"""The path of a stack past its peak against exact statics; the largest tilts, ours and exact [degrees]."""
		leans, tilts = stackPath(count, size, young)
		exact = max(tilts)
		peakAt = leans[tilts.index(exact)]
		path = Path([stack(count, size, young, math.radians(60))[-1]], .95 * exact, 2 * peakAt, count * size[2], rate)
		self.assertTrue(path.ended)
		self.judge('%s, E = %g Pa: largest tilt [degrees]' % (name, young), path.peak(), exact, tolerance, TURNED)
		ours, shown = zip(*path.shown()), [(lean, tilt) for lean, tilt in zip(leans, tilts) if tilt > .9 * exact and lean < 2.2 * peakAt]
		for series, points, line in ((name + ': ours', ours, False), (name + ': exact statics', thinned(shown), True)):
			scaled = zip(*((lean / peakAt, tilt / exact) for lean, tilt in points))
			self.curve(figure, series, *scaled, 'lean, over that at the largest tilt of exact statics', 'tilt of the table, over that', line=line)
		return path.peak(), exact

	def judgeLimit(self, figure, name, count, size, limit, tolerance, measured):
		"""Exact statics of ever stiffer springs against the rigid limit; measured: pairs of stiffness and tilt of ours."""
		young = [9.8e8, 9.8e9, 9.8e10, 9.8e11]
		angles = [stackAngle(count, size, E) for E in young]
		label = '%s: statics of ever stiffer springs, extrapolated [degrees]' % name
		self.judge(label, withoutCompliance(young, angles), limit, tolerance, 'what is left after the inverse cubic root')
		self.curve(figure, name + ': exact statics', young, [a / limit for a in angles], 'Young\'s modulus [Pa]', 'largest tilt, over that of rigid bricks', True)
		self.curve(figure, name + ': ours', [E for E, _ in measured], [a / limit for _, a in measured], line=False)

	def test_blocks(self):
		"""Single rigid blocks of four slendernesses on the ground; gravity turns slowly, and back once the block leans too far, so that the path of equilibrium is
		seen past its peak. Expected: exact statics of a rigid block on springs that only press; its limit for stiff springs is the reference, tan = width/height.
		"""
		for name, limit in reference('dyn.tilt')['topple_deg'].items():
			width, height = map(float, name.split('/'))
			ours, _ = self.follow('Blocks on a tilting table', name, 1, (width, .2, height), 9.8e8, 2e-3)
			self.compare('%s: largest tilt [degrees]' % name, ours, limit, SOFTER)
			self.judgeLimit('Blocks on a tilting table: stiffness', name, 1, (width, .2, height), limit, 2e-4, [(9.8e8, ours)])

	def test_column(self):
		"""Six rigid cubes of 0.2 m on each other, likewise. Expected: exact statics of the stack, in which every joint turns; its limit for stiff springs is the
		reference (six times as high as wide). All rows of the reference that differ in friction alone must agree, since nothing slides: tan 9.5 degrees is far
		below all of it.
		"""
		limits = {name: row for name, row in reference('dyn.tilting').items() if name.startswith(STACK)}
		self.assertEqual(len(limits), 6)
		limit = limits[STACK + ' mu=None']['deg']
		ours, exact = self.follow('Column of six on a tilting table, E = 9.8e8 Pa', 'column', 6, ONE_BRICK, 9.8e8, 1e-2, .3)
		self.compare('largest tilt [degrees]', ours, limit, SOFTER)
		self.judgeLimit('Column of six on a tilting table: stiffness', 'column', 6, ONE_BRICK, limit, 1e-3, [(9.8e8, ours)])
		given = {name: name.split('mu=')[1].strip('(').split(',')[0] for name in limits}
		for name, row in limits.items():
			self.judge(name + ': limit [degrees]', row['deg'], limit, 1e-9, 'the same for all')
		for bed in sorted(set(given.values())):
			friction = math.radians(89.9) if bed == 'None' else math.atan(float(bed))
			stands, falls = (standsAt(stack(6, ONE_BRICK, 9.8e8, friction)[-1:], factor * exact, .02, seconds=1.) for factor in (.98, 1.02))
			self.judge('friction %s: stands 2 %% below exact statics' % bed, int(stands), 1, 0, 'yes')
			self.judge('friction %s: stands 2 %% above' % bed, int(falls), 0, 0, 'no')

	def test_references_of_walls(self):
		"""The references of walls are linear programs of rigid blocks; ours, written anew, gives the same numbers, so both are of the walls that our builders make.
		Without any head joints the numbers are those of frictionless ones: no head joint is pressed in those states. The least tilt at which some part turns over
		while all its joints to the rest open is lower for the English bond: in a linear program the friction of these joints still holds, as if sliding opened
		them.
		"""
		for name, row in reference('dyn.tilting').items():
			bond, given = name.split()[0], name.split('mu=')[1]
			friction = tuple(None if text.strip() == 'None' else float(text) for text in given.strip('()').split(','))
			blocks = wall(courses(bond, 6, ROWS, SIDE), SIDE, friction[0], friction[-1])
			self.judge('%s: tan of the tilt' % name, blocks.largestTilt(), row['lam'], 1e-6, DIGITS)
		for bond in ('straight', 'english'):
			for bed in (math.tan(FRICTION), 1., 2., 10., 100.):
				id = 'dyn.tilting_frictionless_heads.%s_(%s,_0.0)' % (bond, bed)
				bricks = courses(bond, 6, ROWS, SIDE)
				self.judge('%s, beds %g, heads 0: tan of the tilt' % (bond, bed), wall(bricks, SIDE, bed, 0.).largestTilt(), reference(id), 1e-6, DIGITS)
				self.judge('%s, beds %g, no heads: likewise' % (bond, bed), wall(bricks, SIDE, bed, 'none').largestTilt(), reference(id), 1e-6, 'no head is pressed')
		outOfPlane = wall(courses('column', 1, ROWS, SIDE), SIDE, None, None).largestTilt()
		self.judge('out of plane: tan of the tilt', outOfPlane, reference('dyn.out_of_plane')['lam'], 1e-6, DIGITS)
		free = {bond: leastOpening(courses(bond, 6, ROWS, SIDE), SIDE) for bond in ('english', 'straight')}
		self.judge('english: tan of the tilt at which a part turns over freely', free['english'], 11 / 38, 1e-9, 'counted by hand')
		self.judge('straight: likewise', free['straight'], 1 / 6, 1e-9, 'a column alone')
