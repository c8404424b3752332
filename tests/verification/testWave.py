# SPDX-License-Identifier: GPL-2.0-or-later
# A pressure step runs along a free bar of 40 bricks, rigid ones and deformable ones.
#
# Three things are told apart: the product against the exact motion of the same discrete bar (its modes, found by NumPy), the reference values
# against that bar integrated with their own step, and the discrete bar against the elastic one.
import unittest

import numpy as np

from cases import *

GROUP = 'Wave arrival'
SIDE, COUNT, PRESSURE = .2, 40, 100.
AREA, VOLUME = SIDE**2, SIDE**3
LEVEL = PRESSURE / (2 * math.sqrt(YOUNG * DENSITY))  # half the velocity behind the front in an elastic bar: arrival is when a brick's centre has it [m/s]
PLACES = (9, 19)  # the tenth and the twentieth brick
SIGNS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])  # of a brick's corners
OWN_STEP = 'leap-frog in steps of a quarter of the limit with velocities half a step late, as the reference: its digits'
DISPERSION = 'the discrete bar is dispersive: its front spreads, and half the velocity comes the later the farther it runs; so it does in any chain of bricks'


def springs(length):
	"""Of joints with this distance between the two bricks' deforming parts, eq. (3), per area [N/m3]."""
	return YOUNG / ((1 - POISSON**2) * length), YOUNG / (2 * (1 + POISSON) * length)


class Bar:
	"""A free linear bar: stiffness, mass, how each brick's centre moves with the coordinates, and the load."""

	def __init__(self, size):
		self.stiffness, self.mass = np.zeros((size, size)), np.zeros((size, size))
		self.centre, self.load = np.zeros((COUNT, size)), np.zeros(size)

	def connect(self, i, j, k):
		self.stiffness[np.ix_([i, j], [i, j])] += k * np.array([[1, -1], [-1, 1]])

	def modes(self):
		"""Angular frequencies, and each mode's share in the velocity of each brick per unit of time (or of sine over frequency)."""
		root = np.linalg.inv(np.linalg.cholesky(self.mass))
		squares, shapes = np.linalg.eigh(root @ self.stiffness @ root.T)
		shapes = root.T @ shapes
		return np.sqrt(np.maximum(squares, 0)), (self.centre @ shapes) * (shapes.T @ self.load)

	def velocity(self, places, times):
		"""Exact velocities of bricks after the load was put on a bar at rest."""
		omega, shares = self.modes()
		moving = omega > 1e-6 * omega[-1]
		growth = np.where(moving, np.sin(np.outer(times, omega)) / np.where(moving, omega, 1), np.outer(times, np.ones(len(omega))))
		return growth @ shares[list(places)].T

	def leapFrog(self):
		"""Arrivals as the references have them: a step of a quarter of the limit, and the velocity of a step taken as that of its middle."""
		step = .25 * 2 / self.modes()[0][-1]
		inverse, v, u, rows = np.linalg.inv(self.mass), np.zeros(len(self.load)), np.zeros(len(self.load)), []
		while step * len(rows) < .06:
			v = v + step * (inverse @ (self.load - self.stiffness @ u))
			u = u + step * v
			rows.append(self.centre[list(PLACES)] @ v)
		return arrivals(step * (np.arange(len(rows)) + .5), np.array(rows))


def arrivals(times, velocities):
	"""When each column first reaches LEVEL."""
	found = []
	for column in velocities.T:
		k = int(np.argmax(column >= LEVEL))
		found.append(times[k - 1] + (times[k] - times[k - 1]) * (LEVEL - column[k - 1]) / (column[k] - column[k - 1]))
	return found


def rigidBar():
	bar = Bar(COUNT)
	for i in range(COUNT):
		bar.mass[i, i], bar.centre[i, i] = DENSITY * VOLUME, 1
		if i > 0: bar.connect(i - 1, i, springs(SIDE)[0] * AREA)
	bar.load[0] = PRESSURE * AREA
	return bar


def deformableBar(element, thickness, segments=4, consistent=False, platen=None):
	"""By symmetry a brick has four coordinates: the motion of its two ends along the bar, and how far either end widens.

	:param platen: (mass, spring) through which the pressure acts; without one it acts on the end itself
	"""
	nodes = [Vector3(*(SIDE / 2 * s)) for s in SIGNS]
	hexahedron = np.array([[k for k in row] for row in Brick.stiffness(nodes, YOUNG, POISSON, element)]).reshape(24, 24)
	shapes = np.zeros((24, 4))
	for a, s in enumerate(SIGNS):
		end = int(s[0] > 0)
		shapes[3 * a, end], shapes[3 * a + 1, 2 + end], shapes[3 * a + 2, 2 + end] = 1, s[1], s[2]
	reduced = shapes.T @ hexahedron @ shapes
	mass = DENSITY * VOLUME
	linear = np.array([[2, 1], [1, 2]]) / 6
	# a widening end moves its points by y and by z over half a side, of mean square 1/3 each
	reducedMass = mass * np.kron(np.diag([1, 2 / 3]), linear) if consistent else mass * np.diag([.5, .5, 1, 1])
	normal, shear = springs(2 * thickness)
	bar = Bar(4 * COUNT + (platen is not None))
	for i in range(COUNT):
		own = np.ix_(range(4 * i, 4 * i + 4), range(4 * i, 4 * i + 4))
		bar.stiffness[own] += reduced
		bar.mass[own] += reducedMass
		bar.centre[i, 4 * i:4 * i + 2] = .5
		if i == 0: continue
		bar.connect(4 * i - 3, 4 * i, normal * AREA)
		bar.connect(4 * i - 1, 4 * i + 2, shear * AREA * 2 / 3 * (1 - 1 / segments**2))  # slip is taken in the middle of each segment
	if platen:
		bar.mass[-1, -1] = platen[0]
		bar.connect(4 * COUNT, 0, platen[1])
	bar.load[-1 if platen else 0] = PRESSURE * AREA
	return bar


class WaveInABar(Case):

	def run40(self, pushed, bricks):
		"""Runs until the front has passed both places. Times and velocities of the two bricks."""
		O.forces.setPermF(pushed.id, (PRESSURE * AREA, 0, 0))
		times, velocities = [], []
		while len(times) < 2 or velocities[-1][1] < 1.2 * LEVEL:
			O.step()
			# rest before the first step is rest half a step earlier, in leap-frog: velocities are those at the end of the step
			times.append(O.time)
			velocities.append([bricks[place].state.vel[0] for place in PLACES])
			if O.time > .07: self.fail('no wave arrives')
		return np.array(times), np.array(velocities)

	def judgeArrivals(self, got, exact, tolerance, reason):
		for place, ours, truth in zip(PLACES, got, exact):
			self.judge('arrival at brick %d [s]' % (place + 1), ours, truth, tolerance, reason)

	def judgeReference(self, expected, bar):
		found = bar.leapFrog()
		for place, ours in zip(PLACES, found):
			self.judge('reference: arrival at brick %d [s]' % (place + 1), ours, expected['arr_brick%d' % (place + 1)], 1e-7, OWN_STEP)
		self.judge('reference: speed between them [m/s]', 10 * SIDE / (found[1] - found[0]), expected['c_measured'], 1e-6, OWN_STEP)

	def compareWithElasticBar(self, got, speed):
		for place, ours in zip(PLACES, got):
			self.compare('arrival at brick %d [s]' % (place + 1), ours, (place + .5) * SIDE / speed, DISPERSION)
		self.compare('speed between them [m/s]', 10 * SIDE / (got[1] - got[0]), speed, DISPERSION)

	def draw(self, figure, times, velocities, bar, speed):
		thin = slice(None, None, max(1, len(times) // 60))
		fine = np.linspace(times[0], times[-1], 400)
		exact = bar.velocity(PLACES, fine)
		for k, place in enumerate(PLACES):
			name = 'brick %d' % (place + 1)
			self.curve(figure, name + ': ours', times[thin], velocities[thin, k] / (2 * LEVEL), 'time [s]', 'velocity over that behind the front', line=False)
			self.curve(figure, name + ': exact motion of the discrete bar', fine, exact[:, k] / (2 * LEVEL))
			front, behind = (place + .5) * SIDE / speed, PRESSURE / (DENSITY * speed) / (2 * LEVEL)
			self.curve(figure, name + ': elastic bar', [0, front, front, times[-1]], [0, 0, behind, behind])

	def test_rigid_bricks(self):
		"""40 rigid cubes of 0.2 m in a row, jointed; a constant force acts on the first. Arrival: a brick's velocity is half of that behind the front of an elastic
		bar. Expected: the exact motion of the chain of equal masses and springs. The reference is that chain too, integrated in steps of 0.66 ms; we get its digits
		with that step and its convention for the time of a velocity.
		"""
		expected = reference('wave.rigid.r0.lumped')
		brickMaterial = material(mortar=Mortar(**UNBREAKABLE))
		bricks = [add((SIDE, SIDE, SIDE), center=(SIDE * i, 0, 0), material=brickMaterial, deformation='rigid') for i in range(COUNT)]
		MortarJoints()()
		engines(gravity=(0, 0, 0), safety=.1)
		times, velocities = self.run40(bricks[0], bricks)
		bar = rigidBar()
		fine = np.linspace(0, times[-1], 4000)
		got = arrivals(times, velocities)
		self.judgeArrivals(got, arrivals(fine, bar.velocity(PLACES, fine)), 2e-4, 'second order in a step of a tenth of the limit')
		momentum = sum(b.state.mass * b.state.vel[0] for b in bricks)
		self.judge('momentum [N s]', momentum, PRESSURE * AREA * O.time, 1e-11, 'round-off: internal forces cancel')
		speed = SIDE * math.sqrt(springs(SIDE)[0] * AREA / (DENSITY * VOLUME))
		self.judge('speed of long waves, reference [m/s]', speed, expected['c_series'], 1e-7, 'its digits')
		self.judgeReference(expected, bar)
		self.compareWithElasticBar(got, speed)
		self.draw('Wave in a bar of rigid bricks', times, velocities, bar, speed)

	def deformable(self, id, element, thickness):
		expected = reference(id)
		brickMaterial = material(mortar=Mortar(**UNBREAKABLE), hn=0, hs=0)
		# the pressure comes through a platen without friction, so light that it matters little: a force on a brick would act on its centre
		share, plate = 1 / 50, .002
		platenMaterial = material(young=1e3 * YOUNG, density=DENSITY * share * SIDE / plate, frictionAngle=0, hn=0, hs=0)
		bricks = [
		        add((SIDE, SIDE, SIDE), center=(SIDE * (i + .5), 0, 0), material=brickMaterial, element=element, inner='full', contactThickness=thickness)
		        for i in range(COUNT)
		]
		MortarJoints()()
		platen = add((plate, SIDE, SIDE), center=(-plate / 2, 0, 0), material=platenMaterial, deformation='rigid')
		engines(gravity=(0, 0, 0), safety=.9)
		times, velocities = self.run40(platen, bricks)
		between = AREA / ((1 - POISSON**2) * (thickness / YOUNG + plate / 2 / (1e3 * YOUNG)))
		bar = deformableBar(element, thickness, platen=(share * DENSITY * VOLUME, between))
		free = deformableBar(element, thickness)
		fine = np.linspace(0, times[-1], 4000)
		got, exact, withoutPlaten = arrivals(times, velocities), *(arrivals(fine, b.velocity(PLACES, fine)) for b in (bar, free))
		self.judgeArrivals(got, exact, 2e-4, 'second order in a step that the light platen keeps short')
		for place, ours, truth in zip(PLACES, exact, withoutPlaten):
			self.judge('what the platen changes, brick %d [s]' % (place + 1), ours, truth, 3e-3, 'a fiftieth of a brick more at the end, and its spring')
		speed = math.sqrt(SIDE / (DENSITY * (SIDE / YOUNG + 1 / springs(2 * thickness)[0])))
		self.judge('speed of long waves, reference [m/s]', speed, expected['c_series'], 1e-7, 'its digits')
		self.judgeReference(expected, free)
		self.compareWithElasticBar(got, speed)
		figure = 'Wave in a bar of deformable bricks, %s, r = %g mm' % (element, 1e3 * thickness)
		self.draw(figure, times, velocities, bar, speed)

	def test_deformable_bricks_full(self):
		"""40 deformable cubes (full integration), joints of 2 r = 2 mm; the pressure acts on the end through a light platen without friction. Expected: the exact
		motion (all modes, by NumPy) of the bar with the stiffness of eq. (17), lumped masses and the springs of the joints, four coordinates a brick by symmetry.
		The reference is the same bar in steps of a quarter of the limit; with that step we get its digits.
		"""
		self.deformable('wave.full.r0.001.lumped', 'full', .001)

	def test_deformable_bricks_thick_contact_part(self):
		"""As before with r = 5 mm: the joints' compliance slows the wave by another 2 %."""
		self.deformable('wave.full.r0.005.lumped', 'full', .005)

	def test_deformable_bricks_incompatible(self):
		"""As before with incompatible modes and r = 1 mm: they matter for bending, and next to nothing along a bar."""
		self.deformable('wave.wilson.r0.001.lumped', 'incompatible', .001)

	def test_consistent_mass(self):
		"""The mass of the product's elements is lumped. Lumped and consistent masses err to opposite sides: the reference with a consistent mass, whose digits our
		bar in NumPy gives with that mass, is compared with the exact motion of the bar with lumped mass, which the product was shown to follow.
		"""
		bars = [deformableBar('full', .001, consistent=consistent) for consistent in (False, True)]
		self.judgeReference(reference('wave.full.r0.001.consistent'), bars[1])
		fine = np.linspace(0, .06, 4000)
		lumped, consistent = (arrivals(fine, bar.velocity(PLACES, fine)) for bar in bars)
		for place, ours, other in zip(PLACES, lumped, consistent):
			reason = 'short waves run slower with lumped mass, faster with consistent'
			self.compare('arrival at brick %d, lumped against consistent [s]' % (place + 1), ours, other, reason)
