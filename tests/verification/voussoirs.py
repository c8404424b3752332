# SPDX-License-Identifier: GPL-2.0-or-later
# Semicircular arches of voussoirs with radial dry joints: as scenes, as linear programs of rigid blocks, and exact statics on springs that only press.
#
# A voussoir of the references is a sector of the ring; a brick has planar faces, and its centre lies a little further in. The weight therefore gets a
# torque that moves it to the sector's centre. Angles are from the crown, in the direction of x.
import math

import numpy as np

from cases import *
from limitAnalysis import Blocks
from tilting import pressedJoint, thinned, withoutCompliance

RADIUS, DEPTH = 1., .2  # of the middle of the ring, and through the arch [m]
SLIDE = math.radians(80)  # friction: no sliding
SEGMENTS = 4
MARGIN = .015  # of thickness, about the thinnest arch of exact statics
SOFTER = 'the method: springs need an area to press on, so hinges lie inside the ring, by the inverse cubic root of the stiffness'


class Voussoir:
	"""Geometry of an arch of `count` voussoirs of given thickness [m]."""

	def __init__(self, count, thickness):
		self.count, self.thickness, self.angle = count, thickness, math.pi / count
		self.inner, self.outer = RADIUS - thickness / 2, RADIUS + thickness / 2
		half = self.angle / 2
		below, above, height = 2 * self.inner * math.sin(half), 2 * self.outer * math.sin(half), thickness * math.cos(half)
		self.weight = DENSITY * GRAVITY * DEPTH * height * (below + above) / 2
		self.centre = self.inner * math.cos(half) + height / 3 * (below + 2 * above) / (below + above)
		self.toJoint = self.centre * math.sin(half)
		self.sectorCentre = 2 / 3 * math.sin(half) / half * (self.outer**3 - self.inner**3) / (self.outer**2 - self.inner**2)

	def offset(self, angle):
		"""How far beside a voussoir's centre its weight acts [m]."""
		return (self.sectorCentre - self.centre) * math.sin(angle)


# Scene


class Arch:
	"""An arch on the ground; its weight is put on slowly."""

	def __init__(self, count, thickness, young):
		O.reset()
		self.shape = Voussoir(count, thickness)
		dry = material(young=young, frictionAngle=SLIDE)
		ground(dry)
		self.bricks = [self.voussoir((k + .5) * self.shape.angle - math.pi / 2, dry) for k in range(count)]
		engines(gravity=(0, 0, 0))
		self.crown, self.history = self.bricks[count // 2], []

	def voussoir(self, angle, dry):
		half = self.shape.angle / 2
		at = lambda r, y, a: Vector3(r * math.sin(a), y, r * math.cos(a))
		corners = []
		for a in (angle + half, angle - half):
			corners += [at(self.shape.inner, -DEPTH / 2, a), at(self.shape.outer, -DEPTH / 2, a), at(self.shape.outer, DEPTH / 2, a), at(self.shape.inner, DEPTH / 2, a)]
		return add(corners=corners, material=dry, deformation='rigid', segments=SEGMENTS)

	def load(self, share):
		engine(NewtonIntegrator).gravity = (0, 0, -share * GRAVITY)
		for k, b in enumerate(self.bricks):
			offset = self.shape.offset((k + .5) * self.shape.angle - math.pi / 2)
			O.forces.setPermT(b.id, (0, share * offset * self.shape.weight, 0))

	def drop(self):
		return self.crown.state.refPos[2] - self.crown.state.pos[2]

	def stands(self, far=.02, raising=.5, resting=.5, watched=.5):
		"""Whether the crown stays above `far` [m] below its place: weight put on and rest, both with damping; then a time with little."""
		setDamping(.7)
		O.step()
		# the bound counts springs as short as the ring is thin, on all faces; the joints' are longer
		engine(BrickTimeStepper).active = False
		O.dt *= 2
		while O.time < raising + resting + watched:
			if O.iter % 50 == 1:
				self.load(min(1, O.time / raising))
				self.history.append((O.time, self.drop()))
			if O.time > raising + resting: setDamping(.2)
			O.step()
			if self.drop() > far: return False
		return True


# Limit analysis


def rigidArchStands(count, thickness):
	shape, blocks = Voussoir(count, thickness), Blocks()
	radial = lambda a: np.array([math.sin(a), math.cos(a)])
	for k in range(count):
		blocks.block(shape.sectorCentre * radial((k + .5) * shape.angle - math.pi / 2), 1.)
	for k in range(count + 1):
		a = k * shape.angle - math.pi / 2
		across = np.array([math.cos(a), -math.sin(a)])
		ends = [shape.inner * radial(a), shape.outer * radial(a)]
		if k < count: blocks.touch(k - 1, k, ends, across, None)
		else: blocks.touch(-1, k - 1, ends, -across, None)
	return blocks.stand()


def thinnestRigid(count):
	"""Thickness over radius."""
	falls, stands = .05, .2
	while stands - falls > 1e-7:
		middle = (falls + stands) / 2
		if rigidArchStands(count, middle * RADIUS): stands = middle
		else: falls = middle
	return stands


# Exact statics


def turned(angle, v):
	"""Against the direction of positive pitch."""
	return np.array([math.cos(angle) * v[0] - math.sin(angle) * v[1], math.sin(angle) * v[0] + math.cos(angle) * v[1]])


def springing(shape, thrust, eccentricity, young):
	"""Rotation and shift [m] of the ground that half an arch would need, from the crown down, for a thrust (over a voussoir's weight) that acts on the crown's
	joint at this share of the thickness from its middle. Both are zero in equilibrium. None when a joint cannot carry what it gets.
	"""
	turn, shift, forces = 0., np.zeros(2), []
	for k in range((shape.count + 1) // 2):
		angle, last = (k + .5) * shape.angle, k == (shape.count - 1) // 2
		outward = np.array([math.sin(angle), math.cos(angle)])
		place = shift + turned(turn, RADIUS * outward)
		if k == 0: forces.append((place + eccentricity * shape.thickness * outward, shape.weight * np.array([thrust, -.5])))
		else:
			at = k * shape.angle
			centre = shift + turned(turn, shape.centre * np.array([math.sin(at), math.cos(at)]))
			forces.append((centre + np.array([shape.offset(at), 0]), np.array([0, -shape.weight])))
		total = sum(force for _, force in forces)
		moment = sum((x - place)[0] * force[1] - (x - place)[1] * force[0] for x, force in forces)
		length = shape.toJoint * (1 if last else 2)
		rotation = 0
		for _ in range(3):
			# forces act along the mean normal of the two faces; on the ground along its own
			radial = turned(turn + rotation * (1 if last else .5), outward)
			along = np.array([radial[1], -radial[0]])
			normal = total @ along
			if normal <= 0: return None
			found = pressedJoint(normal * (1 - POISSON**2) * length / (young * DEPTH), -moment / normal, shape.thickness)
			if found is None: return None
			closing, rotation, contact = found
		slip = total @ radial * 2 * (1 + POISSON) * length / (young * DEPTH * contact)
		turn += rotation
		shift = place - closing * along - slip * radial - turned(turn, RADIUS * outward)
	return np.array([turn, shift[0]])


class StaticArch:
	"""Equilibrium of ever thinner arches, by following (thickness over `scale`, thrust, eccentricity) from a thick one until the thickness has to grow again."""

	def __init__(self, count, young, scale):
		self.count, self.young, self.scale = count, young, scale
		x = self.thickArch()
		self.path, tangent = [x], np.array([-1., 0, 0])
		while not (len(self.path) > 3 and x[0] > self.path[-2][0] > self.path[-3][0]):
			step = self.step(x, tangent)
			if step is None: break
			tangent, x = (step - x) / np.linalg.norm(step - x), step
			self.path.append(x)

	def thinnest(self):
		"""Thickness over radius of the thinnest arch that has an equilibrium."""
		return min(x[0] for x in self.path) * self.scale

	def residual(self, x):
		return springing(Voussoir(self.count, x[0] * self.scale * RADIUS), x[1], x[2] / 2, self.young)

	def slopes(self, x, residual):
		columns = []
		for k in range(3):
			for change in (1e-7, -1e-7):
				moved = x.copy()
				moved[k] += change
				other = self.residual(moved)
				if other is not None: break
			else: return None
			columns.append((other - residual) / change)
		return np.array(columns).T

	def newton(self, x, row, value):
		"""Solves for equilibrium and row.x = value; None when that fails."""
		for _ in range(12):
			residual = self.residual(x)
			slopes = None if residual is None else self.slopes(x, residual)
			if slopes is None: return None
			change = np.linalg.solve(np.vstack([slopes, row]), -np.append(residual, row @ x - value))
			x = x + change
			if np.abs(change).max() < 1e-9: return x
		return None

	def thickArch(self):
		"""Equilibrium of an arch about three times as thick as the scale."""
		row = np.array([1., 0, 0])
		for thick in (3, 2.5, 4):
			for share in np.linspace(.1, .6, 51):
				for eccentricity in (0, .3, -.3, .6):
					found = self.newton(np.array([thick, share * self.count / 2, eccentricity]), row, thick)
					if found is not None and abs(found[2]) < 1: return found
		raise RuntimeError('no equilibrium of a thick arch found')

	def step(self, x, tangent):
		"""The next point of the path, or None where it ends."""
		slopes = self.slopes(x, self.residual(x))
		if slopes is None: return None
		direction = np.linalg.svd(slopes)[2][2]
		if direction @ tangent < 0: direction = -direction
		length = .04
		while length > 1e-6:
			found = self.newton(x + length * direction, direction, direction @ x + length)
			if found is not None and np.linalg.norm(found - x) < 2 * length: return found
			length /= 2
		return None


# Cases


class ThinnestArch(Case):

	def standOrFall(self, count, young):
		"""An arch a little thicker than exact statics asks for, and one a little thinner."""
		limit = reference('dyn.arch')[str(count)]
		exact = StaticArch(count, young, limit).thinnest()
		name = '%d voussoirs, E = %g Pa' % (count, young)
		for factor, expected in ((1 + MARGIN, 1), (1 - MARGIN, 0)):
			arch = Arch(count, factor * exact * RADIUS, young)
			stands = int(arch.stands())
			self.judge('%s, t/R = %.5f: stands' % (name, factor * exact), stands, expected, 0, 'exact statics: t/R = %.5f' % exact)
			self.curve('Crown of an arch of ' + name, 't/R = %.5f' % (factor * exact), *zip(*thinned(arch.history)), 'time [s]', 'drop [m]')
		self.compare('%s: thinnest t/R, exact statics' % name, exact, limit, SOFTER)

	def judgeLimit(self, count, young):
		limit = reference('dyn.arch')[str(count)]
		self.judge('%d voussoirs: t/R by our linear program' % count, thinnestRigid(count), limit, 1e-5, 'bisection to 1e-6, digits of the program')
		if not young: return
		thinnest = [StaticArch(count, E, limit).thinnest() for E in young]
		label = '%d voussoirs: t/R by statics of ever stiffer springs, extrapolated' % count
		self.judge(label, withoutCompliance(young, thinnest), limit, 1e-3, 'what is left after the inverse cubic root')
		figure = 'Thinnest arches over those of rigid voussoirs, exact statics'
		self.curve(figure, '%d voussoirs' % count, young, [t / limit - 1 for t in thinnest], 'Young\'s modulus [Pa]', 'excess of t/R', True, True)
