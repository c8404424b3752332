# SPDX-License-Identifier: GPL-2.0-or-later
# Where faces just meet: overlaps of 1 mm, coincident corners, cross joints, gaps of exactly zero, faces exactly parallel, exactly in one plane.
#
# Criterion: MortarJoints finds each pair of faces that overlap once, and none that only meet at an edge or corner; the area is the overlap's to the round-off of
# places over its width; a second call finds nothing. Dry bricks that just touch push nothing; pressed by d, they push kn d times the overlap (the exact integral),
# and neighbours in the same plane add up to the whole face. Loaded, cracked and shaken, such a scene makes no energy: its ledger closes.
import unittest

from hardCase import *

GROUP = '11 Faces that just meet'
EPS = 2.2e-16
LEVELS = 'rigid', 'uniform', 'trilinear', 'refined'
L, OVERLAP = .2, .001
OCTAGON = 2 * (math.sqrt(2) - 1)  # of two unit squares, one turned by 45 degrees


def cubes(*places, edge=L):
	return [((edge,) * 3, tuple(edge * x for x in p), None) for p in places]


def grid(*counts, edge=L):
	return cubes(*[(i, j, k) for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])], edge=edge)


def neighbours(*counts, edge=L):
	"""Joints of a grid, by place in it."""
	number = lambda i, j, k: i + counts[0] * (j + counts[1] * k)
	found = {}
	for k in range(counts[2]):
		for j in range(counts[1]):
			for i in range(counts[0]):
				if i + 1 < counts[0]: found[number(i, j, k), number(i + 1, j, k)] = edge**2
				if j + 1 < counts[1]: found[number(i, j, k), number(i, j + 1, k)] = edge**2
				if k + 1 < counts[2]: found[number(i, j, k), number(i, j, k + 1)] = edge**2
	return found


# name: bricks (size, centre, turn), joints (pair: area)
SCENES = {
        'overlap of 1 mm along an edge': (cubes((0, 0, 0), (1 - OVERLAP / L, 0, 1)), {(0, 1): L * OVERLAP}),
        'overlap of 1 mm at a corner': (cubes((0, 0, 0), (1 - OVERLAP / L, 1 - OVERLAP / L, 1)), {(0, 1): OVERLAP**2}),
        'edges that meet': (cubes((0, 0, 0), (1, 0, 1)), {}),
        'corners that meet': (cubes((0, 0, 0), (1, 1, 1)), {}),
        'cross joint of four': (grid(2, 1, 2), neighbours(2, 1, 2)),
        'eight that meet in a corner': (grid(2, 2, 2), neighbours(2, 2, 2)),
        'eight with exact places': (grid(2, 2, 2, edge=.25), neighbours(2, 2, 2, edge=.25)),
        'one over the corner of four': (grid(2, 2, 1) + cubes((.5, .5, 1)), {**neighbours(2, 2, 1), **{(k, 4): L**2 / 4 for k in range(4)}}),
        'one over four, 1 mm on one side': (
                grid(2, 2, 1) + cubes((1 - OVERLAP / L, .5, 1)), {
                        **neighbours(2, 2, 1), (0, 4): L * OVERLAP / 2, (2, 4): L * OVERLAP / 2, (1, 4): L * (L - OVERLAP) / 2, (3, 4): L * (L - OVERLAP) / 2
                }
        ),
        'thirds over thirds': (
                cubes((0, 0, 0), (1, 0, 0), (1 / 3, 0, 1), (4 / 3, 0, 1)), {
                        (0, 1): L**2, (2, 3): L**2, (0, 2): L**2 * 2 / 3, (1, 2): L**2 / 3, (1, 3): L**2 * 2 / 3
                }
        ),
        'turned by 45 degrees in the plane': (
                cubes((0, 0, 0)) + [((L,) * 3, (0, 0, L), Quaternion(Vector3(0, 0, 1), math.pi / 4))], {(0, 1): OCTAGON * L**2}
        ),
        'turned by 90 degrees in the plane': (cubes((0, 0, 0)) + [((L,) * 3, (0, 0, L), Quaternion(Vector3(0, 0, 1), math.pi / 2))], {(0, 1): L**2}),
        'a tie beside a corner': (
                grid(2, 1, 2) + [((L / 2, L, 2 * L), (-.75 * L, 0, L / 2), None)], {**neighbours(2, 1, 2), (0, 4): L**2, (2, 4): L**2}
        ),
}

UNLIKE = ('a tie beside a corner',)  # scenes with a brick whose edges differ


class FacesThatMeet(Case):

	def build(self, name, level, dry=False, strength=None, **attributes):
		O.reset()
		mortar = None if dry else Mortar(**(strength or UNBREAKABLE))
		adobe = material(mortar=mortar, **attributes)
		layout, joints = SCENES[name]
		made = [add(size, center=center, orientation=turn, material=adobe, deformation=level, contactThickness=.002) for size, center, turn in layout]
		return made, joints

	def test_joints(self):
		"""Each scene in mortar, for all levels: pairs, areas, a second call, and a step without any force."""
		for name, (layout, joints) in SCENES.items():
			for level in LEVELS:
				self.build(name, level)
				joining = MortarJoints()
				joining()
				again = MortarJoints()
				again()
				got = {tuple(sorted((i.id1, i.id2))): sum(i.phys.segmentArea) for i in O.interactions if i.phys.jointed}
				label = '%s, %s: ' % (name, level)
				self.judge(label + 'joints made', joining.made, len(joints), 0, 'those listed')
				self.judge(label + 'joints made again', again.made, 0, 0, 'they are there')
				self.assertEqual(sorted(got), sorted(joints))
				worst = max((abs(got[pair] / area - 1) for pair, area in joints.items()), default=0.)
				self.atMost(label + 'worst area, relative', worst, 16 * EPS * 3 * L / OVERLAP, 'round-off of places up to three edges over an overlap of 1 mm')
				engines(gravity=(0, 0, 0))
				O.step()
				force = max((i.phys.normalForce.norm() for i in O.interactions if i.isReal), default=0.)
				self.atMost(label + 'largest force [N]', force, 16 * EPS * 3 * L * self.spring(level) * L**2, 'round-off of places')
				self.judge(label + 'interactions that are real', sum(i.isReal for i in O.interactions), len(joints), 0, 'nothing is counted twice')

	def spring(self, level):
		length = L / 2 if level == 'rigid' else .002
		return YOUNG / ((1 - POISSON**2) * 2 * length)

	def test_touch(self):
		"""The same dry, as laid and with the uppermost brick lowered by 1e-6 m: forces upon it against kn d times the areas."""
		deep = 1e-6
		for name, (layout, joints) in SCENES.items():
			for level in LEVELS:
				made, _ = self.build(name, level, dry=True, frictionAngle=0, hn=0, hs=0)
				edge = layout[0][0][0]
				length = edge / 2 if level == 'rigid' else .002
				spring = YOUNG / ((1 - POISSON**2) * 2 * length)
				label = '%s, %s: ' % (name, level)
				engines(gravity=(0, 0, 0))
				O.step()
				force = max((O.forces.f(b.id).norm() for b in made), default=0.)
				self.atMost(label + 'largest force on a brick as laid [N]', force, 64 * EPS * 3 * edge * spring * edge**2, 'round-off of places')
				made, _ = self.build(name, level, dry=True, frictionAngle=0, hn=0, hs=0)
				highest = max(b.state.pos[2] for b in made)
				course = [b.id for b in made if b.state.pos[2] > highest - 1e-9]
				for number in course: O.bodies[number].state.pos -= Vector3(0, 0, deep)
				top = course[-1]
				below = sum(area for pair, area in joints.items() if top in pair and min(pair) not in course)
				engines(gravity=(0, 0, 0))
				O.step()
				got = O.forces.f(top)
				if below == 0:
					reason = 'the wedge along an edge, d across'
					self.atMost(label + 'force where only an edge or corner is pressed [N]', got.norm(), spring * edge * deep**2, reason)
					continue
				self.judge(label + 'force upwards [N]', got[2], spring * deep * below, 16 * EPS * 3 * edge / deep, 'the exact integral; round-off of places over d')

	def drift(self, name, level):
		"""Largest drift of the energy in units of that of the blow; the lowest bricks are held."""
		weak = dict(tensileStrength=2e3, cohesion=2e3, frictionAngle=FRICTION, compressiveStrength=5e5)
		made, _ = self.build(name, level, strength=weak)
		lowest = min(b.state.pos[2] for b in made)
		for b in made:
			if b.state.pos[2] < lowest + 1e-9: b.dynamic = False
		MortarJoints()()
		engines()
		O.step()
		stepByHand(.2 * limit())
		for b in moving(): b.state.vel = Vector3(.8, .5, 0) * ((b.state.pos[2] - lowest) / L)
		blow = sum(b.state.mass * b.state.vel.squaredNorm() for b in moving()) / 2
		return Ledger().run(2000) / blow

	def test_loaded_and_shaken(self):
		"""Each scene, its lowest bricks held, in mortar that fails, is loaded by gravity and struck sideways (0.9 m/s at the top of two courses): the ledger closes."""
		for name, (layout, joints) in SCENES.items():
			if len(joints) == 0: continue
			for level in LEVELS:
				reason = '(w dt)^2 / 4 where segments open, close or fail within a step, w dt = 0.2'
				allowed = .01
				# soft contact, half a brick long, is deep on edges; the same at a quarter of the step and with four times the segments
				if level == 'rigid': allowed, reason = .02, reason + '; footprints of faces that dig in askew do not meet (see testImpact.py)'
				if level == 'rigid' and name in UNLIKE: allowed, reason = .06, reason + '; edges of 1:2:4, so springs that differ from face to face'
				self.atMost('%s, %s: largest drift of energy over that of the blow' % (name, level), self.drift(name, level), allowed, reason)
