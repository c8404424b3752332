# SPDX-License-Identifier: GPL-2.0-or-later
# What runs of 02 and 03 with deformation on demand cost, and how far they are from the run in which all bricks deform. Needs numpy only.
"""Measures of example 07; see `Measured` and `differences`."""

from typing import NamedTuple

import numpy as np


class Measured(NamedTuple):
	"""What a run cost and what became of its wall.

	:param cpu: processor time of the shaking without the recording [s]
	:param dt: mean time step [s]
	:param share: of all brick-steps, those of bricks that deformed
	:param changes: bricks that became deformable and rigid, (promoted, demoted)
	:param firstFailed: time of the first failed segment [s], None: never
	:param failed: segments failed in tension, shear, compression
	:param collapse: time [s], None: stands
	:param fallen: bricks that are down by half a brick at the end
	:param gained: energy gained without work [J]
	"""

	cpu: float
	steps: int
	dt: float
	share: float
	changes: tuple
	firstFailed: float
	failed: tuple
	collapse: float
	fallen: int
	gained: float


def measured(result, arrays):
	"""The Measured of a run.

	:param result: its result.json
	:param arrays: its wall.npz
	"""
	time, steps, failed = arrays["time"], arrays["step"], np.asarray(arrays["failed"])
	cracked = failed.sum(axis=1) > failed[0].sum()
	return Measured(
	        result["processorSeconds"], result["shakingSteps"], float(time[-1] - time[0]) / result["shakingSteps"],
	        deformableShare(steps, arrays["deformable"], len(arrays["course"])), tuple(result["levelChanges"]),
	        float(time[cracked.argmax()]) if cracked.any() else None, tuple(int(count) for count in failed[-1] - failed[0]), result["collapse"],
	        result["bricksFallen"], result["energyGained"]
	)


def deformableShare(steps, deformable, bricks):
	"""Share of all steps of all bricks in which they deformed.

	:param steps: numbers of the steps that were looked at
	:param deformable: bricks that deformed then; what is between two looks counts as their mean
	"""
	deformable = np.asarray(deformable, dtype=float)
	return float(np.sum(0.5 * (deformable[1:] + deformable[:-1]) * np.diff(steps)) / (bricks * (steps[-1] - steps[0])))


class Difference(NamedTuple):
	"""Distance of bricks' centres from where they are in the reference, up to a time [m].

	:param top: root mean square of the first brick of the top course
	:param all: root mean square of all bricks
	:param most: largest of all bricks
	"""

	top: float
	all: float
	most: float


def difference(arrays, reference, end):
	"""The Difference of two runs up to a time; samples need not be at the same times, as steps differ.

	:param arrays: displacement (times, bricks, 3) [m], time, course of the bricks
	"""
	counted = reference["time"] <= end
	times, course = reference["time"][counted], reference["course"]
	given = arrays["displacement"]
	series = given.reshape(len(given), -1)
	here = np.stack([np.interp(times, arrays["time"], values) for values in series.T], axis=1).reshape(len(times), *given.shape[1:])
	distance = np.linalg.norm(here - reference["displacement"][counted], axis=2)
	top = distance[:, int(np.argmax(course))]
	return Difference(meanSquare(top), meanSquare(distance), float(distance.max()))


def motionSize(arrays, end):
	"""Difference of a run from its own first sample: how much there is to be wrong about."""
	still = {**{name: arrays[name] for name in ("time", "course")}, "displacement": np.broadcast_to(arrays["displacement"][:1], arrays["displacement"].shape)}
	return difference(still, arrays, end)


def meanSquare(values):
	"""The root of their mean square."""
	return float(np.sqrt(np.mean(np.square(values))))


def worst(found):
	"""The largest of each number of several Differences."""
	return Difference(*(max(numbers) for numbers in zip(*found)))


def use(normal, shear, mortar):
	"""Stresses of segments as shares of the mortar's strength in tension and shear; compression is far from it in these walls.

	:param normal: tension positive (n,) [Pa]
	:param shear: magnitude (n,) [Pa]
	"""
	held = np.maximum(mortar.cohesion - normal * np.tan(mortar.frictionAngle), 1e-12)
	return np.maximum(normal / mortar.tensileStrength, shear / held)


def unchanged(arrays):
	"""Which samples are from before the first brick changed, (times,)."""
	asked = np.asarray(arrays["asked"])
	return np.cumsum(asked != asked[0]) == 0


def timeText(seconds):
	return "-" if seconds is None else f"{seconds:.2f}"


def millimetres(length):
	"""With two digits."""
	value = 1e3 * length
	return "0" if value == 0 else f"{value:#.2g}".rstrip(".") if value < 100 else f"{value:.0f}"


def markdown(headings, rows):
	lines = [headings, ["---"] * len(headings), *rows]
	return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)
