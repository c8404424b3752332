# SPDX-License-Identifier: GPL-2.0-or-later
# From acceleration samples to velocity and displacement, and corrections without which both drift: what a recorder or a cut leaves
# in the acceleration is small there, and metres after two integrations. Arrays in, arrays out; Motion calls these.
"""Integrals of sampled accelerations and baseline corrections, on arrays of n rows, one a sample."""

import math

import numpy as np


def runningIntegral(values, dt):
	"""Trapezoidal running integral along axis 0, zero at the first sample: exact for what is linear between samples."""
	result = np.zeros_like(values)
	np.cumsum(0.5 * dt * (values[1:] + values[:-1]), axis=0, out=result[1:])
	return result


def displacementOf(acceleration, dt):
	"""Displacement from rest at zero under an acceleration that is linear between samples: exact, as GroundMotion moves a base."""
	velocity = runningIntegral(acceleration, dt)
	result = np.zeros_like(acceleration)
	np.cumsum(dt * velocity[:-1] + dt * dt / 6 * (2 * acceleration[:-1] + acceleration[1:]), axis=0, out=result[1:])
	return result


def edgeTaper(times, duration, length):
	"""1 inside, falling to 0 at both ends over `length` [s] by half a cosine."""
	edge = np.clip(np.minimum(times, duration - times) / length, 0.0, 1.0)
	return 0.5 * (1 - np.cos(math.pi * edge))


def withoutDrift(acceleration, window, dt):
	"""Acceleration minus window * (straight line), so that velocity and displacement both end at zero. The window is 0 at both ends."""
	ramp = np.linspace(-1.0, 1.0, len(acceleration))
	columns = np.column_stack([acceleration, window, window * ramp])
	velocity = runningIntegral(columns, dt)
	# The trapezoidal rule twice: for samples that begin and end at zero it gives the same last displacement as the exact integral.
	ends = np.vstack([velocity[-1], runningIntegral(velocity, dt)[-1]])
	level, slope = np.linalg.solve(ends[:, 1:], ends[:, 0])
	return acceleration - (level + slope * ramp) * window


def withoutPolynomial(acceleration, dt, degree, endDisplacement):
	"""Acceleration minus the polynomial of this degree whose integral is closest to the velocity (least squares over the samples) among those
	that leave a last velocity of zero and, if asked, a last displacement of zero.

	:param acceleration: (n, 3) [m/s2]   :param degree: >= 0; >= 1 with `endDisplacement`
	"""
	count = len(acceleration)
	basis = np.polynomial.legendre.legvander(np.linspace(-1, 1, count), degree)  # Legendre polynomials keep the equations well conditioned
	velocityBasis, velocity = runningIntegral(basis, dt), runningIntegral(acceleration, dt)
	ends, wanted = [velocityBasis[-1]], [velocity[-1]]
	if endDisplacement:
		ends.append(displacementOf(basis, dt)[-1])
		wanted.append(displacementOf(acceleration, dt)[-1])
	ends, wanted = np.array(ends), np.array(wanted)
	# Least squares with constraints: one solution of the constraints, and the best step within what they leave free.
	coefficients = np.linalg.lstsq(ends, wanted, rcond=None)[0]
	free = np.linalg.svd(ends)[2][len(ends):].T
	if free.size:
		coefficients += free @ np.linalg.lstsq(velocityBasis @ free, velocity - velocityBasis @ coefficients, rcond=None)[0]
	return acceleration - basis @ coefficients


def highPassPadding(frequency, order, dt):
	"""Samples of zeros at each end in which a filter of this corner and order, run both ways, fades out: 1.5 order / corner seconds, which
	is half of the total for twice the order of Boore and Bommer [2005, Soil Dyn. Earthq. Eng. 25, 93-115].
	"""
	return int(math.ceil(1.5 * order / frequency / dt))


def highPassed(acceleration, dt, frequency, order):
	"""Acceleration with zeros at both ends (highPassPadding), run through a Butterworth high-pass forwards and backwards: no phase shift,
	gain 1 / (1 + (frequency / f)^(2 order)).
	"""
	from scipy.signal import butter, sosfiltfilt
	padding = highPassPadding(frequency, order, dt)
	padded = np.pad(acceleration, ((padding, padding), (0, 0)))
	return sosfiltfilt(butter(order, frequency, "highpass", fs=1 / dt, output="sos"), padded, axis=0, padtype=None)
