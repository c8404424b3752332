# SPDX-License-Identifier: GPL-2.0-or-later
# Tries examples (see inputs.py) inside YADE: reads them from a pipe, one line of JSON each, and answers with what came of it. Run by fuzz.py as
#   yade -n -x -j1 examples.py <pipe to read> <pipe to write>
# An example may end in an exception that says what is wrong, or in numbers that are finite. Anything else is a finding; the end of the process is seen
# by fuzz.py.
import json, linecache, math, os, re, sys, tempfile, traceback

from yade import O, utils
from yade.wrapper import *
from yade.minieigenHP import Quaternion, Vector3
import numpy as np
import yade_brick
from yade_brick import *
from yade_brick import build, picture, report

packageFolder = os.path.dirname(os.path.realpath(yade_brick.__file__))
folder = tempfile.mkdtemp(prefix='fuzz')


class Finding(Exception):
	"""Neither refused with a reason nor finite."""


# What a message must not be: nothing but names, or words of Python, NumPy and C++ that do not say what of the input is wrong.
_namesOnly = re.compile(r'[\w:<>,*& ]*(::|bad_alloc|exception|error_already_set)[\w:<>,*& ]*')
_words = re.compile(
        r"could not convert string to float|cannot convert float|invalid literal for int|math domain error|math range error|Result too large|"
        r"setting an array element|could not be broadcast|object is not (iterable|subscriptable|callable)|unsupported operand|not supported between|"
        r"must be real number|bad operand type|to unpack|index out of range|has no attribute|by zero|object cannot be interpreted|_M_range_check|"
        r"map::at|basic_string|unidentifiable C\+\+|must be a string|expected string|can't multiply|unhashable|must be str|inhomogeneous|must contain|"
        r"is not a valid value for|Singular matrix|not in list|truth value of an array|has no len"
)
#: YADE's own, for a value of a type that it cannot convert.
_ofConversion = ('did not match C++ signature', 'No registered converter', 'too large to convert to C long', 'value too large', 'bad numeric conversion')
_vague = (AttributeError, IndexError, KeyError, ZeroDivisionError, AssertionError, OverflowError, RecursionError, MemoryError, SystemError, UnicodeError,
        NameError)


def isReadable(error):
	"""Whether a message tells what is wrong: YADE's own about a type that it cannot convert does."""
	text = str(error).strip()
	if any(words in text for words in _ofConversion): return True
	if len(text) < 10 or ' ' not in text or _namesOnly.fullmatch(text): return False
	if isinstance(error, _vague): return False
	return not _words.search(text)


def attempt(function, *arguments, **keywords):
	"""What a call gives, or the error with which it was refused."""
	try:
		return function(*arguments, **keywords)
	except Exception as error:
		if isinstance(error, Finding): raise
		if not isReadable(error):
			where = [frame for frame in traceback.extract_tb(error.__traceback__) if os.path.realpath(frame.filename).startswith(packageFolder)]
			place = ' at %s:%d' % (os.path.basename(where[-1].filename), where[-1].lineno) if where else ''
			raise Finding('unreadable message%s from %s: %s: %s' % (place, getattr(function, '__name__', function), type(error).__name__, error)) from error
		return error


def numbersIn(value):
	"""All numbers in nested lists, vectors, arrays, dicts."""
	if isinstance(value, (bool, str, bytes, type(None))): return []
	if isinstance(value, (int, float, np.number)): return [float(value)]
	if isinstance(value, np.ndarray): return [float(x) for x in value.ravel()]
	if isinstance(value, dict): return [x for entry in value.values() for x in numbersIn(entry)]
	return [x for entry in list(value) for x in numbersIn(entry)]


def mustBeFinite(what, value):
	if not all(math.isfinite(x) for x in numbersIn(value)): raise Finding('%s is not finite' % what)


def refused(value):
	return isinstance(value, Exception)


def vector(value):
	return Vector3(*value) if isinstance(value, list) and len(value) == 3 and all(isinstance(x, (int, float)) for x in value) else value


def vectors(values):
	return [vector(value) for value in values] if isinstance(values, list) else values


# Shapes


def tryShape(example):
	given, options = vectors(example['corners']), example['options']
	solid = attempt(Brick.solidProperties, given)
	if not refused(solid):
		mustBeFinite('solidProperties', [solid[name] for name in ('volume', 'centroid', 'inertia', 'corners')])
		if not (solid['volume'] > 0 and min(solid['inertia']) > 0): raise Finding('volume %g, inertia %s' % (solid['volume'], solid['inertia']))
	stiffness = attempt(Brick.stiffness, vectors(example['nodes']), example['young'], example['poisson'], options.get('element', 'full'))
	if not refused(stiffness): mustBeFinite('stiffness', [[stiffness[i, j] for j in range(24)] for i in range(24)])
	shape = attempt(Brick, corners=given, **options)
	if not refused(shape) and given: mustBeFinite('volume', shape.volume)
	material = attempt(BrickMat, young=example['young'], poisson=example['poisson'])
	body = attempt(build.brick, corners=given, material=BrickMat() if refused(material) else material, **options)
	if refused(body): return 'refused'
	setUsualEngines()
	O.bodies.append(body)
	body.state.angVel = Vector3(1, 2, 3)
	return 'finite' if not any(refused(attempt(O.step)) for _ in range(3)) and isFinite() else 'refused'


# Materials


def tryMaterial(example):
	mortar = attempt(Mortar, **example['mortar']) if example['mortar'] is not None else None
	mortar = Mortar() if refused(mortar) else mortar
	material = attempt(BrickMat, mortar=mortar, **example['brick'])
	outcome = 'refused' if refused(material) else 'finite'
	if outcome == 'refused': material = BrickMat(mortar=mortar)
	for target, name, value in example['set']:
		thing = material if target == 'brick' else mortar
		if thing is not None and hasattr(thing, name): attempt(setattr, thing, name, value)
	O.materials.append(material)
	setUsualEngines()
	wall = attempt(build.straightJointWall, 2, 2, material=material)
	if refused(wall): return 'refused'
	O.bodies.append(wall.bodies)
	if any(refused(attempt(function)) for function in (lambda: MortarJoints()(), lambda: O.step(), lambda: O.step(), lambda: O.step())): return 'refused'
	return outcome if isFinite() else 'refused'


# Scenes

_makers = {
        'ForceResetter': ForceResetter, 'BrickTimeStepper': BrickTimeStepper, 'BrickDynamics': BrickDynamics, 'DeformationOnDemand': DeformationOnDemand,
        'NewtonIntegrator': lambda: NewtonIntegrator(gravity=(0, 0, -9.8), damping=0),
        'GroundMotion': lambda: GroundMotion(dt=.01, acceleration=[Vector3(0, 0, 0), Vector3(3, 1, 0), Vector3(0, 0, 0)])
}


def setUsualEngines(names=('ForceResetter', 'InsertionSortCollider', 'InteractionLoop', 'BrickTimeStepper', 'BrickDynamics', 'NewtonIntegrator'),
        without=(), verletDist=0.):

	def made(*functors):
		return [functor() for functor in functors if functor.__name__ not in without]

	engines = []
	for name in names:
		if name == 'InsertionSortCollider': engines.append(InsertionSortCollider(made(Bo1_Brick_Aabb, Bo1_Wall_Aabb, Bo1_Box_Aabb), verletDist=verletDist))
		elif name == 'InteractionLoop':
			engines.append(InteractionLoop(made(Ig2_Brick_Brick_BrickGeom, Ig2_Wall_Brick_BrickGeom, Ig2_Box_Brick_BrickGeom),
			        made(Ip2_BrickMat_BrickMat_BrickPhys, Ip2_FrictMat_BrickMat_BrickPhys),
			                               made(Law2_BrickGeom_BrickPhys_Mortar)))
		else: engines.append(_makers[name]())
	O.engines = engines
	O.dt = 1e-5


def addOnDemand(attributes):
	"""Puts the engine where its documentation says."""
	names = [type(e).__name__ for e in O.engines]
	place = names.index('BrickDynamics') if 'BrickDynamics' in names else len(names)
	O.engines = O.engines[:place] + [DeformationOnDemand(**attributes)] + O.engines[place:]


def chooseTerms(choices):
	law = Loop(O.engines).law
	for name, value in choices.items():
		if law is not None: setattr(law, name, value)


def loopArguments(given):
	"""Arguments of yade_brick.engines, in which objects are written as their names or attributes."""
	made = dict(given)
	if isinstance(given.get('functors'), list):
		made['functors'] = [functorKinds[name]() if isinstance(name, str) and name in functorKinds else name for name in given['functors']]
	if isinstance(given.get('motion'), dict) and given['motion']:
		dt, acceleration = given['motion']['dt'], vectors(given['motion']['acceleration'])
		made['motion'] = GroundMotion(dt=dt, acceleration=acceleration) if given['motion']['engine'] else Motion(dt, acceleration, 'a motion')
	return made


def useLoop(given):
	O.engines = yade_brick.engines(**loopArguments(given))
	effects()


functorKinds = {
        kind.__name__: kind
        for kind in (
                Bo1_Brick_Aabb, Bo1_Wall_Aabb, Bo1_Box_Aabb, Bo1_Sphere_Aabb, Ig2_Brick_Brick_BrickGeom, Ig2_Wall_Brick_BrickGeom,
                Ig2_Box_Brick_BrickGeom, Ip2_BrickMat_BrickMat_BrickPhys, Ip2_FrictMat_BrickMat_BrickPhys, Ip2_FrictMat_FrictMat_FrictPhys,
                Law2_BrickGeom_BrickPhys_Mortar, Law2_ScGeom_FrictPhys_CundallStrack
        )
}


def engine(name):
	return next((e for e in O.engines if type(e).__name__ == name), None)


def bricks():
	return [b for b in O.bodies if isinstance(b.shape, Brick)]


def checkScene():
	"""All that can be read of bricks, joints and contacts after a step."""
	dynamics = engine('BrickDynamics')
	if dynamics is None or dynamics.dead or engine('InteractionLoop') is None: return  # what moves the bricks is YADE alone
	for b in bricks():
		s = b.state
		for name in ('pos', 'vel', 'angVel', 'ori'):
			mustBeFinite('state.' + name, [getattr(s, name)[k] for k in range(4 if name == 'ori' else 3)])
		for name in ('amplitudes', 'rates', 'displacement', 'displacementRate'):
			mustBeFinite('Brick.' + name, [list(v) if isinstance(v, Vector3) else v for v in getattr(b.shape, name)])
		if not 0 < b.shape.share <= 1: raise Finding('share is %g' % b.shape.share)
		if b.shape.amplitudes:
			mustBeFinite('Brick.stress()', list(b.shape.stress()))
			mustBeFinite('energies of a brick', [b.shape.elasticEnergy(), b.shape.kineticEnergy()])
	for i in O.interactions:
		if i.isReal and isinstance(i.phys, BrickPhys):
			mustBeFinite('forces of a contact', [i.phys.normalForce, i.phys.shearForce, i.phys.kn, i.phys.ks])


def isFinite():
	"""Whether the scene is finite; a number that is not, which the last step may have left behind, must be refused by the next."""
	try:
		checkScene()
		return True
	except Finding:
		if not refused(attempt(O.step)): raise
		return False


def makeScene(example):
	"""The bodies and engines; what of it is refused is left out."""
	materials = []
	for brickPart, mortarPart in example['materials']:
		mortar = None if mortarPart is None else attempt(Mortar, **mortarPart)
		material = attempt(BrickMat, mortar=None if refused(mortar) else mortar, **brickPart)
		materials.append(BrickMat() if refused(material) else material)
		O.materials.append(materials[-1])
	if example['support']: O.bodies.append(supportOf(example['support'], materials[0]))
	place, before = Vector3(0, 0, .1), None
	for given in example['bricks']:
		given = dict(given)
		size = given.pop('size', [.2] * 3)
		if before is not None:
			axis = 'xyz'.find(given['side'][-1]) if given['side'] != 'free' else 0
			sign = -1 if given['side'][0] == '-' else 1
			move = [0., 0., 0.]
			move[axis] = sign * ((size[axis] + before[axis]) / 2 + given['gap'] + (.5 if given['side'] == 'free' else 0))
			move[(axis + 1) % 3] = given.get('slip', 0)
			place = place + Vector3(*move)
		turn = Quaternion(*given.get('turn', [1, 0, 0, 0]))
		body = attempt(
		        build.brick, size, center=place, orientation=turn.normalized() if turn.norm() > 1e-3 else None, material=materials[given.get('material', 0)],
		        deformation=given.get('level', 'trilinear'),
		        element=given.get('element', 'full'), inner=given.get('inner', 'inset'), segments=given.get('segments', 4),
		        cells=given.get('cells') if given.get('level') == 'refined' else None,
		        contactThickness=given.get('thickness'), fixed=given.get('fixed', False)
		)
		if refused(body): continue
		body.state.vel, body.state.angVel = Vector3(*given.get('vel', [0] * 3)), Vector3(*given.get('angVel', [0] * 3))
		O.bodies.append(body)
		before = size
	setUsualEngines(example['engines'], example['without'], example['verletDist'])
	if 'loop' in example: attempt(useLoop, example['loop'])
	if 'terms' in example: attempt(chooseTerms, example['terms'])
	if 'onDemand' in example: attempt(addOnDemand, example['onDemand'])


def materialNamed(name, usual):
	return {'brick': usual, 'frict': FrictMat(), 'elast': ElastMat(), 'none': None}[name]


def supportOf(given, usual):
	material = materialNamed(given.get('material', 'brick'), usual)
	if given['shape'] == 'wall': body = utils.wall(0, axis=2, sense=1, material=usual)
	else: body = utils.box(center=Vector3(0, 0, -1), extents=Vector3(2, 2, 1), fixed=True, material=usual)
	if 'axis' in given and given['shape'] == 'wall': body.shape.axis = given['axis']
	if 'sense' in given and given['shape'] == 'wall': body.shape.sense = given['sense']
	if 'extents' in given and given['shape'] == 'box': body.shape.extents = Vector3(*given['extents'])
	body.material = material
	return body


def pick(things, place):
	return things[place % len(things)] if things else None


def assign(target, place, name, value):
	if target == 'engine': thing = engine(place)
	elif target == 'scene': thing = O
	else:
		body = pick(bricks(), place)
		thing = body
		if body is not None and target != 'body': thing = {'state': body.state, 'shape': body.shape, 'material': body.material}.get(target,
		        getattr(body.material, 'mortar', None))
	if thing is None: return
	if target == 'body' and name == 'material': value = materialNamed(value, O.materials[0])
	if name == 'ori': value = Quaternion(*value)
	elif name in ('corners', 'acceleration'): value = vectors(value)
	elif target in ('state', 'engine') and name != 'ids': value = vector(value)
	setattr(thing, name, value)


def steps(count):
	for _ in range(count):
		O.step()


def changeLevel(place, attributes):
	"""Of one brick, or of all."""
	for b in bricks() if place is None else [pick(bricks(), place)]:
		if b is not None: b.shape.updateAttrs(attributes)


def settle():
	"""Steps until levels of deformation have changed, as far as they do in few steps."""
	steps(2)
	for _ in range(200):
		if all(b.shape.share == 1 for b in bricks()): break
		O.step()


def savedAndLoaded(ending):
	path = os.path.join(folder, 'scene' + ending)
	O.save(path, quiet=True)
	O.load(path, quiet=True)


def joined():
	return [(i.id1, i.id2) for i in O.interactions if isinstance(i.phys, BrickPhys) and i.phys.jointed]


def erase(place):
	b = pick(bricks(), place)
	if b is not None: O.bodies.erase(b.id)


def unjoin(place):
	pair = pick(joined(), place)
	if pair: O.interactions.erase(*pair)


def addAgain(place):
	"""One more body with the same shape object, a bit aside."""
	b = pick(bricks(), place)
	if b is None: return
	other = Body()
	other.shape, other.material = b.shape, b.material
	other.state.pos = b.state.pos + Vector3(1.3, 0, 0)
	other.state.mass, other.state.inertia = b.state.mass, b.state.inertia
	O.bodies.append(other)


def stresses():
	for i in O.interactions:
		if isinstance(i.phys, BrickPhys) and i.geom is not None:
			for read in (i.phys.normalStress, i.phys.shearStress, i.phys.segmentPoints, i.phys.elasticEnergy):
				read(i.geom)


def addMotion(given):
	O.engines = list(O.engines)[:-1] + [GroundMotion(dt=given['dt'], acceleration=vectors(given['acceleration']))] + list(O.engines)[-1:]


def addForce(place, value):
	b = pick(bricks(), place)
	if b is not None and b.iterBorn < O.iter: O.forces.setPermF(b.id, Vector3(*value))


def withBill():
	with Bill() as bill:
		steps(2)
	return bill.table()


def frequencies():
	mustBeFinite('natural frequencies', assembled().frequencies(2))


def solve():
	assembly = assembled()
	mustBeFinite('solve', assembly.solve(np.ones(assembly.stiffness.shape[0])))


def record():
	found = JointRecord()
	found.update()
	found.marks()
	return found.failedByMode()


def rest():
	found = restState()
	if O.iter > 0 and not given: mustBeFinite('restState', [found.kinetic, found.elastic])
	if not given and math.isnan(found.imbalance): raise Finding('restState().imbalance is NaN')


def drawn():
	wallPicture(os.path.join(folder, 'wall.png'), patches(O.bodies), width=3, dpi=40)


actions = {
        'step': steps, 'run': lambda count: O.run(count, True), 'joints': lambda given: MortarJoints(**{k: vector(v) if k == 'normal' else v for k,
        v in given.items()})(),
        'equilibrium': lambda given: StaticEquilibrium(**{k: vector(v) for k, v in given.items()})(), 'set': lambda change: assign(*change),
        'saved': savedAndLoaded, 'erase': erase, 'unjoin': unjoin, 'again': addAgain, 'motion': addMotion,
        'force': addForce, 'assembled': assembled, 'frequencies': frequencies, 'rest': rest, 'record': record, 'picture': drawn, 'bill': withBill,
        'limit': lambda: yade_brick.bill.stepLimit(), 'stresses': stresses,
        'level': changeLevel, 'settle': settle, 'terms': chooseTerms, 'loop': useLoop, 'onDemand': addOnDemand, 'effects': lambda: str(effects()),
        'clear': lambda: O.interactions.clear(), 'solve': solve, 'progress': lambda: runWithProgress(duration=3 * O.dt, stream=open(os.devnull, 'w')),
        'reset': lambda: O.resetTime()
}
_stepping = ('step', 'run', 'bill', 'progress', 'settle')
given = False  # whether something was set since the last step that was done: what is read then is what was given


def tryScene(example):
	makeScene(example)
	global given
	failed = given = False
	for name, *arguments in example['actions']:
		given = given or name in ('set', 'force', 'saved', 'level')
		outcome = attempt(actions[name], *arguments)
		if name in _stepping and not refused(outcome): given = False
		failed = failed or refused(outcome)
		# what was set since the last step is what was given
		if name in _stepping and not failed: failed = not isFinite()
	return 'refused' if failed else 'finite'


# Files


def broken(data, breaks):
	"""Bytes with parts cut off, changed, inserted, removed, repeated."""
	for kind, place, value in breaks:
		if not data: return data
		place %= len(data)
		if kind == 'cut': data = data[:place]
		elif kind == 'flip': data = data[:place] + bytes([data[place] ^ (value or 1)]) + data[place + 1:]
		elif kind == 'insert': data = data[:place] + bytes([value]) + data[place:]
		elif kind == 'delete': data = data[:place] + data[place + 1 + value % 7:]
		elif kind == 'double': data = data[:place] + data[max(0, place - value):]
		elif kind == 'line':
			lines = data.split(b'\n')
			del lines[place % len(lines)]
			data = b'\n'.join(lines)
	return data


def tryFile(example):
	path = os.path.join(folder, 'motion.txt')
	with open(path, 'wb') as file:
		file.write(broken(example['text'].encode('utf-8'), example['breaks']))
	options = example['options']
	if example['reader'] == 'at2': found = attempt(readAt2, path, **{k: v for k, v in options.items() if k in ('axis', 'name')})
	else: found = attempt(readColumns, path, **{'units': 'g', **{k: v for k, v in options.items() if k != 'axis'}})
	if refused(found): return 'refused'
	return checkMotion(found)


def checkMotion(found):
	mustBeFinite('acceleration', found.acceleration)
	mustBeFinite('dt', found.dt)
	shaking = attempt(build.groundMotion, found)
	if refused(shaking): return 'refused'
	mustBeFinite('groundDisplacement', [shaking.groundDisplacement(t) for t in (-1, 0, found.dt, found.duration, found.duration + 1)])
	for integral in (found.velocity, found.displacement, found.peak):
		mustBeFinite(integral.__name__, integral())
	return 'finite'


_saved = {}


def savedScene(when, ending):
	"""Bytes of a wall with all levels that was saved before the first step, in the middle of cracking, later, or as a scene of contacts."""
	if (when, ending) not in _saved:
		sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(sys.argv[0]))), 'yade'))
		import collapse
		collapse.build(2, 2)
		if when == 3: O.interactions.clear()
		steps((0, 1, 1500, 20)[when])
		path = os.path.join(folder, 'good' + ending)
		O.save(path, quiet=True)
		with open(path, 'rb') as file:
			_saved[when, ending] = file.read()
		O.reset()
	return _saved[when, ending]


_xmlValue = re.compile(rb'>([^<>\n\t]+)<')


def trySaved(example):
	data = savedScene(example['when'], example['format'])
	if example['format'] == '.xml' and example['values']:
		data = withValues(data, example['values'])
	path = os.path.join(folder, 'broken' + example['format'])
	with open(path, 'wb') as file:
		file.write(broken(data, example['breaks']))
	try:
		O.load(path, quiet=True)
	except Exception:  # in the words of YADE's archive, which it is read by
		return 'refused'
	if any(refused(attempt(O.step)) for _ in range(example['steps'])): return 'refused'
	return 'finite' if not example['steps'] or isFinite() else 'refused'


# What YADE reads through this plugin: attributes of bricks, their materials, joints and contacts, by their names in the XML.
_ours = rb'corners|amplitudes|rates|displacement|displacementRate|mortar'
_ourAttributes = (
        b'deformation|cells|element|inner|contactThickness|segments|whole|joints|young|poisson|density|frictionAngle|hn|hs|dampingRatio|deepest|contactPart|'
        b'safety|limit|limitingBrick|damping|acceleration|mass|sense|tensionFailures'
)
_xmlParts = re.compile(rb'<(%s)[ >].*?</\1>|<(%s)>[^<]*</\2>' % (_ours, _ourAttributes), re.S)


def withValues(data, values):
	"""The XML with some values of the parts that YADE reads through this plugin changed."""
	parts = [(match.start(), match.end()) for match in _xmlParts.finditer(data)]
	places = [match.span(1) for start, end in parts for match in _xmlValue.finditer(data, start, end)]
	for place, value in sorted({place % len(places): value for place, value in values}.items(), reverse=True):
		start, end = places[place]
		data = data[:start] + value.encode() + data[end:]
	return data


# Calls


def usualScene():
	"""Two jointed bricks on a wall, one step done."""
	material = BrickMat(young=1e7, mortar=Mortar(tensileStrength=1e4, cohesion=1e4, frictionAngle=.5, compressiveStrength=1e6))
	O.materials.append(material)
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
	O.bodies.append(build.straightJointWall(2, 1, material=material).bodies)
	setUsualEngines()
	MortarJoints()()
	O.step()


def tryCall(example):
	name, given = example['call']
	given = dict(given)
	picturePath = os.path.join(folder, 'call.png')
	if name in ('brick', 'straightJointWall', 'englishBondWall'):
		if given.get('material') == 'good' or 'material' not in given: given['material'] = BrickMat()
		if isinstance(given.get('corners'), list): given['corners'] = vectors(given['corners'])
		if isinstance(given.get('orientation'), list) and len(given['orientation']) == 4 and all(isinstance(v, (int,
		        float)) for v in given['orientation']): given['orientation'] = Quaternion(*given['orientation'])
		if name == 'brick': given = {'size': None if 'corners' in given else (.2, .2, .2), **given}
		made = attempt(getattr(build, name), **given)
		if refused(made): return 'refused'
		for body in [made] if name == 'brick' else made.bodies:
			mustBeFinite('made brick', [body.state.pos, body.state.mass, body.state.inertia, body.shape.color])
		return 'finite'
	if name == 'Motion':
		made = attempt(Motion, **given)
		return 'refused' if refused(made) else checkMotion(made)
	if name == 'syntheticNearFault':
		made = attempt(syntheticNearFault, **given)
		return 'refused' if refused(made) else checkMotion(made)
	if name in ('resampled', 'scaled'):
		made = attempt(getattr(Motion(.01, [[0, 0, 0], [1, 0, 0], [0, 0, 0]], 'm'), name), **given)
		return 'refused' if refused(made) else checkMotion(made)
	if name == 'GroundMotion':
		given['acceleration'] = vectors(given.get('acceleration'))
		made = attempt(GroundMotion, **{key: value for key, value in given.items() if value is not None})
		return 'refused' if refused(made) else 'finite'
	if name == 'DeformationOnDemand': return 'refused' if refused(attempt(DeformationOnDemand, **given)) else 'finite'
	if name == 'judgedRow':
		made = attempt(report.judgedRow, **given)
		return 'refused' if refused(made) else 'finite'
	if name == 'historyPlot':
		made = attempt(historyPlot, picturePath, **{'time': [0., 1.], 'histories': {'A': [[0, 0, 0], [1, 1, 1]]}, **given}, width=4, dpi=40)
		return 'refused' if refused(made) else 'finite'
	usualScene()
	call = {
	        'engines': lambda: (useLoop(given), steps(3), mustBeFinite('places', [b.state.pos for b in bricks()])), 'effects': lambda: str(effects(**given)),
	        'frequencies': lambda: mustBeFinite('frequencies', assembled().frequencies(**given)),
	        'solve': lambda: mustBeFinite('solve', assembled().solve(**given)), 'place': lambda: assembled().place(**given),
	        'runWithProgress': lambda: runWithProgress(**limited(given), stream=open(os.devnull, 'w')), 'isAtRest': lambda: isAtRest(**given),
	        'patches': lambda: patches(O.bodies, **given),
	        'wallPicture': lambda: wallPicture(picturePath, **{'bricks': patches(O.bodies), 'width': 3, 'dpi': 40, **given})
	}[name]
	return 'refused' if refused(attempt(call)) else 'finite'


def limited(given):
	"""Times of a run cut to what a thousand steps do."""
	for name in ('duration', 'until'):
		value = given.get(name)
		if isinstance(value, (int, float)) and math.isfinite(value): given[name] = min(value, (O.time if name == 'until' else 0) + 1000 * O.dt)
	if 'every' in given and given['every'] is not None: given['callback'] = lambda: None
	if isinstance(given.get('every'), (int, float)) and given['every'] > 0: given['every'] = max(given['every'], O.dt)
	return given


kinds = {'shape': tryShape, 'material': tryMaterial, 'scene': tryScene, 'file': tryFile, 'saved': trySaved, 'call': tryCall}


def tried(example):
	"""'refused' or 'finite', or what was found."""
	O.reset()
	O.timingEnabled = False
	try:
		return {'outcome': kinds[example['kind']](example)}
	except Finding as finding:
		return {'finding': str(finding)}
	except Exception as error:
		frames = traceback.extract_tb(error.__traceback__)
		return {'finding': '%s: %s in the fuzzer itself, line %s' % (type(error).__name__, error, [frame.lineno for frame in frames])}


if __name__ == '__main__':
	np.seterr(all='ignore')
	os.chdir(folder)  # where runs that are stopped leave their scenes
	with open(int(sys.argv[1])) as examples, open(int(sys.argv[2]), 'w') as answers:
		for line in examples:
			answers.write(json.dumps(tried(json.loads(line))) + '\n')
			answers.flush()
	os._exit(0)
