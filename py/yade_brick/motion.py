# SPDX-License-Identifier: GPL-2.0-or-later
# Ground motions: what a recorded or synthetic accelerogram is, the file formats it is read from (PEER AT2, plain columns),
# and the synthetic near-fault motion that stands in where no record may be shipped.
# Needs numpy only; the engine that applies a motion to a scene is GroundMotion.
"""Ground motions: reading, combining, making and writing accelerograms. SI units inside, whatever the file holds."""

import math
import os
import re
from dataclasses import dataclass

import numpy as np

from .checks import isFinite

#: Standard gravity [m/s2] (CODATA, exact by definition): the g of a file given in g.
standardGravity = 9.80665

#: Units an acceleration file may be in, and what one of them is in m/s2.
accelerationUnits = {"m/s2": 1.0, "g": standardGravity, "cm/s2": 0.01}

axisNames = ("x", "y", "z")


@dataclass(frozen=True)
class Motion:
	"""Ground acceleration sampled at equal intervals; the first sample is at time 0.

	:param dt: sampling interval [s], > 0
	:param acceleration: (n, 3) array [m/s2], world axes x, y, z, n >= 2; copied, and read-only afterwards
	:param name: what it is, for titles and files; the name of a synthetic motion has to say "synthetic"
	:param synthetic: True for a motion that no instrument recorded
	:raises ValueError: for a dt, shape, value or name outside these

	>>> shake = Motion(0.5, [[0, 0, 0], [2, 0, 0], [0, 0, 0]], name="one spike")
	>>> shake.duration, shake.peak().tolist(), shake.velocity()[-1, 0]
	(1.0, [2.0, 0.0, 0.0], 1.0)
	"""

	dt: float
	acceleration: np.ndarray
	name: str
	synthetic: bool = False

	def __post_init__(self):
		_checkInterval(self.dt, "dt")
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
		"""Ground velocity, (n, 3) [m/s], from rest, by the trapezoidal rule."""
		return _integral(self.acceleration, self.dt)

	def displacement(self):
		"""Ground displacement, (n, 3) [m], from rest at zero, by the trapezoidal rule applied twice."""
		return _integral(self.velocity(), self.dt)

	def scaled(self, factor):
		"""The motion with every acceleration multiplied by `factor` (finite)."""
		if not isFinite(factor):
			raise ValueError(f"factor is {factor!r}; allowed are finite numbers")
		return Motion(self.dt, self.acceleration * factor, f"{self.name} x {factor:g}", self.synthetic)

	def resampled(self, dt):
		"""The motion at a finer interval, linear between samples; it ends at the last multiple of dt within the duration.

		:param dt: new interval [s], 0 < dt <= the present one
		:raises ValueError: for a coarser interval: frequencies above 1/(2 dt) would come back as false lower ones
		"""
		_checkInterval(dt, "dt")
		if dt > self.dt * (1 + 1e-12):
			raise ValueError(f"dt is {dt} s; allowed is at most the motion's own {self.dt} s, since a coarser sampling needs a filter first")
		# A duration that is a whole number of new intervals keeps its last sample in spite of round-off.
		times = np.arange(int(math.floor(self.duration / dt * (1 + 1e-12))) + 1) * dt
		columns = [np.interp(times, self.times(), self.acceleration[:, axis]) for axis in range(3)]
		return Motion(dt, np.column_stack(columns), self.name, self.synthetic)


def _areNumbers(values, count):
	return isinstance(values, (list, tuple, np.ndarray)) and len(values) == count and all(isFinite(value) for value in values)


def _checkInterval(value, name):
	if not (isFinite(value) and value > 0):
		raise ValueError(f"{name} is {value!r}; allowed is a finite number of seconds > 0")


def _integral(values, dt):
	"""Trapezoidal running integral along axis 0, zero at the first sample."""
	result = np.zeros_like(values)
	np.cumsum(0.5 * dt * (values[1:] + values[:-1]), axis=0, out=result[1:])
	return result


def _axisIndex(axis):
	if not isinstance(axis, str) or axis not in axisNames:
		raise ValueError(f"axis is {axis!r}; allowed are 'x', 'y' and 'z'")
	return axisNames.index(axis)


# Files


def _readLines(path):
	with open(path, encoding="latin-1") as file:
		lines = file.read().splitlines()
	if not any(line.strip() for line in lines):
		raise ValueError(f"{path}: the file is empty")
	return lines


# Fixed-width columns may leave no space between two values (1.2E-02-3.6E-01): a sign or a second point starts a new number.
_number = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d{1,3})?")
_at2Count = re.compile(r"NPTS\s*=\s*(\S*?)\s*(?:,|\s|$)", re.IGNORECASE)
_at2Interval = re.compile(r"\bDT\s*=\s*(\S*?)\s*(?:,|SEC|\s|$)", re.IGNORECASE)
_at2HeaderLines = 4


def readAt2(path, axis="x", name=None):
	"""One component of a record in PEER's AT2 format, as the NGA databases give it.

	Four header lines, the last with `NPTS= n, DT= x SEC`, then accelerations in g, several a line, in fixed width.

	:param path: the file
	:param axis: world axis 'x', 'y' or 'z' that the component is applied along
	:param name: name of the motion; by default the file's name and its second header line (event and station)
	:returns: Motion, in m/s2
	:raises ValueError: naming file, line, what was found and what is allowed: no header, no NPTS or DT, another quantity than
		acceleration or another unit than g, text or NaN among the values, a number of values other than NPTS
	:raises OSError: for a file that cannot be read
	"""
	column = _axisIndex(axis)
	lines = _readLines(path)
	if len(lines) <= _at2HeaderLines:
		raise ValueError(f"{path}: {len(lines)} lines found; an AT2 file has {_at2HeaderLines} header lines and then values")
	count, dt = _at2Header(path, lines)
	values = []
	for lineNumber, line in enumerate(lines[_at2HeaderLines:], _at2HeaderLines + 1):
		rest = _number.sub(" ", line).replace(",", " ").split()
		if rest:
			raise ValueError(f"{path}, line {lineNumber}: {rest[0]!r} found; allowed are finite numbers only")
		values.extend(float(text.upper().replace("D", "E")) for text in _number.findall(line))
	if len(values) != count:
		raise ValueError(f"{path}, line {len(lines)}: the file ends after {len(values)} values; its header announces NPTS = {count}")
	acceleration = np.zeros((count, 3))
	acceleration[:, column] = np.array(values) * standardGravity
	return _motionOfFile(path, dt, acceleration, name or " ".join([os.path.basename(path), lines[1].strip()]).strip())


def _at2Header(path, lines):
	"""NPTS and DT [s] of the four header lines."""
	header = " ".join(lines[:_at2HeaderLines]).upper()
	for quantity in ("VELOCITY TIME", "DISPLACEMENT TIME"):
		if quantity in header:
			raise ValueError(f"{path}, line 3: a {quantity.split()[0].lower()} found; allowed is an acceleration time series in units of g")
	unit = re.search(r"UNITS?\s+OF\s+(\S+)", header)
	if unit and unit.group(1).strip(".,;()") not in ("G", "G'S", "GS"):
		raise ValueError(f"{path}, line 3: the unit {unit.group(1)!r} found; allowed in an AT2 file is g (other units: readColumns)")
	line = lines[_at2HeaderLines - 1]
	count, interval = _at2Count.search(line), _at2Interval.search(line)
	if not count or not interval:
		raise ValueError(f"{path}, line {_at2HeaderLines}: {line.strip()!r} found; it has to say 'NPTS= n, DT= x SEC'")
	if not re.fullmatch(r"\d+", count.group(1)) or int(count.group(1)) < 2:
		raise ValueError(f"{path}, line {_at2HeaderLines}: NPTS is {count.group(1)!r}; allowed is a whole number >= 2")
	if not _number.fullmatch(interval.group(1)) or not float(interval.group(1)) > 0:
		raise ValueError(f"{path}, line {_at2HeaderLines}: DT is {interval.group(1)!r}; allowed is a number of seconds > 0")
	return int(count.group(1)), float(interval.group(1))


def _motionOfFile(path, dt, acceleration, name, synthetic=False):
	try:
		return Motion(dt, acceleration, name, synthetic)
	except ValueError as error:
		raise ValueError(f"{path}: {error}") from None


#: How far a written time may be from an exact multiple of the interval, in intervals. Times rounded to two or three digits pass
#: (0.0078125 s written as 0.008 would need 0.06); a missing or repeated sample is off by a third at least.
timeTolerance = 0.1


def readColumns(path, units, dt=None, axes=None, name=None):
	"""Accelerations in plain columns, separated by blanks, tabs, commas or semicolons.

	Lines that start with # or % are comments, one line of headings without any number may come first. With `dt`, every column is
	an acceleration; without, the first column is the time [s], in equal steps, and the motion starts at its first row.

	:param path: the file
	:param units: 'm/s2', 'g' or 'cm/s2' (gal); there is no default, because a wrong guess gives a plausible motion
	:param dt: sampling interval [s] of a file without times, else None
	:param axes: world axes of the acceleration columns, such as 'x' or 'xz'; by default x, then y, then z
	:param name: name of the motion; by default the one that writeColumns left in the file, or the file's name
	:returns: Motion, in m/s2; synthetic when the file's comments say `synthetic: yes`
	:raises ValueError: naming file, line, what was found and what is allowed: text, NaN or infinity, a missing value, another number
		of columns than in the first row, times not in equal steps, fewer than two rows
	:raises OSError: for a file that cannot be read
	"""
	if not isinstance(units, str) or units not in accelerationUnits:
		raise ValueError(f"units is {units!r}; allowed are {', '.join(map(repr, accelerationUnits))}")
	if dt is not None:
		_checkInterval(dt, "dt")
	rows, rowLines, comments = _numericRows(path)
	first = 1 if dt is None else 0
	columns = _columnAxes(path, rowLines[0], rows.shape[1] - first, axes)
	if dt is None:
		dt = _uniformInterval(path, rows[:, 0], rowLines)
	acceleration = np.zeros((len(rows), 3))
	acceleration[:, columns] = rows[:, first:] * accelerationUnits[units]
	synthetic = comments.get("synthetic") == "yes"
	return _motionOfFile(path, dt, acceleration, name or comments.get("name") or os.path.basename(path), synthetic)


def _numericRows(path):
	"""The rows of numbers, (n, columns), the line number of each, and the `# key: value` comments as a dict."""
	rows, rowLines, comments = [], [], {}
	headingAllowed = True
	for lineNumber, line in enumerate(_readLines(path), 1):
		text = line.strip()
		if text.startswith(("#", "%")):
			key, separator, value = text.lstrip("#% ").partition(":")
			if separator:
				comments[key.strip().lower()] = value.strip()
			continue
		if not text:
			continue
		fields = text.split(";") if ";" in text else re.split(r"\s*,\s*|\s+", text)
		numbers = [_floatOrNone(field) for field in fields]
		if headingAllowed and all(number is None for number in numbers):
			headingAllowed = False
			continue
		headingAllowed = False
		for field, number in zip(fields, numbers):
			if number is None or not math.isfinite(number):
				raise ValueError(f"{path}, line {lineNumber}: {field!r} found; allowed are finite numbers with a decimal point")
		if rows and len(numbers) != len(rows[0]):
			raise ValueError(f"{path}, line {lineNumber}: {len(numbers)} columns found; allowed are the {len(rows[0])} of line {rowLines[0]}")
		rows.append(numbers)
		rowLines.append(lineNumber)
	if len(rows) < 2:
		raise ValueError(f"{path}: {len(rows)} rows of numbers found; a motion needs at least 2")
	return np.array(rows), rowLines, comments


def _floatOrNone(text):
	try:
		return float(text)
	except ValueError:
		return None


def _columnAxes(path, lineNumber, found, axes):
	"""Axis index of each acceleration column."""
	if axes is None:
		if not 1 <= found <= 3:
			raise ValueError(f"{path}, line {lineNumber}: {found} acceleration columns found; allowed are 1 to 3 (without dt the first is time)")
		return list(range(found))
	columns = [_axisIndex(axis) for axis in axes]
	if len(set(columns)) != len(columns) or not columns:
		raise ValueError(f"axes is {axes!r}; allowed are different letters out of x, y and z")
	if len(columns) != found:
		raise ValueError(f"{path}, line {lineNumber}: {found} acceleration columns found; axes {axes!r} names {len(columns)}")
	return columns


def _uniformInterval(path, times, rowLines):
	"""The interval of equally spaced times [s]; ValueError where they are not."""
	dt = (times[-1] - times[0]) / (len(times) - 1)
	for row in range(1, len(times)):
		if not times[row] > times[row - 1]:
			raise ValueError(f"{path}, line {rowLines[row]}: time {times[row]:g} s found after {times[row - 1]:g} s; allowed are rising times")
	offset = np.abs(times - times[0] - dt * np.arange(len(times)))
	if offset.max() > timeTolerance * dt:
		# The first step that differs from the usual one is the place to look at, not the row that drifted farthest.
		steps = np.diff(times)
		usual = np.median(steps)
		row = 1 + int(np.argmax(np.abs(steps - usual) > timeTolerance * usual))
		raise ValueError(
		        f"{path}, line {rowLines[row]}: time {times[row]:g} s found, {steps[row - 1]:g} s after the one before, "
		        f"where the usual step is {usual:g} s; allowed are equal steps"
		)
	return float(dt)


def combineComponents(motions, name=None, pad=False):
	"""One motion out of components, each along its own axes.

	:param motions: motions of equal dt; no two of them may move along the same axis
	:param name: by default the names, joined
	:param pad: True lengthens shorter components by zeros, as is usual where the files of a record differ by a few samples
	:raises ValueError: for none, for different dt, for different lengths without `pad`, for two motions along one axis
	"""
	motions = list(motions)
	if not motions:
		raise ValueError("motions is empty; at least one component is needed")
	length = max(len(motion) for motion in motions)
	acceleration = np.zeros((length, 3))
	owner = {}
	for motion in motions:
		if not math.isclose(motion.dt, motions[0].dt, rel_tol=1e-9):
			raise ValueError(f"{motion.name}: dt is {motion.dt} s; allowed is the {motions[0].dt} s of {motions[0].name}")
		if len(motion) != length and not pad:
			raise ValueError(f"{motion.name}: {len(motion)} samples found; allowed are {length}, as in the longest component (or pad=True)")
		for axis in np.flatnonzero(motion.peak()):
			if axis in owner:
				raise ValueError(f"{motion.name}: moves along {axisNames[axis]}, as {owner[axis]} does; allowed is one motion an axis")
			owner[axis] = motion.name
			acceleration[:len(motion), axis] = motion.acceleration[:, axis]
	return Motion(motions[0].dt, acceleration, name or " + ".join(motion.name for motion in motions), any(motion.synthetic for motion in motions))


def readAt2Components(x=None, y=None, z=None, name=None, pad=False):
	"""Up to three AT2 files, each applied along its axis; parameters and errors as in readAt2 and combineComponents."""
	paths = {axis: path for axis, path in zip(axisNames, (x, y, z)) if path is not None}
	return combineComponents([readAt2(path, axis) for axis, path in paths.items()], name, pad)


def writeColumns(motion, path):
	"""Writes time [s] and the accelerations along x, y, z [m/s2] so that readColumns(path, 'm/s2') gives the motion back, with its
	name and whether it is synthetic; numbers to 12 digits.
	"""
	with open(path, "w", encoding="latin-1", errors="replace") as file:
		file.write(f"# name: {' '.join(motion.name.split())}\n# synthetic: {'yes' if motion.synthetic else 'no'}\n")
		file.write("# time [s], acceleration along x, y, z [m/s2]\n")
		for time, row in zip(motion.times(), motion.acceleration):
			file.write(" ".join(f"{value:.12g}" for value in (time, *row)) + "\n")


# The synthetic motion


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


def _edgeTaper(times, duration, length):
	"""1 inside, falling to 0 at both ends over `length` [s] by half a cosine."""
	edge = np.clip(np.minimum(times, duration - times) / length, 0.0, 1.0)
	return 0.5 * (1 - np.cos(math.pi * edge))


def _withoutDrift(acceleration, window, dt):
	"""Acceleration minus window * (straight line), so that velocity and displacement both end at zero by the trapezoidal rule."""
	ramp = np.linspace(-1.0, 1.0, len(acceleration))
	columns = np.column_stack([acceleration, window, window * ramp])
	velocity = _integral(columns, dt)
	ends = np.vstack([velocity[-1], _integral(velocity, dt)[-1]])
	level, slope = np.linalg.solve(ends[:, 1:], ends[:, 0])
	return acceleration - (level + slope * ramp) * window


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
	window = _edgeTaper(times, duration, _taperLength)
	pulse = sum(
	        velocityPulse(times, strength * pulseVelocity, pulsePeriod, centre)[1] for strength, centre in zip((1.0, -_secondShare), phaseTimes)
	)
	envelope = _phaseEnvelope(times, phaseTimes[0], 0.6) + _secondShare * _phaseEnvelope(times, phaseTimes[1], 0.6) + _quietShare
	noise = _groundNoise(times, duration, seed) * envelope * window
	pulse, noise = _withoutDrift(pulse * window, window, dt), _withoutDrift(noise, window, dt)
	strongest = np.abs(pulse).max()
	if not strongest < peak:
		raise ValueError(f"pulseVelocity is {pulseVelocity} m/s: the pulses alone reach {strongest:.3g} m/s2; they have to stay below peak, {peak:.3g}")
	return pulse + _noiseShare(pulse, noise, peak) * noise


def _checkSynthetic(duration, dt, peak, pulsePeriod, pulseVelocity, phaseTimes, ratios, seed):
	for name, value in (("duration", duration), ("dt", dt), ("pulsePeriod", pulsePeriod)):
		_checkInterval(value, name)
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
