# SPDX-License-Identifier: GPL-2.0-or-later
# Accelerograms in files: PEER's AT2 as its databases give it, and plain columns or CSV. Every reader says file, line, what it found and
# what is allowed, because a file that is read wrongly gives a plausible motion.
"""Reading and writing ground motions. SI units inside, whatever the file holds."""

import math
import os
import re

import numpy as np

from .checks import checkPositive
from .motion import Motion, axisIndex, axisNames, combineComponents, standardGravity

#: Units an acceleration file may be in, and what one of them is in m/s2.
accelerationUnits = {"m/s2": 1.0, "g": standardGravity, "cm/s2": 0.01}


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
_at2NumbersFirst = re.compile(r"^\s*(\S+?)[\s,]+(\S+?)[\s,]+NPTS\s*,?\s*DT\b", re.IGNORECASE)
_at2HeaderLines = 4


def readAt2(path, axis="x", name=None):
	"""One component of a record in PEER's AT2 format, as the NGA databases give it.

	Four header lines, the last with `NPTS= n, DT= x SEC` or, as older files have it, `n x NPTS, DT`; then accelerations in g, several a line,
	in fixed width, so that numbers may touch. The VT2 and DT2 files beside it hold velocity and displacement, and are refused.

	:param path: the file
	:param axis: world axis 'x', 'y' or 'z' that the component is applied along
	:param name: name of the motion; by default the file's name and its second header line (event and station)
	:returns: Motion, in m/s2
	:raises ValueError: naming file, line, what was found and what is allowed: no header, no NPTS or DT, another quantity than
		acceleration or another unit than g, text or NaN among the values, a number of values other than NPTS
	:raises OSError: for a file that cannot be read
	"""
	column = axisIndex(axis)
	_checkExtension(path)
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


_otherQuantities = {"VELOCITY": ".VT2", "DISPLACEMENT": ".DT2"}


def _checkExtension(path):
	for quantity, extension in _otherQuantities.items():
		if os.path.splitext(path)[1].upper() == extension:
			raise ValueError(f"{path}: a {extension[1:]} file holds {quantity.lower()}; allowed is the AT2 file of the same record, with its acceleration")


def _at2Header(path, lines):
	"""NPTS and DT [s] of the four header lines."""
	header = " ".join(lines[:_at2HeaderLines]).upper()
	for quantity in _otherQuantities:
		if f"{quantity} TIME" in header:
			raise ValueError(f"{path}, line 3: a {quantity.lower()} found; allowed is an acceleration time series in units of g (the record's AT2 file)")
	unit = re.search(r"UNITS?\s+OF\s+(\S+)", header)
	if unit and unit.group(1).strip(".,;()") not in ("G", "G'S", "GS"):
		raise ValueError(f"{path}, line 3: the unit {unit.group(1)!r} found; allowed in an AT2 file is g (other units: readColumns)")
	line = lines[_at2HeaderLines - 1]
	count, interval = _at2CountAndInterval(line)
	if count is None:
		raise ValueError(f"{path}, line {_at2HeaderLines}: {line.strip()!r} found; it has to say 'NPTS= n, DT= x SEC' or 'n x NPTS, DT'")
	if not re.fullmatch(r"\d+", count) or int(count) < 2:
		raise ValueError(f"{path}, line {_at2HeaderLines}: NPTS is {count!r}; allowed is a whole number >= 2")
	if not _number.fullmatch(interval) or not float(interval) > 0:
		raise ValueError(f"{path}, line {_at2HeaderLines}: DT is {interval!r}; allowed is a number of seconds > 0")
	return int(count), float(interval)


def _at2CountAndInterval(line):
	"""The two texts of the fourth line, or None twice."""
	numbersFirst = _at2NumbersFirst.search(line)
	if numbersFirst:
		return numbersFirst.groups()
	count, interval = _at2Count.search(line), _at2Interval.search(line)
	return (count.group(1), interval.group(1)) if count and interval else (None, None)


def _motionOfFile(path, dt, acceleration, name, synthetic=False):
	try:
		return Motion(dt, acceleration, name, synthetic)
	except ValueError as error:
		raise ValueError(f"{path}: {error}") from None


#: How far a written time may be from an exact multiple of the interval, in intervals. Times rounded to two or three digits pass
#: (0.0078125 s written as 0.008 would need 0.06); a missing or repeated sample is off by a third at least.
timeTolerance = 0.1


def readColumns(path, units=None, dt=None, axes=None, name=None):
	"""Accelerations in plain columns, separated by blanks, tabs, commas or semicolons.

	Lines that start with # or % are comments, one line of headings without any number may come first. With `dt`, every column is
	an acceleration; without, the first column is the time [s], in equal steps, and the motion starts at its first row.

	:param path: the file
	:param units: 'm/s2', 'g' or 'cm/s2' (gal); may be left out only where a comment of the file says it (`# units: g`), as writeColumns does,
		because a wrong guess gives a plausible motion
	:param dt: sampling interval [s] of a file without times, else None
	:param axes: world axes of the acceleration columns, such as 'x' or 'xz'; by default x, then y, then z
	:param name: name of the motion; by default the one that writeColumns left in the file, or the file's name
	:returns: Motion, in m/s2; synthetic when the file's comments say `synthetic: yes`
	:raises ValueError: naming file, line, what was found and what is allowed: text, NaN or infinity, a missing value, another number
		of columns than in the first row, times not in equal steps, fewer than two rows; units that nobody says, or other ones than the file's
	:raises OSError: for a file that cannot be read
	"""
	if units is not None and (not isinstance(units, str) or units not in accelerationUnits):
		raise ValueError(f"units is {units!r}; allowed are {', '.join(map(repr, accelerationUnits))}")
	if dt is not None:
		checkPositive(dt, "dt", "s")
	rows, rowLines, comments = _numericRows(path)
	first = 1 if dt is None else 0
	columns = _columnAxes(path, rowLines[0], rows.shape[1] - first, axes)
	if dt is None:
		dt = _uniformInterval(path, rows[:, 0], rowLines)
	acceleration = np.zeros((len(rows), 3))
	acceleration[:, columns] = rows[:, first:] * accelerationUnits[_unitsOf(path, units, comments.get("units"))]
	synthetic = comments.get("synthetic") == "yes"
	return _motionOfFile(path, dt, acceleration, name or comments.get("name") or os.path.basename(path), synthetic)


def _unitsOf(path, asked, said):
	"""The units that are asked for or said in the file, which must not contradict each other."""
	known = said in accelerationUnits
	if asked is None and not known:
		found = "does not say its units" if said is None else f"says the units {said!r}"
		raise ValueError(f"{path}: the file {found}; give units: allowed are {', '.join(map(repr, accelerationUnits))}")
	if asked is not None and known and asked != said:
		raise ValueError(f"{path}: units is {asked!r}, but the file says {said!r}; allowed is the latter, or none")
	return asked or said


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
	columns = [axisIndex(axis) for axis in axes]
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


def readAt2Components(x=None, y=None, z=None, name=None, pad=False, dt=None):
	"""Up to three AT2 files, each applied along its axis; parameters and errors as in readAt2 and combineComponents, where `pad` evens different
	lengths out and `dt` different intervals.
	"""
	paths = {axis: path for axis, path in zip(axisNames, (x, y, z)) if path is not None}
	return combineComponents([readAt2(path, axis) for axis, path in paths.items()], name, pad, dt)


def writeColumns(motion, path):
	"""Writes time [s] and the accelerations along x, y, z [m/s2] so that readColumns(path) gives the motion back, with its
	name and whether it is synthetic; numbers to 12 digits.
	"""
	with open(path, "w", encoding="latin-1", errors="replace") as file:
		file.write(f"# name: {' '.join(motion.name.split())}\n# synthetic: {'yes' if motion.synthetic else 'no'}\n# units: m/s2\n")
		file.write("# time [s], acceleration along x, y, z [m/s2]\n")
		for time, row in zip(motion.times(), motion.acceleration):
			file.write(" ".join(f"{value:.12g}" for value in (time, *row)) + "\n")
