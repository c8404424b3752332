# SPDX-License-Identifier: GPL-2.0-or-later
# Fragility curves: the probability of collapse, or of another state of damage, against the intensity of shaking, estimated from runs that did or did
# not collapse. The estimate is a lognormal distribution of capacity by maximum likelihood [Baker 2015, Earthquake Spectra 31(1), 579-599], which is probit
# regression on the logarithm of intensity; bands and intervals come from likelihood ratios, which hold for few runs too, and where no curve can be fitted.
"""Fragility curves: fitting, confidence, plot."""

import math
import textwrap
from typing import NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, LogLocator

from .checks import isFinite


class Fragility(NamedTuple):
	"""A fitted curve, P(collapse | x) = Phi(ln(x / median) / dispersion), with the runs that it was fitted to.

	:param median: intensity at which half of the runs collapse; NaN where the runs have no single best curve
	:param dispersion: standard deviation of the logarithm of capacity; NaN likewise
	:param note: why there is no curve, in words; None where there is one
	:param intensities: the levels (n,), rising
	:param collapsed: runs that collapsed at each (n,)
	:param runs: runs at each (n,)
	"""

	median: float
	dispersion: float
	note: str
	intensities: np.ndarray
	collapsed: np.ndarray
	runs: np.ndarray

	def probability(self, intensity):
		"""P(collapse) at intensities > 0, of the same shape; NaN where there is no curve."""
		from scipy.special import ndtr
		return ndtr(np.log(np.asarray(intensity, dtype=float) / self.median) / self.dispersion)

	def band(self, intensity, level=0.95):
		"""Confidence band of P(collapse), pointwise: at each intensity the probabilities that no likelihood ratio test rejects among all lognormal curves.

		:param intensity: (m,) > 0
		:param level: of confidence, between 0 and 1
		:returns: lower and upper ends, two (m,) arrays
		"""
		return _Region(self, level).band(np.log(np.asarray(intensity, dtype=float)))

	def medianInterval(self, level=0.95):
		"""Confidence interval of the median: the intensities at which the band contains one half; 0 or infinity where the runs set no bound."""
		return _Region(self, level).medianInterval()

	def dispersionInterval(self, level=0.95):
		"""Confidence interval of the dispersion by likelihood ratio; 0 or infinity where the runs set no bound."""
		return _Region(self, level).dispersionInterval()

	def facts(self):
		"""For result.json."""
		region = _Region(self, 0.95)
		return {
		        "median": self.median, "dispersion": self.dispersion, "note": self.note, "medianInterval": region.medianInterval(),
		        "dispersionInterval": region.dispersionInterval(), "intensities": self.intensities, "collapsed": self.collapsed, "runs": self.runs
		}


def fitFragility(intensities, collapsed, runs=None):
	"""The fragility curve of greatest likelihood.

	:param intensities: of each run, or of each level (n,), > 0, such as the peak ground acceleration in m/s2
	:param collapsed: whether each run collapsed; with `runs`, how many did at each level
	:param runs: None, or the number of runs at each level
	:returns: Fragility. Where runs do not determine a curve (none collapsed, or all; those that did all stronger than those that did not; one level;
		collapse not more frequent with intensity) median and dispersion are NaN and its note says why; the band and the intervals are valid nevertheless
	:raises ValueError: for intensities that are not > 0, other outcomes than these, no run

	>>> fit = fitFragility([2.0, 4.0], [10, 30], runs=[40, 40])  # a quarter and three quarters
	>>> round(fit.median, 6), round(fit.dispersion, 4)  # ln 2 is 2 x 0.6745 dispersions
	(2.828427, 0.5138)
	"""
	levels, counts, totals = _byLevel(*_checkedRuns(intensities, collapsed, runs))
	note = _noCurve(levels, counts, totals)
	if note is None:
		median, dispersion = _greatestLikelihood(levels, counts, totals)
		if dispersion > 0:
			return Fragility(median, dispersion, None, levels, counts, totals)
		note = "collapse is not more frequent at higher intensities"
	return Fragility(math.nan, math.nan, note, levels, counts, totals)


def lognormalCapacity(capacities):
	"""Median and dispersion of collapse intensities, one for each motion, as an incremental dynamic analysis finds them: mean and standard deviation of the
	logarithms [Baker 2015, eqs. 1 and 2].

	:param capacities: (n,) > 0, n >= 2
	:returns: (median, dispersion)
	:raises ValueError: for other capacities

	>>> median, dispersion = lognormalCapacity([1.0, 4.0])
	>>> round(median, 6), round(dispersion, 6) == round(math.log(4) / math.sqrt(2), 6)
	(2.0, True)
	"""
	values = _array(capacities, "capacities")
	if len(values) < 2 or not (values > 0).all():
		raise ValueError(f"capacities is {capacities!r}; allowed are at least two intensities > 0")
	return float(np.exp(np.log(values).mean())), float(np.log(values).std(ddof=1))


# What is given


def _array(values, name):
	try:
		array = np.array([float(value) for value in values])
	except (TypeError, ValueError, OverflowError):
		raise ValueError(f"{name} is {values!r}; allowed are finite numbers") from None
	if not np.isfinite(array).all():
		raise ValueError(f"{name} is {values!r}; allowed are finite numbers")
	return array


def _checkedRuns(intensities, collapsed, runs):
	levels, counts = _array(intensities, "intensities"), _array(collapsed, "collapsed")
	totals = np.ones(len(levels)) if runs is None else _array(runs, "runs")
	if not len(levels):
		raise ValueError("intensities is empty; at least one run is needed")
	if not (levels > 0).all():
		raise ValueError(f"intensities are {levels.tolist()}; allowed are numbers > 0")
	if not len(levels) == len(counts) == len(totals):
		raise ValueError(f"there are {len(levels)} intensities, {len(counts)} outcomes and {len(totals)} numbers of runs; allowed is one of each")
	whole = (counts == np.round(counts)) & (totals == np.round(totals))
	wrong = np.flatnonzero(~(whole & (counts >= 0) & (counts <= totals) & (totals > 0)))
	if len(wrong):
		i = wrong[0]
		raise ValueError(f"collapsed at intensity {levels[i]:g} is {collapsed[i]!r} of {totals[i]:g} runs; allowed are whole numbers from 0 to the number of runs")
	return levels, counts, totals


def _byLevel(levels, counts, totals):
	"""Runs of equal intensity together, rising."""
	found, place = np.unique(levels, return_inverse=True)
	return found, np.bincount(place, counts), np.bincount(place, totals)


def _checkLevel(level):
	if not (isFinite(level) and 0 < level < 1):
		raise ValueError(f"level is {level!r}; allowed are numbers between 0 and 1")


def _noCurve(levels, counts, totals):
	"""Why the likelihood has no greatest value at a finite curve, in words; None where it has one."""
	if not counts.any():
		return f"none of {totals.sum():.0f} runs collapsed: the median is above {levels[-1]:g}"
	if (counts == totals).all():
		return f"all of {totals.sum():.0f} runs collapsed: the median is below {levels[0]:g}"
	if len(levels) == 1:
		return f"all runs are of the intensity {levels[0]:g}: they say nothing of the dispersion"
	standing, fallen = levels[counts < totals], levels[counts > 0]
	if standing[-1] <= fallen[0]:
		return f"no run that stood was stronger than one that collapsed: the median is from {standing[-1]:g} to {fallen[0]:g}, and the dispersion has no lower bound"
	if fallen[-1] <= standing[0]:
		return "collapse is not more frequent at higher intensities"
	return None


# Likelihood: lines eta = a + b z, P = Phi(eta), where z is the logarithm of intensity, moved and scaled for good numbers


def _logarithms(levels, totals):
	"""z of the levels, and the shift and scale that make ln(intensity) of it."""
	x = np.log(levels)
	shift, scale = np.average(x, weights=totals), x.std() or 1.0
	return (x - shift) / scale, shift, scale


def _logLikelihood(a, b, z, counts, totals):
	from scipy.special import log_ndtr
	eta = a + b * z
	return float(counts @ log_ndtr(eta) + (totals - counts) @ log_ndtr(-eta))


def _greatestLikelihood(levels, counts, totals):
	"""Median and dispersion of greatest likelihood; the likelihood is log-concave, so that there is one. The dispersion is < 0 where collapse gets rarer."""
	from scipy.optimize import root
	from scipy.special import log_ndtr, ndtri
	z, shift, scale = _logarithms(levels, totals)

	def gradient(line):
		eta = line[0] + line[1] * z
		logDensity = -0.5 * eta**2 - 0.5 * math.log(2 * math.pi)
		rate = counts * np.exp(logDensity - log_ndtr(eta)) - (totals - counts) * np.exp(logDensity - log_ndtr(-eta))
		return [rate.sum(), (rate * z).sum()]

	share = np.clip(counts.sum() / totals.sum(), 0.01, 0.99)
	a, b = root(gradient, [ndtri(share), 0.0], options={"xtol": 1e-13}).x
	return math.exp(shift - scale * a / b), scale / b


class _Region:
	"""The lines with b >= 0 whose likelihood is not too small beside the greatest: for each of some slopes b the range of a. Log-likelihood is concave, so
	that the region is convex and these ranges have no gaps; what holds for all its lines is a confidence interval by likelihood ratio.
	"""

	steepest = 1e3  # as good as a step
	slopeCount = 121

	def __init__(self, fit, level):
		from scipy.special import ndtri
		_checkLevel(level)
		self.z, self.shift, self.scale = _logarithms(fit.intensities, fit.runs)
		self.counts, self.totals = fit.collapsed, fit.runs
		self.bestSlope = [math.log1p(self.scale / fit.dispersion)] if fit.note is None else []
		self.allowed = self.greatest(fit) - 0.5 * ndtri(0.5 + 0.5 * level)**2  # half the chi square of one degree of freedom
		flattest, steepest = self.slopeRange()
		self.slopes = np.expm1(np.linspace(math.log1p(flattest), math.log1p(steepest), self.slopeCount))
		self.low, self.high = np.array([self.interceptRange(slope) for slope in self.slopes]).T

	def at(self, a, b):
		return _logLikelihood(a, b, self.z, self.counts, self.totals)

	def greatest(self, fit):
		"""The greatest log-likelihood; without a curve what lines come as near to as one likes: that of a step, or of the same probability everywhere."""
		if fit.note is None:
			return self.at((self.shift - math.log(fit.median)) / fit.dispersion, self.scale / fit.dispersion)
		best = _binomial(self.counts.sum(), self.totals.sum())
		for place in range(len(self.z)):
			if not self.counts[:place].any() and (self.counts == self.totals)[place + 1:].all():
				best = max(best, _binomial(self.counts[place], self.totals[place]))  # a step at this level, where any probability is possible
		return best

	def bestIntercept(self, b):
		from scipy.optimize import minimize_scalar
		reach = (-b * self.z[-1] - 9, -b * self.z[0] + 9)
		found = minimize_scalar(lambda a: -self.at(a, b), bounds=reach, method="bounded", options={"xatol": 1e-7})
		return found.x, -found.fun

	def slopeRange(self):
		"""Slopes of the flattest and the steepest line."""
		excess = lambda t: self.bestIntercept(math.expm1(t))[1] - self.allowed
		grid = np.unique([*np.linspace(0, math.log1p(self.steepest), 20), *self.bestSlope])  # the most likely slope is in the region, however small that is
		values = np.array([excess(t) for t in grid])
		first, last = np.flatnonzero(values >= 0)[[0, -1]]
		flattest = grid[0] if first == 0 else _zero(excess, grid[first - 1], grid[first])
		steepest = grid[-1] if last == len(grid) - 1 else _zero(excess, grid[last], grid[last + 1])
		return math.expm1(flattest), math.expm1(steepest)

	def interceptRange(self, b):
		"""Lowest and highest a of lines of slope b; infinite where no run bounds it."""
		best, likelihood = self.bestIntercept(b)
		if likelihood <= self.allowed:
			return best, best  # the tip of the region
		excess = lambda a: self.at(a, b) - self.allowed
		ends = (-b * self.z[-1] - 40, -b * self.z[0] + 40)
		return tuple(sign * math.inf if excess(end) >= 0 else _zero(excess, *sorted((best, end))) for sign, end in zip((-1, 1), ends))

	def band(self, x):
		from scipy.special import ndtr
		z = (x - self.shift) / self.scale
		rise = np.multiply.outer(z, self.slopes)
		return ndtr((rise + self.low).min(axis=-1)), ndtr((rise + self.high).max(axis=-1))

	def medianInterval(self):
		"""Where lines cross one half."""
		with np.errstate(divide="ignore"):
			lowest, highest = (-self.high / self.slopes).min(), (-self.low / self.slopes).max()
		with np.errstate(over="ignore"):
			return tuple(float(np.exp(self.shift + self.scale * z)) for z in (lowest, highest))

	def dispersionInterval(self):
		flattest, steepest = self.slopes[[0, -1]]
		return (0.0 if steepest > 0.99 * self.steepest else float(self.scale / steepest), float(self.scale / flattest) if flattest > 0 else math.inf)


def _zero(function, low, high):
	from scipy.optimize import brentq
	return brentq(function, low, high, xtol=1e-8)


def _binomial(count, total):
	"""Greatest log-likelihood of `count` events in `total` runs of one probability."""
	return sum(float(k * math.log(k / total)) for k in (count, total - count) if k > 0)


# Plot


_fontSize = 11
_colors = ("#1f4e79", "#c0562f", "#3d7a4a", "#7b4b94")


def fragilityPlot(path, fits, intensityLabel, stateLabel="collapse", title=None, level=0.95, limits=None, width=7.0, dpi=150):
	"""Saves fragility curves: observed shares with the number of runs, fitted curves, and their confidence bands.

	:param path: PNG file, or PDF or SVG by its ending
	:param fits: Fragility, or a dict from name to Fragility
	:param intensityLabel: what the intensity is, with unit
	:param stateLabel: what the probability is of
	:param title: text above; motions made by us have to be called synthetic there or in the caption
	:param level: of confidence of the bands
	:param limits: (lowest, highest) intensity shown, > 0; by default around the runs
	:param width: [inches]
	:param dpi: pixels per inch
	:raises ValueError: for no fit and for arguments outside these
	"""
	fits = fits if isinstance(fits, dict) else {"": fits}
	if not fits or not all(isinstance(fit, Fragility) for fit in fits.values()):
		raise ValueError(f"fits is {fits!r}; allowed is a Fragility, or a dict from name to Fragility, of at least one")
	_checkLevel(level)
	low, high = _limits(fits.values()) if limits is None else limits
	if not (isFinite(low) and isFinite(high) and 0 < low < high):
		raise ValueError(f"limits is {limits!r}; allowed are two finite rising intensities > 0")
	figure = Figure(figsize=(width, 0.68 * width), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	ax = figure.subplots()
	at = np.geomspace(low, high, 90)
	for (name, fit), color in zip(fits.items(), _colors * len(fits)):
		_drawFit(ax, fit, at, level, color, name)
	_dress(ax, intensityLabel, stateLabel, (low, high))
	_legend(figure, ax, level)
	if title:
		ax.set_title(title, fontsize=_fontSize + 1)
	figure.savefig(path)


def _limits(fits):
	levels = np.concatenate([fit.intensities for fit in fits])
	return levels.min() / 1.25, levels.max() * 1.25


def _drawFit(ax, fit, at, level, color, name):
	lower, upper = fit.band(at, level)
	ax.fill_between(at, lower, upper, color=color, alpha=0.16, linewidth=0)
	prefix = f"{name}: " if name else ""
	if fit.note is None:
		ax.plot(at, fit.probability(at), color=color, linewidth=2, label=f"{prefix}median {fit.median:.3g}, dispersion {fit.dispersion:.2f}")
	else:
		ax.plot([], [], color=color, linewidth=2, linestyle=":", label=textwrap.fill(f"{prefix}no curve: {fit.note}", 80))
	shares, sizes = fit.collapsed / fit.runs, 24 + 60 * fit.runs / fit.runs.max()
	ax.scatter(fit.intensities, shares, s=sizes, facecolor="white", edgecolor=color, linewidth=1.4, zorder=4)
	if len(fit.intensities) <= 12:
		for x, share, collapsed, runs in zip(fit.intensities, shares, fit.collapsed, fit.runs):
			place = (0, 9) if share < 0.9 else (0, -16)
			text = ax.annotate(f"{collapsed:.0f}/{runs:.0f}", (x, share), place, textcoords="offset points", ha="center", fontsize=_fontSize - 2, color=color, zorder=5)
			text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def _dress(ax, intensityLabel, stateLabel, limits):
	ax.set_xscale("log")
	ax.set_xlim(*limits)
	decades = math.log10(limits[1] / limits[0])
	ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades > 1 else (1, 2, 3, 4, 5, 6, 8) if decades > 0.5 else np.arange(1, 10, 0.5)))
	ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
	ax.xaxis.set_minor_formatter("")
	ax.set_ylim(-0.03, 1.03)
	ax.set_xlabel(intensityLabel, fontsize=_fontSize)
	ax.set_ylabel(f"probability of {stateLabel}", fontsize=_fontSize)
	ax.tick_params(labelsize=_fontSize - 1)
	ax.grid(color="#dddddd", linewidth=0.7)
	ax.set_axisbelow(True)


def _legend(figure, ax, level):
	"""In a strip of its own below the axes."""
	handles, _ = ax.get_legend_handles_labels()
	handles += [
	        Patch(facecolor=_colors[0], alpha=0.16, label=f"{100 * level:g} % confidence, pointwise"),
	        Line2D([], [], linestyle="", marker="o", markersize=7, markerfacecolor="white", color=_colors[0], label="runs: collapsed / all"),
	]
	columns = 1 if max(len(handle.get_label()) for handle in handles) > 45 else 3 if len(handles) == 3 else 2
	lines = sum(handle.get_label().count("\n") for handle in handles) + -(-len(handles) // columns)
	strip = (0.2 * lines + 0.15) / figure.get_figheight()
	figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
	figure.legend(handles=handles, loc="lower center", ncol=columns, frameon=False, fontsize=_fontSize - 2)
