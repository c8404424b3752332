# SPDX-License-Identifier: GPL-2.0-or-later
# A block that rocks freely from edge to edge: period and loss at each impact, against a rigid block on rigid ground (Housner).
#
# The period depends on the rotary inertia: eight lumped masses would make it 22 % longer. The loss depends on where the impact acts. Housner's
# block lands on its far edge; ours does so when only its edges are supported. On flat ground the contact runs along the base, and less is lost.
import unittest

from cases import *

GROUP = 'Rocking blocks'
WIDTH, HEIGHT, SHARE = .2, .6, .5  # of the angle at which the block would topple
TOPPLE = math.atan(WIDTH / HEIGHT)


def tilt(b):
	x = b.state.ori * Vector3(0, 0, 1)
	return math.atan2(x[0], x[2])


def energy(share):
	"""Of a block at rest at this share of the toppling angle, over its weight times half its diagonal."""
	return math.cos(TOPPLE * (1 - share)) - math.cos(TOPPLE)


class FreeRocking(Case):

	def rock(self, level, brickMaterial, impacts, dt=None):
		"""Releases a tilted block on what is already there. Quarter period [s] and the largest tilts after each impact, as shares."""
		turn = Quaternion(Vector3(0, 1, 0), SHARE * TOPPLE)
		centre = Vector3(WIDTH / 2, 0, 0) + turn * Vector3(-WIDTH / 2, 0, HEIGHT / 2)
		b = add((WIDTH, .2, HEIGHT), center=centre, orientation=turn, material=brickMaterial, deformation=level, contactThickness=.005)
		engines()
		O.step()
		if dt:
			engine(BrickTimeStepper).active = False
			O.dt = dt
		quarter, peaks, largest, before = None, [], 0, SHARE
		while len(peaks) <= impacts:
			O.step()
			share = tilt(b) / TOPPLE
			if share * before < 0:
				if quarter is None: quarter = O.time
				peaks.append(largest)
				largest = 0
			largest, before = max(largest, abs(share)), share
			if O.time > 3: self.fail('does not rock')
		return quarter, peaks[1:]

	def test_on_its_edges(self):
		expected, edge = reference('dyn.rock_0.2_0.6'), .004
		hard = material(young=1e10, frictionAngle=math.radians(80), hn=20, hs=20)
		for side in (-1, 1):
			add((edge, .2, .1), center=(side * (WIDTH - edge) / 2, 0, -.05), material=hard, deformation='rigid', fixed=True)
		# dashpots this strong on so small an area: the bound, which takes whole faces, is far below what is stable
		quarter, peaks = self.rock('rigid', hard, 3, dt=1e-5)
		self.judge('quarter period [s]', quarter, expected['T']['0.5']['T_exact'] / 4, 1e-2, 'indentation moves the edge inward')
		for k, peak in enumerate(peaks, 1):
			self.judge('tilt after impact %d' % k, peak, expected['amp_exact'][k], .02 * k, 'impact 1 % inside the edge, on supports of 4 mm, takes 1.5 % less')

	def test_on_flat_ground(self):
		expected = reference('dyn.rock_0.2_0.6')
		for level, young in (('rigid', 1e10), ('trilinear', 1e9)):
			O.reset()
			rough = material(young=young, frictionAngle=math.radians(60), dampingRatio=.1, hn=.02, hs=.02)
			ground(rough)
			quarter, peaks = self.rock(level, rough, 1)
			reason = 'indentation moves the edge inward, by the inverse root of the stiffness'
			self.judge('%s: quarter period [s]' % level, quarter, expected['T']['0.5']['T_exact'] / 4, 1e-2, reason)
			ratio = math.sqrt(energy(peaks[0]) / energy(SHARE))
			self.atMost('%s: what the far edge alone leaves of the speed, over ours' % level, expected['r_vel'] / ratio, 1, 'less is lost')
			self.atMost('%s: speed after over before' % level, ratio, 1, 'no energy comes from nowhere')
