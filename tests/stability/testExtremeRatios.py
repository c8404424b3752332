# SPDX-License-Identifier: GPL-2.0-or-later
# One joint between bricks that differ by all that may be asked for: a slab of 20:1, edges of 1000:1, stiffness of 1e6:1, and all three at once.
#
# Criterion: at rest under its weight the upper brick has settled by what a bar of the same layers gives (nu = 0, so there is nothing across): with W its
# weight and A the area of the joint,
#     W / A (lA/EA + lB/EB) + sum over the two elements of  W/2 (H/2 - r) / ((L - 2 r)^2 E) ,
# since the nodes on the joint's side carry W and have half of the mass that it comes from.
# A free pair keeps linear and angular momentum to round-off, and its energy. The limits of round-off are those of the numbers themselves: a place x in the
# larger brick is known to eps x, so the small brick's springs, stretched by d, carry eps x / d of noise.
import unittest

from hardCase import *

GROUP = '3 Extreme ratios in one joint'
EPS = 2.2e-16
SHARE = .01  # r over the shortest edge
LEVELS = 'rigid', 'uniform', 'trilinear', 'refined'
# size below, size above [m], Young's modulus below, above [Pa]
PAIRS = {
        'equal': ((.2, .2, .2), (.2, .2, .2), YOUNG, YOUNG),
        'slab 20:1 on a cube': ((.1, .1, .1), (2., 2., .1), YOUNG, YOUNG),
        'beam 20:1 on a cube': ((.1, .1, .1), (2., .1, .1), YOUNG, YOUNG),
        'cube of a thousandth on a cube': ((1., 1., 1.), (.001, .001, .001), YOUNG, YOUNG),
        'a million times stiffer': ((.2, .2, .2), (.2, .2, .2), 1e4 * 9.8, 1e10 * 9.8),
        'a million times softer': ((.2, .2, .2), (.2, .2, .2), 1e10 * 9.8, 1e6 * 9.8),
        'a thousandth, 20:1, a million times stiffer': ((1., 1., 1.), (.001, .001, .02), 1e5, 1e11),
}


class ExtremeRatios(Case):

	def pair(self, name, level, fixed):
		O.reset()
		lower, upper, softer, stiffer = PAIRS[name]
		mortar = Mortar(**UNBREAKABLE)
		below, above = (material(young=young, poisson=0, hn=0, hs=0, mortar=mortar) for young in (softer, stiffer))
		# off the middle, so that the joint also turns the larger brick
		across = (.1 * lower[0], .05 * lower[1]) if upper[0] < lower[0] and not fixed else (0, 0)
		first = add(lower, center=(0, 0, -lower[2] / 2), material=below, deformation=level, contactThickness=SHARE * min(lower), fixed=fixed)
		second = add(upper, center=(*across, upper[2] / 2), material=above, deformation=level, contactThickness=SHARE * min(upper))
		joining = MortarJoints()
		joining()
		self.assertEqual(joining.made, 1)
		area = min(lower[0], upper[0]) * min(lower[1], upper[1])
		joint, = O.interactions
		self.judge('%s, %s: area of the joint [m2]' % (name, level), sum(joint.phys.segmentArea), area, 16 * EPS * 1e3, 'round-off of places over the smaller edge')
		engines(gravity=(0, 0, 0))
		return first, second, area

	def test_statics(self):
		"""The lower brick is held; the upper one settles under a weight that strains the softer one by 1e-4. All levels."""
		for name, (lower, upper, softer, stiffer) in PAIRS.items():
			for level in LEVELS:
				first, second, area = self.pair(name, level, True)
				# that strains what it stands on by 1e-4
				gravity = 1e-4 * min(softer, stiffer) * area / second.state.mass
				engine(NewtonIntegrator).gravity = Vector3(0, 0, -gravity)
				start, weight = second.state.pos[2], gravity * second.state.mass
				StaticEquilibrium()()
				lengths = (lower[2] / 2, upper[2] / 2) if level == 'rigid' else (SHARE * min(lower), SHARE * min(upper))
				down = opening = weight / area * (lengths[0] / softer + lengths[1] / stiffer)
				if level != 'rigid': down += self.inside(weight, lower, softer) + self.inside(weight, upper, stiffer)
				label = '%s, %s: settlement [m]' % (name, level)
				got = start - second.state.pos[2]
				noise = 4 * EPS * max(*lower, *upper)
				reason = 'round-off of places, 4 eps of the largest edge, over the settlement or the opening of the joint'
				if level != 'refined': self.judge(label, got, down, noise / down, reason)
				else: self.compare(label, got, down, 'its inside is finer than one element, and bends where the joint is smaller than the face')
				stress = sum(a * s for a, s in zip(self.joint().phys.segmentArea, self.stresses()))
				self.judge('%s, %s: force in the joint over the weight' % (name, level), -stress / weight, 1, noise / opening, reason)

	def inside(self, weight, size, young):
		"""What the face in the joint comes nearer to the brick's middle [m]."""
		r = SHARE * min(size)
		return weight / 2 * (size[2] / 2 - r) / ((size[0] - 2 * r) * (size[1] - 2 * r) * young)

	def joint(self):
		return next(iter(O.interactions))

	def stresses(self):
		O.step()
		i = self.joint()
		return i.phys.normalStress(i.geom)

	def test_free_pair(self):
		"""A free pair is struck: the upper brick gets a velocity of 1e-3 of its shortest edge in each millisecond of its own time scale; 4000 steps."""
		count = 4000
		for name, (lower, upper, *_) in PAIRS.items():
			for level in LEVELS:
				first, second, _ = self.pair(name, level, False)
				O.step()
				stepByHand(.1 * limit())
				# along a part in a thousand of the brick in a hundred steps
				speed = 1e-5 * min(upper) / O.dt
				second.state.vel = speed * Vector3(.3, .2, -1)
				p, l = momentum(), angularMomentum()
				struck = second.state.mass * second.state.vel.squaredNorm() / 2
				drift = Ledger().run(count, 4)
				label = '%s, %s: ' % (name, level)
				self.atMost(label + 'change of momentum, relative', (momentum() - p).norm() / p.norm(), count * EPS, 'round-off, an eps a step')
				arm = max(max(lower), max(upper)) * second.state.mass * speed
				self.atMost(label + 'change of angular momentum, relative', (angularMomentum() - l).norm() / arm, 4 * count * EPS, 'round-off, about the middle')
				self.atMost(label + 'largest drift of energy over that of the blow', drift / struck, 1e-3, 'linear springs; axes turn by 1e-3 at most')
