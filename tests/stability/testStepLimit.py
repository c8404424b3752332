# SPDX-License-Identifier: GPL-2.0-or-later
# Case 10: time steps on both sides of the limit. Leap-frog is stable up to 2 / omega, the largest frequency of the springs on the bricks' masses (dense
# eigenvalues of the product's own matrices), and swings up beyond, by exp(2 acosh(1.05)) = 1.87 a step at 1.05 of it.
# Criterion: at 0.95 of it the ledger of energy closes and the guard keeps silent; at 1.05 the guard stops the run before the energy has grown a
# thousandfold, names the step and saves the scene; BrickTimeStepper's bound is safe and within 2 of the truth. A step set by hand above the bound is
# warned of, once. Dashpots shorten the limit: at the bound energy only falls.
import contextlib, re, tempfile, unittest

from hardCase import *
from testTimeStepLimits import Structure
from yade_brick import englishBondWall, straightJointWall

GROUP = '10 Time step at 0.95 and 1.05 of the limit'
SIDE, SPEED = .2, 1e-4
WALLS = {'straight': straightJointWall, 'English': englishBondWall}


@contextlib.contextmanager
def standardError(lines):
	"""Collects what the process writes there, from C++ too."""
	with tempfile.TemporaryFile('w+') as file:
		sys.stderr.flush()
		kept = os.dup(2)
		os.dup2(file.fileno(), 2)
		try:
			yield
		finally:
			sys.stderr.flush()
			os.dup2(kept, 2)
			os.close(kept)
			file.seek(0)
			lines += file.read().splitlines()


class StepLimit(Case):

	def wall(self, bond, level, dashpots=0):
		"""A wall without gravity in which every brick has another velocity; returns the true limit of the step [s]."""
		O.reset()
		m = material(mortar=Mortar(**UNBREAKABLE), hn=dashpots, hs=dashpots)
		ground(m)
		options = {} if level == 'rigid' else dict(contactThickness=.005)
		O.bodies.append(WALLS[bond](3, 3, (SIDE, SIDE, SIDE), material=m, deformation=level, **options).bodies)
		engines(gravity=(0, 0, 0))
		MortarJoints()()
		O.step()
		self.bound = limit()
		true = Structure().schemeStep()
		for k, b in enumerate(bricks()):
			b.state.vel = SPEED * Vector3(1, .7, -1) * (-1)**k
		O.trackEnergy = True
		return true

	def check(self, bond, level):
		name = '%s, %s: ' % (bond, level)
		true = self.wall(bond, level)
		self.atMost(name + 'bound over true limit', self.bound / true, 1 + 1e-9, 'a bound; a wall of equal bricks can reach it')
		self.atMost(name + 'true limit over bound', true / self.bound, 2, 'tight')
		stepByHand(.95 * true)
		O.step()
		start = O.energy.total()
		for _ in range(3000):
			O.step()
		self.judge(name + 'energy after 3000 steps at 0.95', O.energy.total(), start, 1e-4, 'rotations are small: axes turn by 1e-5')

		true = self.wall(bond, level)
		start = utils.kineticEnergy()
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		saved = engine(BrickDynamics).stopFile = os.path.join(folder.name, 'stopped.yade.gz')
		stepByHand(1.05 * true)
		first = O.iter
		with self.assertRaisesRegex(RuntimeError, r'energy from nothing: .* J of work .* Likely cause: O\.dt = .* s is above .*; the scene was saved as'):
			while O.iter < first + 3000:
				O.step()
		grown = utils.kineticEnergy() / start
		self.atMost(name + 'energy at the stop, over that at the start', grown, 1e3, 'ten times of what there is has to come from nothing first; one step multiplies by 3.5 at most, and the alarm rings a step late')
		self.atMost(name + 'steps to the stop', O.iter - first, 60, 'round-off of the energy, 1e-16, grows to all of it in 30 steps')
		stopped, velocity = O.iter, bricks()[0].state.vel
		O.load(saved)
		self.judge(name + 'saved scene: step', O.iter, stopped, 0, 'the step that was not made')
		self.judge(name + 'saved scene: change of a velocity', (bricks()[0].state.vel - velocity).norm(), 0, 0, 'bitwise')

	def test_straight_rigid(self):
		self.check('straight', 'rigid')

	def test_straight_trilinear(self):
		self.check('straight', 'trilinear')

	def test_english_rigid(self):
		self.check('English', 'rigid')

	def test_english_uniform(self):
		self.check('English', 'uniform')

	def test_cracked_wall_with_dashpots(self):
		"""All joints are contact with friction and strong dashpots, at the whole bound: energy must fall."""
		for level in ('rigid', 'trilinear'):
			O.reset()
			m = material(hn=1, hs=1)
			ground(m)
			O.bodies.append(straightJointWall(3, 3, (SIDE, SIDE, SIDE), material=m, deformation=level, contactThickness=.005).bodies)
			engines(safety=1)
			O.trackEnergy = True
			steps(200)
			energy, highest = [], 0
			for _ in range(3000):
				O.step()
				parts = dict(O.energy.items())
				energy.append(sum(parts[k] for k in ('kinetic', 'deformKinetic', 'deformElastic', 'elastPotential', 'gravWork')))
			lowest = energy[0]
			for e in energy:
				lowest, highest = min(lowest, e), max(highest, e - lowest)
			self.atMost(level + ': highest rise of energy over the lowest before [J]', highest, 1e-3 * (energy[0] - energy[-1]), 'a thousandth of what was lost')

	def test_warning(self):
		"""Once for each step set by hand above the bound, with numbers; none below it or while BrickTimeStepper sets it."""
		lines = []
		with standardError(lines):
			self.wall('straight', 'rigid')
			for dt in (.9 * self.bound, 1.01 * self.bound):
				stepByHand(dt)
				steps(1200)
		warnings = [line for line in lines if 'WARNING' in line]
		self.judge('warnings', len(warnings), 1, 0, 'one of two steps is above the bound')
		found = re.search(r'O\.dt = (\S+) s is above (\S+) s, .*brick #(\d+), springs on its face ([+-][xyz])', warnings[0])
		self.assertTrue(found, warnings[0])
		self.judge('step that it names [s]', float(found[1]), O.dt, 1e-4, 'printed digits')
		self.judge('bound that it names [s]', float(found[2]), self.bound, 1e-4, 'printed digits')
