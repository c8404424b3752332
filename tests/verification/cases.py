# SPDX-License-Identifier: GPL-2.0-or-later
# What the verification cases share: reference values, the table of expected and got, a scene with the engines in order, and the engines' use.
# Every tolerance is given with its reason; a row that is not ok fails its test.
import json, math, os, unittest

from yade import O, Quaternion, Vector3, utils
from yade.wrapper import Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator
from yade_brick import *
from yade_brick.build import brick
from yade_brick.report import judgedRow, table

GRAVITY = 9.8  # of all references [m/s2]
YOUNG, POISSON, DENSITY = 9.8e6, .25, 1800.  # of the paper's walls
FRICTION = math.radians(32)
UNBREAKABLE = dict(tensileStrength=1e15, cohesion=1e15, frictionAngle=FRICTION, compressiveStrength=1e15)

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'references.json')) as file:
	_references = {row['id']: row for row in json.load(file)}


def reference(id):
	"""Value of a row of references.json."""
	return _references[id]['value']


class Case(unittest.TestCase):
	"""A test whose rows are printed, good or bad."""

	def setUp(self):
		O.reset()
		self.rows = []

	def tearDown(self):
		O.reset()
		print('\n' + table(self.rows, self.id().split('.', 1)[1]))
		for reason in dict.fromkeys(row['reason'] for row in self.rows):
			print('  ' + reason)

	def judge(self, id, got, expected, tolerance, reason):
		"""tolerance: relative, absolute where expected is 0."""
		self._add(judgedRow(id, got, expected=expected, tolerance=tolerance, reason=reason))

	def atMost(self, id, got, limit, reason):
		self._add(judgedRow(id, got, limit=limit, reason=reason))

	def _add(self, row):
		self.rows.append(row)
		if not row['ok']: self.fail(table([row], 'not ok: ' + row['reason']))


def material(**attributes):
	"""The paper's brick, changed where asked; appended to the scene."""
	given = dict(young=YOUNG, poisson=POISSON, density=DENSITY, frictionAngle=FRICTION)
	given.update(attributes)
	O.materials.append(BrickMat(**given))
	return O.materials[-1]


def ground(material, axis=2):
	"""A wall below (axis 2) or beside the scene, through the origin; its id."""
	return O.bodies.append(utils.wall(0, axis=axis, sense=1, material=material))


def add(*arguments, **options):
	"""A brick in the scene: see yade_brick.build.brick. Returns the body."""
	return O.bodies[O.bodies.append(brick(*arguments, **options))]


def engines(gravity=(0, 0, -GRAVITY), damping=0, safety=.9, before=(), after=()):
	"""Sets O.engines; `before` stand before NewtonIntegrator, `after` at the end.

	:param damping: local damping of the rigid motion and of the modes
	"""
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(safety=safety),
	        BrickDynamics(damping=damping), *before,
	        NewtonIntegrator(gravity=gravity, damping=damping), *after
	]


def engine(Class):
	found, = [e for e in O.engines if isinstance(e, Class)]
	return found


def setDamping(value):
	engine(BrickDynamics).damping = engine(NewtonIntegrator).damping = value


def runFor(seconds):
	"""At the present time step, which is set by a first step when there is none yet."""
	if O.iter == 0: O.step()
	O.run(max(1, round(seconds / O.dt)), True)


def untilRest(seconds, damping=.4):
	"""Runs with local damping, which does not change the state of rest, then takes damping and velocities away."""
	setDamping(damping)
	runFor(seconds)
	setDamping(0)
	for b in O.bodies:
		b.state.vel = b.state.angVel = b.state.angMom = Vector3.Zero


def pitch(b):
	"""Rotation of a body about y against its first orientation [rad], positive from z to x."""
	turn = b.state.ori * b.state.refOri.conjugate()
	x = turn * Vector3(0, 0, 1)
	return math.atan2(x[0], x[2])
