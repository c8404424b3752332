# SPDX-License-Identifier: GPL-2.0-or-later
# Reads the memory of live YADE objects and compares it with the layout that yade-abi/ declares.
# Run by:  build/yade -n -x tests/yade/layoutCheck.py   (exit status 1 if anything differs)
#
# Values are written by YADE's own code (attributes set from Python) and looked up at the declared offset. The offsets are those
# that the headers assert at compile time.
import ctypes, itertools, struct, sys
from yade import wrapper

right, wrong = 0, []
numbers = itertools.count(1001)


def address(o):
	"""Of the C++ object, as YADE prints it."""
	return int(str(o).split(' at ')[1].rstrip('>'), 16)


def read(at, code):
	return struct.unpack(code, ctypes.string_at(at, struct.calcsize(code)))


def expect(what, found, wanted):
	global right
	if found == wanted: right += 1
	else: wrong.append('%s: found %s, expected %s' % (what, found, wanted))


def real():
	return next(numbers) + .5


# kind: (a new value, how it reads in memory, what is expected there)
KINDS = {
        'real': (real, 'd', lambda v: (v, )),
        'int': (lambda: next(numbers), 'i', lambda v: (v, )),
        'unsigned': (lambda: next(numbers), 'I', lambda v: (v, )),
        'long': (lambda: next(numbers), 'q', lambda v: (v, )),
        'vector': (lambda: Vector3(real(), real(), real()), '3d', tuple),
        'ints': (lambda: Vector3i(next(numbers), next(numbers), next(numbers)), '3i', tuple),
        'quaternion': (lambda: Quaternion(Vector3(0, 0, 1), .001 * next(numbers)), '4d', lambda v: tuple(v[k] for k in range(4))),
        'matrix': (lambda: Matrix3(*[real() for _ in range(9)]), '9d', lambda v: tuple(v[r, c] for c in range(3) for r in range(3))),
}


def readString(at):
	start, size = read(at, 'QQ')
	return ctypes.string_at(start, size).decode()


def probe(o, **members):
	"""members: name = (offset, kind); kind is one of KINDS, 'bool', 'string', or the name of the class pointed to."""
	for name, (offset, kind) in members.items():
		at, what = address(o) + offset, '%s.%s' % (type(o).__name__, name)
		if kind == 'bool':
			for v in (True, False):
				o.updateAttrs({name: v})
				expect(what, read(at, 'B')[0], int(v))
		elif kind == 'string':
			v = 'text %d, longer than what fits in place' % next(numbers)
			o.updateAttrs({name: v})
			expect(what, readString(at), v)
		elif kind in KINDS:
			new, code, wanted = KINDS[kind]
			v = new()
			o.updateAttrs({name: v})
			expect(what, read(at, code), wanted(v))
		else:
			v = getattr(wrapper, kind)()
			setattr(o, name, v)
			expect(what, read(at, 'Q')[0], address(v))


# Single objects
probe(Sphere(), color=(64, 'vector'), wire=(88, 'bool'), highlight=(89, 'bool'), radius=(96, 'real'))
probe(Box(), extents=(96, 'vector'))
probe(Wall(), sense=(92, 'int'), axis=(96, 'int'))
probe(FrictMat(), id=(32, 'int'), label=(40, 'string'), density=(72, 'real'), young=(80, 'real'), poisson=(88, 'real'), frictionAngle=(96, 'real'))
probe(
        State(),
        vel=(144, 'vector'),
        mass=(168, 'real'),
        angVel=(176, 'vector'),
        angMom=(200, 'vector'),
        inertia=(224, 'vector'),
        refPos=(248, 'vector'),
        refOri=(272, 'quaternion'),
        blockedDOFs=(304, 'unsigned'),
        isDamped=(308, 'bool'),
        densityScaling=(312, 'real')
)
s = State()
expect('State.pos, ori', read(address(s) + 32, 'QQ'), (address(s) + 88, address(s) + 112))
probe(
        Aabb(),
        lastUpdateIter=(32, 'int'),
        refPos=(40, 'vector'),
        sweepLength=(64, 'real'),
        color=(72, 'vector'),
        min=(96, 'vector'),
        max=(120, 'vector')
)
probe(
        FrictPhys(),
        kn=(32, 'real'),
        normalForce=(40, 'vector'),
        ks=(64, 'real'),
        shearForce=(72, 'vector'),
        tangensOfFrictionAngle=(96, 'real')
)
probe(ScGeom(), normal=(32, 'vector'), contactPoint=(56, 'vector'), refR1=(80, 'real'), refR2=(88, 'real'))
probe(
        Body(),
        id=(24, 'int'),
        groupMask=(28, 'int'),
        flags=(32, 'int'),
        subdomain=(36, 'int'),
        material=(40, 'FrictMat'),
        state=(56, 'State'),
        shape=(72, 'Sphere'),
        bound=(88, 'Aabb'),
        clumpId=(152, 'int'),
        iterBorn=(160, 'long'),
        timeBorn=(168, 'real')
)
probe(
        wrapper.Interaction(),
        id1=(88, 'int'),
        id2=(92, 'int'),
        iterMadeReal=(96, 'long'),
        iterLastSeen=(104, 'long'),
        geom=(112, 'ScGeom'),
        phys=(128, 'FrictPhys'),
        cellDist=(144, 'ints'),
        linIx=(156, 'int'),
        iterBorn=(160, 'long')
)
probe(Ip2_FrictMat_FrictMat_FrictPhys(), label=(48, 'string'))
for functor in (Gl1_Sphere(), Gl1_NormPhys(), Gl1_Brick(), Gl1_BrickGeom(), Gl1_BrickPhys()): probe(functor, label=(48, 'string'))
probe(ForceResetter(), dead=(64, 'bool'), ompThreads=(68, 'int'), label=(72, 'string'))
probe(GlobalStiffnessTimeStepper(), active=(104, 'bool'), timeStepUpdateInterval=(108, 'unsigned'))
e = TranslationEngine(ids=[5, 6, 7])
first, last = read(address(e) + 104, 'QQ')
expect('PartialEngine.ids', read(first, '%di' % ((last - first) // 4)), (5, 6, 7))

# Scene and containers, running
O.bodies.append([utils.sphere((0, 0, 0), 1), utils.sphere((1.5, 0, 0), 1)])
O.trackEnergy = True
O.energy['probe'] = 3.25
O.dt = 1e-6
O.step()
scene = address(O._sceneObj)
for name, offset, code in (('dt', 440, 'd'), ('iter', 448, 'q'), ('subStep', 460, 'i'), ('time', 464, 'd'), ('stopAtIter', 480, 'q'), ('stopAtTime', 488, 'd'),
                           ('selectedBody', 500, 'i'), ('subdomain', 504, 'i'), ('doSort', 498, '?')):
	expect('Scene.' + name, read(scene + offset, code)[0], getattr(O._sceneObj, name))
expect('Scene.isPeriodic, trackEnergy', read(scene + 496, 'BB'), (0, 1))
begin, end = read(scene + 552, 'QQ')
expect('Scene.engines', [read(begin + 16 * i, 'Q')[0] for i in range((end - begin) // 16)], [address(e) for e in O.engines])
expect('Engine.scene', read(address(O.engines[0]) + 24, 'Q')[0], scene)
bodies, interactions, energy = (read(scene + k, 'Q')[0] for k in (600, 616, 632))
expect('Scene.energy', energy, address(O.energy))
expect('BodyContainer.body', read(read(bodies + 24, 'Q')[0] + 16, 'Q')[0], address(O.bodies[1]))
i = O.interactions[0, 1]
expect('InteractionContainer.linIntrs', read(read(interactions + 24, 'Q')[0], 'Q')[0], address(i))
expect('InteractionContainer.bodies, currSize', read(interactions + 72, 'QQ'), (bodies + 24, 1))
expect('Body.intrs', read(address(O.bodies[0]) + 104 + 40, 'Q')[0], 1)
loop = [e for e in O.engines if type(e) is InteractionLoop][0]
cache = read(address(i) + 32, 'B7xQQQQQQ')
functors = [d.functors[0] for d in (loop.geomDispatcher, loop.physDispatcher, loop.lawDispatcher)]
expect('Interaction.functorCache', (cache[0], cache[1], cache[3], cache[5]), (1, ) + tuple(address(f) for f in functors))
expect('Functor.scene', read(address(functors[2]) + 40, 'Q')[0], scene)
forces = scene + 32
expect('ForceContainer: threads, synced', read(forces + 204, 'i') + read(forces + 280, 'B'), (O.numThreads, 1))
expect('ForceContainer: summed forces', read(read(forces + 96, 'Q')[0] + 24, '3d'), tuple(O.forces.f(1)))
expect('EnergyTracker.energies', read(energy + 24 + 8, 'Q') + read(energy + 24 + 48, 'Q'), (O.numThreads, len(O.energy.keys())))
expect('EnergyTracker.names', read(energy + 88 + 40, 'Q')[0], len(O.energy.keys()))
slots = read(energy + 24 + 24, 'Q')[0]
expect('EnergyTracker: value', 3.25 in read(read(slots, 'Q')[0], '%dd' % len(O.energy.keys())), True)

O.reset()
O.periodic = True
O.cell.hSize = Matrix3(2, .1, 0, 0, 3, .2, .3, 0, 4)
cell = read(address(O._sceneObj) + 688, 'Q')[0]
for name, offset in (('trsf', 592), ('hSize', 736), ('shearTrsf', 320), ('unshearTrsf', 392)):
	expect('Cell.' + name, read(cell + offset, '9d'), KINDS['matrix'][2](getattr(O.cell, name)))
expect('Cell._size', read(cell + 240, '3d'), tuple(O.cell.size))
expect('Cell._hasShear', read(cell + 312, 'B')[0], 1)

print('layout: %d right, %d wrong' % (right, len(wrong)))
print('\n'.join(wrong))
sys.exit(1 if wrong else 0)
