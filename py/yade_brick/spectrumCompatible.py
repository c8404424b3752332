# SPDX-License-Identifier: GPL-2.0-or-later
# Synthetic ground motion whose response spectrum follows a given one: noise of random phases in the envelope of Jennings, whose Fourier
# amplitudes are corrected by the ratio of the spectra [Gasparini and Vanmarcke 1976], and then by small wavelets at the times of the largest
# responses [Lilhanand and Tseng 1987], without which single periods stay off.
"""Spectrum-compatible synthetic motion: `syntheticFromSpectrum`."""

import math

import numpy as np

from .baseline import edgeTaper, withoutDrift
from .checks import checkPositive, isFinite
from .motion import Motion
from .spectrum import checkedPeriods, pseudoAcceleration, responseSpectrum

#: Periods, evenly spread on a logarithmic scale, at which the spectrum is looked at while it is corrected (every other one is matched), and in the end.
judgedPeriods, allPeriods = 201, 801

#: Draws of phases at most; corrections of Fourier amplitudes, then by wavelets at most, and the part of a correction below which a draw is given up.
_attempts, _spectralRounds, _waveletRounds, _leastStep = 12, 4, 12, 0.2

#: Share of the tolerance at the judged periods that ends the corrections, so that something is left for those between; how much small weights of wavelets are
#: preferred; what is left of the envelope at the end.
_ownShare, _ridge, _envelopeEnd = 0.9, 0.1, 0.05


def syntheticFromSpectrum(
        periods, accelerations, duration=20.0, dt=0.01, damping=0.05, seed=1, matched=None, strong=None, tolerance=0.1, ratios=(1.0, 0.0, 0.0), name="target"
):
	"""Synthetic ground motion whose pseudo-acceleration spectrum is within `tolerance` of a target at all matched periods (801 of them are looked at). It
	ends at rest where it began. The same arguments give the same motion, to round-off.

	:param periods: of the target [s], rising, > 0
	:param accelerations: of the target [m/s2], each > 0; in between linear in the logarithms. See designSpectrum.elasticSpectrum
	:param duration: [s], at least 3 times the longest matched period
	:param dt: sampling interval [s], at most a fifth of the shortest matched period
	:param damping: of the target, share of critical
	:param seed: whole number >= 0 that chooses the phases; motions of different seeds are independent
	:param matched: (shortest, longest) period [s] at which the spectrum is matched, within the target's; None: the target's, cut to what duration
		and dt allow. The peak acceleration is the target's only as far as short periods are matched, down to 0.05 s or so
	:param strong: (begin, end) [s] of the strong part: the envelope rises with the square of time before, and falls to 5 % at the end after; None: 15 to
		65 % of the duration. EN 1998-1 wants 10 s where nothing else is known
	:param tolerance: largest relative difference, 0.02 to 0.5
	:param ratios: target along x, y, z over the given one, each in [0, 1]; each axis has its own phases
	:param name: of the target, for the motion's name
	:returns: Motion with synthetic=True
	:raises ValueError: naming the argument, its value and what is allowed; or when the tolerance is not reached, with the mismatch that was
	"""
	target = _checkedTarget(periods, accelerations)
	for argument, value in (("duration", duration), ("dt", dt)):
		checkPositive(value, argument, "s")
	shortest, longest = _checkedRange(matched, target[0], duration, dt)
	begin, end = _checkedStrong(strong, duration)
	_checkRest(damping, seed, tolerance, ratios)
	times = np.arange(int(round(duration / dt)) + 1) * dt
	envelope = _jenningsEnvelope(times, begin, end)
	acceleration = np.zeros((len(times), 3))
	for axis in range(3):
		if ratios[axis] > 0:
			acceleration[:, axis] = ratios[axis] * _matched(target, (shortest, longest), dt, envelope, damping, seed + axis, tolerance)
	text = f"synthetic motion of spectrum {name} ({shortest:g} to {longest:g} s, {100 * damping:g} %, seed {seed})"
	return Motion(dt, acceleration, text, synthetic=True)


def mismatch(motion, periods, accelerations, damping=0.05, axis="x"):
	"""Largest relative difference of a motion's pseudo-acceleration to a target at the target's periods.

	:param motion: Motion
	:param periods: of the target [s], > 0
	:param accelerations: the target [m/s2]
	:param damping: share of critical, 0 <= damping < 1
	:param axis: 'x', 'y' or 'z'
	:returns: share of the target [-]
	"""
	found = responseSpectrum(motion, periods, damping).of(axis)
	return float(np.abs(found / np.asarray(accelerations) - 1).max())


def _matched(target, ends, dt, envelope, damping, seed, tolerance):
	"""A component that meets the target, or ValueError. Phases that cannot be brought to it are drawn again."""
	judged, all_ = (np.geomspace(*ends, count) for count in (judgedPeriods, allPeriods))
	wanted, allWanted = (_interpolated(periods, *target) for periods in (judged, all_))
	least = math.inf
	for attempt in range(_attempts):
		acceleration, error = _attempted(judged, wanted, dt, envelope, damping, [seed, attempt], tolerance)
		if error < tolerance:
			error = np.abs(_found(acceleration, dt, all_, damping) / allWanted - 1).max()
		if error < tolerance:
			return acceleration
		least = min(least, error)
	raise ValueError(f"tolerance is {tolerance}: {_attempts} draws came within {least:.3g} of the target; allowed is what a motion can meet: a longer one, fewer periods")


def _attempted(judged, wanted, dt, envelope, damping, seeds, tolerance):
	"""Noise whose spectrum is brought to the target as far as it goes, and the largest relative difference at the judged periods."""
	inside = np.minimum(1, envelope / _envelopeEnd)  # 0 at both ends: what is added begins and ends with the motion
	acceleration = withoutDrift(_noise(judged, wanted, dt, envelope, seeds), envelope, dt)
	acceleration = acceleration * np.exp(np.log(wanted / _found(acceleration, dt, judged, damping)).mean())
	for _ in range(_spectralRounds):
		ratios = wanted / _found(acceleration, dt, judged, damping)
		acceleration = withoutDrift(_amplitudesCorrected(acceleration, dt, judged, ratios) * inside, envelope, dt)
	found, step = _found(acceleration, dt, judged, damping), 1.0
	for _ in range(_waveletRounds):
		if step < _leastStep or np.abs(found / wanted - 1).max() < _ownShare * tolerance:
			break
		added = _wavelets(acceleration, dt, judged[::2], step * (wanted - found)[::2], damping, inside)
		tried = withoutDrift(acceleration + added, envelope, dt)
		triedFound = _found(tried, dt, judged, damping)
		if _badness(triedFound / wanted) < _badness(found / wanted):
			acceleration, found, step = tried, triedFound, min(1.0, 2 * step)
		else:
			step /= 2
	return acceleration, np.abs(found / wanted - 1).max()


def _badness(ratios):
	"""Of a spectrum: near to the largest difference, but one that would have to grow first does not hold all others up."""
	return ((ratios - 1)**6).sum()


def _noise(control, wanted, dt, envelope, seeds):
	"""Noise of random phases in the envelope, with Fourier amplitudes as the target's pseudo-velocity: the right shape to begin with."""
	frequencies = np.fft.rfftfreq(len(envelope), dt)
	# The legacy generator: numpy guarantees its numbers for ever, those of default_rng it does not.
	phases = np.random.RandomState(seeds).uniform(0, 2 * math.pi, len(frequencies))
	amplitudes = np.zeros(len(frequencies))
	amplitudes[1:] = np.exp(np.interp(np.log(frequencies[1:]), -np.log(control[::-1]), np.log((wanted * control)[::-1])))
	amplitudes[1:] *= (np.minimum(1, frequencies[1:] * control[-1]) * np.minimum(1, 1 / (frequencies[1:] * control[0])))**2  # outside it fades
	return np.fft.irfft(amplitudes * np.exp(1j * phases), len(envelope)) * envelope


def _amplitudesCorrected(acceleration, dt, control, ratios):
	"""Each Fourier amplitude times the ratio of target and spectrum at its period; phases stay."""
	frequencies = np.fft.rfftfreq(len(acceleration), dt)
	correction = np.interp(frequencies, (1 / control)[::-1], ratios[::-1])
	return np.fft.irfft(np.fft.rfft(acceleration) * correction, len(acceleration))


def _wavelets(acceleration, dt, control, missing, damping, inside):
	"""Small wavelets that change the largest responses by what is missing, as far as these change linearly and their times stay: each the impulse response of an
	oscillator, run backwards from the time of its largest response [Lilhanand and Tseng 1987, 1988].
	"""
	times = np.arange(len(acceleration)) * dt
	impulses, signs = np.zeros((len(control), len(acceleration))), np.zeros(len(control))
	for row, period in enumerate(control):
		response = pseudoAcceleration(acceleration, dt, period, damping)
		place = int(np.argmax(np.abs(response)))
		before, frequency = times[place] - times[:place + 1], 2 * math.pi / period
		# impulse response of the pseudo-acceleration, but for 1 / sqrt(1 - damping^2)
		impulses[row, :place + 1] = frequency * np.exp(-damping * frequency * before) * np.sin(frequency * math.sqrt(1 - damping**2) * before)
		signs[row] = np.sign(response[place])
	waves = impulses * inside
	# What a wave does at those times is the sum of its products with the impulse response; einsum, since BLAS adds in an order of its own.
	effects = dt * np.einsum("in,jn->ij", impulses, waves)
	# Neighbouring periods want nearly the same: small weights in the sum are preferred to an exact solution of large ones.
	stiffness = _ridge * np.diag(np.diag(effects))
	weights = np.linalg.lstsq(np.vstack([effects, stiffness]), np.concatenate([signs * missing, np.zeros(len(control))]), rcond=None)[0]
	return (weights[:, None] * waves).sum(axis=0)


def _found(acceleration, dt, control, damping):
	return responseSpectrum(_alongX(acceleration, dt), control, damping).of("x")


def _alongX(values, dt):
	return Motion(dt, np.outer(values, (1.0, 0.0, 0.0)), "synthetic component", synthetic=True)


def _jenningsEnvelope(times, begin, end):
	"""Rises as the square of time, stays at 1, falls exponentially [Jennings, Housner and Tsai 1968], and ends at 0."""
	duration = times[-1]
	fall = math.log(1 / _envelopeEnd) / (duration - end)
	envelope = np.where(times < begin, (times / begin)**2, np.exp(-fall * np.maximum(0, times - end)))
	return envelope * np.where(times > end, edgeTaper(times, duration, 0.5 * (duration - end)), 1.0)


def _interpolated(at, periods, accelerations):
	return np.exp(np.interp(np.log(at), np.log(periods), np.log(accelerations)))


def _checkedTarget(periods, accelerations):
	periods = checkedPeriods(periods)
	try:
		accelerations = np.array(accelerations, dtype=float)
	except (TypeError, ValueError, OverflowError):
		raise ValueError(f"accelerations is {accelerations!r}; allowed are finite numbers > 0 m/s2") from None
	if len(periods) < 2 or not periods[0] > 0 or not (np.diff(periods) > 0).all():
		raise ValueError(f"periods is {periods.tolist()}; allowed are two or more rising numbers > 0 s")
	if accelerations.shape != periods.shape or not np.isfinite(accelerations).all() or not (accelerations > 0).all():
		raise ValueError(f"accelerations is {accelerations.tolist()}; allowed are {len(periods)} finite numbers > 0 m/s2, one a period")
	return periods, accelerations


def _checkedRange(matched, periods, duration, dt):
	least, most = max(periods[0], 5 * dt), min(periods[-1], duration / 3)
	if matched is None:
		matched = (least, most)
	try:
		shortest, longest = matched
		right = isFinite(shortest) and isFinite(longest) and least * (1 - 1e-9) <= shortest < longest <= most * (1 + 1e-9)
	except (TypeError, ValueError):
		right = False
	if not right:
		raise ValueError(f"matched is {matched!r}; allowed are two rising periods from {least:g} to {most:g} s: the target's, 5 dt, a third of the duration")
	return shortest, longest


def _checkedStrong(strong, duration):
	if strong is None:
		return 0.15 * duration, 0.65 * duration
	try:
		begin, end = strong
		right = isFinite(begin) and isFinite(end) and 0 < begin <= end <= 0.9 * duration
	except (TypeError, ValueError):
		right = False
	if not right:
		raise ValueError(f"strong is {strong!r}; allowed are two times with 0 < begin <= end <= {0.9 * duration:g} s, nine tenths of the duration")
	return begin, end


def _checkRest(damping, seed, tolerance, ratios):
	if not (isFinite(damping) and 0 < damping < 1):
		raise ValueError(f"damping is {damping!r}; allowed is 0 < damping < 1, share of critical")
	if not (isinstance(seed, (int, np.integer)) and not isinstance(seed, bool) and 0 <= seed < 2**32 - 3):
		raise ValueError(f"seed is {seed!r}; allowed is a whole number from 0 to {2**32 - 4}")
	if not (isFinite(tolerance) and 0.02 <= tolerance <= 0.5):
		raise ValueError(f"tolerance is {tolerance!r}; allowed are 0.02 to 0.5")
	if not isinstance(ratios, (list, tuple, np.ndarray)) or len(ratios) != 3 or not all(isFinite(r) and 0 <= r <= 1 for r in ratios) or not any(ratios):
		raise ValueError(f"ratios is {ratios!r}; allowed are three numbers in [0, 1], not all 0")
