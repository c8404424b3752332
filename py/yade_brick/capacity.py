# SPDX-License-Identifier: GPL-2.0-or-later
# Capacity curves: what a structure bears against how far it has moved, from histories of a slow loading, and the collapse multiplier.
"""Capacity curve of a pushover or a tilting table: `capacityCurve`, `capacityPlot`."""

from dataclasses import dataclass

import numpy as np

from .checks import checkPositive


@dataclass(frozen=True)
class CapacityCurve:
	"""Base shear coefficient against control displacement.

	:param displacement: of the control point along the push, (n,) [m]
	:param coefficient: base shear over the weight (or over the normal force that is given), (n,) [-]
	:param applied: coefficient that the load has, (n,) [-]; infinite where it is not known
	:param balanced: number of samples until equilibrium with the load is lost; n if it is not, or not known
	"""

	displacement: np.ndarray
	coefficient: np.ndarray
	applied: np.ndarray
	balanced: int

	@property
	def multiplier(self):
		"""Collapse multiplier: the largest coefficient that was both applied and borne before equilibrium was lost; a lower bound unless `collapsed`."""
		return float(self._borne().max())

	@property
	def displacementAtMultiplier(self):
		"""Control displacement there [m]."""
		return float(self.displacement[int(np.argmax(self._borne()))])

	@property
	def collapsed(self):
		"""Whether the structure lost its equilibrium before the histories end."""
		return self.balanced < len(self.coefficient)

	def _borne(self):
		# What cracking stirs up shakes the base shear about the load; its peaks are no capacity.
		return np.minimum(self.coefficient, self.applied)[:self.balanced]


def capacityCurve(displacement, baseShear, normal, applied=None, tolerance=0.01, patience=50):
	"""The capacity curve from histories of equal length.

	Once more is applied than the structure can bear it accelerates, and the base shear goes on growing for a while with the load: for a block that turns over,
	at a quarter of the load's rate or more. So where `applied` is given, equilibrium counts as lost from where the base shear stays behind the load by more than
	`tolerance`, for `patience` samples in a row or to the end. Without it, the multiplier is simply the largest coefficient, and depends on the rate.

	:param displacement: of a control point along the push, (n,) [m]
	:param baseShear: sum of the forces on the supports along the push, (n,) [N]: in a scene O.forces.f(id) of each support
	:param normal: weight [N], > 0; for a tilting table the sum of the forces on the supports across the table, (n,) [N], each > 0
	:param applied: coefficient that the load has, (n,) [-]: push over gravity, tangent of the tilt; None: unknown
	:param tolerance: [-], > 0
	:param patience: samples, >= 1: longer than half a period of what cracking stirs up
	:returns: CapacityCurve
	:raises ValueError: naming the argument and what is allowed

	>>> curve = capacityCurve([0, 1e-3, 3e-3, 0.1], [0, 10, 15, 12], normal=100, applied=[0, 0.1, 0.15, 0.2])
	>>> curve.multiplier, curve.displacementAtMultiplier, curve.collapsed
	(0.15, 0.003, True)
	"""
	displacement = _history(displacement, "displacement", None)
	baseShear = _history(baseShear, "baseShear", len(displacement))
	if np.ndim(normal):
		normal = _history(normal, "normal", len(displacement))
		if not (normal > 0).all():
			raise ValueError(f"normal falls to {normal.min():g} N; allowed are numbers > 0")
	else:
		checkPositive(normal, "normal", "N")
	checkPositive(tolerance, "tolerance", "(a coefficient)")
	if not isinstance(patience, int) or isinstance(patience, bool) or patience < 1:
		raise ValueError(f"patience is {patience!r}; allowed is a whole number >= 1")
	coefficient = baseShear / normal
	if applied is None:
		return CapacityCurve(displacement, coefficient, np.full(len(coefficient), np.inf), len(coefficient))
	applied = _history(applied, "applied", len(displacement))
	balanced = _lossOf(applied - coefficient <= tolerance, patience)
	if not balanced:
		raise ValueError(f"baseShear is {coefficient[0]:g} of normal at first, behind the {applied[0]:g} that is applied; the histories have to begin at rest")
	return CapacityCurve(displacement, coefficient, applied, balanced)


def _lossOf(holds, patience):
	"""Number of samples before the first stretch of `patience` that do not hold, or one that lasts to the end; all if there is none."""
	begin = 0
	for place, held in enumerate(holds):
		if held:
			begin = place + 1
		elif place + 1 - begin >= patience:
			break
	return begin


def _history(values, name, length):
	try:
		array = np.array(values, dtype=float)
	except (TypeError, ValueError, OverflowError):
		raise ValueError(f"{name} is {values!r}; allowed are finite numbers") from None
	if array.ndim != 1 or len(array) < 2 or not np.isfinite(array).all() or length not in (None, len(array)):
		raise ValueError(f"{name} has the shape {array.shape}; allowed are {length or '2 or more'} finite numbers")
	return array


_colors = ("#1f4e79", "#c0562f", "#3d7a4a", "#7b4b94", "#8a6d1f", "#555555")
_fontSize = 11


def capacityPlot(path, curves, references=None, shown=None, title=None, width=7.0, dpi=150):
	"""Saves capacity curves, each drawn up to its collapse in full and thin after it, with a mark at its multiplier.

	:param path: PNG file, or another that matplotlib writes
	:param curves: dict from label to CapacityCurve
	:param references: dict from label to a coefficient, drawn as a line across, such as that of rigid-body statics
	:param shown: largest displacement that is drawn [m]; None: four times the largest at a multiplier
	:param title: above
	:param width: [inches]; dpi: pixels per inch
	:raises ValueError: for no curve
	"""
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	if not curves:
		raise ValueError("curves is empty; at least one is needed")
	if shown is None:
		shown = 4 * max(curve.displacementAtMultiplier for curve in curves.values())
	figure = Figure(figsize=(width, 0.66 * width), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	ax = figure.subplots()
	for (label, curve), color in zip(curves.items(), _colors * len(curves)):
		x, y = 1e3 * curve.displacement, curve.coefficient
		text = f"{label}: {curve.multiplier:.3f}" + ("" if curve.collapsed else " at least")
		ax.plot(x[:curve.balanced], y[:curve.balanced], color=color, linewidth=1.8, label=text)
		ax.plot(x[max(0, curve.balanced - 1):], y[max(0, curve.balanced - 1):], color=color, linewidth=0.7)
		ax.plot(1e3 * curve.displacementAtMultiplier, curve.multiplier, "o", color=color, markersize=6)
	for (label, value), line in zip((references or {}).items(), ((0, (5, 2)), (0, (1, 1.5)), "dashdot") * len(references or {})):
		ax.axhline(value, color="black", linewidth=1.0, linestyle=line, label=f"{label}: {value:.3f}")
	ax.set_xlim(0, 1e3 * shown)
	ax.set_ylim(0, 1.25 * max([curve.multiplier for curve in curves.values()] + list((references or {}).values())))
	ax.set_xlabel("control displacement [mm]", fontsize=_fontSize)
	ax.set_ylabel("base shear coefficient [-]", fontsize=_fontSize)
	ax.grid(color="#dddddd", linewidth=0.6)
	ax.tick_params(labelsize=_fontSize - 1)
	for side in ("top", "right"):
		ax.spines[side].set_visible(False)
	ax.legend(frameon=False, fontsize=_fontSize - 1, loc="lower right", title="collapse multiplier", title_fontsize=_fontSize - 1,
	          alignment="left")
	if title:
		ax.set_title(title, fontsize=_fontSize + 1)
	figure.savefig(path)
