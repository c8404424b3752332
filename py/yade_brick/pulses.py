# SPDX-License-Identifier: GPL-2.0-or-later
# Synthetic ground motions of closed form: pulses and harmonic motions, for tests on a shaking table, rocking spectra and understanding.
# All say in their name that they are synthetic.
"""Synthetic ground motions of closed form: Ricker, half sine, near-fault velocity pulse, harmonic with ramps, sweep."""

import math

import numpy as np

from .baseline import edgeTaper, withoutDrift
from .checks import checkPositive, isFinite
from .motion import Motion, directionName, directionVector
from .synthetic import velocityPulse

#: Samples in a period, at least, of what has one: linear between them, the motion is closer than 1 % of its peak.
_samplesInPeriod = 25


def syntheticRicker(peak, frequency, direction="x", dt=0.005):
	"""Ricker wavelet, z''(t) = A (1 - 2 s^2) exp(-s^2) with s = pi f (t - 2/f): one strong half cycle between two weaker ones. Velocity and displacement
	end at zero.

	:param peak: A [m/s2], > 0, of the middle half cycle
	:param frequency: f [Hz] at which its Fourier spectrum is largest, > 0
	:param direction: 'x', '-y' and the like, or three numbers
	:param dt: sampling interval [s], at most 1 / (25 f)
	"""
	_checkHarmonic(peak, frequency, dt)
	times = _times(4 / frequency, dt)
	s = math.pi * frequency * (times - 2 / frequency)
	return _motion(peak * (1 - 2 * s**2) * np.exp(-s**2), direction, dt, f"Ricker wavelet, {frequency:g} Hz, {peak:g} m/s2")


def syntheticHalfSine(peak, duration, direction="x", dt=0.005):
	"""Half a sine of acceleration, z''(t) = A sin(pi t / D), as rocking blocks are studied under. The ground is left with the velocity 2 A D / pi: a scene
	whose base is moved needs `endingAtRest()`.

	:param peak: A [m/s2], > 0
	:param duration: D [s], > 0
	:param direction, dt: as in syntheticRicker; dt at most D / 12.5
	"""
	checkPositive(duration, "duration", "s")
	_checkHarmonic(peak, 0.5 / duration, dt)
	count = round(duration / dt)
	times = np.arange(count + 1) * duration / count
	return _motion(peak * np.sin(math.pi * times / duration), direction, duration / count, f"half sine, {duration:g} s, {peak:g} m/s2")


def syntheticPulse(velocity, period, cycles=1.2, phase=0.5 * math.pi, direction="x", dt=0.005):
	"""Near-fault velocity pulse of Mavroeidis and Papageorgiou, see synthetic.velocityPulse; it begins and ends with zero velocity.

	:param velocity: amplitude of the envelope [m/s], > 0
	:param period: [s], > 0
	:param cycles: gamma, > 1
	:param phase: nu [rad]; pi/2 leaves no displacement behind, 0 does
	:param direction, dt: as in syntheticRicker
	"""
	checkPositive(velocity, "velocity", "m/s")
	checkPositive(period, "period", "s")
	_checkHarmonic(1, 1 / period, dt)
	if not (isFinite(cycles) and cycles > 1):
		raise ValueError(f"cycles is {cycles!r}; allowed is a finite number > 1: with fewer the velocity would jump")
	if not isFinite(phase):
		raise ValueError(f"phase is {phase!r}; allowed is a finite number of radians")
	times = _times(cycles * period, dt)
	values = velocityPulse(times, velocity, period, 0.5 * cycles * period, cycles, phase)[1]
	return _motion(values, direction, dt, f"velocity pulse, {period:g} s, {velocity:g} m/s, {cycles:g} cycles")


def syntheticHarmonic(peak, frequency, cycles=10, ramps=2, direction="x", dt=0.005):
	"""Sine of acceleration whose amplitude rises and falls by half a cosine over some cycles, so that a base that is moved neither jumps nor drifts.

	:param peak: amplitude between the ramps [m/s2], > 0
	:param frequency: [Hz], > 0
	:param cycles: in all, a whole number >= 1
	:param ramps: cycles in which the amplitude rises, and in which it falls, >= 0, together at most `cycles`; with 0 the velocity has a mean,
		and a base that is moved walks away
	:param direction, dt: as in syntheticRicker
	"""
	_checkHarmonic(peak, frequency, dt)
	if not isinstance(cycles, int) or isinstance(cycles, bool) or cycles < 1:
		raise ValueError(f"cycles is {cycles!r}; allowed is a whole number >= 1")
	if not (isFinite(ramps) and 0 <= ramps <= cycles / 2):
		raise ValueError(f"ramps is {ramps!r}; allowed are 0 to {cycles / 2:g}, half of the cycles")
	count = round(cycles / (frequency * dt))
	interval = cycles / (frequency * count)  # a whole number of samples in the whole: what falls then mirrors what rises
	times = np.arange(count + 1) * interval
	window = edgeTaper(times, times[-1], ramps / frequency) if ramps else 1.0
	values = peak * window * np.sin(2 * math.pi * frequency * times)
	return _motion(values, direction, interval, f"harmonic motion, {frequency:g} Hz, {peak:g} m/s2, {cycles} cycles")


def syntheticSweep(peak, begin, end, duration, ramps=1.0, direction="x", dt=0.005):
	"""Sine whose frequency goes from `begin` to `end` by the same factor every second (a logarithmic sweep), faded in and out; velocity and displacement
	end at zero.

	:param peak: largest acceleration [m/s2], > 0
	:param begin, end: frequencies [Hz], > 0
	:param duration: [s], > 0
	:param ramps: length of fading at each end [s], > 0, together at most the duration
	:param direction, dt: as in syntheticRicker, for the higher frequency
	"""
	from scipy.signal import chirp
	for name, value, unit in (("begin", begin, "Hz"), ("end", end, "Hz"), ("duration", duration, "s"), ("ramps", ramps, "s")):
		checkPositive(value, name, unit)
	_checkHarmonic(peak, max(begin, end), dt)
	if 2 * ramps > duration:
		raise ValueError(f"ramps is {ramps} s; allowed is at most half of the duration of {duration} s")
	times = _times(duration, dt)
	window = edgeTaper(times, times[-1], ramps)
	values = withoutDrift(window * chirp(times, begin, duration, end, method="logarithmic", phi=-90), window, dt)
	return _motion(values * (peak / np.abs(values).max()), direction, dt, f"sweep from {begin:g} to {end:g} Hz, {peak:g} m/s2")


def _checkHarmonic(peak, frequency, dt):
	checkPositive(peak, "peak", "m/s2")
	checkPositive(frequency, "frequency", "Hz")
	checkPositive(dt, "dt", "s")
	if dt > (1 + 1e-9) / (_samplesInPeriod * frequency):
		raise ValueError(f"dt is {dt} s; allowed is at most {1 / (_samplesInPeriod * frequency):g} s, {_samplesInPeriod} samples in a period")


def _times(duration, dt):
	return np.arange(int(math.ceil(duration / dt - 1e-9)) + 1) * dt


def _motion(values, direction, dt, text):
	unit = directionVector(direction)
	return Motion(dt, np.outer(values, unit), f"synthetic {text}, {directionName(unit)}", synthetic=True)
