# SPDX-License-Identifier: GPL-2.0-or-later
# How strong a ground motion is, in the measures of the field. The integrals are exact for an acceleration that is linear between samples.
"""Intensity measures of ground motions: `intensity`."""

import math
from dataclasses import dataclass

import numpy as np

from .motion import axisNames, standardGravity


@dataclass(frozen=True)
class Intensity:
	"""Measures of a motion along x, y, z, (3,) each; `print` shows those of the axes that move.

	:param pga: largest acceleration [m/s2]
	:param pgv: largest velocity at a sample [m/s]
	:param pgd: largest displacement at a sample [m]
	:param arias: Arias intensity, pi / (2 g) times the integral of the squared acceleration [m/s]
	:param cav: cumulative absolute velocity, integral of the absolute acceleration [m/s]
	:param significantDuration: between 5 and 95 % of the Arias intensity [s]
	:param significantBegin: time at which the 5 % are reached [s]
	"""

	pga: np.ndarray
	pgv: np.ndarray
	pgd: np.ndarray
	arias: np.ndarray
	cav: np.ndarray
	significantDuration: np.ndarray
	significantBegin: np.ndarray

	def __str__(self):
		lines = ["      PGA [g]  PGV [m/s]  PGD [m]  Arias [m/s]  CAV [m/s]  5-95 % [s]"]
		for axis in np.flatnonzero(self.pga):
			lines.append(
			        f"{axisNames[axis]}  {self.pga[axis] / standardGravity:11.4g}{self.pgv[axis]:11.4g}{self.pgd[axis]:9.4g}{self.arias[axis]:13.4g}"
			        f"{self.cav[axis]:11.4g}{self.significantDuration[axis]:12.4g}"
			)
		return "\n".join(lines)


def intensity(motion, low=0.05, high=0.95):
	"""Intensity of a motion; Sa(T) is in spectrum.responseSpectrum.

	:param motion: Motion
	:param low, high: shares of the Arias intensity between which the significant duration is, 0 <= low < high <= 1
	:raises ValueError: for other shares
	"""
	if not 0 <= low < high <= 1:
		raise ValueError(f"low is {low!r} and high {high!r}; allowed are 0 <= low < high <= 1")
	squares = _running(_squareIntegrals(motion.acceleration, motion.dt))
	begins, ends = (np.array([_timeOfShare(motion.times(), squares[:, axis], share) for axis in range(3)]) for share in (low, high))
	return Intensity(
	        pga=motion.peak(),
	        pgv=np.abs(motion.velocity()).max(axis=0),
	        pgd=np.abs(motion.displacement()).max(axis=0),
	        arias=math.pi / (2 * standardGravity) * squares[-1],
	        cav=_absoluteIntegrals(motion.acceleration, motion.dt).sum(axis=0),
	        significantDuration=ends - begins,
	        significantBegin=begins,
	)


def _running(pieces):
	return np.vstack([np.zeros((1, pieces.shape[1])), np.cumsum(pieces, axis=0)])


def _squareIntegrals(values, dt):
	"""Of the square over each interval, linear in it."""
	first, second = values[:-1], values[1:]
	return dt / 3 * (first**2 + first * second + second**2)


def _absoluteIntegrals(values, dt):
	"""Of the absolute value over each interval: two triangles where the sign changes in it."""
	first, second = np.abs(values[:-1]), np.abs(values[1:])
	total = first + second
	crossing = values[:-1] * values[1:] < 0
	triangles = np.divide(first**2 + second**2, total, out=np.zeros_like(total), where=total > 0)
	return 0.5 * dt * np.where(crossing, triangles, total)


def _timeOfShare(times, running, share):
	"""When a running integral reaches a share of its end; 0 where nothing moves."""
	if not running[-1] > 0:
		return 0.0
	rising = np.concatenate([[True], np.diff(running) > 0])  # np.interp wants rising values
	return float(np.interp(share * running[-1], running[rising], times[rising]))
