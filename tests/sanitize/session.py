# SPDX-License-Identifier: GPL-2.0-or-later
# A short life of small scenes, to be run where every access to memory is watched (scripts/sanitize.sh):
#   build/yade -n -x -j1 tests/sanitize/session.py scale        scale 1 for the whole of it; less for the slowest tools
#
# A wall with bricks of all deformation levels: equilibrium, matrices, ground motion, mortar that cracks and fails, saving and loading; then bricks
# that fall on a box, on a wall and on each other. Ends with the fingerprint of both, which is the same for every build of the same code.
import os, sys, tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(sys.argv[0]))), 'yade'))
import collapse
import yade_brick
from yade import O, Quaternion, Vector3, utils, wrapper

scale = float(sys.argv[1])


def run(steps):
	O.run(max(1, round(steps * scale)), True)
	contacts = sum(1 for i in O.interactions if i.isReal and not i.phys.jointed)
	print('step %d: failures %s, joints %d, contacts %d' % (O.iter, collapse.failures(), collapse.jointCount(), contacts), flush=True)


def wall():
	collapse.build(2, 2, verletDist=.01)
	wrapper.StaticEquilibrium()()
	structure = wrapper.IntactAssembly()
	structure.gather()
	structure.stiffnessEntries(), structure.massEntries()
	with yade_brick.Bill() as bill:
		run(10)
	bill.table()
	joints = yade_brick.JointRecord()
	run(500)
	joints.update(), joints.marks(), yade_brick.restState()
	try:
		structure.gather()
	except ValueError as refusal:
		print('refused:', refusal)
	else:
		raise AssertionError('joints that have cracked were taken as whole')
	for end in ('xml.gz', 'yade'):
		path = os.path.join(folder, 'scene.' + end)
		O.save(path)
		O.reset()
		O.load(path)
		run(200)
	yade_brick.patches(O.bodies)
	run(4000)


def heap():
	O.reset()
	material = yade_brick.BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.5, dampingRatio=.02)
	O.bodies.append(utils.wall(-.3, axis=0, sense=1, material=wrapper.FrictMat()))
	O.bodies.append(utils.box((0, 0, -.1), (.5, .5, .1), fixed=True, material=wrapper.FrictMat()))
	for i, level in enumerate(collapse.LEVELS):
		b = yade_brick.brick((.2, .15, .1), center=(.03 * i, .02 * i, .09 + .14 * i), orientation=Quaternion(Vector3(1, 2, i), .2 * i), material=material,
			deformation=level, contactThickness=.005, segments=6)
		b.state.vel = (-2, 0, -2)
		O.bodies.append(b)
	O.engines = [
	        wrapper.ForceResetter(),
	        wrapper.InsertionSortCollider([wrapper.Bo1_Brick_Aabb(), wrapper.Bo1_Wall_Aabb(), wrapper.Bo1_Box_Aabb()], verletDist=.01),
	        wrapper.InteractionLoop(
	                [wrapper.Ig2_Brick_Brick_BrickGeom(), wrapper.Ig2_Wall_Brick_BrickGeom(), wrapper.Ig2_Box_Brick_BrickGeom()],
	                [wrapper.Ip2_BrickMat_BrickMat_BrickPhys(), wrapper.Ip2_FrictMat_BrickMat_BrickPhys()], [wrapper.Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        wrapper.BrickTimeStepper(),
	        wrapper.BrickDynamics(damping=.1),
	        wrapper.NewtonIntegrator(damping=.1, gravity=(0, 0, -9.8)),
	]
	for _ in range(4):
		run(1000)
		O.bodies[5].shape.elasticEnergy(), yade_brick.restState()


with tempfile.TemporaryDirectory() as folder:
	wall()
	print('fingerprint', collapse.fingerprint())
	heap()
	print('fingerprint', collapse.fingerprint())
	O.reset()
