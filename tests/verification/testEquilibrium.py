# SPDX-License-Identifier: GPL-2.0-or-later
# The direct static solution against the engine loop: the same state, kept without motion; against the linear solution; what it refuses.
import unittest

import numpy as np

from cases import *
from refined import corners
from yade_brick.assembly import assembled

GROUP = 'Statics and rest'
SIDE = .2
PAPER = dict(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=FRICTION, compressiveStrength=4.9e5)
MODELS = {
        'rigid': dict(deformation='rigid'), 'paper': {}, 'incompatible, inner full, r=5 mm': dict(element='incompatible', inner='full', contactThickness=5e-3)
}
WALLS = {'straight': straightJointWall, 'english': englishBondWall}


def wall(bond, columns=3, courses=3, strength=PAPER, damping=0, **options):
	"""A jointed wall on the ground in a new scene, with the engines; its bodies."""
	O.reset()
	mortared = material(mortar=Mortar(**strength))
	ground(mortared)
	bodies = WALLS[bond](columns, courses, (SIDE, SIDE, SIDE), material=mortared, **options).bodies
	O.bodies.append(bodies)
	MortarJoints()()
	engines(damping=damping)
	return bodies


def places(bodies):
	return np.array([corners(b) for b in bodies])


class DirectSolution(Case):

	def test_loop_keeps_the_state(self):
		"""Walls of 3 x 3 bricks with the paper's mortar, both bonds, rigid and deformable. After StaticEquilibrium they stand in the undamped
		engine loop for 2000 steps: corners must not move but for round-off, nothing cracks. In the straight-joint wall deformed bricks also touch
		their diagonal neighbours across the edge, by some 1e-8 m, which is no joint and not part of the direct solution: it moves corners by 1e-10
		m, 1e-6 of their displacement."""
		for bond in WALLS:
			for name, options in MODELS.items():
				bodies, label = wall(bond, **options), '%s, %s: ' % (bond, name)
				rest = StaticEquilibrium()
				rest()
				before = places(bodies)
				O.step()
				self.atMost(label + 'unbalanced force in the first step', restState().imbalance, 1e-5, 'round-off of springs; contact across edges')
				drift = 0
				for _ in range(20):
					O.run(100, True)
					drift = max(drift, np.abs(places(bodies) - before).max())
				touching = bond == 'straight' and name != 'rigid'
				limit, reason = (1e-9, 'contact across the edges of diagonal neighbours') if touching else (1e-12, 'round-off: 1e-16 m a step and spring')
				self.atMost(label + 'largest displacement of a corner in 2000 steps [m]', drift, limit, reason)
				self.atMost(label + 'kinetic over elastic energy', restState().energyRatio, 1e-10 if touching else 1e-16, reason)
				law = engine(InteractionLoop).lawDispatcher.functors[0]
				failures = law.tensionFailures + law.shearFailures + law.compressionFailures
				self.judge(label + 'segments that fail', failures, rest.overloaded, 0, 'none is overloaded')

	def test_damped_loop_reaches_the_state(self):
		"""The same walls, but settled by the engine loop with local damping, from bricks that are not loaded yet: 3 s. The corners come to where
		StaticEquilibrium puts them at once."""
		for bond in WALLS:
			for name, options in MODELS.items():
				bodies, label = wall(bond, strength=UNBREAKABLE, **options), '%s, %s: ' % (bond, name)
				StaticEquilibrium()()
				direct = places(bodies)
				bodies = wall(bond, strength=UNBREAKABLE, damping=.4, **options)
				runFor(3)
				touching = bond == 'straight' and name != 'rigid'
				self.atMost(
				        label + 'largest difference of a corner [m]', np.abs(places(bodies) - direct).max(), 1e-9 if touching else 1e-12,
				        'settlement is 3e-4 m' + (', contact across the edges of diagonal neighbours' if touching else '; what is left is the approach to rest')
				)

	def test_linear_limit_and_energy(self):
		"""A wall of 3 x 3 deformable bricks, English bond, under a thousandth of gravity and a force on its uppermost corner brick:
		StaticEquilibrium, which is geometrically exact, against the linear solution of the assembled matrices. Elastic energy is half the work of
		the loads (Clapeyron). Under full gravity the difference is that of geometry."""
		for share, tolerance in ((1e-3, 1e-5), (1, 5e-3)):
			bodies = wall('english', strength=UNBREAKABLE, element='incompatible')
			assembly = assembled()
			loads = np.zeros(assembly.stiffness.shape[0])
			for b in bodies: loads[assembly.place(b.id) + 2] = -share * GRAVITY * b.state.mass
			force = share * 50
			loads[assembly.place(bodies[-1].id)] += force
			linear = assembly.solve(loads)
			O.forces.setPermF(bodies[-1].id, (force, 0, 0))
			rest = StaticEquilibrium(gravity=(0, 0, -share * GRAVITY))
			rest()
			label = '%g g: ' % share
			got = np.concatenate([list(b.state.displ()) for b in bodies])
			expected = np.concatenate([linear[assembly.place(b.id):][:3] for b in bodies])
			reason = 'strains of 1e-6, so that geometry matters by 1e-6' if share < 1 else 'strains of 1e-3: what geometry does'
			self.atMost(label + 'displacement, largest difference / largest', np.abs(got - expected).max() / np.abs(expected).max(), tolerance, reason)
			self.judge(label + 'elastic energy [J]', rest.elasticEnergy, loads @ linear / 2, tolerance, reason)
			O.step()
			self.judge(label + 'elastic energy, counted in the loop [J]', restState().elastic, rest.elasticEnergy, 1e-6, 'the same joints and bricks')

	def test_overloaded_segments_fail(self):
		"""The paper's English bond wall with contact parts of 0.1 mm locks under self weight (see Self weight of the walls): StaticEquilibrium
		counts the segments beyond the mortar's strength, eqs. (6) to (8). These are the ones whose tractions, read from the same state with
		unbreakable mortar, are beyond it, and those that fail in the first step."""
		options = dict(columns=6, courses=6, inner='full', contactThickness=1e-4)
		wall('english', strength=UNBREAKABLE, **options)
		StaticEquilibrium()()
		O.step()
		beyond = 0
		for i in O.interactions:
			if not i.phys.jointed: continue
			for normal, shear in zip(i.phys.normalStress(i.geom), i.phys.shearStress(i.geom)):
				tau = shear.norm()
				cap = normal < 0 and normal**2 + 9 * tau**2 > PAPER['compressiveStrength']**2
				beyond += normal > PAPER['tensileStrength'] or tau + normal * math.tan(FRICTION) > PAPER['cohesion'] or cap
		wall('english', **options)
		rest = StaticEquilibrium()
		rest()
		self.judge('segments overloaded', rest.overloaded, beyond, 0, 'counted from tractions')
		O.step()
		law = engine(InteractionLoop).lawDispatcher.functors[0]
		self.judge('segments that fail in the first step', law.tensionFailures + law.shearFailures + law.compressionFailures, beyond, 0, 'the same')


class Refused(Case):
	"""What has no static solution is refused with a word on why, and the scene stays as it was."""

	def refused(self, label, error, words):
		before = [(b.state.pos, b.state.ori) for b in O.bodies]
		try:
			StaticEquilibrium()()
			said = 'nothing'
		except error as refusal:
			said = str(refusal)
		self.judge(label + ': words in the error', sum(word in said for word in words), len(words), 0, 'the error says: ' + said)
		moved = sum((b.state.pos, b.state.ori) != was for b, was in zip(O.bodies, before))
		self.judge(label + ': bodies moved', moved, 0, 0, 'refused before anything moves')

	def test_brick_that_floats(self):
		"""A brick beside the wall, joined with nothing: named in the error."""
		wall('straight')
		b = add((SIDE, SIDE, SIDE), center=(2, 0, 1), material=O.materials[0])
		self.refused('floating brick', RuntimeError, ['#%d' % b.id, 'not held'])

	def test_joint_that_has_failed(self):
		"""A tower of three bricks that was bent until joints failed in part: an intact assembly is asked for."""
		bodies = wall('straight', columns=1, strength=dict(PAPER, tensileStrength=100))
		O.forces.setPermT(bodies[-1].id, (0, 8, 0))
		failed = lambda: [sum(state > 0 for state in i.phys.segmentState) for i in O.interactions if i.phys.jointed]
		while not any(failed()): O.step()
		self.refused('failed in part', ValueError, ['failed in part'])

	def test_bricks_without_mortar(self):
		"""A brick that lies on the wall without mortar: dry contact is not part of the direct solution."""
		wall('straight', strength=UNBREAKABLE, deformation='rigid')
		above = add((SIDE, SIDE, SIDE), center=(SIDE / 2, SIDE / 2, 3.5 * SIDE), material=O.materials[0], deformation='rigid')
		runFor(.3)
		self.refused('dry contact', ValueError, ['#%d' % above.id, 'without mortar'])
