# SPDX-License-Identifier: GPL-2.0-or-later
# The synthetic near-fault motion that stands in where no record may be shipped: velocity pulses, and noise around them.
# The same parameters have to give the same bits for ever: collapses depend on the last digit.
"""A synthetic near-fault ground motion: `syntheticNearFault`, and the pulse that it is made of."""

import math

import numpy as np

from .baseline import edgeTaper, withoutDrift
from .checks import checkPositive, isFinite
from .motion import Motion, standardGravity


def velocityPulse(times, amplitude, period, centre, cycles=1.2, phase=0.5 * math.pi):
	"""Near-fault velocity pulse and its acceleration [Mavroeidis and Papageorgiou 2003, Bull. Seism. Soc. Am. 93(3), 1099-1131].

	v(t) = A/2 (1 + cos(2 pi (t - t0) / (gamma Tp))) cos(2 pi (t - t0) / Tp + nu)   for |t - t0| <= gamma Tp / 2, else 0;
	the acceleration is its derivative. With nu = 90 degrees the pulse leaves no displacement behind.

	:param times: (n,) [s]
	:param amplitude: A [m/s], of the envelope: the largest velocity is smaller
	:param period: Tp [s], > 0
	:param centre: t0 [s]
	:param cycles: gamma, > 0: how many periods long the pulse is
	:param phase: nu [rad]
	:returns: velocity (n,) [m/s] and acceleration (n,) [m/s2]
	"""
	local = np.asarray(times, dtype=float) - centre
	carrier = 2 * math.pi / period
	slow = carrier / cycles
	inside = np.abs(local) <= 0.5 * cycles * period
	envelope = 0.5 * amplitude * (1 + np.cos(slow * local))
	envelopeRate = -0.5 * amplitude * slow * np.sin(slow * local)
	velocity = envelope * np.cos(carrier * local + phase)
	acceleration = envelopeRate * np.cos(carrier * local + phase) - envelope * carrier * np.sin(carrier * local + phase)
	return np.where(inside, velocity, 0.0), np.where(inside, acceleration, 0.0)


# Firm alluvium: frequencies [Hz] and damping ratios of the Kanai-Tajimi ground filter and of Clough and Penzien's high-pass in
# series with it; above `noiseTop` there is nothing, so that every dt up to 1/(2 noiseTop) gives the same motion.
_groundFrequency, _groundDamping = 4.0, 0.6
_highPassFrequency, _highPassDamping = 0.5, 0.6
noiseTop = 20.0


def _groundNoise(times, duration, seed):
	"""Stationary noise of unit variance with the Kanai-Tajimi and Clough-Penzien spectrum, as a sum of cosines with random phases
	[Shinozuka and Deodatis 1991, Appl. Mech. Rev. 44(4), 191-204]. The same function of time for every sampling.
	"""
	# A frequency step of 1 / (2 duration) keeps the sum from repeating within the motion.
	frequencies = np.arange(1, int(2 * duration * noiseTop)) / (2 * duration)
	ground, high = frequencies / _groundFrequency, frequencies / _highPassFrequency
	soil = (1 + (2 * _groundDamping * ground) ** 2) / ((1 - ground ** 2) ** 2 + (2 * _groundDamping * ground) ** 2)
	highPass = high ** 4 / ((1 - high ** 2) ** 2 + (2 * _highPassDamping * high) ** 2)
	weights = np.sqrt(soil * highPass * np.cos(0.5 * math.pi * frequencies / noiseTop) ** 2)
	weights *= math.sqrt(2) / np.linalg.norm(weights)
	# The legacy generator: numpy guarantees its numbers for ever, those of default_rng it does not.
	phases = np.random.RandomState(seed).uniform(0, 2 * math.pi, len(frequencies))
	# Sums are written out: a matrix product goes to BLAS, whose last digit depends on the number of threads, and a collapse on the last digit.
	return (np.cos(2 * math.pi * np.outer(times, frequencies) + phases) * weights).sum(axis=1)


def _phaseEnvelope(times, peakTime, rise):
	"""Envelope of one strong phase, (t/rise)^2 exp(2 (1 - t/rise)) from its arrival on, 1 at peakTime [form: Saragoni and Hart 1974,
	Earthq. Eng. Struct. Dyn. 2, 249-267].
	"""
	local = np.maximum(0.0, (times - peakTime) / rise + 1)
	return local ** 2 * np.exp(2 * (1 - local))


def _noiseShare(pulse, noise, peak):
	"""The factor s > 0 with max |pulse + s noise| = peak, by bisection: that maximum is a convex function of s, below `peak` at s = 0."""
	low, high = 0.0, (peak + np.abs(pulse).max()) / np.abs(noise).max()
	for _ in range(60):
		middle = 0.5 * (low + high)
		if np.abs(pulse + middle * noise).max() < peak:
			low = middle
		else:
			high = middle
	return low


#: The second strong phase has this share of the first one's strength; the weak shaking before and after both has `_quietShare`.
_secondShare, _quietShare = 0.75, 0.03
_taperLength = 0.5


def syntheticNearFault(
        duration=9.0, dt=0.01, peak=0.8 * standardGravity, pulsePeriod=2.0, pulseVelocity=1.2, phaseTimes=(3.2, 5.6), ratios=(1.0, 0.0, 0.0), seed=2003
):
	"""Synthetic near-fault ground motion, made by this project: NOT a record, and fitted to none.

	Its character is that of a site beside a rupturing fault, such as method and literature describe for Bam 2003: two strong phases,
	each a velocity pulse (velocityPulse) with noise (Kanai-Tajimi and Clough-Penzien spectrum) in an envelope around it, and weak
	shaking before, between and after. The noise is scaled so that the largest acceleration is `peak` exactly; pulses and noise are
	corrected so that velocity and displacement end at zero. The same parameters give the same motion at any dt and on any machine, to round-off.

	:param duration: [s], at least the second phase time + 0.6 pulsePeriod + 0.5 s: the half length of its pulse, and the taper
	:param dt: sampling interval [s], up to 0.025: the noise reaches to 20 Hz
	:param peak: largest acceleration along an axis whose ratio is 1 [m/s2]
	:param pulsePeriod: Tp of both pulses [s]
	:param pulseVelocity: envelope amplitude of the first pulse [m/s], >= 0; the second has 0.75 of it, in the opposite sense
	:param phaseTimes: centres of the two phases [s], rising; the first one's strong shaking begins about 0.7 s before its centre
	:param ratios: strength along x, y, z, each in [0, 1]; by default only x, in the plane of a wall along x. Each axis has its own noise
	:param seed: whole number >= 0 that chooses the noise
	:returns: Motion with synthetic=True
	:raises ValueError: naming the parameter, its value and what is allowed
	"""
	_checkSynthetic(duration, dt, peak, pulsePeriod, pulseVelocity, phaseTimes, ratios, seed)
	times = np.arange(int(round(duration / dt)) + 1) * dt
	acceleration = np.zeros((len(times), 3))
	for axis in range(3):
		if ratios[axis] > 0:
			acceleration[:, axis] = ratios[axis] * _syntheticComponent(times, dt, peak, pulsePeriod, pulseVelocity, phaseTimes, seed + axis)
	return Motion(dt, acceleration, f"synthetic near-fault motion (pulse {pulsePeriod:g} s, peak {peak / standardGravity:.2g} g)", synthetic=True)


def _syntheticComponent(times, dt, peak, pulsePeriod, pulseVelocity, phaseTimes, seed):
	duration = times[-1]
	window = edgeTaper(times, duration, _taperLength)
	pulse = sum(
	        velocityPulse(times, strength * pulseVelocity, pulsePeriod, centre)[1] for strength, centre in zip((1.0, -_secondShare), phaseTimes)
	)
	envelope = _phaseEnvelope(times, phaseTimes[0], 0.6) + _secondShare * _phaseEnvelope(times, phaseTimes[1], 0.6) + _quietShare
	noise = _groundNoise(times, duration, seed) * envelope * window
	pulse, noise = withoutDrift(pulse * window, window, dt), withoutDrift(noise, window, dt)
	strongest = np.abs(pulse).max()
	if not strongest < peak:
		raise ValueError(f"pulseVelocity is {pulseVelocity} m/s: the pulses alone reach {strongest:.3g} m/s2; they have to stay below peak, {peak:.3g}")
	return pulse + _noiseShare(pulse, noise, peak) * noise


def _areNumbers(values, count):
	return isinstance(values, (list, tuple, np.ndarray)) and len(values) == count and all(isFinite(value) for value in values)


def _checkSynthetic(duration, dt, peak, pulsePeriod, pulseVelocity, phaseTimes, ratios, seed):
	for name, value in (("duration", duration), ("dt", dt), ("pulsePeriod", pulsePeriod)):
		checkPositive(value, name, "s")
	if not (isFinite(peak) and peak > 0):
		raise ValueError(f"peak is {peak!r}; allowed is a finite acceleration > 0 m/s2")
	if not (isFinite(pulseVelocity) and pulseVelocity >= 0):
		raise ValueError(f"pulseVelocity is {pulseVelocity!r}; allowed is a finite velocity >= 0 m/s")
	if dt > 0.5 / noiseTop:
		raise ValueError(f"dt is {dt} s; allowed is at most {0.5 / noiseTop} s, since the noise reaches to {noiseTop:g} Hz")
	if not _areNumbers(phaseTimes, 2) or not 0 < phaseTimes[0] < phaseTimes[1]:
		raise ValueError(f"phaseTimes is {phaseTimes}; allowed are two rising times > 0 s")
	room = phaseTimes[1] + 0.6 * pulsePeriod + _taperLength
	if duration < room:
		raise ValueError(f"duration is {duration} s; allowed is at least {room:g} s, which the second phase and the taper need")
	if not _areNumbers(ratios, 3) or not all(0 <= ratio <= 1 for ratio in ratios) or not any(ratios):
		raise ValueError(f"ratios is {ratios}; allowed are three numbers in [0, 1], not all 0")
	if not (isinstance(seed, (int, np.integer)) and 0 <= seed < 2 ** 32 - 3):
		raise ValueError(f"seed is {seed!r}; allowed is a whole number from 0 to {2 ** 32 - 4}")
