# SPDX-License-Identifier: GPL-2.0-or-later
# How far a scene of bricks is from rest, from energies and forces that the library computes.
"""Criterion of rest: `restState`, `isAtRest`."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class RestState:
	"""Energies and forces of the last step.

	:param kinetic: of bricks, rigid motion and deformation [J]
	:param elastic: of bricks, mortar joints and contacts [J]
	:param imbalance: mean net force on bodies over mean force in joints and contacts, YADE's unbalancedForce [-]; infinite where nothing touches
	"""

	kinetic: float
	elastic: float
	imbalance: float

	@property
	def energyRatio(self):
		"""Kinetic over elastic energy; infinite for motion without elastic energy, 0 when there is neither."""
		return self.kinetic / self.elastic if self.elastic else float("inf") if self.kinetic else 0.0


def restState():
	"""RestState of the scene.

	:raises RuntimeError: before the first step, when energies are not known yet
	"""
	from yade import Brick, O
	from yade.utils import unbalancedForce
	kinetic, elastic = energies([body.shape for body in O.bodies if isinstance(body.shape, Brick)])
	if math.isnan(elastic):
		raise RuntimeError("the elastic energy is not known before the first step of a brick: run O.step() first")
	imbalance = unbalancedForce()
	return RestState(kinetic, elastic, math.inf if math.isnan(imbalance) else imbalance)


def energies(bricks):
	"""Kinetic and elastic energy of the scene [J], see RestState; of its bricks, whose shapes are given, and of their joints and contacts."""
	return kineticEnergy(bricks), elasticEnergy(bricks)


def kineticEnergy(bricks):
	"""Of the scene [J]: of all rigid motion, and of the deformation of the bricks whose shapes are given."""
	from yade.utils import kineticEnergy as ofRigidMotion
	return ofRigidMotion() + sum([shape.kineticEnergy() for shape in bricks])


def elasticEnergy(bricks):
	"""Of the bricks whose shapes are given, and of all joints and contacts of bricks in the scene [J]."""
	from yade import BrickPhys, O
	# each attribute is read once: every reading makes a Python object, and recordings come here often
	springs = sum([phys.elasticEnergy(i.geom) for i in O.interactions.all(onlyReal=True) if isinstance(phys := i.phys, BrickPhys)])
	return sum([shape.elasticEnergy() for shape in bricks]) + springs


def isAtRest(energyRatio=1e-8, imbalance=1e-4):
	"""Whether the scene rests: kinetic over elastic energy and force imbalance both at or below their limits.

	:param energyRatio: largest allowed RestState.energyRatio; 1e-8 means velocities of 1e-4 of those that the elastic energy could give
	:param imbalance: largest allowed RestState.imbalance
	:raises ValueError: for a limit that is not > 0
	"""
	for name, limit in (("energyRatio", energyRatio), ("imbalance", imbalance)):
		if isinstance(limit, bool) or not isinstance(limit, (int, float)) or not limit > 0:
			raise ValueError(f"{name} is {limit!r}; allowed is a number > 0")
	now = restState()
	return now.energyRatio <= energyRatio and now.imbalance <= imbalance
