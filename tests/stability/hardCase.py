# SPDX-License-Identifier: GPL-2.0-or-later
# What the hard cases share, on top of the verification cases: conserved quantities of a scene, and the ledger of its energy.
# GROUP of a module is the title of its case; its rows say what is measured and what is allowed.
import os, sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'verification'))
from cases import *


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


def steps(count):
	"""Few steps one by one: O.run looks only every 40 ms whether it has come to its end."""
	for _ in range(count):
		O.step()


def mechanicalEnergy():
	"""What can still become motion, of the ledger [J]: kinetic energy, that of springs and deformation, and of heights since tracking began."""
	return sum(O.energy[name] for name in ('kinetic', 'elastPotential', 'deformKinetic', 'deformElastic', 'gravWork') if name in O.energy.keys())


class Ledger:
	"""O.energy from now on: its total stays, but for what steps make or lose. At most one in a scene."""

	def __init__(self):
		O.trackEnergy = True
		steps(2)  # kinetic energy of whole steps needs the forces of the step before
		self.start, self.lowest, self.highest = O.energy.total(), 0., 0.

	def drift(self):
		"""Made since the beginning [J]; less than zero: lost."""
		made = O.energy.total() - self.start
		self.lowest, self.highest = min(self.lowest, made), max(self.highest, made)
		return made

	def run(self, count, every=1):
		"""So many steps, looking now and then; the largest drift of all looks, made or lost [J]."""
		for _ in range(count // every):
			steps(every)
			self.drift()
		return self.largest()

	def largest(self):
		return max(self.highest, -self.lowest)
