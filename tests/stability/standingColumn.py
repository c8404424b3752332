# SPDX-License-Identifier: GPL-2.0-or-later
# A column of cubes standing for a long time, for its test and its slow case.
#
# Criterion, from round-off alone: a step rounds the place of each brick to the numbers that there are at the top's height, ulp apart, by ulp / sqrt(12) on
# average. Rounding is a kick of the springs K around a brick, so a run of N steps may gain up to N times the sum of K ulp^2 / 24 over the springs of both
# faces in all directions, and a brick may wander by sqrt(N / 12) ulp as if it were free, some times that since all others move it. Nothing else may grow.
import numpy as np

from hardCase import *
from yade_brick import rest

SIDE, COUNT, THIN = .2, 50, 2e-3
BAKED = 9.8e9  # Young's modulus [Pa]: of the paper's adobe such a column buckles under its weight, at 2.4 m


class StandingColumn(Case):

	def stand(self, level, count, **options):
		"""Cubes in mortar, at rest under their weight, for `count` steps."""
		O.reset()
		clay = material(young=BAKED, mortar=Mortar(**UNBREAKABLE))
		ground(clay)
		column = [
		        add([SIDE] * 3, center=(0, 0, SIDE * (k + .5)), material=clay, deformation=level, contactThickness=THIN, segments=2, **options) for k in range(COUNT)
		]
		MortarJoints()()
		engines()
		StaticEquilibrium()()
		start = [b.state.pos for b in column]
		settled = COUNT * SIDE - SIDE / 2 - start[-1][2]
		length = SIDE / 2 if level == 'rigid' else THIN
		normal, shear = (SIDE**2 * m for m in (BAKED / ((1 - POISSON**2) * 2 * length), BAKED / (4 * (1 + POISSON) * length)))
		ulp = float(np.spacing(COUNT * SIDE))
		noise = count * COUNT * 2 * (normal + 2 * shear) * ulp**2 / 24
		wander = 10 * math.sqrt(count / 12) * ulp
		most, parts = 0., 20
		for part in range(parts):
			O.run(count // parts - 20, True)
			kinetic = []
			for _ in range(20):
				O.step()
				kinetic.append(rest.energies([b.shape for b in column])[0])
			most = max(most, *kinetic)
		moved = max((b.state.pos - p).norm() for b, p in zip(column, start))
		label = '%s, %g steps: ' % (level, count)
		self.judge(label + 'last step', O.iter, count, 0, 'as many as asked')
		self.atMost(label + 'largest kinetic energy [J]', most, noise, 'what rounding of places may give, see the head of standingColumn.py')
		self.atMost(label + 'largest way from the place at the start [m]', moved, wander, 'the same')
		self.atMost(label + 'that over the settlement of the top', moved / settled, 1e-6, 'far below any engineering')
		self.atMost(label + 'segments failed', engine(InteractionLoop).lawDispatcher.functors[0].tensionFailures, 0, 'mortar that holds')
