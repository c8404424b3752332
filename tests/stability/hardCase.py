# SPDX-License-Identifier: GPL-2.0-or-later
# What the hard cases share, on top of the verification cases: conserved quantities of a scene, and supports that move or shut a scene in.
# GROUP of a module is the title of its case; its rows say what is measured and what is allowed.
import os, sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'verification'))
from cases import *
from yade_brick import rest


def bricks():
	return [b for b in O.bodies if isinstance(b.shape, Brick)]


def moving():
	"""Bodies that forces move."""
	return [b for b in O.bodies if b.dynamic and b.state.mass > 0]


def momentum():
	"""Linear momentum of what moves [kg m/s]."""
	return sum((b.state.mass * b.state.vel for b in moving()), Vector3.Zero)


def angularMomentum(about=Vector3.Zero):
	"""Of what moves, about a point of the world [kg m2/s]. Deformation carries none: its modes are free of it."""
	return sum((b.state.angMom + (b.state.pos - about).cross(b.state.mass * b.state.vel) for b in moving()), Vector3.Zero)


def stepByHand(dt):
	engine(BrickTimeStepper).active = False
	O.dt = dt


def limit():
	"""BrickTimeStepper's bound for the present scene [s], after at least one step."""
	return engine(BrickTimeStepper).limit


def mechanicalEnergy(gravity=GRAVITY):
	"""Kinetic energy (half a step before), energy of all springs and deformation, and that of the heights of what moves [J]; after at least one step."""
	kinetic, elastic = rest.energies([b.shape for b in bricks()])
	return kinetic + elastic + gravity * sum(b.state.mass * b.state.pos[2] for b in moving())


def steps(count):
	"""Few steps one by one: O.run looks only every 40 ms whether it has come to its end."""
	for _ in range(count):
		O.step()


class Energy:
	"""Mechanical energy to second order in the step: all of its parts at the same time, kinetic energy as the mean of the half steps before and after."""

	def __init__(self, gravity=GRAVITY):
		self.gravity, self.shapes = gravity, [b.shape for b in bricks()]

	def _parts(self):
		"""Kinetic, of rigid motion and deformation; of deformation; of the heights of what moves [J]."""
		kinetic = utils.kineticEnergy() + sum(s.kineticEnergy() for s in self.shapes)
		height = self.gravity * sum(b.state.mass * b.state.pos[2] for b in moving()) if self.gravity else 0
		return kinetic, sum(s.elasticEnergy() for s in self.shapes), height

	def step(self):
		"""Makes a step; energy at its beginning [J], with that of joints and contacts."""
		before, deformed, height = self._parts()
		O.step()
		springs = sum(i.phys.elasticEnergy(i.geom) for i in O.interactions.all(onlyReal=True))
		return (before + self._parts()[0]) / 2 + deformed + height + springs

	def mean(self, count, every=1):
		"""Over `count` values, taken every so many steps."""
		total = 0
		for _ in range(count):
			total += self.step()
			steps(every - 1)
		return total / count
