# SPDX-License-Identifier: GPL-2.0-or-later
# A pressure step runs along a free bar of 40 rigid bricks: a chain of equal masses and springs, whose motion has a closed form.
import unittest

from cases import *

GROUP = 'Wave arrival'
SIDE, COUNT, PRESSURE = .2, 40, 100.
STIFFNESS = YOUNG / ((1 - POISSON**2) * SIDE) * SIDE**2  # of a joint, eq. (3) [N/m]
MASS = DENSITY * SIDE**3


def exactVelocity(place, time):
	"""Of a mass of the free chain under a constant force on the first one: its modes are cosines."""
	v = time
	for k in range(1, COUNT):
		omega = 2 * math.sqrt(STIFFNESS / MASS) * math.sin(k * math.pi / (2 * COUNT))
		shape = lambda j: math.cos(k * math.pi * (j + .5) / COUNT)
		v += 2 * shape(0) * shape(place) * math.sin(omega * time) / omega
	return PRESSURE * SIDE**2 / (MASS * COUNT) * v


def exactArrival(place, level):
	"""When the velocity first reaches the level, by bisection of its rise."""
	earliest, latest = .001 * place, .0013 * place + .0176
	while exactVelocity(place, latest) < level: latest += 1e-4
	while latest - earliest > 1e-9:
		middle = (earliest + latest) / 2
		if exactVelocity(place, middle) < level: earliest = middle
		else: latest = middle
	return latest


class WaveInABarOfRigidBricks(Case):

	def test_arrival(self):
		expected = reference('wave.rigid.r0.lumped')
		brickMaterial = material(mortar=Mortar(**UNBREAKABLE))
		bar = [add((SIDE, SIDE, SIDE), center=(SIDE * i, 0, 0), material=brickMaterial, deformation='rigid') for i in range(COUNT)]
		MortarJoints()()
		engines(gravity=(0, 0, 0), safety=.1)
		O.forces.setPermF(bar[0].id, (PRESSURE * SIDE**2, 0, 0))
		level = PRESSURE / (2 * DENSITY * expected['c_series'])
		arrival, before = {}, {}
		while len(arrival) < 2:
			O.step()
			for place in (9, 19):
				v = bar[place].state.vel[0]
				if v >= level and place not in arrival:
					# rest before the first step is rest half a step earlier, in leap-frog: velocities are those at the end of the step
					arrival[place] = O.time - O.dt * (v - level) / (v - before[place])
				before[place] = v
		for place in (9, 19):
			self.judge('arrival at brick %d [s]' % (place + 1), arrival[place], exactArrival(place, level), 2e-4, 'second order in a step of a tenth of the limit')
		self.judge(
		        'speed between them [m/s]', 10 * SIDE / (arrival[19] - arrival[9]), expected['c_measured'], 1e-3,
		        'that reference is of a step of some 0.5 ms, which makes it 0.08 % slow'
		)
		momentum = sum(b.state.mass * b.state.vel[0] for b in bar)
		self.judge('momentum [N s]', momentum, PRESSURE * SIDE**2 * O.time, 1e-11, 'round-off: internal forces cancel')
