# SPDX-License-Identifier: GPL-2.0-or-later
# A table that is tilted under rigid bricks until they fall, and the exact statics of a stack of them on springs that only press.
#
# How far it can be tilted is the largest angle at which there is equilibrium. Near it a stack yields so slowly that turning the table on would overshoot,
# so the table is turned back as soon as the top leans further than it is asked to: the path of equilibrium is followed past its peak.
import math

from cases import *


def setTilt(degrees, axis=0):
	"""Gravity seen from a table turned by this angle, downhill along x (axis 0) or y (axis 1)."""
	angle = math.radians(degrees)
	along, down = GRAVITY * math.sin(angle), -GRAVITY * math.cos(angle)
	engine(NewtonIntegrator).gravity = (along, 0, down) if axis == 0 else (0, along, down)


def raiseTable(degrees, seconds, axis=0, damping=.7):
	"""Comes to rest at this tilt, which grows evenly over the first half of the time."""
	setDamping(damping)
	O.step()
	steps = max(2, round(seconds / O.dt))
	for k in range(steps):
		setTilt(degrees * min(1, 2 * k / steps), axis)
		O.step()


class Path:
	"""Lean of the top [m] and tilt [degrees], through equilibrium and past its end.

	:param tops: bodies; the one that has moved most counts
	:param start: tilt to begin with [degrees]
	:param far: lean to end with [m]
	:param height: of what stands [m]: sets how firmly the table answers
	:param rate: at which the table turns as long as nothing moves [degrees/s]
	:param longest: simulated time after which the run is given up [s]
	"""

	def __init__(self, tops, start, far, height, rate=.6, axis=0, longest=12.):
		# lean turns the weights by 1/height radians a metre; the table has to turn back faster than that
		firmness, lag = 6 * math.degrees(1) / height, .15
		self.tops, self.axis = tops, axis
		raiseTable(start, .3, axis)
		setDamping(.3)
		began, first, self.leans, self.tilts = O.time, self.lean()[0], [], []
		while True:
			for _ in range(5):
				O.step()
			lean, velocity = self.lean()
			wanted = rate * (O.time - began) - firmness * (lean - first + lag * velocity)
			setTilt(start + wanted, axis)
			self.leans.append(lean)
			self.tilts.append(start + wanted)
			if lean > far or O.time - began > longest or not 0 <= start + wanted < 80: break
		self.ended = lean > far

	def lean(self):
		return max(((b.state.pos - b.state.refPos)[self.axis], b.state.vel[self.axis]) for b in self.tops)

	def peak(self):
		return max(self.tilts)

	def shown(self):
		"""For a curve."""
		return thinned(self.leans), thinned(self.tilts)


def thinned(values, count=100):
	return values[::max(1, len(values) // count)]


def standsAt(tops, degrees, lean, axis=0, seconds=.6):
	"""Whether no top has come to lean further than `lean` [m] some time after the table was raised, without damping at last."""
	raiseTable(degrees, .5, axis)
	setDamping(0)
	steps = round(seconds / O.dt)
	while steps > 0 and max((b.state.pos - b.state.refPos)[axis] for b in tops) < lean:
		O.step()
		steps -= 1
	return steps == 0


# Statics of a stack


def pressedJoint(force, offset, length):
	"""A joint under a force (over kn and depth) at an offset from its middle; its springs only press.

	:returns: closing in the middle [m], rotation towards the offset [rad], length in contact [m]; None when the force acts outside
	"""
	if abs(offset) <= length / 6: return force / length, 12 * offset * force / length**3, length
	contact = 3 * (length / 2 - abs(offset))  # the force acts at a third of it from the edge
	if contact <= 0: return None
	rotation = 2 * force / contact**2
	return rotation * (contact - length / 2), math.copysign(rotation, offset), contact


def stackAt(lean, count, size, young):
	"""Tilt of the table [rad] and lean of the top brick's centre [m] of a stack whose top brick is turned by `lean` [rad] against gravity.

	From the top down, in the axes of the top brick: what a joint carries is known, so how it closes, turns and slips is, and where the next brick is.
	"""
	width, depth, height = size
	weight = DENSITY * width * height * depth * GRAVITY
	turn, x, z, sumX, sumZ = 0, 0, 0, 0, 0
	for k in range(1, count + 1):
		sumX, sumZ = sumX + x, sumZ + z
		onTable = k == count
		length = height / 2 if onTable else height
		normal, shear = young / ((1 - POISSON**2) * length), young / (2 * (1 + POISSON) * length)
		x, z = x - height / 2 * math.sin(turn), z - height / 2 * math.cos(turn)  # middle of the lower face
		toX, toZ = sumX / k - x, sumZ / k - z  # centre of what the joint carries, from there
		local = lean + turn
		offset = toX * math.cos(turn) - toZ * math.sin(turn) + (toX * math.sin(turn) + toZ * math.cos(turn)) * math.tan(local)
		rotation = 0
		for _ in range(4):
			# forces act along the mean normal of the two faces; on the table along its own
			angle = local - rotation * (1 if onTable else .5)
			found = pressedJoint(k * weight * math.cos(angle) / (normal * depth), offset, width)
			if found is None: return None
			closing, rotation, contact = found
		slip = k * weight * math.sin(angle) / (shear * depth * contact)
		mean = turn - rotation / 2
		x, z = x - slip * math.cos(mean) + closing * math.sin(mean), z + slip * math.sin(mean) + closing * math.cos(mean)
		turn -= rotation
		if not onTable: x, z = x - height / 2 * math.sin(turn), z - height / 2 * math.cos(turn)
	return lean + turn, z * math.sin(turn) - x * math.cos(turn)


def stackPath(count, size, young, points=1500):
	"""Leans [m] and tilts [degrees] of equilibrium, to well past the largest tilt, which is that of collapse."""
	limit, leans, tilts = math.atan(size[0] / (count * size[2])), [], []
	for k in range(1, 2 * points):
		found = stackAt(limit * k / points, count, size, young)
		if found is None: break
		tilts.append(math.degrees(found[0]))
		leans.append(found[1])
		if tilts[-1] < .8 * max(tilts): break
	return leans, tilts


def stackAngle(count, size, young):
	"""Tilt of collapse [degrees]."""
	return max(stackPath(count, size, young)[1])


def withoutCompliance(young, angles):
	"""Limit of angles for stiffness without bound, from the two largest stiffnesses; what is missing goes with the inverse cubic root of it: the lever that
	contact takes from the edge goes with the inverse root of stiffness times rotation, and what the rotation takes with the rotation itself.
	"""
	(first, second), ratio = angles[-2:], (young[-1] / young[-2])**(1 / 3)
	return (ratio * second - first) / (ratio - 1)
