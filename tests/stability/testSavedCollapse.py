# SPDX-License-Identifier: GPL-2.0-or-later
# A collapse with everything in it, saved twice on the way in every format and continued by programs of one and of two threads.
#
# In it: bricks of all levels and elements, tapered ones, two mortars, joints to a fixed brick and to a box, staggered bond, partial failure, contact with
# shear that is remembered, damping of modes, ground motion, strides of the collider.
# Criterion: every number of the state is the same in every bit. A collapse multiplies a difference of the last bit until bricks lie elsewhere.
#
# As a program:  build/yade -n -x -j2 tests/stability/testSavedCollapse.py steps [file...]   prints a fingerprint of the state after so many steps, from the
# beginning without files, otherwise from each file.
import os, re, sys, tempfile, unittest

here = os.path.dirname(os.path.abspath(sys.argv[0] if __name__ == '__main__' else __file__))  # YADE gives a script no __file__ of its own
sys.path[:0] = [here, os.path.join(here, '..', 'yade')]
from hardCase import *
from yade.wrapper import Bo1_Box_Aabb
import collapse
from buildYade import run

GROUP = 'Saved and loaded in mid-collapse, threads'
FORMATS = ('xml', 'xml.gz', 'xml.bz2', 'yade', 'yade.gz', 'yade.bz2')
KINDS = (
        dict(deformation='rigid'), dict(deformation='trilinear', element='incompatible'), dict(deformation='uniform', inner='full'),
        dict(deformation='refined', cells=3, segments=6), dict(deformation='trilinear', element='bbar', segments=3),
        dict(deformation='refined', element='incompatible')
)
FIRST, SECOND, LAST = 500, 2000, 3000  # steps after which it is saved, and its end
BITS = 'bit by bit'


def tapered(size, top):
	"""Corners of a brick that narrows upwards."""
	x, y, z = (s / 2 for s in size)
	return [(sx * x * (top if sz > 0 else 1), sy * y, sz * z) for sz in (-1, 1) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def build():
	O.reset()
	weak = material(dampingRatio=.02)
	strong = material(young=3e7, poisson=.2, density=2000, frictionAngle=.6)
	O.bodies.append(utils.wall(-.1, axis=2, sense=1, material=weak))
	add((.3, .25, .1), center=(.15, 0, -.05), material=strong, deformation='trilinear', fixed=True, contactThickness=.004)
	O.bodies.append(utils.box(center=(.45, 0, -.05), extents=(.15, .125, .05), material=weak, fixed=True))
	for k in range(5):
		for i in range(4 if k % 2 else 3):
			size = (.2 if k % 2 == 0 or i in (1, 2) else .1, .2, .1)
			x = .1 + .2 * i if k % 2 == 0 else (.05, .2, .4, .55)[i]
			kind, m = KINDS[(2 * k + i) % len(KINDS)], strong if (i + k) % 3 else weak
			add(size, center=(x, 0, .1 * k + .05), material=m, contactThickness=.004, **kind)
	for i in range(3):
		add(corners=tapered((.18, .16, .12), .7), center=(.1 + .2 * i, 0, .56), material=weak, contactThickness=.004, **KINDS[i + 1])
	shaking = [Vector3(8, 14, 2) * s for s in (0, 1, 1, -1, -1, 1, 1, -1, 0)]
	O.engines = [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb(), Bo1_Box_Aabb()], verletDist=.01),
	        InteractionLoop(
	                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom(), Ig2_Box_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()],
	                [Law2_BrickGeom_BrickPhys_Mortar()]
	        ),
	        BrickTimeStepper(),
	        BrickDynamics(damping=.01),
	        GroundMotion(dt=.08, acceleration=shaking),
	        NewtonIntegrator(gravity=(0, 0, -GRAVITY), damping=.01),
	]
	# beds hold better than heads
	for normal, share in (((0, 0, 1), 1.), ((0, 0, 0), .5)):
		mortar = Mortar(tensileStrength=4e3 * share, cohesion=3e3 * share, frictionAngle=.5, compressiveStrength=1e6)
		MortarJoints(mortar=mortar, normal=normal)()


class SavedCollapse(Case):

	def elsewhere(self, threads, steps, *files):
		"""Fingerprints that a program of its own prints."""
		process = run('-n', '-x', '-j%d' % threads, os.path.abspath(__file__), str(steps), *files, timeout=600)
		self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
		self.assertEqual(re.findall(r'^threads (\d+)$', process.stdout, re.M), [str(threads)])
		return re.findall(r'^fingerprint (\w+)$', process.stdout, re.M)

	def test_collapse(self):
		"""Runs the collapse here, saves it while joints crack and while bricks fall, and has other programs go on."""
		with tempfile.TemporaryDirectory() as folder:
			build()
			files, counts = {}, []
			for steps in (FIRST, SECOND):
				O.run(steps - O.iter, True)
				files[steps] = [os.path.join(folder, '%d.%s' % (steps, end)) for end in FORMATS]
				for path in files[steps]:
					O.save(path)
				real = [i for i in O.interactions if i.isReal]
				states = [set(i.phys.segmentState) for i in real if i.phys.jointed]
				counts.append((sum(collapse.failures()[:3]), len(states), sum(len(s) > 1 for s in states), sum(not i.phys.jointed for i in real)))
			O.run(LAST - O.iter, True)
			expected = collapse.fingerprint()
			cracked, joints, partly, contacts = counts[0]
			self.assertTrue(cracked and joints and partly and contacts, 'first file: joints whole, failed in part, and contact, not %s' % counts)
			self.assertTrue(counts[1][0] > cracked and counts[1][3] > 5, 'second file: more failures and contacts, not %s' % counts)
			self.assertGreater(sum(collapse.failures()[:3]), cracked)
			self.judge('two threads, the whole collapse: fingerprints that differ', self.elsewhere(2, LAST) != [expected], 0, 0, BITS)
			for threads in (1, 2):
				for steps in (FIRST, SECOND):
					# every format by both programs, half of them early and half of them late, and the other way round
					chosen = files[steps][(threads + (steps == FIRST)) % 2::2]
					got = self.elsewhere(threads, LAST - steps, *chosen)
					self.assertEqual(len(got), len(chosen))
					name = '%d threads, saved after %d steps, %d formats: fingerprints that differ' % (threads, steps, len(chosen))
					self.judge(name, sum(g != expected for g in got), 0, 0, BITS)


if __name__ == '__main__':
	print('threads', O.numThreads)
	for path in sys.argv[2:] or [None]:
		if path is None: build()
		else:
			O.reset()
			O.load(path)
		O.run(int(sys.argv[1]), True)
		print('fingerprint', collapse.fingerprint())
