# SPDX-License-Identifier: GPL-2.0-or-later
# What a ground motion is, and what can be done with one: scaling, resampling, cutting, tapering, correcting, turning, combining.
# Files: motionFiles. Made ones: synthetic, pulses, spectrumCompatible, quasiStatic. Spectra and measures: spectrum, intensity.
# The engine that applies a motion to a scene is GroundMotion. SciPy is loaded only by the operations that need it.
"""Ground motions and their operations. SI units; an operation leaves its motion as it is and returns another, whose name says what was done."""

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from . import baseline
from .checks import checkPositive, isFinite

#: Standard gravity [m/s2] (CODATA, exact by definition): the g of a file given in g.
standardGravity = 9.80665

axisNames = ("x", "y", "z")

#: What a strength may be taken of: one component, the largest of the three, the vector's length, or the geometric mean of the two
#: horizontal components.
strengthMeasures = (*axisNames, "largest", "vector", "geometricMean")

#: Share of the peak velocity that may be left at the end of a motion before a base that is moved by it is said to drift.
allowedResidual = 0.01


class Residual(NamedTuple):
	"""What is left when a motion ends.

	:param velocity: (3,) [m/s]; a base that is moved goes on at it
	:param displacement: (3,) [m]
	:param share: length of the velocity over the largest in the motion [-]; 0 without any
	"""

	velocity: np.ndarray
	displacement: np.ndarray
	share: float


@dataclass(frozen=True)
class Motion:
	"""Ground acceleration sampled at equal intervals, linear in between; the first sample is at time 0.

	Before the first sample and after the last the engine GroundMotion has an acceleration of zero. A scene that is seen from the ground
	(inertia forces) then stands in plain gravity. A base that is moved (GroundMotion.ids) goes on at the velocity that the motion ended with:
	see `residual`, `baselineCorrected`, `highPassed`, `endingAtRest`.

	:param dt: sampling interval [s], > 0
	:param acceleration: (n, 3) array [m/s2], world axes x, y, z, n >= 2; copied, and read-only afterwards
	:param name: what it is, for titles and files; the name of a synthetic motion has to say "synthetic"
	:param synthetic: True for a motion that no instrument recorded
	:raises ValueError: for a dt, shape, value or name outside these

	>>> shake = Motion(0.5, [[0, 0, 0], [2, 0, 0], [0, 0, 0]], name="one spike")
	>>> shake.duration, shake.peak().tolist(), shake.velocity()[-1, 0]
	(1.0, [2.0, 0.0, 0.0], 1.0)
	>>> shake.scaledToPeak(3).name
	'one spike, scaled to 3 m/s2 (largest)'
	"""

	dt: float
	acceleration: np.ndarray
	name: str
	synthetic: bool = False

	def __post_init__(self):
		checkPositive(self.dt, "dt", "s")
		try:
			values = np.array(self.acceleration, dtype=float)
		except (TypeError, ValueError, OverflowError):
			raise ValueError(f"acceleration is {self.acceleration!r}; allowed are n rows of three numbers") from None
		if values.ndim != 2 or values.shape[1] != 3 or values.shape[0] < 2:
			raise ValueError(f"acceleration has the shape {values.shape}; allowed is (n, 3) with n >= 2")
		wrong = np.argwhere(~np.isfinite(values))
		if len(wrong):
			row, axis = wrong[0]
			raise ValueError(f"acceleration of sample {row} along {axisNames[axis]} is {values[row, axis]}; allowed are finite numbers [m/s2]")
		if not isinstance(self.name, str) or not self.name:
			raise ValueError(f"name is {self.name!r}; a motion needs one that is a text and not empty")
		if self.synthetic and "synthetic" not in self.name.lower():
			raise ValueError(f"name is {self.name!r}; the name of a synthetic motion has to contain 'synthetic'")
		values.setflags(write=False)
		object.__setattr__(self, "dt", float(self.dt))
		object.__setattr__(self, "acceleration", values)

	def __len__(self):
		return len(self.acceleration)

	@property
	def duration(self):
		"""Time of the last sample [s]."""
		return (len(self) - 1) * self.dt

	def times(self):
		"""Time of each sample, (n,) [s]."""
		return np.arange(len(self)) * self.dt

	def peak(self):
		"""Largest absolute acceleration along x, y, z, (3,) [m/s2]."""
		return np.abs(self.acceleration).max(axis=0)

	def velocity(self):
		"""Ground velocity, (n, 3) [m/s], from rest: the exact integral of what is linear between samples."""
		return baseline.runningIntegral(self.acceleration, self.dt)

	def displacement(self):
		"""Ground displacement, (n, 3) [m], from rest at zero: exact too, as GroundMotion moves a base."""
		return baseline.displacementOf(self.acceleration, self.dt)

	def residual(self):
		"""Residual: velocity and displacement at the end, and whether that velocity is much (`allowedResidual`)."""
		velocity = self.velocity()
		speeds = np.linalg.norm(velocity, axis=1)
		return Residual(velocity[-1], self.displacement()[-1], float(speeds[-1] / speeds.max()) if speeds.max() else 0.0)

	# Strength

	def scaled(self, factor):
		"""The motion with every acceleration multiplied by `factor` (finite)."""
		if not isFinite(factor):
			raise ValueError(f"factor is {factor!r}; allowed are finite numbers")
		return Motion(self.dt, self.acceleration * factor, f"{self.name} x {factor:g}", self.synthetic)

	def peakOf(self, of="largest"):
		"""Peak ground acceleration [m/s2] of a component 'x', 'y' or 'z'; 'largest': of the strongest component; 'vector': of the length of the
		acceleration vector at a time; 'geometricMean': square root of the product of the peaks along x and y.
		"""
		if of == "vector":
			return float(np.linalg.norm(self.acceleration, axis=1).max())
		return strengthOf(self.peak(), of)

	def scaledToPeak(self, acceleration, of="largest"):
		"""The motion with all components multiplied by one factor, so that its peakOf(of) is `acceleration`.

		:param acceleration: [m/s2], > 0
		:raises ValueError: for a motion without any of that, or an unknown `of`
		"""
		checkPositive(acceleration, "acceleration", "m/s2")
		return self._multiplied(acceleration, self.peakOf(of), f"scaled to {acceleration:g} m/s2 ({of})")

	def scaledToSpectralAcceleration(self, acceleration, period, damping=0.05, of="largest"):
		"""The motion with all components multiplied by one factor, so that its pseudo-acceleration at a period is `acceleration`.

		:param acceleration: [m/s2], > 0
		:param period: of the oscillator [s], > 0
		:param damping: of the oscillator, share of critical, 0 <= damping < 1
		:param of: as in peakOf, but 'vector'
		"""
		from .spectrum import responseSpectrum
		checkPositive(acceleration, "acceleration", "m/s2")
		found = strengthOf(responseSpectrum(self, [period], damping).pseudoAcceleration[0], of)
		return self._multiplied(acceleration, found, f"scaled to Sa({period:g} s, {100 * damping:g} %) = {acceleration:g} m/s2 ({of})")

	# Time

	def resampled(self, dt, bandLimited=False):
		"""The motion at another interval; it ends at the last multiple of dt within the duration.

		Coarser: run through an anti-alias filter without phase shift, which passes 80 % of the new Nyquist frequency 1/(2 dt) and stops above it;
		the peak may fall. Finer: linear between samples, which is the same motion, since GroundMotion is linear there; or, if asked,
		band-limited by the same filter, which adds nothing above the old Nyquist frequency and rounds the corners off.

		:param dt: new interval [s], > 0; a filter meets it to a millionth, by the nearest ratio of whole numbers up to 1000
		:param bandLimited: for a finer interval, down to a thousandth
		:raises ValueError: when fewer than two samples would be left, or for more than a thousand in place of one by a filter
		"""
		checkPositive(dt, "dt", "s")
		# A duration that is a whole number of new intervals keeps its last sample in spite of round-off.
		count = int(math.floor(self.duration / dt * (1 + 1e-12))) + 1
		if count < 2:
			raise ValueError(f"dt is {dt} s; allowed is at most the motion's duration, {self.duration} s")
		if dt > self.dt * (1 + 1e-12) or bandLimited:
			values = _filteredAt(self.acceleration, self.dt, dt)[:count]
			return self._changed(values, f"resampled to {dt:g} s ({'band-limited' if dt <= self.dt else 'anti-alias filter'})", dt)
		times = np.arange(count) * dt
		columns = [np.interp(times, self.times(), self.acceleration[:, axis]) for axis in range(3)]
		return self._changed(np.column_stack(columns), f"resampled to {dt:g} s (linear)", dt)

	def between(self, begin, end):
		"""The samples from `begin` to `end` [s], 0 <= begin < end <= duration. The new motion starts from rest, so the velocity at `begin` is lost:
		taper and correct it, or see `residual`.
		"""
		if not (isFinite(begin) and isFinite(end) and 0 <= begin < end <= self.duration * (1 + 1e-12)):
			raise ValueError(f"begin is {begin!r} and end {end!r}; allowed are 0 <= begin < end <= {self.duration:g} s")
		first, last = math.ceil(begin / self.dt - 1e-9), math.floor(end / self.dt + 1e-9)
		return self._changed(self.acceleration[first:last + 1], f"{begin:g} to {end:g} s")

	def padded(self, before=0.0, after=0.0):
		"""The motion with zeros before and after, each for so many seconds >= 0, to the next whole interval."""
		for name, value in (("before", before), ("after", after)):
			if not (isFinite(value) and value >= 0):
				raise ValueError(f"{name} is {value!r}; allowed is a finite number >= 0 s")
		counts = [math.ceil(value / self.dt - 1e-9) for value in (before, after)]
		return self._changed(np.pad(self.acceleration, (counts, (0, 0))), f"padded by {before:g} s and {after:g} s")

	# Corrections

	def tapered(self, begin, end=None):
		"""The motion faded in and out by half a cosine (with begin = end a Tukey window), to zero at its first and last sample.

		:param begin: length of the beginning that is faded [s], >= 0
		:param end: likewise of the end; as `begin` unless given
		:raises ValueError: for lengths that together exceed the duration
		"""
		end = begin if end is None else end
		if not (isFinite(begin) and isFinite(end) and begin >= 0 and end >= 0 and begin + end <= self.duration * (1 + 1e-12)):
			raise ValueError(f"begin is {begin!r} and end {end!r}; allowed are lengths >= 0, together at most the duration of {self.duration:g} s")
		times, window = self.times(), np.ones(len(self))
		for length, distance in ((begin, times), (end, self.duration - times)):
			if length > 0:
				window *= 0.5 * (1 - np.cos(math.pi * np.clip(distance / length, 0, 1)))
		return self._changed(self.acceleration * window[:, None], f"tapered over {begin:g} s and {end:g} s")

	def baselineCorrected(self, degree=1, endDisplacement=False):
		"""The motion less the polynomial in time whose integral fits its velocity best and leaves a last velocity of zero.

		:param degree: of the polynomial in the acceleration, 0 to 10; 0: a constant
		:param endDisplacement: True: the last displacement is zero as well, which takes a degree of at least 1. A permanent displacement, as
			near a fault, is then lost
		:raises ValueError: naming what is wrong; a motion may have too few samples for the degree
		"""
		least = 1 if endDisplacement else 0
		if not isinstance(degree, int) or isinstance(degree, bool) or not least <= degree <= 10:
			raise ValueError(f"degree is {degree!r}; allowed is a whole number from {least} to 10")
		if len(self) < degree + 3:
			raise ValueError(f"degree is {degree} for {len(self)} samples; allowed is at most {len(self) - 3}")
		values = baseline.withoutPolynomial(self.acceleration, self.dt, degree, endDisplacement)
		return self._changed(values, f"baseline corrected (degree {degree}{', back to zero' if endDisplacement else ''})")

	def highPassed(self, frequency, order=2):
		"""The motion without its slow part: a Butterworth filter run forwards and backwards, so that nothing is shifted in time.

		Zeros are added at both ends, 1.5 order / frequency seconds each, and stay: in them the filter fades out, and a motion cut to its old
		length would drift again. So everything happens that much later. The displacement goes back to where it began.

		:param frequency: corner [Hz], below 1 / (2 dt): there, a quarter of the power passes
		:param order: of the filter each way, 1 to 8
		"""
		if not (isFinite(frequency) and 0 < frequency < 0.5 / self.dt):
			raise ValueError(f"frequency is {frequency!r}; allowed is a number of Hz > 0 and < {0.5 / self.dt:g}, the Nyquist frequency")
		if not isinstance(order, int) or isinstance(order, bool) or not 1 <= order <= 8:
			raise ValueError(f"order is {order!r}; allowed is a whole number from 1 to 8")
		padding = baseline.highPassPadding(frequency, order, self.dt) * self.dt
		return self._changed(
		        baseline.highPassed(self.acceleration, self.dt, frequency, order),
		        f"high-pass {frequency:g} Hz (order {order} both ways, {padding:g} s of zeros at each end)"
		)

	def endingAtRest(self, seconds=1.0):
		"""The motion with an end in which its last velocity is braked smoothly to zero; the record itself stays as it is, and the base comes to rest
		where it then is.

		:param seconds: length of the braking [s], at least 4 dt; its largest acceleration is 2 v / seconds
		"""
		checkPositive(seconds, "seconds", "s")
		if seconds < 4 * self.dt:
			raise ValueError(f"seconds is {seconds}; allowed is at least 4 dt = {4 * self.dt:g} s")
		count = math.ceil(seconds / self.dt - 1e-9)
		left = self.velocity()[-1] + 0.5 * self.dt * self.acceleration[-1]  # the interval to the first braking sample, which is zero, counts
		braking = -np.outer(1 - np.cos(2 * math.pi * np.arange(count + 1) / count), left / (count * self.dt))
		return self._changed(np.vstack([self.acceleration, braking]), f"brought to rest in {seconds:g} s")

	# Direction

	def rotated(self, angle):
		"""The motion turned about the vertical, from x towards y [rad]: what was along x goes along (cos angle, sin angle)."""
		if not isFinite(angle):
			raise ValueError(f"angle is {angle!r}; allowed is a finite number of radians")
		cosine, sine = math.cos(angle), math.sin(angle)
		x, y, z = self.acceleration.T
		return self._changed(np.column_stack([x * cosine - y * sine, x * sine + y * cosine, z]), f"turned by {math.degrees(angle):g} degrees")

	def _changed(self, acceleration, what, dt=None):
		return Motion(self.dt if dt is None else dt, acceleration, f"{self.name}, {what}", self.synthetic)

	def _multiplied(self, wanted, found, what):
		if not found > 0:
			raise ValueError(f"{self.name}: found is {found:g} m/s2; allowed is a motion that has some of what is to be scaled to {wanted:g} m/s2")
		return self._changed(self.acceleration * (wanted / found), what)


def strengthOf(components, of):
	"""One number for three strengths along x, y, z, see strengthMeasures; the vector's length cannot be told from them."""
	allowed = [measure for measure in strengthMeasures if measure != "vector"]
	if not isinstance(of, str) or of not in allowed:
		raise ValueError(f"of is {of!r}; allowed are {', '.join(map(repr, allowed))}, and 'vector' for peaks")
	if of == "largest":
		return float(max(components))
	if of == "geometricMean":
		return math.sqrt(components[0] * components[1])
	return float(components[axisNames.index(of)])


def directionVector(direction):
	"""A unit vector for a direction: 'x', '-y' and the like, or three numbers that are not all zero.

	>>> directionVector("-y").tolist(), directionVector((3, 4, 0)).tolist()
	([0.0, -1.0, 0.0], [0.6, 0.8, 0.0])
	"""
	wrong = ValueError(f"direction is {direction!r}; allowed are 'x', 'y', 'z', '-x', '-y', '-z', or three finite numbers, not all 0")
	if isinstance(direction, str):
		if direction.lstrip("-") not in axisNames or len(direction) > 2:
			raise wrong
		vector = np.zeros(3)
		vector[axisNames.index(direction[-1])] = -1 if direction[0] == "-" else 1
		return vector
	try:
		vector = np.array([float(value) for value in direction])
	except (TypeError, ValueError, OverflowError):
		raise wrong from None
	length = np.linalg.norm(vector) if vector.shape == (3,) else 0
	if not (math.isfinite(length) and length > 0):
		raise wrong
	return vector / length


def directionName(vector):
	"""Short name of a direction, for titles: +x, or (0.6, 0.8, 0)."""
	for axis, name in enumerate(axisNames):
		if abs(abs(vector[axis]) - 1) < 1e-12:
			return ("+" if vector[axis] > 0 else "-") + name
	return f"({', '.join(f'{value:.3g}' for value in vector)})"


def axisIndex(axis):
	if not isinstance(axis, str) or axis not in axisNames:
		raise ValueError(f"axis is {axis!r}; allowed are 'x', 'y' and 'z'")
	return axisNames.index(axis)


def combineComponents(motions, name=None, pad=False, dt=None):
	"""One motion out of components, each along its own axes.

	:param motions: motions of equal dt; no two of them may move along the same axis
	:param name: by default the names, joined
	:param pad: True lengthens shorter components by zeros, as is usual where the files of a record differ by a few samples
	:param dt: common interval [s] that each is resampled to first (Motion.resampled); None: all have to have the same
	:raises ValueError: for none, for different dt, for different lengths without `pad`, for two motions along one axis
	"""
	motions = list(motions)
	if not motions:
		raise ValueError("motions is empty; at least one component is needed")
	if dt is not None:
		motions = [motion.resampled(dt) for motion in motions]
	length = max(len(motion) for motion in motions)
	acceleration = np.zeros((length, 3))
	owner = {}
	for motion in motions:
		if not math.isclose(motion.dt, motions[0].dt, rel_tol=1e-9):
			raise ValueError(f"{motion.name}: dt is {motion.dt} s; allowed is the {motions[0].dt} s of {motions[0].name} (or dt=..., to resample all)")
		if len(motion) != length and not pad:
			raise ValueError(f"{motion.name}: {len(motion)} samples found; allowed are {length}, as in the longest component (or pad=True)")
		for axis in np.flatnonzero(motion.peak()):
			if axis in owner:
				raise ValueError(f"{motion.name}: moves along {axisNames[axis]}, as {owner[axis]} does; allowed is one motion an axis")
			owner[axis] = motion.name
			acceleration[:len(motion), axis] = motion.acceleration[:, axis]
	return Motion(motions[0].dt, acceleration, name or " + ".join(motion.name for motion in motions), any(motion.synthetic for motion in motions))


#: The filter of resampling: corner over the lower Nyquist frequency, half length in samples of the coarser motion, and Kaiser's beta:
#: within 0.1 % up to 80 % of that frequency, below 0.1 % from it on.
_filterCorner, _filterReach, _filterBeta = 0.9, 32, 8.0


def _filteredAt(acceleration, oldDt, newDt):
	"""The samples at multiples of newDt, low-pass filtered without phase shift; zero before and after."""
	from scipy.signal import firwin, resample_poly
	if not oldDt / 1000 <= newDt <= 1000 * oldDt:
		raise ValueError(f"dt is {newDt} s; allowed with a filter are {oldDt / 1000} to {1000 * oldDt} s, a thousandth to a thousand times the motion's own")
	ratio = Fraction(oldDt / newDt).limit_denominator(1000)
	if ratio == 1:
		return acceleration
	longer = max(ratio.numerator, ratio.denominator)
	taps = firwin(2 * _filterReach * longer + 1, _filterCorner / longer, window=("kaiser", _filterBeta))
	return resample_poly(acceleration, ratio.numerator, ratio.denominator, axis=0, window=taps)
