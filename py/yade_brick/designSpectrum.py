# SPDX-License-Identifier: GPL-2.0-or-later
# The elastic response spectrum that EN 1998-1 (Eurocode 8, 2004) gives for the horizontal motion of the ground; national annexes may
# have other numbers. A target for spectrumCompatible, and a line in motionPlot.
"""Elastic spectra of codes: `elasticSpectrum`."""

import math
from typing import NamedTuple

import numpy as np

from .checks import checkPositive, isFinite
from .spectrum import checkedPeriods


class Soil(NamedTuple):
	"""Soil factor S [-] and the periods at which the branches of the spectrum meet [s]."""

	factor: float
	plateauBegin: float  # T_B
	plateauEnd: float  # T_C
	displacementBegin: float  # T_D


#: Recommended values, by type of spectrum and ground type: tables 3.2 and 3.3.
soils = {
        1: {"A": Soil(1.0, 0.15, 0.4, 2.0), "B": Soil(1.2, 0.15, 0.5, 2.0), "C": Soil(1.15, 0.2, 0.6, 2.0), "D": Soil(1.35, 0.2, 0.8, 2.0),
            "E": Soil(1.4, 0.15, 0.5, 2.0)},
        2: {"A": Soil(1.0, 0.05, 0.25, 1.2), "B": Soil(1.35, 0.05, 0.25, 1.2), "C": Soil(1.5, 0.1, 0.25, 1.2), "D": Soil(1.8, 0.1, 0.3, 1.2),
            "E": Soil(1.6, 0.05, 0.25, 1.2)},
}  # yapf: disable

#: Longest period of the formulae [s].
longestPeriod = 4.0


def elasticSpectrum(periods, groundAcceleration, ground="A", type=1, damping=0.05):
	"""Horizontal elastic response spectrum Se(T) of EN 1998-1, 3.2.2.2, equations (3.2) to (3.6).

	:param periods: [s], 0 to 4
	:param groundAcceleration: a_g on ground A, with the importance factor [m/s2], > 0
	:param ground: ground type 'A' to 'E'
	:param type: 1, or 2 where earthquakes are of surface-wave magnitude 5.5 at most
	:param damping: share of critical, >= 0; the correction is that of equation (3.6)
	:returns: (m,) [m/s2]
	:raises ValueError: naming the argument, its value and what is allowed

	>>> elasticSpectrum([0, 0.3, 1.0], 2.0, ground="B").round(3).tolist()
	[2.4, 6.0, 3.0]
	"""
	periods = checkedPeriods(periods)
	checkPositive(groundAcceleration, "groundAcceleration", "m/s2")
	if periods.max() > longestPeriod:
		raise ValueError(f"periods reach {periods.max():g} s; the formulae of EN 1998-1 end at {longestPeriod:g} s")
	if isinstance(type, bool) or type not in (1, 2):
		raise ValueError(f"type is {type!r}; allowed are 1 and 2")
	if not isinstance(ground, str) or ground not in soils[type]:
		raise ValueError(f"ground is {ground!r}; allowed are {', '.join(map(repr, soils[type]))}")
	if not (isFinite(damping) and damping >= 0):
		raise ValueError(f"damping is {damping!r}; allowed is a finite share of critical >= 0")
	factor, begin, end, far = soils[type][ground]
	plateau = 2.5 * max(0.55, math.sqrt(10 / (5 + 100 * damping)))
	T = np.maximum(periods, 1e-12)
	shape = np.select(
	        [periods <= begin, periods <= end, periods <= far], [1 + periods / begin * (plateau - 1), np.full(len(T), plateau), plateau * end / T],
	        plateau * end * far / T**2
	)
	return groundAcceleration * factor * shape
