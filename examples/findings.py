# SPDX-License-Identifier: GPL-2.0-or-later
# What the walls of 02 and 03 did, measured, and whether that is what Furukawa et al. 2014 found: read from the files that the runs leave.
# Needs numpy only. A verdict follows from numbers by the criterion that stands with it; no number here depends on the outcome.
"""Measures and findings of the paper's walls; see `Outcome` and `findings`."""

import json
import os
from typing import NamedTuple

import numpy as np

side, courses = 0.2, 6  # of a brick [m]; of the walls
openJoint = 0.01 * side  # a head joint that gapes as wide is open: a crack that is seen [m]
leastSpread, leastStress = 1e-6, 1.0  # what counts as a spread [m] and as a stress between neighbours [Pa], not as round-off
similar = 0.1  # two models nearly agree when times of collapse and shares of bricks fallen differ by no more

#: Mean stress along the wall at its middle, by course from below [Pa]: elasticity with the bonded base held, joints of 2 r = 2 mm,
#: 4 x 4 x 4 elements a brick; tests/verification/references.json, wall2.<bond>.FE4.wilson.r0.001.seg0.025.
elasticStress = {"straight": (-3917, -1643, -459, 18, 172, 305), "english": (-3892, -1551, -449, 22, 169, 286)}


class Outcome:
	"""One run of 02 or 03, from its folder.

	:param result: its result.json
	:param arrays: its wall.npz, see paperWall.Recorder.writeArrays
	"""

	def __init__(self, folder):
		with open(os.path.join(folder, "result.json")) as file:
			self.result = json.load(file)
		self.folder = folder
		self.arrays = np.load(os.path.join(folder, "wall.npz"))

	@property
	def collapse(self):
		"""Time at which the first brick had come down by half its height [s], or None."""
		return self.result["collapse"]

	@property
	def fallen(self):
		"""Bricks that are down by half a brick at the end."""
		return self.result["bricksFallen"]

	@property
	def bricks(self):
		return len(self.arrays["course"])

	def fallenCourses(self):
		"""Course of each brick that has fallen, from 0."""
		height = self.arrays["displacement"][:, :, 2]
		return self.arrays["course"][height[0] - height[-1] > side / 2]

	def largestSpread(self, axis):
		"""Largest growth of a course's half width under self weight [m], of either sign."""
		return max(self.result["atRest"]["spread" + axis.upper()], key=abs)

	def middleStress(self):
		"""Stress of the head joint nearest the wall's middle, by course from below [Pa]."""
		return [stresses[len(stresses) // 2] for stresses in self.result["atRest"]["headJointStress"]]

	def sectionForce(self):
		"""Force of the middle head joints on each other, all courses of a straight wall together, tension positive [N]."""
		return sum(self.middleStress()) * side**2

	def courseStress(self):
		"""Mean stress of the head joints, by course from below [Pa]."""
		return [float(np.mean(stresses)) for stresses in self.result["atRest"]["headJointStress"]]

	def diagonalCrack(self):
		"""(courses, time [s]) of the longest diagonal crack before the wall collapses, the first if there are several; see `longestStair`."""
		longest, when = 0, None
		for time, shape in zip(self.arrays["frameTime"], self.arrays["frameCorners"]):
			if self.collapse is not None and time >= self.collapse:
				break
			length = longestStair(openHeadJoints(shape, self.arrays["frameCorners"][0], self.arrays["course"]))
			if length > longest:
				longest, when = length, float(time)
		return longest, when


def openHeadJoints(shape, intact, course):
	"""Places along x of the head joints that are open, a list for each course from below [m].

	:param shape: corners of the bricks now (bricks, 8, 3) [m]; `intact`: when the joints were closed
	:param course: (bricks,) course of each; bricks are in order along x
	"""
	places = [[] for _ in range(courses)]
	for left in range(len(course) - 1):
		if course[left] != course[left + 1]:
			continue
		place = intact[left, :, 0].max()
		oneSide, otherSide = np.isclose(intact[left, :, 0], place, atol=0.1 * side), np.isclose(intact[left + 1, :, 0], place, atol=0.1 * side)
		gap = shape[left + 1, otherSide, 0].mean() - shape[left, oneSide, 0].mean()
		if gap > openJoint:
			places[course[left]].append(float(place))
	return places


def longestStair(places):
	"""Courses that the longest diagonal crack crosses: open head joints in courses above each other, each half a brick further in one direction."""
	longest = 0
	for step in (-0.5 * side, 0.5 * side):
		lengths = {}
		for course, here in enumerate(places):
			for place in here:
				below = [lengths[course - 1, other] for other in places[course - 1] if abs(place - other - step) < 0.1 * side] if course else []
				lengths[course, place] = 1 + max(below, default=0)
		longest = max([longest, *lengths.values()])
	return longest


# Findings


class Finding(NamedTuple):
	"""A finding of the paper against ours.

	:param number: 1 to 6
	:param paper: what the paper reports
	:param criterion: what 'seen' means here; 'in part' is said in it too
	:param verdict: 'seen', 'in part' or 'not seen'
	:param numbers: what was measured
	"""

	number: int
	paper: str
	criterion: str
	verdict: str
	numbers: str


def verdict(seen, inPart):
	return "seen" if seen else "in part" if inPart else "not seen"


def findings(outcomes):
	"""The six findings.

	:param outcomes: dict from (bond, model, direction), such as ('straight', 'rigid', 'x'), to a list of Outcome: the run, and repetitions
		of it with a motion that differs by round-off. Without runs out of plane there is no sixth.
	"""
	found = [spreadFinding(outcomes), prestressFinding(outcomes), laterFinding(outcomes), standsFinding(outcomes), upperPartFinding(outcomes)]
	return found + ([outOfPlaneFinding(outcomes)] if ("straight", "rigid", "y") in outcomes else [])


def spreadFinding(outcomes):
	parts, ok = [], []
	for bond in ("straight", "english"):
		rigid, deform = ([abs(outcomes[bond, model, "x"][0].largestSpread(axis)) for axis in "xy"] for model in ("rigid", "deform"))
		ok += [deform[axis] > leastSpread and rigid[axis] < 1e-3 * leastSpread for axis in range(2)]
		parts.append(f"{bond}: DEFORM {1e4 * deform[0]:.2f}e-4 m in x, {1e4 * deform[1]:.2f}e-4 m in y; RIGID {rigid[0]:.0e} and {rigid[1]:.0e} m")
	return Finding(
	        1, "Under self weight DEFORM spreads sideways (x and y) by Poisson's effect, RIGID by nothing",
	        f"half width of a course grows by over {leastSpread:g} m in DEFORM and by less than a thousandth of that in RIGID, in x and y, in both walls; "
	        "in part: in some of these",
	        verdict(all(ok), any(ok)), "; ".join(parts)
	)


def prestressFinding(outcomes):
	deform, rigid = (outcomes["straight", model, "x"][0] for model in ("deform", "rigid"))
	stress = deform.middleStress()
	pressed = [course + 1 for course, value in enumerate(stress) if value < -leastStress]
	numbers = (
	        f"DEFORM, middle joint, courses 1 to {courses}: {', '.join(f'{value:.0f}' for value in stress)} Pa; pressed together: "
	        f"{', '.join(map(str, pressed)) or 'none'}. Sum over the section {deform.sectionForce():.0f} N; the ground holds the half wall with "
	        f"{deform.result['atRest']['baseThrust']:.0f} N: the prestress is the reaction of the base. RIGID: {max(map(abs, rigid.middleStress())):.0e} Pa"
	)
	return Finding(
	        2, "Straight joints: Poisson's effect presses neighbours together, a prestress",
	        f"over {leastStress:g} Pa of compression in the middle head joint of every course of DEFORM; in part: of some courses",
	        verdict(len(pressed) == courses, pressed), numbers
	)


def laterFinding(outcomes):
	rigid, deform = (outcomes["straight", model, "x"] for model in ("rigid", "deform"))
	rigidTimes, deformTimes = ([run.collapse if run.collapse is not None else np.inf for run in runs] for runs in (rigid, deform))
	return Finding(
	        3, "So DEFORM collapses later than RIGID in the straight wall",
	        "every DEFORM run collapses later than every RIGID run; in part: the first run does, or the mean",
	        verdict(min(deformTimes) > max(rigidTimes), deformTimes[0] > rigidTimes[0] or np.mean(deformTimes) > np.mean(rigidTimes)),
	        f"RIGID {spanText(rigidTimes)}, DEFORM {spanText(deformTimes)}; fallen {countText(rigid)} and {countText(deform)}"
	)


def standsFinding(outcomes):
	runs = outcomes["english", "rigid", "x"]
	stands, cracks = all(run.collapse is None for run in runs), runs[0].diagonalCrack()
	diagonal = cracks[0] >= courses / 2
	when = f" at {cracks[1]:.2f} s" if cracks[0] else ""
	return Finding(
	        4, "English bond: RIGID cracks diagonally and stands",
	        f"no run collapses, and open head joints (over {1e3 * openJoint:g} mm) make a stair through {courses // 2} courses or more; in part: one of these",
	        verdict(stands and diagonal, stands or diagonal),
	        f"collapse {spanText([run.collapse if run.collapse is not None else np.inf for run in runs])}, fallen {countText(runs)}; "
	        f"longest stair of open joints: {cracks[0]} courses{when}"
	)


def upperPartFinding(outcomes):
	runs, straight = outcomes["english", "deform", "x"], outcomes["straight", "deform", "x"]
	fallen = runs[0].fallenCourses()
	upper = int((fallen >= courses / 2).sum())
	falls = len(fallen) > 0 and upper >= 2 / 3 * len(fallen)
	cracks = runs[0].diagonalCrack()
	return Finding(
	        5, "English bond: DEFORM cracks and its upper part falls (fewer bricks than of the straight wall)",
	        "bricks fall, two thirds of them or more from the upper three courses; in part: bricks fall, or open joints make a stair through 3 courses",
	        verdict(falls, len(fallen) > 0 or cracks[0] >= courses / 2),
	        f"collapse {spanText([run.collapse if run.collapse is not None else np.inf for run in runs])}; fallen {countText(runs)} of {runs[0].bricks}, "
	        f"in the first run {upper} of {len(fallen)} from the upper courses (straight wall: {countText(straight)} of {straight[0].bricks}); "
	        f"longest stair of open joints: {cracks[0]} courses"
	)


def outOfPlaneFinding(outcomes):
	agree, parts = [], []
	for bond in ("straight", "english"):
		rigid, deform = (outcomes[bond, model, "y"][0] for model in ("rigid", "deform"))
		sameFate = (rigid.collapse is None) == (deform.collapse is None)
		late = deform.collapse / rigid.collapse - 1 if rigid.collapse and deform.collapse else 0 if sameFate else np.inf
		share = abs(deform.fallen - rigid.fallen) / rigid.bricks
		agree.append((sameFate, sameFate and abs(late) <= similar and share <= similar))
		parts.append(
		        f"{bond}: RIGID {spanText([rigid.collapse or np.inf])}, {rigid.fallen} fallen; DEFORM {spanText([deform.collapse or np.inf])}, "
		        f"{deform.fallen} fallen"
		)
	return Finding(
	        6, "Out of plane the two models nearly agree",
	        f"both fall or both stand, times of collapse within {100 * similar:.0f} %, bricks fallen within {100 * similar:.0f} % of all; in part: in one "
	        "wall, or only as to whether they fall", verdict(all(full for _, full in agree), all(same for same, _ in agree) or any(full for _, full in agree)),
	        "; ".join(parts)
	)


# Texts


def timeText(value):
	return f"{value:.2f} s" if value is not None and np.isfinite(value) else "stands"


def spanText(times):
	"""A time of collapse, with its range over the repetitions."""
	low, high = min(times), max(times)
	return timeText(times[0]) if low == high else f"{timeText(times[0])} ({timeText(low)} to {timeText(high)} in {len(times)} runs)"


def countText(runs):
	counts = [run.fallen for run in runs]
	return f"{counts[0]}" if min(counts) == max(counts) else f"{counts[0]} ({min(counts)} to {max(counts)})"


def markdown(headings, rows):
	"""A table in Markdown."""
	lines = [headings, ["---"] * len(headings), *rows]
	return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def wallRow(key, runs):
	"""What the first run of a wall did, and the range over its repetitions."""
	bond, model, direction = key
	first, crack = runs[0], runs[0].result["firstCrack"]
	modes = [timeText(crack[mode]) if crack[mode] is not None else "-" for mode in ("tension", "shear", "compression")]
	times = spanText([run.collapse if run.collapse is not None else np.inf for run in runs])
	spread = [f"{1e4 * first.largestSpread(axis):.2f}" for axis in "xy"]
	half = first.result["halfFailed"]
	gained = f"{max(run.result['energyGained'] for run in runs):.0f}"
	return [bond, model.upper(), direction, *modes, timeText(half) if half is not None else "-", times, f"{countText(runs)} of {first.bricks}", *spread, gained]


wallHeadings = [
        "wall", "model", "motion", "first crack in tension", "in shear", "in compression", "half of all segments failed", "collapse", "bricks fallen",
        "spread x [1e-4 m]", "spread y [1e-4 m]", "energy gained without work [J]"
]


def restRows(outcomes, bond):
	"""The wall at rest by course: spread and stress between neighbours, against elasticity."""
	deform = outcomes[bond, "deform", "x"][0]
	atRest, rigid = deform.result["atRest"], outcomes[bond, "rigid", "x"][0]
	rows = zip(atRest["spreadX"], atRest["spreadY"], deform.courseStress(), deform.middleStress(), elasticStress[bond], rigid.middleStress())
	return [
	        [bond, course + 1, f"{1e4 * x:.3f}", f"{1e4 * y:.3f}", f"{mean:.0f}", f"{middle:.0f}", elastic, f"{abs(none):.0e}"]
	        for course, (x, y, mean, middle, elastic, none) in enumerate(rows)
	]


restHeadings = [
        "wall", "course", "DEFORM spread x [1e-4 m]", "spread y [1e-4 m]", "mean stress of head joints [Pa]", "middle joint [Pa]", "elasticity there [Pa]",
        "RIGID [Pa]"
]
