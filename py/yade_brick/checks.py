# SPDX-License-Identifier: GPL-2.0-or-later
# What arguments are asked for before anything is done with them: shared by the modules of the package, none of which needs YADE for it.
"""Checks of arguments."""

import numbers
import sys

import numpy as np


def isFinite(value):
	"""Whether a value is a finite real number; True and False are none.

	>>> [isFinite(value) for value in (1, 2.5, float("nan"), float("inf"), True, "1", None, 10**400)]
	[True, True, False, False, False, False, False, False]
	"""
	return isinstance(value, numbers.Real) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def isNumber(value):
	"""Whether a value is a number that a float can hold, NaN and infinity too, as what was measured may be; True and False are 1 and 0.

	>>> [isNumber(value) for value in (1, float("nan"), float("inf"), True, "1", None, 10**400)]
	[True, True, True, True, False, False, False]
	"""
	return isinstance(value, (float, np.floating)) or isinstance(value, numbers.Real) and abs(value) <= sys.float_info.max


def checkPositive(value, name, unit):
	"""Refuses anything but a finite number > 0.

	:raises ValueError: naming the argument, its value and what is allowed

	>>> checkPositive(0, "dt", "s")
	Traceback (most recent call last):
	ValueError: dt is 0; allowed is a finite number > 0 s
	"""
	if not (isFinite(value) and value > 0):
		raise ValueError(f"{name} is {value!r}; allowed is a finite number > 0 {unit}")
