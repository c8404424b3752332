# SPDX-License-Identifier: GPL-2.0-or-later
# Slow loading by inertia forces that every body feels in proportion to its mass: a table that is tilted, and a push that grows. Both are
# Motions, for GroundMotion without ids, on top of the scene's own gravity; capacity reads what the scene could bear.
"""Quasi-static loading as ground motions: `tiltingTable`, `pushover`.

GroundMotion gives every free body the force -m z''. So a push of a m/s2 along a direction is a motion with z'' = -a along it. After its last sample the
engine gives nothing, and a wall that was pushed would be let go at once: both motions therefore go on at their full load for `hold` seconds. Simulate no longer
than `motion.duration`. They have no meaning for a base that is moved in space.

Local damping (`yade_brick.engines(damping=0.3)` or so) keeps what the beginning stirs up small. The slower the ramp, the closer to statics: what falls
takes about a second, during which the load goes on growing.
"""

import math

import numpy as np

from .checks import checkPositive, isFinite
from .motion import Motion, directionName, directionVector, standardGravity

#: Sampling interval of these motions [s]: linear between samples, a tilting table is closer than 1e-6 g to a turning one at 0.1 rad/s.
interval = 0.01


def tiltingTable(rate, upTo, direction="x", gravity=9.81, ease=0.5, hold=5.0):
	"""A table that is slowly tilted, as seen from it: gravity turns downhill by the angle a(t), of unchanged size.

	z'' = -g sin(a) d - g (1 - cos(a)) e_z,   with d the downhill direction; together with the scene's gravity (0, 0, -g):  g sin(a) d - g cos(a) e_z.
	What a table's own rotation adds (centrifugal and Euler forces, rate^2 times distance) is left out: it is small where this is quasi-static.

	:param rate: at which the table turns between its smooth start and end [rad/s], > 0
	:param upTo: angle to which it turns [rad], in (0, pi/2]
	:param direction: downhill, where things slide to: 'x', '-y', or three numbers, horizontal
	:param gravity: that of the scene, which NewtonIntegrator.gravity has downwards [m/s2]; the loop of `engines` has 9.81 unless told
	:param ease: time in which the rate rises, and in which it falls, by half a cosine [s], at least 4 samples, at most upTo / rate
	:param hold: time at the last angle [s], >= 0; afterwards the load is gone
	:returns: Motion with synthetic=True; tiltAt gives the angle at a time
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	checkPositive(rate, "rate", "rad/s")
	if not (isFinite(upTo) and 0 < upTo <= math.pi / 2):
		raise ValueError(f"upTo is {upTo!r}; allowed is 0 < upTo <= pi/2 rad")
	checkPositive(gravity, "gravity", "m/s2")
	downhill = _horizontal(direction)
	angles = _ramp(upTo, upTo / rate, ease, hold)
	acceleration = -gravity * (np.outer(np.sin(angles), downhill) + np.outer(1 - np.cos(angles), (0, 0, 1)))
	text = f"synthetic loading: table tilted to {math.degrees(upTo):.4g} degrees at {math.degrees(rate):.3g} degrees/s, downhill {directionName(downhill)}"
	return Motion(interval, acceleration, text, synthetic=True)


def tiltAt(motion, time, gravity=9.81):
	"""Angle of a tiltingTable [rad] at times since its first sample [s]; 0 before and after, as for GroundMotion.

	:param motion: Motion made by tiltingTable
	:param time: [s], a number or (k,)
	:param gravity: that it was made with [m/s2]
	:returns: [rad], a number or (k,)

	>>> float(tiltAt(tiltingTable(rate=0.1, upTo=0.5), 8.0).round(9))  # held
	0.5
	"""
	load = loadAt(motion, time)
	return np.arctan2(np.linalg.norm(load[..., :2], axis=-1), gravity - load[..., 2])


def pushover(upTo, direction="x", rate=None, duration=None, ease=0.5, hold=5.0):
	"""A push on every body in proportion to its mass, which grows evenly: z'' = -a(t) d.

	:param upTo: last acceleration [m/s2], > 0; over gravity it is the largest base shear coefficient that is applied
	:param direction: that the bodies are pushed in: 'x', '-y', or three numbers
	:param rate: of growth between smooth start and end [m/s3], > 0; or
	:param duration: of the growth without easing, upTo / rate [s], > 0: the ramp takes `ease` longer
	:param ease: time in which the rate rises, and in which it falls, by half a cosine [s], at least 4 samples, at most upTo / rate
	:param hold: time at the last acceleration [s], >= 0; afterwards the load is gone
	:returns: Motion with synthetic=True; loadAt gives the push at a time
	:raises ValueError: naming the argument, its value and what is allowed
	"""
	checkPositive(upTo, "upTo", "m/s2")
	if (rate is None) == (duration is None):
		raise ValueError(f"rate is {rate!r} and duration {duration!r}; allowed is exactly one of them")
	if duration is None:
		checkPositive(rate, "rate", "m/s3")
		duration = upTo / rate
	checkPositive(duration, "duration", "s")
	pushed = directionVector(direction)
	sizes = _ramp(upTo, duration, ease, hold)
	text = f"synthetic loading: push to {upTo:.4g} m/s2 ({upTo / standardGravity:.3g} g) along {directionName(pushed)}"
	return Motion(interval, -np.outer(sizes, pushed), text, synthetic=True)


def loadAt(motion, time):
	"""What a motion applies to bodies, -z'' [m/s2], at times since its first sample [s]: linear between samples, zero before and after, as GroundMotion
	does it.

	:param motion: Motion
	:param time: [s], a number or (k,)
	:returns: (3,), or (k, 3)
	"""
	columns = [np.interp(time, motion.times(), -motion.acceleration[:, axis], left=0.0, right=0.0) for axis in range(3)]
	return np.stack(columns, axis=-1)


def _horizontal(direction):
	vector = directionVector(direction)
	if abs(vector[2]) > 1e-12:
		raise ValueError(f"direction is {direction!r}; allowed are horizontal directions")
	return vector


def _ramp(upTo, growth, ease, hold):
	"""Samples of a load that grows to `upTo` in growth + ease seconds, whose rate rises and falls by half a cosine, and stays there."""
	if not (isFinite(hold) and hold >= 0):
		raise ValueError(f"hold is {hold!r}; allowed is a finite number >= 0 s")
	if not (isFinite(ease) and 4 * interval <= ease <= growth):
		raise ValueError(f"ease is {ease!r}; allowed are {4 * interval:g} to {growth:g} s, the time of an even growth")
	times = np.arange(math.ceil((growth + ease + hold) / interval - 1e-9) + 1) * interval
	return upTo / growth * (_eased(times, ease) - _eased(times - growth, ease))


def _eased(times, ease):
	"""Integral of a rate that rises from 0 to 1 by half a cosine in `ease` seconds."""
	inside = np.clip(times, 0, ease)
	return 0.5 * (inside - ease / math.pi * np.sin(math.pi * inside / ease)) + np.maximum(0, times - ease)
