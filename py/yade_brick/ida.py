# SPDX-License-Identifier: GPL-2.0-or-later
# Incremental dynamic analysis: each of several motions is made stronger until the structure collapses [Vamvatsikos and Cornell 2002, Earthquake
# Engineering and Structural Dynamics 31(3), 491-514]. Which intensity comes next follows from the results so far alone, so that the runs are an ordinary
# study (study.py) whose table grows, and an interrupted analysis takes the same way again through the results that are there.
"""Incremental dynamic analysis: hunt, bisection, fill; curves, their summary, plot."""

import math
from typing import NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from . import study
from .checks import isFinite


class IdaPoint(NamedTuple):
	"""A run: the intensity, the measure of damage that it left, and whether it collapsed."""

	intensity: float
	measure: float
	collapsed: bool


class IdaCurve(NamedTuple):
	"""The runs of one motion.

	:param name: of the motion
	:param points: IdaPoint of each run, by rising intensity
	:param stands: highest intensity below the first collapse; 0 for none
	:param collapses: lowest intensity of a collapse; infinite where none was found
	:param note: why the analysis of this motion ended early, in words; None where it did not
	"""

	name: str
	points: list
	stands: float
	collapses: float
	note: str

	@property
	def capacity(self):
		"""Collapse intensity: the middle between `stands` and `collapses`; infinite where no collapse was found."""
		return 0.5 * (self.stands + self.collapses)

	def measureAt(self, intensity):
		"""Damage at intensities (m,): linear between runs, infinite beyond the capacity, NaN where there are no runs."""
		standing = [point for point in self.points if point.intensity <= self.stands]
		levels, measures = [0.0] + [point.intensity for point in standing], [0.0] + [point.measure for point in standing]
		at = np.asarray(intensity, dtype=float)
		known = np.interp(at, levels, measures)
		return np.where(at > self.capacity, math.inf, np.where((at > levels[-1]) & (self.collapses == math.inf), math.nan, known))


class HuntAndFill(NamedTuple):
	"""Which intensities are run: upwards from `first` in growing steps until one collapses or `limit` is reached; then halving the interval between the
	highest that stands and the lowest that collapses; then, below, in the middle of the widest gaps. Step i of the hunt is step + i x growth.

	:param first: first intensity, > 0
	:param step: first step, > 0; growth 0 and fill 0 make it an analysis in fixed steps
	:param limit: highest intensity, >= first
	:param growth: by how much each step of the hunt is longer than the one before, >= 0
	:param tolerance: the halving ends when the interval is at most this share of the intensity that collapses, > 0
	:param fill: number of further runs below the collapse, >= 0
	"""

	first: float
	step: float
	limit: float
	growth: float = 0.0
	tolerance: float = 0.05
	fill: int = 0

	def checked(self):
		"""Itself; ValueError for values outside these."""
		for name in ("first", "step", "limit", "tolerance"):
			if not (isFinite(getattr(self, name)) and getattr(self, name) > 0):
				raise ValueError(f"{name} is {getattr(self, name)!r}; allowed is a finite number > 0")
		if not (isFinite(self.growth) and self.growth >= 0):
			raise ValueError(f"growth is {self.growth!r}; allowed is a finite number >= 0")
		if self.limit < self.first:
			raise ValueError(f"limit is {self.limit!r}; allowed is at least first, {self.first:g}")
		if not isinstance(self.fill, int) or isinstance(self.fill, bool) or self.fill < 0:
			raise ValueError(f"fill is {self.fill!r}; allowed is a whole number >= 0")
		return self

	def hunted(self):
		"""The intensities of the hunt, up to the limit."""
		intensity, step = self.first, self.step
		while intensity < self.limit:
			yield _rounded(intensity)
			intensity, step = intensity + step, step + self.growth
		yield _rounded(self.limit)


def _rounded(intensity):
	"""To 6 digits, so that tables and folders are readable."""
	return float(f"{intensity:.6g}")


def nextIntensity(points, plan):
	"""The intensity to run next; None when the curve is complete.

	:param points: IdaPoint of each run so far
	:param plan: HuntAndFill

	>>> points, plan = [], HuntAndFill(first=1.0, step=1.0, limit=8.0, tolerance=0.2)
	>>> while (intensity := nextIntensity(points, plan)) is not None:
	...     points.append(IdaPoint(intensity, 0.01 * intensity, intensity > 2.6))
	>>> [point.intensity for point in points]
	[1.0, 2.0, 3.0, 2.5]
	"""
	return _progress(points, plan)[0]


def _progress(points, plan):
	"""What is to be run next, or None; the highest intensity that stands and the lowest that collapses, as hunt and halving have found them."""
	collapsed, asked = {point.intensity: point.collapsed for point in points}, set()
	stands, collapses = 0.0, math.inf
	for intensity in plan.hunted():
		if intensity not in collapsed:
			return intensity, stands, collapses
		asked.add(intensity)
		if collapsed[intensity]:
			collapses = intensity
			break
		stands = intensity
	while collapses < math.inf and collapses - stands > plan.tolerance * collapses:
		middle = _rounded(0.5 * (stands + collapses))
		if middle not in collapsed:
			return middle, stands, collapses
		asked.add(middle)
		stands, collapses = (stands, middle) if collapsed[middle] else (middle, collapses)
	toFill = len(set(collapsed) - asked) < plan.fill and stands > 0
	return _widestGap([0.0] + sorted(level for level in collapsed if level <= stands)) if toFill else None, stands, collapses


def _widestGap(levels):
	gap = int(np.argmax(np.diff(levels)))
	return _rounded(0.5 * (levels[gap] + levels[gap + 1]))


def curveOf(name, points, plan, note=None):
	"""IdaCurve of the runs of one motion. Where a run of the fill collapsed below others that stood, the lowest collapse counts, and the note says so."""
	_, stands, collapses = _progress(points, plan)
	lowest = min((point.intensity for point in points if point.collapsed), default=math.inf)
	if lowest < collapses:
		note = note or f"collapsed at {lowest:g} although it stood at {stands:g}"
		collapses, stands = lowest, max((point.intensity for point in points if point.intensity < lowest), default=0.0)
	if note is None and collapses == math.inf:
		note = f"no collapse up to {stands:g}"
	return IdaCurve(name, sorted(points), stands, collapses, note)


# Running


def incrementalDynamicAnalysis(table, script, motions, intensity, plan, measure="drift", collapsed="collapsed", **options):
	"""Runs the analysis as a study that grows; interrupted and called again it goes on where it was.

	In each round every motion that is not complete gets its next row, and the rows are run as runStudy does. A motion one of whose runs fails is left there, with
	the reason; the others go on.

	:param table: path of the table that is written
	:param script: path of the script, which reads the parameters of a row and calls yade_brick.study.record
	:param motions: dict from name to the parameters that make the motion, such as {"seed3": {"seed": 3}}; names are of letters, digits and _.,+@^-
	:param intensity: name of the parameter that is the intensity, such as "pga"
	:param plan: HuntAndFill
	:param measure: which entry of the result is the measure of damage; a number >= 0
	:param collapsed: which entry of the result says whether it collapsed; True or False
	:param options: further arguments of runStudy
	:returns: list of IdaCurve, in the order of the motions
	:raises ValueError: for arguments outside these, and a result without these entries
	"""
	plan.checked()
	if not isinstance(motions, dict) or not motions or not all(isinstance(parameters, dict) for parameters in motions.values()):
		raise ValueError(f"motions is {motions!r}; allowed is a dict from name to a dict of parameters, of at least one motion")
	points, notes, rows = {name: [] for name in motions}, {}, {}
	while True:
		wanted = {name: nextIntensity(points[name], plan) for name in motions if name not in notes}
		wanted = {name: level for name, level in wanted.items() if level is not None}
		if not wanted:
			return [curveOf(name, points[name], plan, notes.get(name)) for name in motions]
		rows.update({f"{name}-{intensity}={level:g}": {**motions[name], intensity: level} for name, level in wanted.items()})
		described = {id(row): description for description, row in rows.items()}
		study.writeTable(table, rows.values(), describe=lambda row: described[id(row)])
		states = {state["description"]: state for state in _states(table, script, options)}
		for name, level in wanted.items():
			state = states[f"{name}-{intensity}={level:g}"]
			if state["result"] is None:
				notes[name] = f"run at {level:g} {state['state']}: {state['reason']}; see {state['log']}"
			else:
				points[name].append(_point(level, state["result"], measure, collapsed, state["log"]))


def _states(table, script, options):
	"""The states of all rows, after those were run that had no result."""
	if not options.get("rerun") and all(study.resultOf(row, script) is not None for row in study.readTable(table)):
		return study.collect(table, script)
	return study.runStudy(table, script, **options).rows


def _point(level, result, measure, collapsed, log):
	if not isFinite(result.get(measure)) or result[measure] < 0 or not isinstance(result.get(collapsed), bool):
		raise ValueError(
		        f"the result beside {log} has {measure} {result.get(measure)!r} and {collapsed} {result.get(collapsed)!r}; "
		        f"allowed are a finite number >= 0 and a truth value"
		)
	return IdaPoint(level, float(result[measure]), result[collapsed])


# Summary


def summary(curves, intensities, shares=(0.16, 0.5, 0.84)):
	"""Fractiles of damage over the motions at given intensities; infinite where so many motions have collapsed that the fractile is among them.

	The fractile is the damage of one of the motions (the smallest that so large a share of them does not exceed): collapse has no number to interpolate to. Strong
	damage is a low capacity: the 84 % fractile of damage ends where 16 % of the motions have collapsed.

	:param curves: list of IdaCurve
	:param intensities: (m,)
	:param shares: each in (0, 1)
	:returns: (shares, m) array; NaN beyond the runs of a motion that did not collapse
	"""
	damage = np.sort(np.array([curve.measureAt(intensities) for curve in curves]), axis=0)
	ranks = [_rank(share, len(curves)) for share in shares]
	return np.where(np.isnan(damage).any(axis=0), math.nan, damage[ranks])


def capacityFractiles(curves, shares=(0.16, 0.5, 0.84)):
	"""The intensities at which these shares of the motions have collapsed; infinite where fewer do."""
	capacities = sorted(curve.capacity for curve in curves)
	return [capacities[_rank(share, len(capacities))] for share in shares]


def _rank(share, count):
	"""Place of a fractile among sorted values."""
	return max(0, math.ceil(share * count - 1e-9) - 1)


# Plot


_fontSize = 11
_curveColor, _summaryColors = "#9a9a9a", {0.16: "#3d7a4a", 0.5: "#1f4e79", 0.84: "#c0562f"}


def idaPlot(path, curves, intensityLabel, measureLabel, title=None, limits=None, shares=(0.16, 0.5, 0.84), width=7.0, dpi=150):
	"""Saves the curves of all motions, intensity over damage, with their fractiles; a curve that ends in a horizontal line has collapsed.

	:param path: PNG file, or PDF or SVG by its ending
	:param curves: list of IdaCurve
	:param intensityLabel, measureLabel: what the axes are, with units
	:param title: text above; motions made by us have to be called synthetic there or in the caption
	:param limits: largest damage shown, > 0; by default a little more than the largest without collapse
	:param shares: of the fractiles
	:param width: [inches]
	:param dpi: pixels per inch
	:raises ValueError: for no curve with a run
	"""
	curves = [curve for curve in curves if curve.points]
	if not curves:
		raise ValueError("curves has no curve with a run; at least one is needed")
	standing = [point.measure for curve in curves for point in curve.points if point.intensity <= curve.stands]
	right = limits if limits is not None else 1.25 * max([*standing, 1e-12])
	if not (isFinite(right) and right > 0):
		raise ValueError(f"limits is {limits!r}; allowed is a finite number > 0")
	figure = Figure(figsize=(width, 0.72 * width), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	ax = figure.subplots()
	for index, curve in enumerate(curves):
		_drawCurve(ax, curve, right, f"{len(curves)} motions, each run a point" if index == 0 else None)
	_drawSummary(ax, curves, shares, right)
	ax.set_xlim(0, right)
	ax.set_ylim(0, 1.03 * ax.get_ylim()[1])
	ax.set_xlabel(measureLabel, fontsize=_fontSize)
	ax.set_ylabel(intensityLabel, fontsize=_fontSize)
	ax.tick_params(labelsize=_fontSize - 1)
	ax.grid(color="#dddddd", linewidth=0.7)
	ax.set_axisbelow(True)
	ax.legend(fontsize=_fontSize - 2, loc="lower right", framealpha=0.9)
	if title:
		ax.set_title(title, fontsize=_fontSize + 1)
	figure.savefig(path)


def _drawCurve(ax, curve, right, label):
	standing = [point for point in curve.points if point.intensity <= curve.stands]
	measures, levels = [0.0] + [point.measure for point in standing], [0.0] + [point.intensity for point in standing]
	ax.plot(measures[1:], levels[1:], linestyle="", marker="o", markersize=3.5, color=_curveColor, zorder=3)
	if curve.collapses < math.inf:
		measures, levels = measures + [measures[-1], right], levels + [curve.capacity, curve.capacity]
	ax.plot(measures, levels, color=_curveColor, linewidth=1, label=label)


def _drawSummary(ax, curves, shares, right):
	top = max(min(curve.capacity, curve.points[-1].intensity) for curve in curves)
	levels = np.linspace(0, top, 400)
	capacities = sorted((curve.capacity for curve in curves), reverse=True)
	for share, damage in zip(shares, summary(curves, levels, shares)):
		capacity = capacities[_rank(share, len(curves))]
		finite = np.isfinite(damage)
		measures, at = damage[finite], levels[finite]
		if capacity < math.inf and capacity <= top:
			measures, at = np.append(measures, [measures[-1], right]), np.append(at, [capacity, capacity])
		color = _summaryColors.get(share, "black")
		label = f"{100 * share:g} % fractile, " + (f"collapse at {capacity:.3g}" if capacity < math.inf else "no collapse")
		ax.plot(measures, at, color=color, linewidth=2.2, linestyle="-" if share == 0.5 else "--", label=label, zorder=4)
