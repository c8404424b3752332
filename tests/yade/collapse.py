# SPDX-License-Identifier: GPL-2.0-or-later
# A wall that collapses, and the fingerprint of a run, for the tests that ask whether two runs are the same to the last bit.
# As a script it runs the wall and prints the fingerprint:  build/yade -n -x -j2 tests/yade/collapse.py steps verletDist columns courses
# and, if wanted, onDemand, and what its law leaves out: failure friction dashpots
#
# Bricks of all deformation levels stand on a Wall, in weak mortar, under a pulse in and out of the plane that cracks and throws them.
import hashlib, struct, sys

from yade import O, utils
from yade.wrapper import ForceResetter, InsertionSortCollider, InteractionLoop, Bo1_Wall_Aabb, NewtonIntegrator, Body
from yade_brick import *
from yade.minieigenHP import Vector3

SIDE = .2  # of the cubes [m]
DENSITY = 1800.
LEVELS = ('rigid', 'uniform', 'trilinear', 'refined')


def cube(centre, material, level):
	"""Body: a cube of SIDE with its centre of gravity at `centre` [m]."""
	solid = Brick.solidProperties([Vector3(x, y, z) * (SIDE / 2) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
	b = Body()
	b.shape = Brick(corners=solid['corners'], deformation=level, contactThickness=.005)
	b.material = material
	b.state.pos = b.state.refPos = centre
	b.state.mass = DENSITY * solid['volume']
	b.state.inertia = DENSITY * solid['inertia']
	b.aspherical = True
	return b


def build(columns=4, courses=4, verletDist=0., onDemand=False):
	"""The wall at rest, nothing run yet; verletDist [m] as the collider's. onDemand: rigid bricks and trilinear ones change into each other, often."""
	O.reset()
	mortar = Mortar(tensileStrength=2e3, cohesion=2e3, frictionAngle=.5, compressiveStrength=5e5)
	O.materials.append(BrickMat(young=9.8e6, poisson=.25, density=DENSITY, frictionAngle=.5, mortar=mortar, dampingRatio=.02))
	material = O.materials[0]
	O.bodies.append(utils.wall(0, axis=2, sense=1, material=material))
	for k in range(courses):
		for i in range(columns):
			O.bodies.append(cube(Vector3(SIDE * (i + .5), 0, SIDE * (k + .5)), material, LEVELS[(i + 2 * k) % len(LEVELS)]))
	pulse = [Vector3(6, 12, 1) * s for s in (0, 1, 1, -1, -1, 1, 0)]
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=verletDist),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(),
	        *([DeformationOnDemand(utilisation=.3, stress=5e3, interval=5, patience=.02)] if onDemand else []),
	        BrickDynamics(),
	        GroundMotion(dt=.1, acceleration=pulse),
	        NewtonIntegrator(gravity=(0, 0, -9.8), damping=0),
	]
	MortarJoints()()


def law():
	"""The functor that counts failures."""
	loop, = [e for e in O.engines if isinstance(e, InteractionLoop)]
	return loop.lawDispatcher.functors[0]


def failures():
	return [law().tensionFailures, law().shearFailures, law().compressionFailures, law().crushedContacts]


def jointCount():
	return sum(1 for i in O.interactions if i.phys.jointed)


def _numbers(value):
	return [float(value)] if isinstance(value, (int, float)) else [x for item in value for x in _numbers(item)]


def state():
	"""The state of the scene as a dict from names to lists of floats. Interactions are sorted by ids, since their order means nothing."""
	out = {'scene': [O.iter, O.time, O.dt], 'failures': failures()}
	for b in O.bodies:
		s = b.state
		out['body %d' % b.id] = _numbers([s.pos, [s.ori[k] for k in range(4)], s.vel, s.angVel, s.angMom])
		if isinstance(b.shape, Brick):
			out['brick %d' % b.id] = _numbers([b.shape.amplitudes, b.shape.rates, b.shape.displacement, b.shape.displacementRate])
	for i in sorted(O.interactions, key=lambda i: sorted((i.id1, i.id2))):
		if not i.isReal: continue
		g, p = i.geom, i.phys
		sign = 1 if i.id1 < i.id2 else -1
		values = [p.jointed, p.segmentState, p.segmentArea, p.normalStress(g), p.shearStress(g), sign * p.normalForce, sign * p.shearForce, p.kn, p.ks, p.deepest]
		out['interaction %d-%d' % tuple(sorted((i.id1, i.id2)))] = _numbers(values + [g.penetration, g.area, g.spotCount, g.contactPoint])
	return out


def fingerprint():
	"""One text for every bit of state()."""
	digest = hashlib.sha256()
	for name, values in state().items():
		digest.update(name.encode() + struct.pack('%dd' % len(values), *values))
	return digest.hexdigest()


if __name__ == '__main__':
	steps, verletDist, columns, courses = int(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
	build(columns, courses, verletDist, onDemand='onDemand' in sys.argv)
	for term in sys.argv[5:]:
		if term != 'onDemand': setattr(law(), term, False)
	O.run(steps, True)
	print('threads', O.numThreads)
	print('failures', sum(failures()))
	print('fingerprint', fingerprint())
