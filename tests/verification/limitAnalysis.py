# SPDX-License-Identifier: GPL-2.0-or-later
# Limit analysis of rigid blocks in a plane by linear programs: the largest tilt with a state of equilibrium, joints that do not pull and Coulomb's limit.
#
# That is what the references are of. Such a state is all that blocks need to stand if sliding opened the joints (associative flow); with real friction,
# which does not, the largest tilt is an upper bound. `leastOpening` is the other side: what turns over without any help of friction.
import math

import numpy as np
from scipy.optimize import linprog


class Blocks:
	"""Blocks with their weights, and the points at which they touch: the ends of the joints. Block -1 is the ground."""

	def __init__(self):
		self.centres, self.weights, self.points = [], [], []

	def block(self, centre, weight):
		self.centres.append(np.array(centre))
		self.weights.append(weight)
		return len(self.weights) - 1

	def touch(self, first, second, places, normal, friction):
		"""`normal` points from the first to the second; friction: tan of its angle, or None for a joint that cannot slide."""
		for place in places:
			self.points.append((first, second, np.array(place), np.array(normal), friction))

	def _equilibrium(self):
		"""Coefficients (3 n, 2 p) of normal and shear forces in force x, force z and moment of each block."""
		matrix = np.zeros((3 * len(self.weights), 2 * len(self.points)))
		for k, (first, second, place, normal, _) in enumerate(self.points):
			for column, force in ((2 * k, normal), (2 * k + 1, np.array([normal[1], -normal[0]]))):
				for body, sign in ((first, -1), (second, 1)):
					if body < 0: continue
					arm = place - self.centres[body]
					matrix[3 * body:3 * body + 3, column] += sign * np.array([*force, arm[0] * force[1] - arm[1] * force[0]])
		return matrix

	def _solve(self, sideways):
		"""The largest share of the weights that can act sideways as well, or just whether there is equilibrium."""
		count = 2 * len(self.points)
		matrix, limits = np.zeros((3 * len(self.weights), count + 1)), []
		matrix[:, :count] = self._equilibrium()
		matrix[0::3, count] = np.array(self.weights) if sideways else 0
		load = np.zeros(3 * len(self.weights))
		load[1::3] = self.weights
		for k, point in enumerate(self.points):
			if point[4] is None: continue
			for sign in (-1, 1):
				limits.append(np.zeros(count + 1))
				limits[-1][2 * k], limits[-1][2 * k + 1] = -point[4], sign
		goal = np.zeros(count + 1)
		goal[count] = -1
		bounds = [(0, None), (None, None)] * len(self.points) + [(0, 100)]
		limits = dict(A_ub=np.array(limits), b_ub=np.zeros(len(limits))) if limits else {}
		return linprog(goal, A_eq=matrix, b_eq=load, bounds=bounds, method='highs', **limits)

	def largestTilt(self):
		"""Tangent of the largest tilt."""
		return self._solve(True).x[-1]

	def stand(self):
		return self._solve(False).status == 0


def wall(courses, height, bed, head):
	"""Blocks of a dry wall. courses: ends (left, right) of the bricks of each course, from below.

	:param bed, head: friction of the joints, None: they cannot slide; head='none' for a wall without head joints
	"""
	blocks, below = Blocks(), None
	for row, course in enumerate(courses):
		ids = [blocks.block(((a + b) / 2, (row + .5) * height), b - a) for a, b in course]
		for i, (a, b) in zip(ids, course):
			for j, (c, d) in below or [(-1, (a, b))]:
				low, high = max(a, c), min(b, d)
				if high - low > 1e-9: blocks.touch(j, i, [(low, row * height), (high, row * height)], (0., 1.), bed)
		if head != 'none':
			for i, j, (_, x) in zip(ids, ids[1:], course):
				blocks.touch(i, j, [(x, row * height), (x, (row + 1) * height)], (1., 0.), head)
		below = list(zip(ids, course))
	return blocks


def courses(bond, columns, rows, length):
	"""Ends of the bricks of a wall, as yade_brick.build lays them; bond 'straight', 'english' or 'column'."""
	out = []
	for row in range(rows):
		lengths = [length] * (1 if bond == 'column' else columns)
		if bond == 'english' and row % 2: lengths = [length / 2] + [length] * (columns - 1) + [length / 2]
		ends = np.concatenate([[0], np.cumsum(lengths)])
		out.append(list(zip(ends[:-1], ends[1:])))
	return out


def leastOpening(rows, height):
	"""Tangent of the smallest tilt at which some part of a wall turns over about the lower right corner of a course as one piece, and every joint between it and
	the rest opens: then nothing of the rest holds it, whatever the friction. The part takes bricks from the right of its courses, and all that rests on them.
	"""
	best = math.inf

	def extend(row, base, first, overturning, resisting):
		nonlocal best
		if row == len(rows):
			best = min(best, resisting / overturning)
			return
		# whatever rests on a brick of the part below belongs to it
		most = next(i for i, brick in enumerate(rows[row]) if row == base or brick[1] > first + 1e-9)
		for start in range(len(rows[row]) if row == base else most + 1):
			part = rows[row][start:]
			mass = sum(b - a for a, b in part)
			resisted = sum((b - a) * (rows[base][-1][1] - (a + b) / 2) for a, b in part)
			extend(row + 1, base, part[0][0], overturning + mass * (row - base + .5) * height, resisting + resisted)

	for base in range(len(rows)):
		extend(base, base, None, 0, 0)
	return best
