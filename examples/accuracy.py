# SPDX-License-Identifier: GPL-2.0-or-later
# What example 05 varies, what it compares with, and how it reads what was measured: which settings are worth their time, which dial to turn first, what
# is wasted. Arrays and numbers only: no YADE, so that all of it can be tested without one.
"""Dials of a brick, references, Pareto front, effects of single dials, tables of examples/05_accuracy_versus_time.py."""

import itertools
import math
from typing import NamedTuple

import numpy as np

# Dials


class Setting(NamedTuple):
	"""All dials of a brick and of the step; what is not given is what `yade_brick.brick` does by itself.

	:param level: rigid, uniform, trilinear or refined
	:param cells: elements along each edge of the inner part; more than 1 for refined
	:param element: full, incompatible or bbar
	:param inner: where the inner part ends: inset or full
	:param thinness: edge of a brick over the thickness r of its contact part
	:param segments: along each edge of a face
	:param safety: of BrickTimeStepper, the dt factor
	"""

	level: str = "trilinear"
	cells: int = 1
	element: str = "full"
	inner: str = "inset"
	thinness: int = 100
	segments: int = 4
	safety: float = 0.9


#: Values of each dial from coarse to fine, or from the paper's choice to the others; also the order in which neighbours are compared.
values = {
        "level": (("rigid", 1), ("uniform", 1), ("trilinear", 1), ("refined", 2), ("refined", 3), ("refined", 4)),
        "element": ("full", "bbar", "incompatible"),
        "inner": ("inset", "full"),
        "thinness": (20, 40, 100, 200, 400),
        "segments": (2, 4, 6, 8, 9, 16),
        "safety": (0.9, 0.45)
}
#: Dials that change nothing at a level: a rigid brick has no element, and those of constant strain are all the same.
_idle = {"rigid": {"element", "inner", "thinness"}, "uniform": {"element"}, "trilinear": set(), "refined": set()}

defaults = Setting()
better = Setting(element="incompatible", inner="full")  # around which most of the sweep goes


def dial(setting, name):
	"""Value of a dial; that of the level has the cells with it."""
	return (setting.level, setting.cells) if name == "level" else getattr(setting, name)


def active(setting):
	"""Names of the dials that matter at its level."""
	return [name for name in values if name not in _idle[setting.level]]


def usual(setting):
	"""The setting with dials that do not matter at its level as they are by default, so that settings alike are equal."""
	return setting._replace(**{name: getattr(defaults, name) for name in _idle[setting.level]})


def sweep():
	"""Settings of the default sweep, one dial at a time from `better`, and steps that go together."""
	rigid = Setting("rigid")
	found = [rigid, rigid._replace(segments=2), rigid._replace(segments=8), Setting("uniform"), Setting("uniform", inner="full")]
	found += [better._replace(element=element, inner=inner) for inner in values["inner"] for element in values["element"]]
	found += [better._replace(thinness=thinness) for thinness in values["thinness"]]
	found += [better._replace(segments=segments) for segments in (2, 8, 16)] + [better._replace(safety=0.45)]
	two, three, four = (better._replace(level="refined", cells=cells, segments=max(4, 2 * cells)) for cells in (2, 3, 4))
	found += [two, two._replace(element="full"), two._replace(thinness=40), two._replace(thinness=200), two._replace(thinness=400)]
	found += [two._replace(segments=8), three, three._replace(thinness=400), four, four._replace(thinness=400)]
	return list(dict.fromkeys(found))


def quickSweep():
	"""A few settings that show the main effects."""
	return [
	        Setting("rigid"), defaults, better,
	        better._replace(thinness=40),
	        better._replace(segments=8),
	        better._replace(level="refined", cells=2)
	]


def everyCombination():
	"""All dials with all others: some hundred settings, for many cores."""
	found = []
	for level, *others in itertools.product(*values.values()):
		setting = usual(Setting(*level, *others))
		if setting.segments % setting.cells == 0 and setting.segments in (2, 4, 6, 8, 16):
			found.append(setting)
	return list(dict.fromkeys(found))


def finest():
	"""The reference of what has no other: finer in every dial than what the shaken walls of the sweep have."""
	return better._replace(level="refined", cells=3, thinness=400, segments=9, safety=0.45)


def shaken(settings):
	"""Those of the settings that the wall is shaken with: coarser than `finest`, which they are compared with."""
	return [setting for setting in settings if setting.cells <= 2 and setting.segments <= 8]


def levelText(setting):
	return f"{setting.cells} x {setting.cells} x {setting.cells}" if setting.level == "refined" else setting.level


def dialTexts(setting):
	"""Level, element, inner, r, segments, safety as texts; '-' for what does not matter at its level."""
	texts = {
	        "level": levelText(setting), "element": setting.element, "inner": setting.inner, "thinness": f"L/{setting.thinness}",
	        "segments": f"{setting.segments} x {setting.segments}", "safety": f"{setting.safety:g}"
	}
	return [text if name in active(setting) else "-" for name, text in texts.items()]


#: How a dial and its value are said in a sentence.
_said = {
        "level": "{}", "element": "element {}", "inner": "inner part {}", "thinness": "r = {}", "segments": "{} segments", "safety": "dt factor {}"
}


def title(setting):
	"""All that matters of a setting in words."""
	said = [_said[name].format(text) for name, text in zip(values, dialTexts(setting)) if text != "-" and not (name == "safety" and setting.safety == 0.9)]
	return ", ".join(said)


def difference(setting, other):
	"""Names of the dials that differ, of those that matter at both levels."""
	return [name for name in values if name in active(setting) and name in active(other) and dial(setting, name) != dial(other, name)]


def shortTitle(setting):
	"""What makes it differ from `better`, the base, for a label in a plot."""
	if setting == better:
		return "base"
	texts = dict(zip(values, dialTexts(setting)))
	short = {"element": "{}", "inner": "{}" if setting.inner == "inset" else "inner {}", "thinness": "{}", "segments": "{}", "safety": "dt x {}", "level": "{}"}
	return ", ".join(short[name].format(texts[name]) for name in difference(setting, better))


# Rows of the table that says what to run


class Row(NamedTuple):
	"""One run.

	:param case: cube, cantilever, weight or seismic
	:param scale: factor on the ground motion: a little off 1 in repetitions
	:param seconds: of shaking at most
	:param reference: whether others are compared with it
	"""

	case: str
	setting: Setting
	scale: float = 1.0
	seconds: float = 5.0
	reference: bool = False


cases = ("cube", "cantilever", "weight", "seismic")
roundOff = 1e-6  # by which the motion of repetitions differs


def plan(chosen, settings, quick):
	"""The runs of the chosen cases, the reference of the shaken wall first."""
	rows = []
	for case in (case for case in cases if case in chosen):
		if case != "seismic":
			rows += [Row(case, setting) for setting in settings]
			continue
		seconds = 0.8 if quick else 5.0
		reference = better._replace(thinness=200) if quick else finest()
		rows.append(Row(case, reference, seconds=seconds, reference=True))
		rows += [Row(case, setting, seconds=seconds) for setting in shaken(settings) if setting != reference]
		if not quick:
			rows += [Row(case, better, scale, seconds) for scale in (1 + roundOff, 1 - roundOff)]
	return rows


_columns = ("case", *Setting._fields, "scale", "seconds", "reference")


def tableText(rows):
	"""The rows as a table for yade-batch, which evaluates what stands in it; lines are counted from 1, row i is in line firstLine + i."""
	lines = ["# made by 05_accuracy_versus_time.py, one run a line: yade-batch FILE 05_accuracy_versus_time.py", " ".join(("description", *_columns))]
	for index, row in enumerate(rows):
		entries = (row.case, *row.setting, row.scale, row.seconds, row.reference)
		lines.append(" ".join([f"{index:03d}-{row.case}-{row.setting.level}", *(repr(entry) for entry in entries)]))
	return "\n".join(lines) + "\n"


firstLine = 3


def rowOf(entries):
	"""The Row of a dict or namespace of what stands in a line of that table."""
	return Row(entries["case"], Setting(*(entries[name] for name in Setting._fields)), entries["scale"], entries["seconds"], bool(entries["reference"]))


# References

#: Cube on a fixed base under a rigid plate that it may slip along, W = 200 N, by Poisson's ratio: change of width at the top corner, settlement of the plate
#: [m]. Three-dimensional elasticity, tensor-product finite elements of order 8 (tests/verification/references.json, t2.truth.rigidfree); error 2e-5.
cube = {0.25: (5.156702e-6, -1.9999006e-5), 0.40: (8.2296334e-6, -1.9280489e-5)}

#: Six lowest natural frequencies of the column of five cubes as one solid [Hz]: bending (two), torsion, second bending (two), along its axis.
#: Three-dimensional elasticity, tensor-product finite elements of order 3, 4, 5 on a mesh graded to the base, whose values differ by 3e-6 at last; the first is
#: col.N5.truth.r0 of references.json, too, and CalculiX's quadratic elements, four along an edge, are within 0.1 % of all.
cantilever = np.array([2.32786, 2.32786, 10.7479, 12.6012, 12.6012, 18.5120])

#: Wall of 6 x 6 under its weight as one solid: mean stress across the vertical joints at 0, 0.2 and 0.4 m from the middle, courses from below [Pa],
#: likewise (wall.truth.straight/continuum_r=0); error 0.1 %, of the first at 0.4 m 1 %.
headStress = np.array(
        [
                [-4041.0472, -1652.0603, -461.59344, 16.599283, 172.38051, 304.88554], [-3883.0038, -1405.6038, -341.93612, 31.889013, 144.66364, 236.23993],
                [-3196.2593, -640.43736, -91.901486, 33.955919, 65.650936, 86.518999]
        ]
)
#: Displacement along the wall of its vertical edge at the top of each course [m]: CalculiX 2.20, three C3D20R an edge of a brick; four digits.
edgeSpread = np.array([1.706e-4, 1.881e-4, 1.592e-4, 1.126e-4, 0.615e-4, 0.124e-4])


def meanSquare(errors):
	"""The root of their mean square."""
	return float(np.sqrt(np.mean(np.square(errors))))


def relative(got, expected):
	"""Root mean square of what differs, against the largest of what is expected."""
	return meanSquare(np.asarray(got) - expected) / float(np.abs(expected).max())


def historyError(times, values, referenceTimes, referenceValues, end):
	"""Root mean square of the difference of two histories up to a time, against that of the reference; samples need not be at the same times."""
	referenceTimes, referenceValues = np.asarray(referenceTimes), np.asarray(referenceValues)
	counted = referenceTimes <= end
	moved = np.interp(referenceTimes[counted], times, values)
	return meanSquare(moved - referenceValues[counted]) / meanSquare(referenceValues[counted])


sampleEvery = 0.01  # of the shaken wall [s]


def judgeShaking(results):
	"""Adds to the results of shaken walls their errors against the one that is the reference: `error` of the history before the reference cracks, and
	`collapseError`, None where either wall stands. The latter is never less than what repetitions scatter, or the time between two looks.

	:param results: dicts with row (Row), times, displacements, firstCrack (None: never), collapse (None: stands)
	:returns: that least error of the time of collapse; None if the reference stands
	"""
	reference = next(result for result in results if result["row"].reference)
	end, falls = 0.95 * (reference["firstCrack"] or math.inf), reference["collapse"]
	repeated = {result["row"].setting for result in results if result["row"].scale != 1}
	times = [result["collapse"] for result in results if result["row"].setting in repeated and result["collapse"]] or [0]
	least = max(max(times) - min(times), sampleEvery) / falls if falls else None
	for result in results:
		result["error"] = historyError(result["times"], result["displacements"], reference["times"], reference["displacements"], end)
		result["collapseError"] = max(abs(result["collapse"] / falls - 1), least) if result["collapse"] and falls else None
	return least


# What the numbers say


class Point(NamedTuple):
	"""A setting as measured in one panel: error [-], seconds of work a simulated second."""

	setting: Setting
	error: float
	time: float


sameTime = 1.25  # times nearer than this are taken as equal: on a machine with other work timing is not better than that
noGain = 0.95  # an error left by more than this share is no gain


def front(points):
	"""Points that no other beats in both error and time, from the cheapest on."""
	found, best = [], math.inf
	for point in sorted(points, key=lambda point: (point.time, point.error)):
		if point.error < best:
			found.append(point)
			best = point.error
	return found


class Effect(NamedTuple):
	"""One dial turned by one notch, towards what costs more; towards the smaller error where times are the same."""

	dial: str
	before: Point
	after: Point

	@property
	def timeFactor(self):
		return self.after.time / self.before.time

	@property
	def errorFactor(self):
		return self.after.error / self.before.error if self.before.error else math.inf


def neighbours(points):
	"""(dial, point, point) of all that differ in a single dial, by one notch of the values measured, in the order of `values`."""
	groups = {}
	for point in points:
		for name in active(point.setting):
			rest = tuple(dial(point.setting, other) for other in values if other != name)
			groups.setdefault((name, rest), []).append(point)
	found = []
	for (name, _), members in groups.items():
		members.sort(key=lambda point: values[name].index(dial(point.setting, name)))
		found += [(name, before, after) for before, after in zip(members, members[1:])]
	return found


def effects(points):
	"""Effects between neighbours."""
	found = []
	for name, before, after in neighbours(points):
		ratio = after.time / before.time
		turned = ratio < 1 / sameTime or (ratio < sameTime and after.error > before.error)
		found.append(Effect(name, *((after, before) if turned else (before, after))))
	return found


def firstTurn(points, start=defaults, turned=()):
	"""The Effect that takes the most off the error for its time, of all settings that differ from `start` in one dial; None if none helps.

	:param turned: names of dials that stay as they are
	"""
	home = next((point for point in points if point.setting == start), None)
	if home is None:
		return None
	ways = [Effect(changed[0], home, point) for point in points for changed in [difference(home.setting, point.setting)] if len(changed) == 1]
	ways = [way for way in ways if way.errorFactor < noGain and way.dial not in turned]
	return max(ways, key=lambda way: -math.log(max(way.errorFactor, 1e-12)) / math.log(max(way.timeFactor, sameTime)), default=None)


def turns(points):
	"""From the defaults on, the first turn and those that follow, each of another dial."""
	found = []
	while True:
		turn = firstTurn(points, found[-1].after.setting if found else defaults, [turn.dial for turn in found])
		if turn is None:
			return found
		found.append(turn)


def wasted(points):
	"""Effects that cost time and leave the error as it is, or make it larger."""
	return [effect for effect in effects(points) if effect.timeFactor > sameTime and effect.errorFactor > noGain]


def worstWaste(points):
	"""Of each dial the wasted effect that costs most, the costliest dial first."""
	worst = {}
	for effect in sorted(wasted(points), key=lambda effect: -effect.timeFactor):
		worst.setdefault(effect.dial, effect)
	return list(worst.values())


def cheapestBelow(points, limit):
	"""The cheapest point whose error is at most the limit; None if there is none."""
	return min((point for point in points if point.error <= limit), key=lambda point: point.time, default=None)


def percent(value):
	"""A share in percent with two digits that count."""
	if value is None or not math.isfinite(value):
		return "-"
	return f"{100 * value:.2g} %" if value < 0.995 else f"{100 * value:.0f} %"


def timeText(seconds):
	return f"{seconds:.2g}" if seconds < 99.5 else f"{seconds:.0f}"


def notchText(name, before, after):
	"""What a dial is turned from and to."""
	index = list(values).index(name)
	return " -> ".join(_said[name].format(dialTexts(setting)[index]) for setting in (before, after))


def turnText(effect):
	"""What an Effect turned, from what to what, and what came of it."""
	turned = notchText(effect.dial, effect.before.setting, effect.after.setting)
	return f"{turned}: error {percent(effect.before.error)} -> {percent(effect.after.error)}, time x {effect.timeFactor:.2g}"


def notchTable(panels):
	"""What each notch of each dial does to error and time, over all panels in which it was measured: medians, and the range of the errors.

	:param panels: dict from panel to its points
	"""
	found = {}
	for points in panels.values():
		for name, before, after in neighbours(points):
			if before.error > 0:
				entry = found.setdefault((name, notchText(name, before.setting, after.setting)), ([], []))
				entry[0].append(after.error / before.error)
				entry[1].append(after.time / before.time)
	rows = []
	for (name, notch), (errors, times) in sorted(found.items(), key=lambda item: list(values).index(item[0][0])):
		rows.append([notch, f"{np.median(errors):.2g}", f"{min(errors):.2g} to {max(errors):.2g}", f"{np.median(times):.2g}", len(errors)])
	return markdown(["notch", "error x", "range", "time x", "measured"], rows)


def reading(name, points, scatter=None):
	"""What one panel says, as lines of text; all of it from its points.

	:param scatter: error below which differences mean nothing, where there is such
	"""
	wanted = [(f"error at most {percent(limit)}", cheapestBelow(points, limit)) for limit in (0.1, 0.03, 0.01)]
	wanted.append(("smallest error", min(points, key=lambda point: (point.error, point.time))))
	# what does for the next, stricter one is said there
	wanted = [(what, point) for what, point in wanted if point]
	told = [(what, point) for index, (what, point) in enumerate(wanted) if point not in [other for _, other in wanted[index + 1:]]]
	lines = [f"{what}: {title(point.setting)} ({percent(point.error)}, {timeText(point.time)} s a simulated second)" for what, point in told]
	lines += [f"{when}: {turnText(turn)}" for when, turn in zip(("from the defaults, turn first", "then", "then"), turns(points))]
	lines += [f"wasted: {turnText(effect)} (at {title(effect.before.setting)})" for effect in worstWaste(points)]
	if scatter is not None:
		lines.append(f"{percent(scatter)} is what runs scatter whose motions differ by {roundOff:g}: smaller errors count as that")
	return [f"**{name}.**"] + [f"- {line}" for line in lines]


# Tables


def pointsOf(results, panels):
	"""dict from panel to its points, of those panels that have any. The reference and repetitions are none.

	:param panels: names: those of the cases, and collapse
	"""
	points = {}
	for name in panels:
		case, key = ("seismic", "collapseError") if name == "collapse" else (name, "error")
		of = [result for result in results if result["row"].case == case and result["row"].scale == 1 and not result["row"].reference]
		found = [Point(result["row"].setting, result[key], result["secondsPerSimulatedSecond"]) for result in of if result.get(key) is not None]
		if found:
			points[name] = found
	return points


dialHeadings = ["level", "element", "inner", "r", "segments", "dt factor"]


def fullTable(results):
	"""Headings and a row for each run."""
	headings = ["case", *dialHeadings, "error", "collapse [s]", "s a simulated s", "dt [us]", "limited by", "kB a brick"]
	rows = []
	for result in results:
		row = result["row"]
		case = row.case + (" (reference)" if row.reference else f" x {row.scale!r}" if row.scale != 1 else "")
		collapse = "" if row.case != "seismic" else "stands" if result["collapse"] is None else f"{result['collapse']:.2f}"
		measured = [f"{result['error']:.3g}", collapse, f"{result['secondsPerSimulatedSecond']:.3g}", f"{1e6 * result['dt']:.3g}"]
		rows.append([case, *dialTexts(row.setting), *measured, result["limitText"], f"{result['memoryPerBrick'] / 1024:.1f}"])
	return headings, rows


def pageTable(results, points):
	"""A row for each setting with error and seconds of work of every panel, as markdown; in bold what is on a Pareto front. Step, what limits it and memory
	are those of the wall under its weight, or of what was run instead."""
	named = {name: {point.setting: point for point in members} for name, members in points.items()}
	fronts = {name: front(members) for name, members in points.items()}
	known = {result["row"].setting: result for wall in (False, True) for result in results if (result["row"].case == "weight") == wall}
	rows = []
	for setting in dict.fromkeys(point.setting for members in points.values() for point in members):
		cells = []
		for name in points:
			point = named[name].get(setting)
			text = f"{percent(point.error)}, {timeText(point.time)}" if point else "-"
			cells.append(f"**{text}**" if point in fronts[name] else text)
		result = known[setting]
		rows.append(dialTexts(setting) + cells + [f"{1e6 * result['dt']:.0f}", result["limitText"], f"{result['memoryPerBrick'] / 1024:.1f}"])
	return markdown([*dialHeadings, *(f"{name}: error, s/s" for name in points), "dt [us]", "limited by", "kB"], rows)


def readings(points, titles, scatter):
	"""What all panels say, as markdown.

	:param titles: of panels, by name
	"""
	lines = []
	for name, members in points.items():
		lines += reading(titles[name], members, scatter if name == "collapse" else None) + [""]
	intro = "**Each notch**, over all the above: what is left of the error and what becomes of the time, as medians; 'range' is that of the error."
	return "\n".join(lines) + f"\n{intro}\n\n{notchTable(points)}"


def markdown(headings, rows):
	lines = [headings, ["---"] * len(headings), *rows]
	return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)


def withinMarks(text, name, content):
	"""The text of a page with what stands between the marks of that name replaced; the marks stay.

	:raises ValueError: when the page has no such marks
	"""
	begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
	if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
		raise ValueError(f"the page has no part between {begin.strip()} and {end}")
	head, rest = text.split(begin)
	return head + begin + content + end + rest.split(end)[1]
