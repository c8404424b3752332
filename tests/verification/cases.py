# SPDX-License-Identifier: GPL-2.0-or-later
# What the verification cases share: reference values, the table of expected and got, a scene with the engines in order, and the engines' use.
# Every tolerance is given with its reason; a row that is not ok fails its test.
import inspect, json, math, os, sys, unittest

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
_touched = set()


def reference(id):
	"""Value of a row of references.json. The report says which case used it."""
	_touched.add(id)
	return _references[id]['value']


class Case(unittest.TestCase):
	"""A test whose rows are printed, good or bad, and kept for the report when VERIFICATION_ROWS names a folder.

	What a case does is its docstring, which the report prints; the group it belongs to is GROUP of its module.
	"""

	def setUp(self):
		O.reset()
		self.rows, self.comparisons, self.curves = [], [], []
		_touched.clear()

	def tearDown(self):
		O.reset()
		print('\n' + table(self.rows, self.id().split('.', 1)[1]))
		for reason in dict.fromkeys(row['reason'] for row in self.rows):
			print('  ' + reason)

	def run(self, result=None):
		result = super().run(result)
		if 'VERIFICATION_ROWS' in os.environ: self._keep(os.environ['VERIFICATION_ROWS'], result)
		return result

	def judge(self, id, got, expected, tolerance, reason):
		"""The implementation against what it has to give. tolerance: relative, absolute where expected is 0."""
		self._add(judgedRow(id, got, expected=expected, tolerance=tolerance, reason=reason))

	def atMost(self, id, got, limit, reason):
		self._add(judgedRow(id, got, limit=limit, reason=reason))

	def compare(self, id, got, truth, reason):
		"""The method against the truth: an error that the method itself has, reported and not judged. Say in `reason` what it comes from; a judged row,
		such as the convergence with refinement, has to show that it is the method's.
		"""
		self.comparisons.append(dict(id=id, got=float(got), truth=float(truth), reason=reason))

	def curve(self, figure, series, x, y, xLabel='', yLabel='', logX=False, logY=False, line=True):
		"""A curve (line=False: points) for a figure of the report; what is said of the axes first holds for the figure."""
		self.curves.append(
		        dict(figure=figure, series=series, x=[float(v) for v in x], y=[float(v) for v in y], xLabel=xLabel, yLabel=yLabel, logX=logX, logY=logY, line=line)
		)

	def _add(self, row):
		self.rows.append(row)
		if not row['ok']: self.fail(table([row], 'not ok: ' + row['reason']))

	def _keep(self, folder, result):
		module, case = self.id().split('.')[0], self.id().split('.')[-1]
		content = dict(
		        module=module, case=case, group=sys.modules[type(self).__module__].GROUP, about=inspect.getdoc(getattr(self, case)) or '',
		        passed=not any(test is self for test, _ in result.failures + result.errors), references=sorted(_touched), rows=self.rows,
		        comparisons=self.comparisons, curves=self.curves
		)
		os.makedirs(folder, exist_ok=True)
		with open(os.path.join(folder, module + '.' + case + '.json'), 'w') as file:
			json.dump(content, file, indent='\t', default=lambda value: value.item())  # NumPy's numbers


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
	        BrickDynamics(damping=damping, stopFile=""), *before,
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
