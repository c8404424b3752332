# SPDX-License-Identifier: GPL-2.0-or-later
# A ground motion as a paper shows it: acceleration, velocity and displacement by component, and the response spectrum beside them.
# As in picture, matplotlib's Agg canvas is used directly, so that neither a window system nor a backend matters.
"""Figure of a ground motion: `motionPlot`."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .motion import axisNames, standardGravity
from .spectrum import responseSpectrum, usualPeriods

componentColors = ("#1f4e79", "#c0562f", "#3d7a4a")
_fontSize = 10
_histories = (("acceleration", "g"), ("velocity", "m/s"), ("displacement", "m"))


def motionPlot(path, motion, periods=usualPeriods, damping=0.05, target=None, before=None, title=None, width=10.0, dpi=150):
	"""Saves acceleration [g], velocity and displacement over time, by component with their largest values, and the pseudo-acceleration spectrum.

	:param path: PNG file, or another that matplotlib's Agg or vector backends write (pdf, svg)
	:param motion: Motion
	:param periods: of the spectrum [s]
	:param damping: of the spectrum, share of critical
	:param target: (label, periods [s], accelerations [m/s2]) of a spectrum to compare with
	:param before: another Motion, such as the record before it was processed, drawn thin behind
	:param title: by default the motion's name
	:param width: [inches]; dpi: pixels per inch
	:raises ValueError: for a motion without any acceleration
	"""
	moving = np.flatnonzero(motion.peak())
	if not len(moving):
		raise ValueError(f"{motion.name}: all accelerations are 0; there is nothing to draw")
	figure = Figure(figsize=(width, 0.56 * width), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	grid = figure.add_gridspec(3, 2, width_ratios=(1.65, 1))
	axes = [figure.add_subplot(grid[0, 0])]
	axes += [figure.add_subplot(grid[row, 0], sharex=axes[0]) for row in (1, 2)]
	_drawHistories(axes, motion, moving, before)
	figure.align_ylabels(axes)
	_drawSpectrum(figure.add_subplot(grid[:, 1]), motion, moving, periods, damping, target, before)
	figure.suptitle(_wrapped(title or motion.name), fontsize=_fontSize + 2)
	figure.savefig(path)


def _drawHistories(axes, motion, moving, before):
	for ax, (quantity, unit) in zip(axes, _histories):
		largest = []
		if before is not None:
			_, values = _history(before, quantity)
			for axis in moving:
				ax.plot(before.times(), values[:, axis], color="#b3b3b3", linewidth=0.8)
		times, values = _history(motion, quantity)
		for axis in moving:
			ax.plot(times, values[:, axis], color=componentColors[axis], linewidth=0.9)
			largest.append(f"{axisNames[axis]}: {np.abs(values[:, axis]).max():.3g} {unit}")
		ax.set_ylabel(f"{quantity} [{unit}]", fontsize=_fontSize)
		ax.text(0.995, 0.96, "largest  " + ",  ".join(largest), transform=ax.transAxes, ha="right", va="top", fontsize=_fontSize - 2,
		        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 1})  # yapf: disable
		ax.set_ylim(*np.array(ax.get_ylim()) * (1.0, 1.18) if ax.get_ylim()[1] > 0 else ax.get_ylim())  # room for these words
		_dress(ax)
		ax.margins(x=0)
		ax.tick_params(labelbottom=ax is axes[-1])
	axes[-1].set_xlabel("time [s]", fontsize=_fontSize)


def _history(motion, quantity):
	values = motion.acceleration / standardGravity if quantity == "acceleration" else getattr(motion, quantity)()
	return motion.times(), values


def _drawSpectrum(ax, motion, moving, periods, damping, target, before):
	if before is not None:
		found = responseSpectrum(before, periods, damping)
		for axis in moving:
			ax.plot(found.periods, found.of(axisNames[axis]) / standardGravity, color="#b3b3b3", linewidth=1.0, label="before" if axis == moving[0] else None)
	found = responseSpectrum(motion, periods, damping)
	for axis in moving:
		ax.plot(found.periods, found.of(axisNames[axis]) / standardGravity, color=componentColors[axis], linewidth=1.5, label=f"along {axisNames[axis]}")
	if target is not None:
		label, wantedPeriods, wanted = target
		ax.plot(wantedPeriods, np.asarray(wanted) / standardGravity, color="black", linewidth=1.2, linestyle=(0, (5, 2)), label=label)
	ax.set_xscale("log")
	ax.set_xlim(found.periods[found.periods > 0].min(), found.periods.max())
	ax.set_ylim(bottom=0)
	ax.set_xticks([tick for tick in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10) if ax.get_xlim()[0] <= tick <= ax.get_xlim()[1]])
	ax.xaxis.set_major_formatter("{x:g}")
	ax.xaxis.set_minor_formatter("")
	ax.set_xlabel("period [s]", fontsize=_fontSize)
	ax.set_ylabel(f"pseudo-acceleration, {100 * damping:g} % damping [g]", fontsize=_fontSize)
	ax.legend(frameon=False, fontsize=_fontSize - 1)
	_dress(ax)


def _dress(ax):
	ax.grid(color="#dddddd", linewidth=0.6)
	ax.tick_params(labelsize=_fontSize - 1)
	for side in ("top", "right"):
		ax.spines[side].set_visible(False)


def _wrapped(text, width=110):
	"""A long name in lines that the figure has room for."""
	import textwrap
	return "\n".join(textwrap.wrap(text, width))
