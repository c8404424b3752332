# SPDX-License-Identifier: GPL-2.0-or-later
# Response spectra: the largest response of linear oscillators of many periods to a ground motion. An acceleration that is linear
# between samples, as GroundMotion has it, is integrated exactly, so there is no error of a time step. [Nigam and Jennings 1969]
"""Response spectra of ground motions: `responseSpectrum`, `oscillator`."""

import math
from dataclasses import dataclass

import numpy as np

from .checks import checkPositive, isFinite
from .motion import axisNames

#: Periods that a spectrum is asked at unless others are given [s].
usualPeriods = np.geomspace(0.02, 5.0, 150)
usualPeriods.setflags(write=False)

#: Steps in a period, at least, in which the largest response is looked for: between two of them it is higher by 0.3 % at most.
stepsInPeriod = 40


@dataclass(frozen=True)
class ResponseSpectrum:
	"""Largest responses of oscillators, along x, y and z each.

	:param periods: (m,) [s]
	:param damping: share of critical [-]
	:param displacement: relative to the ground, (m, 3) [m]
	:param velocity: relative to the ground, (m, 3) [m/s]
	:param acceleration: absolute, (m, 3) [m/s2]
	:param name: of the motion
	"""

	periods: np.ndarray
	damping: float
	displacement: np.ndarray
	velocity: np.ndarray
	acceleration: np.ndarray
	name: str

	@property
	def pseudoVelocity(self):
		"""(2 pi / T) times the displacement, (m, 3) [m/s]; 0 for a period of 0."""
		return self._frequencies() * self.displacement

	@property
	def pseudoAcceleration(self):
		"""(2 pi / T)^2 times the displacement, (m, 3) [m/s2]: what codes call Sa; the ground's peak for a period of 0."""
		return np.where(self.periods[:, None] > 0, self._frequencies()**2 * self.displacement, self.acceleration)

	def of(self, axis, quantity="pseudoAcceleration"):
		"""One of the quantities along 'x', 'y' or 'z', (m,); along 'geometricMean' that of x and y."""
		values = getattr(self, quantity)
		return np.sqrt(values[:, 0] * values[:, 1]) if axis == "geometricMean" else values[:, axisNames.index(axis)]

	def _frequencies(self):
		"""(m, 1) [rad/s], 0 for a period of 0."""
		return np.divide(2 * math.pi, self.periods, out=np.zeros(len(self.periods)), where=self.periods > 0)[:, None]


def responseSpectrum(motion, periods=usualPeriods, damping=0.05):
	"""Response spectrum of each component of a motion. An oscillator is followed for one period beyond the record's end, where the ground has no
	acceleration.

	:param motion: Motion
	:param periods: of the undamped oscillators [s], >= 0; 0: the ground itself
	:param damping: share of critical, 0 <= damping < 1
	:returns: ResponseSpectrum
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	periods = checkedPeriods(periods)
	_checkDamping(damping)
	found = np.zeros((3, len(periods), 3))
	for axis in np.flatnonzero(motion.peak()):
		for place, period in enumerate(periods):
			found[:, place, axis] = _largest(motion.acceleration[:, axis], motion.dt, period, damping)
	return ResponseSpectrum(periods, float(damping), *found, motion.name)


def oscillator(motion, period, damping=0.05):
	"""Response of an oscillator at the samples of a motion, from rest:  u'' + 2 zeta w u' + w^2 u = -z'',  exact for z'' linear between samples.

	:param period: 2 pi / w [s], > 0
	:param damping: zeta, 0 <= zeta < 1
	:returns: relative displacement [m], relative velocity [m/s], absolute acceleration [m/s2], (n, 3) each
	"""
	checkPositive(period, "period", "s")
	_checkDamping(damping)
	root = _root(period, damping)
	columns = [_parts(_complexResponse(motion.acceleration[:, axis], motion.dt, root), root) for axis in range(3)]
	return tuple(np.column_stack([column[kind] for column in columns]) for kind in range(3))


def checkedPeriods(periods):
	"""Periods as an array; ValueError for others than finite numbers >= 0."""
	try:
		values = np.array(periods, dtype=float)
	except (TypeError, ValueError, OverflowError):
		values = np.array([math.nan])
	if values.ndim != 1 or not len(values) or not np.isfinite(values).all() or (values < 0).any():
		raise ValueError(f"periods is {periods!r}; allowed are one or more finite numbers >= 0 s")
	return values


def _checkDamping(damping):
	if not (isFinite(damping) and 0 <= damping < 1):
		raise ValueError(f"damping is {damping!r}; allowed is 0 <= damping < 1, share of critical")


def _root(period, damping):
	"""Root of the oscillator's characteristic polynomial with the positive imaginary part [1/s]."""
	frequency = 2 * math.pi / period
	return complex(-damping * frequency, frequency * math.sqrt(1 - damping**2))


def _complexResponse(acceleration, dt, root):
	"""q = u' - conj(root) u  at the samples: both equations of the oscillator in one, q' = root q - z'', solved interval by interval."""
	from scipy.signal import lfilter
	z = root * dt
	grown = np.expm1(z)
	atEnd = (grown - z) / z**2  # integral of exp(root (dt - s)) s/dt, over dt
	atBegin = grown / z - atEnd
	weights = -dt * np.array([atEnd, atBegin])
	response, _ = lfilter(weights, [1, -(grown + 1)], acceleration.astype(complex), zi=-weights[0] * acceleration[..., :1])
	return response


def pseudoAcceleration(acceleration, dt, period, damping):
	"""-(2 pi / T)^2 u(t) at the samples of one or more accelerations, (..., n) [m/s2]."""
	root = _root(period, damping)
	return -abs(root)**2 / root.imag * _complexResponse(acceleration, dt, root).imag


def _parts(response, root):
	"""Relative displacement and velocity and absolute acceleration of a complex response."""
	displacement = response.imag / root.imag
	velocity = response.real + root.real * displacement
	return displacement, velocity, 2 * root.real * velocity - abs(root)**2 * displacement


def _largest(acceleration, dt, period, damping):
	"""Largest displacement, velocity and absolute acceleration of one component."""
	if period == 0:
		return 0.0, 0.0, np.abs(acceleration).max()
	finer = max(1, math.ceil(stepsInPeriod * dt / period))
	if finer > 1:
		places = np.arange((len(acceleration) - 1) * finer + 1) / finer
		acceleration, dt = np.interp(places, np.arange(len(acceleration)), acceleration), dt / finer
	root = _root(period, damping)
	response = _complexResponse(acceleration, dt, root)
	after = response[-1] * np.exp(root * np.linspace(0, period, stepsInPeriod + 1))
	return [max(np.abs(during).max(), np.abs(free).max()) for during, free in zip(_parts(response, root), _parts(after, root))]
