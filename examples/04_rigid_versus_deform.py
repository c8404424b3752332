# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's comparison of RIGID and DEFORM: straight joints and English bond, in plane and out of it, with its figures and findings.

    build/yade -n -x examples/04_rigid_versus_deform.py [--out DIR] [--duration S] [--motion FILE] [--sensitivity] [--hold] [--help]

Runs examples 02 and 03 with both models and both directions, two at a time, each in a YADE of its own; the runs in plane are repeated
with the motion scaled by 1 +- 1e-6, since a collapse is chaotic and one run alone proves nothing. About five minutes on two cores.

Leaves in DIR: report.md and result.json (tables, and for each of the six findings of Furukawa et al. 2014, section 4.3, whether it is seen,
by which criterion and with which numbers), figure09.png to figure12.png (as the paper's), figureOutOfPlane.png, and each run in a folder of its own.

--sensitivity varies, one at a time, what the paper leaves open or what might decide: r, segments, element, dashpots, motion, settling, and Poisson's
ratio 0, which takes Poisson's effect away and leaves the rest of DEFORM; it says which verdicts change (an hour). --hold leaves each wall
for 10 s without motion. No parameter is fitted to a finding.
"""

import argparse
import math
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

import yade_brick
from yade_brick import picture, report

examples = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path.insert(0, examples)
import findings
from findings import Outcome

scripts = {"straight": "02_straight_joint_wall.py", "english": "03_english_bond_wall.py"}
bonds, models = ("straight", "english"), ("rigid", "deform")
roundOff = 1e-6  # by which the motion of repetitions differs
figureShares = (0.25, 0.35, 0.45, 0.6, 1)  # of the duration: the shapes in figures 11 and 12; 2.5, 3.5, 4.5, 6 and 10 s
historySeconds = 1.5  # of figures 9 and 10

# What to run


def options():
	parser = argparse.ArgumentParser(prog=os.path.basename(sys.argv[0]), description=__doc__.splitlines()[0])
	parser.add_argument("--duration", type=float, default=10, help="seconds of shaking (default: 10)")
	parser.add_argument("--motion", metavar="FILE", help="as in 02; default: synthetic near-fault motion")
	parser.add_argument("--scale", type=float, default=1, help="factor on the motion (default: 1)")
	parser.add_argument("--repeat", type=int, default=3, help="runs in plane of each wall and model, the first with the motion itself (default: 3)")
	parser.add_argument("--sensitivity", action="store_true", help="also vary r, segments, element, dashpots, motion, settling and Poisson's ratio")
	parser.add_argument("--hold", action="store_true", help="also leave the walls without motion for 10 s")
	parser.add_argument("--resume", action="store_true", help="take runs that DIR has already, made with the same options, instead of running them again")
	parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default: 2)")
	parser.add_argument("--out", metavar="DIR", default="result-04", help="folder for the results (default: result-04)")
	chosen = parser.parse_args()
	if not (math.isfinite(chosen.duration) and chosen.duration > 0):
		parser.error(f"--duration is {chosen.duration}; allowed is a finite number of seconds > 0")
	if not (math.isfinite(chosen.scale) and chosen.repeat >= 1 and chosen.jobs >= 1):
		parser.error(f"--scale, --repeat, --jobs are {chosen.scale}, {chosen.repeat}, {chosen.jobs}; allowed are a finite number and whole numbers >= 1")
	return chosen


class Run(NamedTuple):
	"""One run of 02 or 03.

	:param study: what it belongs to: 'paper', 'hold', or the name of a variation
	:param arguments: further options of the script
	"""

	study: str
	bond: str
	model: str
	direction: str = "x"
	repetition: int = 0
	arguments: tuple = ()

	@property
	def folder(self):
		return os.path.join(self.study, "-".join([self.bond, self.model, self.direction] + ([str(self.repetition)] if self.repetition else [])))


def paperRuns(chosen):
	"""Both walls and models, in plane (with repetitions) and out of plane."""
	runs = []
	for bond in bonds:
		for model in models:
			for repetition in range(chosen.repeat):
				# 0, +1, -1, +2, ... times round-off
				shift = (repetition + 1) // 2 * (1 if repetition % 2 else -1) * roundOff
				runs.append(Run("paper", bond, model, "x", repetition, ("--scale", repr(chosen.scale * (1 + shift)))))
			runs.append(Run("paper", bond, model, "y", 0, ("--scale", repr(chosen.scale))))
	return runs


def holdRuns():
	return [Run("hold", bond, model, arguments=("--scale", "0", "--duration", "10")) for bond in bonds for model in models]


#: What is varied, and the options that do it: in both models, in DEFORM alone, in RIGID alone.
variations = {
        "segments 2": ("--segments", "2"),
        "segments 8": ("--segments", "8"),
        "hn = hs = 0.02": ("--hn", "0.02", "--hs", "0.02"),
        "hn = hs = 0.3": ("--hn", "0.3", "--hs", "0.3"),
        "hn = hs = 1": ("--hn", "1", "--hs", "1"),
        "Poisson's ratio 0": ("--poisson", "0"),
        "damped settling": ("--settle", "damped"),
        "motion x 0.3": ("--scale", "0.3"),
        "motion x 0.5": ("--scale", "0.5"),
        "motion x 0.75": ("--scale", "0.75"),
        "motion x 1.5": ("--scale", "1.5"),
}
deformVariations = {
        "r = 0.1 mm": ("--thickness", "0.0001"),
        "r = 5 mm": ("--thickness", "0.005"),
        "r = 10 mm": ("--thickness", "0.01"),
        "incompatible modes": ("--element", "incompatible"),
        "inner part of full size": ("--inner", "full"),
        "r = 40 mm, inner part of full size": ("--thickness", "0.04", "--inner", "full"),
        "inner damping 5 %": ("--damping-ratio", "0.05"),
}
# RIGID has springs of half a brick's length; with E x 100 they are as stiff as those of DEFORM's r = 1 mm
rigidVariations = {"RIGID with springs of r = 1 mm": ("--young", "9.8e8")}
otherMotions = {
        "motion of seed 2004": {"seed": 2004},
        "motion of seed 2005": {"seed": 2005},
        "pulse of 1.5 s": {"pulsePeriod": 1.5},
        "pulse of 3 s": {"pulsePeriod": 3.0}
}


def sensitivityRuns(out):
	"""The walls in plane with one thing changed at a time."""
	runs = [Run(name, bond, model, arguments=given) for name, given in variations.items() for bond in bonds for model in models]
	runs += [Run(name, bond, "deform", arguments=given) for name, given in deformVariations.items() for bond in bonds]
	runs += [Run(name, bond, "rigid", arguments=given) for name, given in rigidVariations.items() for bond in bonds]
	for name, changed in otherMotions.items():
		path = os.path.join(out, f"{name}.txt")
		yade_brick.writeColumns(yade_brick.syntheticNearFault(**changed), path)
		runs += [Run(name, bond, model, arguments=("--motion", path)) for bond in bonds for model in models]
	return runs


# Running


def perform(run, chosen):
	"""Runs it in a YADE of its own; its Outcome."""
	folder = os.path.join(chosen.out, run.folder)
	common = ["--duration", str(chosen.duration), "--scale", str(chosen.scale), "--model", run.model, "--direction", run.direction, "--out", folder]
	motion = ["--motion", chosen.motion] if chosen.motion else []
	script = [os.path.join(examples, scripts[run.bond]), *common, *motion, *run.arguments]
	recorded = os.path.join(folder, "command.txt")
	if chosen.resume and os.path.exists(recorded) and open(recorded).read() == "\n".join(script):
		return Outcome(folder)
	command = [sys.yade_argv[0], "-n", "-x", "-j1", *script]
	os.makedirs(folder, exist_ok=True)
	with open(os.path.join(folder, "log.txt"), "w") as log:
		status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode
	# 1: a judged row is not ok, which belongs to the results; anything else, or no results, is a failure to run
	if status not in (0, 1) or not os.path.exists(os.path.join(folder, "wall.npz")):
		raise RuntimeError(f"{' '.join(command)} ended with status {status}; see {log.name}")
	with open(recorded, "w") as file:
		file.write("\n".join(script))
	return Outcome(folder)


def performAll(runs, chosen):
	"""All runs, several at a time; a list of Outcome in their order. Says on stderr how far it is."""
	begun, done = time.perf_counter(), []

	def follow(run):
		outcome = perform(run, chosen)
		done.append(run)
		elapsed = time.perf_counter() - begun
		sys.stderr.write(f"{len(done)} of {len(runs)} runs, {elapsed:.0f} s: {run.folder}: collapse {findings.timeText(outcome.collapse)}\n")
		return run, outcome

	# the costly ones first, so that none is left alone at the end
	ordered = sorted(runs, key=lambda run: (run.model != "deform", run.bond != "english", run.direction))
	with ThreadPoolExecutor(chosen.jobs) as pool:
		found = dict(pool.map(follow, ordered))
	return [found[run] for run in runs]


def grouped(runs, outcomes, study):
	"""dict from (bond, model, direction) to the list of Outcome of a study."""
	groups = {}
	for run, outcome in zip(runs, outcomes):
		if run.study == study:
			groups.setdefault((run.bond, run.model, run.direction), []).append(outcome)
	return groups


# Figures


def historyFigure(path, walls, bond, title, array):
	"""Figures 9 and 10: displacement of A and B, both models, from where they were laid: so the curves begin with what self weight did."""
	histories, styles = {}, {}
	for model, line in (("rigid", "--"), ("deform", "-")):
		arrays = walls[bond, model, "x"][0].arrays
		course = arrays["course"]
		moved = arrays["displacement"][:, [int(np.argmax(course)), len(course) - 1]] if array == "displacement" else arrays[array]
		for place, (name, color) in enumerate((("A", "#1f4e79"), ("B", "#c0562f"))):
			histories[f"{name} {model.upper()}"], styles[f"{name} {model.upper()}"] = moved[:, place], {"linestyle": line, "color": color}
	# both models were looked at at the same times to within a step
	length = min(len(values) for values in histories.values())
	histories = {name: values[:length] for name, values in histories.items()}
	picture.historyPlot(path, arrays["time"][:length], histories, title=title, timeRange=(0, historySeconds), styles=styles)


def shapeFigure(path, walls, bond, direction, title, chosen):
	"""Figures 11 and 12: shapes at five times with the failed segments, RIGID above DEFORM."""
	frames = []
	for model in models:
		arrays = walls[bond, model, direction][0].arrays
		ends = np.cumsum(arrays["markCount"])
		for share in figureShares:
			index = int(np.abs(arrays["frameTime"] - share * chosen.duration).argmin())
			marked = slice(ends[index] - arrays["markCount"][index], ends[index])
			marks = picture.Marks(arrays["markPoint"][marked], arrays["markState"][marked]) if direction == "x" else None
			frames.append((float(arrays["frameTime"][index]), [picture.Patch(corners) for corners in arrays["frameCorners"][index]], marks))
	# bricks that have flown farther are outside the picture
	limits, view = ((-0.8, 2.0, -0.15, 1.5), "elevation") if direction == "x" else ((-1.5, 1.5, -0.15, 1.5), "side")
	picture.pictureSeries(path, frames, view=view, title=title, limits=limits, columns=len(figureShares), width=18, rowLabels=("RIGID", "DEFORM"))


def drawFigures(walls, chosen):
	name = walls["straight", "rigid", "x"][0].result["motion"]
	for bond, joints, histories, shapes in (("straight", "straight joints", "09", "11"), ("english", "English bond", "10", "12")):
		for array, what, suffix in (("displacement", "centres", ""), ("corner", "front corners", "-corners")):
			title = f"As Fig. {histories.lstrip('0')}, {joints}: {what} of A and B; {name}"
			historyFigure(os.path.join(chosen.out, f"figure{histories}{suffix}.png"), walls, bond, title, array)
		shapeFigure(os.path.join(chosen.out, f"figure{shapes}.png"), walls, bond, "x", f"As Fig. {shapes}, {joints}; {name}", chosen)
		shapeFigure(os.path.join(chosen.out, f"figureOutOfPlane-{bond}.png"), walls, bond, "y", f"Out of plane, {joints}; {name}", chosen)


# The report


def paperTables(walls, found):
	rests = [row for bond in bonds for row in findings.restRows(walls, bond)]
	verdicts = [[entry.number, entry.paper, f"**{entry.verdict}**", entry.numbers, entry.criterion] for entry in found]
	return "\n".join([
	        "## The six findings\n",
	        findings.markdown(["", "the paper reports", "here", "measured", "criterion"], verdicts),
	        "## The walls\n",
	        "Times from the start of the shaking, to 0.005 s. Collapse: the first time when a brick's centre has come down by half a brick side. "
	        f"Ranges: repetitions with the motion scaled by 1 +- {roundOff:g}. Spread: largest growth of a course's half width under self weight. "
	        "Energy gained without work: largest rise of the bricks' energy less the work of the ground motion, which only friction, dashpots and "
	        "cracks may change, downwards.\n",
	        findings.markdown(findings.wallHeadings, [findings.wallRow(key, runs) for key, runs in walls.items()]),
	        "## Under self weight\n",
	        "Courses from below; stress along the wall, tension positive. By equilibrium the sum over a vertical section is the horizontal reaction of "
	        "the base. Figures 9 and 10 count displacement from where the bricks were laid: at 0 s they show what self weight has done.\n",
	        findings.markdown(findings.restHeadings, rests),
	])


def sensitivityTable(walls, runs, outcomes):
	"""A row for each variation: what became of the four walls in plane, and the verdicts that changed; RIGID's runs stand in where it does not change."""
	first = {key: found[:1] for key, found in walls.items() if key[2] == "x"}
	usual = findings.findings(first)
	rows, verdicts = [variationRow("none", first, usual, usual)], {entry.number: {} for entry in usual}
	for study in dict.fromkeys(run.study for run in runs if run.study not in ("paper", "hold")):
		changed = {**first, **grouped(runs, outcomes, study)}
		now = findings.findings(changed)
		rows.append(variationRow(study, changed, now, usual))
		for entry in now:
			verdicts[entry.number].setdefault(entry.verdict, []).append(study)
	headings = ["varied", *(f"{bond} {model.upper()}: collapse, fallen" for bond in bonds for model in models), "stair of open joints RIGID, DEFORM (English)"]
	text = "Findings 1 to 5 judged from one run each. A cell: time of collapse, bricks fallen.\n"
	summary = "".join(
	        f"- Finding {number}, {usual[number - 1].verdict}: " + "; ".join(f"{word} in {len(names)} ({', '.join(names)})" for word, names in seen.items()) + "\n"
	        for number, seen in verdicts.items()
	)
	return f"## Sensitivity\n\n{text}\n" + findings.markdown([*headings, "verdicts 1 to 5", "changed"], rows) + f"\n{summary}", rows


def variationRow(name, walls, found, usual):
	cells = [f"{findings.timeText(walls[bond, model, 'x'][0].collapse)}, {walls[bond, model, 'x'][0].fallen}" for bond in bonds for model in models]
	stairs = ", ".join(str(walls["english", model, "x"][0].diagonalCrack()[0]) for model in models)
	changed = [str(now.number) for now, before in zip(found, usual) if now.verdict != before.verdict]
	return [name, *cells, stairs, ", ".join(entry.verdict for entry in found), ", ".join(changed) or "-"]


def judged(walls, runs, outcomes):
	"""What has to hold whatever the findings are: the walls began at rest, in equilibrium, lost no brick and made no energy; without motion nothing happened."""
	worst, limits = {}, {}
	usual = [outcome for run, outcome in zip(runs, outcomes) if run.study in ("paper", "hold")]
	for row in (row for outcome in usual for row in outcome.result["rows"]):
		if any(words in row["id"] for words in ("before the shaking", "not finite", "energy gained")):
			# what is not finite is null in the file
			worst[row["id"]] = max(worst.get(row["id"], 0), math.inf if row["got"] is None else row["got"])
			limits[row["id"]] = row["limit"]
	found = [report.judgedRow(f"{id}, worst of {len(usual)} runs", got, limit=limits[id]) for id, got in worst.items()]
	straight = walls["straight", "deform", "x"][0]
	# the static solution balances the joints to round-off
	thrust = straight.result["atRest"]["baseThrust"]
	found.append(report.judgedRow("force on the middle section, by the ground's thrust [N]", -straight.sectionForce(), expected=thrust, tolerance=1e-6))
	for run, outcome in zip(runs, outcomes):
		if run.study == "hold":
			found += [{**row, "id": f"{run.folder}: {row['id']}"} for row in outcome.result["rows"] if "before" not in row["id"] and "gained" not in row["id"]]
	return found


def main():
	chosen = options()
	os.makedirs(chosen.out, exist_ok=True)
	begun = time.perf_counter()
	runs = paperRuns(chosen) + (holdRuns() if chosen.hold else []) + (sensitivityRuns(chosen.out) if chosen.sensitivity else [])
	outcomes = performAll(runs, chosen)
	walls = grouped(runs, outcomes, "paper")
	found = findings.findings(walls)
	drawFigures(walls, chosen)
	text = paperTables(walls, found)
	varied = []
	if chosen.sensitivity:
		table, varied = sensitivityTable(walls, runs, outcomes)
		text += "\n" + table
	first = walls["straight", "rigid", "x"][0].result
	with open(os.path.join(chosen.out, "report.md"), "w") as file:
		file.write(f"# RIGID and DEFORM\n\nMotion: {first['motion']}.\n\n{text}")
	rows = judged(walls, runs, outcomes)
	report.writeResult(
	        chosen.out,
	        rows,
	        motion=first["motion"],
	        motionIsSynthetic=first["motionIsSynthetic"],
	        duration=chosen.duration,
	        findings=[entry._asdict() for entry in found],
	        walls=[dict(zip(findings.wallHeadings, findings.wallRow(key, runs))) for key, runs in walls.items()],
	        sensitivity=varied,
	        wallSeconds=time.perf_counter() - begun,
	)
	print(text)
	print(report.table(rows, title=f"results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
