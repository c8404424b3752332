# SPDX-License-Identifier: GPL-2.0-or-later
"""What deformation on demand costs and errs: the paper's walls with rigid bricks, deformable ones, and bricks that deform where joints are stressed.

    build/yade -n -x examples/07_deformation_on_demand.py [--out DIR] [--thickness R ...] [--bond BOND ...] [--quick] [--help]

Runs examples 02 (straight joints) and 03 (English bond), one after another, each in a YADE of its own, under the same motion and from the static state of
their own model:

| model | bricks |
|---|---|
| RIGID, DEFORM | all rigid; all deformable, which is the reference |
| DEFORM again | r differs by 1e-6, twice: a collapse is chaotic, and differences of this size say nothing |
| on demand u | rigid until a joint uses the share u of its strength, and again when it does not (DeformationOnDemand) |
| on demand, kept | they stay deformable (release = 0) |
| on demand, together | when one brick has to deform, all do, until no mortar holds them (paperWall.WallTogether) |
| until loose | all deformable, until their mortar has failed: then rigid |

Before that, the walls at rest with some bricks deformable and the others rigid, by statics: what such a mixture does to their joints.

Leaves in DIR: table.md (cost, outcome, and differences from DEFORM before its first crack, before it collapses, and to the end), result.json,
on-demand.png, and each run in a folder of its own. About six minutes for each r; --quick: a minute, and judged.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import time
from typing import NamedTuple

import numpy as np

import yade_brick
from yade import O
from yade_brick import build, report

examples = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path.insert(0, examples)
import onDemand
import paperWall

scripts = {"straight": "02_straight_joint_wall.py", "english": "03_english_bond_wall.py"}
builders = {"straight": build.straightJointWall, "english": build.englishBondWall}
roundOff = 1e-6  # by which r differs in repetitions


class Model(NamedTuple):
	"""How the bricks of a wall deform: options of 02 and 03, and the factor on r."""

	name: str
	arguments: tuple
	factor: float = 1


def onDemandModel(name, *arguments):
	return Model(f"on demand {name}", ("--model", "demand", "--demand", *arguments))


rigid, deform, usual = Model("RIGID", ("--model", "rigid")), Model("DEFORM", ("--model", "deform")), onDemandModel("0.5", "utilisation=0.5")
repetitions = [Model(f"DEFORM again {sign}", deform.arguments, 1 + number * roundOff) for sign, number in (("+", 1), ("-", -1))]
together = onDemandModel("0.5, together", "utilisation=0.5", "release=0", "--together")
# any stress at all, and so any mortar that holds, is a demand
untilLoose = Model("until loose", (*deform.arguments, "--demand", "utilisation=1e-6"))
models = [
        rigid, deform, *repetitions, onDemandModel("0.25", "utilisation=0.25"), usual, onDemandModel("0.75", "utilisation=0.75"),
        onDemandModel("0.5, kept", "utilisation=0.5", "release=0"), together, untilLoose
]


def options():
	parser = argparse.ArgumentParser(prog=os.path.basename(sys.argv[0]), description=__doc__.splitlines()[0])
	parser.add_argument("--thickness", type=float, nargs="+", default=[0.001], help="thickness r of the contact part, one or several [m] (default: 0.001)")
	parser.add_argument("--bond", nargs="+", choices=tuple(scripts), default=list(scripts), help="which walls (default: both)")
	parser.add_argument("--duration", type=float, default=10, help="seconds of shaking (default: 10)")
	parser.add_argument("--quick", action="store_true", help="the straight wall alone for 2.6 s, until it has cracked, with five models")
	parser.add_argument("--resume", action="store_true", help="take runs that DIR has already, made with the same options, instead of running them again")
	parser.add_argument("--out", metavar="DIR", default="result-07", help="folder for the results (default: result-07)")
	chosen = parser.parse_args()
	if not (math.isfinite(chosen.duration) and chosen.duration > 0):
		parser.error(f"--duration is {chosen.duration}; allowed is a finite number of seconds > 0")
	if chosen.quick:
		chosen.bond, chosen.duration = ["straight"], 2.6
	return chosen


# Some bricks deformable at rest


def mixtures(bond, thickness):
	"""The largest share of its strength that a joint uses under self weight: dict from which bricks deform to (least, median, most) of the choices."""
	count = {"straight": 36, "english": 39}[bond]
	course = np.repeat(np.arange(paperWall.courses), 6 if bond == "straight" else [6, 7] * 3)
	every, brick = np.full(count, True), np.eye(count, dtype=bool)
	found = {
	        "none": [largestUse(bond, thickness, ~every)],
	        "all": [largestUse(bond, thickness, every)],
	        "one": [largestUse(bond, thickness, one) for one in brick],
	        "one course": [largestUse(bond, thickness, course == one) for one in range(paperWall.courses)],
	        "all but one": [largestUse(bond, thickness, ~one) for one in brick],
	}
	return {name: (min(uses), float(np.median(uses)), max(uses)) for name, uses in found.items()}


def largestUse(bond, thickness, deformable):
	"""The largest share of its strength that a segment uses in the wall at rest.

	:param deformable: (bricks,) which bricks deform
	"""
	O.reset()
	chosen = paperWall.options(__doc__, "", ["--model", "rigid", "--thickness", repr(thickness)])
	masonry = builders[bond](paperWall.columns, paperWall.courses, 3 * (paperWall.side,), **paperWall.brickOptions(chosen))
	for body, deforms in zip(masonry.bodies, deformable):
		body.shape.deformation = "trilinear" if deforms else "rigid"
	adobe = masonry.bodies[0].material
	O.bodies.append(paperWall.supportingWall(0, axis=2, sense=1, material=adobe))
	O.bodies.append(masonry.bodies)
	O.engines = yade_brick.engines(gravity=(0, 0, -paperWall.gravity), failure=False)
	yade_brick.MortarJoints()()
	yade_brick.StaticEquilibrium()()
	O.step()
	joints = [joint for joint in O.interactions if joint.isReal and joint.phys.jointed]
	normal = np.array([stress for joint in joints for stress in joint.phys.normalStress(joint.geom)])
	shear = np.array([stress.norm() for joint in joints for stress in joint.phys.shearStress(joint.geom)])
	return float(onDemand.use(normal, shear, adobe.mortar).max())



def perform(bond, thickness, model, chosen):
	"""Runs it in a YADE of its own; (result.json, wall.npz)."""
	folder = os.path.join(chosen.out, f"{bond}-{1e3 * thickness:g}mm", model.name.replace(",", "").replace(" ", "-"))
	script = [os.path.join(examples, scripts[bond]), "--duration", str(chosen.duration), "--thickness", repr(thickness * model.factor), "--out", folder]
	script += model.arguments
	recorded = os.path.join(folder, "command.txt")
	if not (chosen.resume and os.path.exists(recorded) and open(recorded).read() == "\n".join(script)):
		os.makedirs(folder, exist_ok=True)
		with open(os.path.join(folder, "log.txt"), "w") as log:
			status = subprocess.run([sys.yade_argv[0], "-n", "-x", "-j1", *script], stdout=log, stderr=subprocess.STDOUT).returncode
		# 1: a judged row is not ok, which belongs to the results; anything else, or no results, is a failure to run
		if status not in (0, 1) or not os.path.exists(os.path.join(folder, "wall.npz")):
			raise RuntimeError(f"{' '.join(script)} ended with status {status}; see {log.name}")
		with open(recorded, "w") as file:
			file.write("\n".join(script))
	with open(os.path.join(folder, "result.json")) as file:
		return json.load(file), dict(np.load(os.path.join(folder, "wall.npz")))


class Wall:
	"""The runs of one wall with one r.

	:param runs: dict from Model to (result, arrays)
	:param mixtures: of the wall at rest, see `mixtures`
	"""

	def __init__(self, bond, thickness, runs, mixtures):
		self.bond, self.thickness, self.runs, self.mixtures = bond, thickness, runs, mixtures
		self.measured = {model: onDemand.measured(*run) for model, run in runs.items()}
		self.reference = runs[deform][1]
		fact, last = self.measured[deform], float(self.reference["time"][-1])
		# a sample is past its event by up to the time between two looks; before the first crack means before that
		cracked = last if fact.firstFailed is None else float(self.reference["time"][self.reference["time"] < fact.firstFailed][-1])
		self.ends = {"before the first crack": cracked, "before the collapse": last if fact.collapse is None else fact.collapse, "to the end": last}

	@property
	def title(self):
		return f"{'Straight joints' if self.bond == 'straight' else 'English bond'}, r = {1e3 * self.thickness:g} mm"

	def differences(self, model):
		"""From DEFORM, for each of the ends."""
		return [onDemand.difference(self.runs[model][1], self.reference, end) for end in self.ends.values()]

	def scatter(self):
		"""The larger of what repetitions of DEFORM differ by, for each of the ends; None without repetitions."""
		found = [self.differences(model) for model in repetitions if model in self.runs]
		return [onDemand.worst(same) for same in zip(*found)] if found else None

	def mixtureTable(self):
		rows = [[name, *(f"{value:.2f}" for value in values)] for name, values in self.mixtures.items()]
		return onDemand.markdown(["at rest, deformable", "least", "median", "most"], rows)

	def costTable(self):
		headings = [
		        "model", "CPU s", "DEFORM / this", "steps", "mean dt [us]", "deformable", "to deformable, back", "first failed [s]", "failed T, S, C", "collapse [s]",
		        "fallen", "energy gained [J]"
		]
		return onDemand.markdown(headings, [self.costRow(model, found) for model, found in self.measured.items()])

	def costRow(self, model, found):
		return [
		        model.name, f"{found.cpu:.1f}", f"{self.measured[deform].cpu / found.cpu:.1f}", found.steps, f"{1e6 * found.dt:.0f}", f"{100 * found.share:.0f} %",
		        f"{found.changes[0]}, {found.changes[1]}", onDemand.timeText(found.firstFailed), ", ".join(map(str, found.failed)),
		        onDemand.timeText(found.collapse), found.fallen, f"{found.gained:.2g}"
		]

	def errorTable(self):
		headings = ["model"] + [f"{name} ({end:.2f} s)" for name, end in self.ends.items()]
		rows = [["DEFORM's own motion", *map(cell, (onDemand.motionSize(self.reference, end) for end in self.ends.values()))]]
		rows += [[model.name, *map(cell, self.differences(model))] for model in self.runs if model != deform]
		return onDemand.markdown(headings, rows)

	def facts(self):
		rows = {
		        model.name: {**found._asdict(), "differences": dict(zip(self.ends, (entry._asdict() for entry in self.differences(model))))}
		        for model, found in self.measured.items()
		}
		return {"bond": self.bond, "thickness": self.thickness, "mixtures": self.mixtures, "ends": self.ends, "models": rows}


def cell(found):
	return ", ".join(onDemand.millimetres(length) for length in found)


def text(walls):
	lines = [
	        "CPU s: processor time of the shaking on one thread, without recording. Deformable: share of all brick-steps. Failed: segments, in tension, shear and "
	        "compression. Collapse: a brick's centre has come down by half a side.\n",
	        "Differences [mm]: distance of centres of bricks from those of DEFORM, both from where they were laid: root mean square of the top's first brick, "
	        "of all bricks, largest of all.\n",
	        "At rest: largest share of its strength that a segment of the intact wall uses, over all choices of the bricks that deform.\n"
	]
	for wall in walls:
		lines += [f"### {wall.title}\n", wall.mixtureTable(), wall.costTable(), wall.errorTable()]
	return "\n".join(lines)


# What has to hold


def judged(walls):
	"""Rows that hold whatever the defects of the criterion: as it began until asked, fewer steps than DEFORM, no energy from nothing."""
	rows = []
	for wall in walls:
		for model in (model for model in wall.runs if "--demand" in model.arguments):
			result, arrays = wall.runs[model]
			where = f"{wall.bond} {1e3 * wall.thickness:g} mm, {model.name}"
			# until the first brick changes it is the wall that it began as, to the last bit
			before, origin = onDemand.unchanged(arrays), deform if model == untilLoose else rigid
			unlike = np.abs(arrays["displacement"][before] - wall.runs[origin][1]["displacement"][:before.sum()]).max()
			rows.append(report.judgedRow(f"{where}: difference from {origin.name} before any brick changes [m]", float(unlike), limit=0))
			# without fewer steps there would be no sense in it
			rows.append(report.judgedRow(f"{where}: steps over DEFORM's", wall.measured[model].steps / wall.measured[deform].steps, limit=1))
			rows += [{**row, "id": f"{where}: {row['id']}"} for row in result["rows"]]
	return rows


# The picture

colors = dict(zip(models, ("#444444", "#1f4e79", "#1f4e79", "#1f4e79", "#c9a227", "#c0562f", "#8a2f1a", "#d98fa0", "#2e8b57", "#7b3fa0")))
shownInTime = (rigid, deform, usual, together, untilLoose)
leastError = 1e-9  # what is no different from DEFORM is drawn there [m]


def draw(walls, path):
	"""Time saved against error; when how many bricks deformed; displacement of the top: a column for each wall."""
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	figure = Figure(figsize=(6.5 * len(walls), 10.5), layout="constrained")
	FigureCanvasAgg(figure)
	for axes, wall in zip(figure.subplots(3, len(walls), squeeze=False, height_ratios=(5, 3, 4)).T, walls):
		drawCost(axes[0], wall)
		drawInTime(axes[1:], wall)
	figure.savefig(path, dpi=70)


def drawCost(axes, wall):
	"""Error of all bricks over the factor by which the run is faster than DEFORM."""
	title = f"{wall.title}\ndots: before the first crack, squares: before the collapse"
	axes.set(xlabel="time of DEFORM / time", ylabel="rms difference from DEFORM [mm]", yscale="log", title=title)
	for model in (model for model in wall.runs if model != deform and model not in repetitions):
		faster, color = wall.measured[deform].cpu / wall.measured[model].cpu, colors[model]
		before, until, _ = (1e3 * max(found.all, leastError) for found in wall.differences(model))
		axes.plot([faster, faster], [before, until], color=color, lw=0.6)
		axes.plot(faster, before, "o", color=color, label=model.name)
		axes.plot(faster, until, "s", color=color, fillstyle="none")
	for found, line, name in zip(wall.scatter() or [], ("-", "--"), ("first crack", "collapse")):
		axes.axhline(1e3 * max(found.all, leastError), color=colors[deform], lw=0.8, linestyle=line, label=f"DEFORM again, before the {name}")
	axes.set_xlim(left=0)
	axes.legend(fontsize=8, loc="lower right")


def drawInTime(axes, wall):
	last = min(4.0, float(wall.reference["time"][-1]))
	count, top = axes
	count.set(ylabel="bricks that deform", xlim=(min(1.0, last / 2), last))
	top.set(xlabel="time [s]", ylabel="ux of the top's first brick [mm]", xlim=count.get_xlim(), ylim=(-1000, 1000))
	top.set_yscale("symlog", linthresh=2)
	for model in (model for model in shownInTime if model in wall.runs):
		arrays, color = wall.runs[model][1], colors[model]
		count.step(arrays["time"], arrays["deformable"], where="post", color=color, lw=1, label=model.name)
		top.plot(arrays["time"], 1e3 * arrays["displacement"][:, int(np.argmax(arrays["course"])), 0], color=color, lw=0.9)
	for each in axes:
		each.axvline(wall.measured[deform].firstFailed or last, color=colors[deform], lw=0.6, linestyle=":")
	count.legend(fontsize=8, loc="upper right")


# The command


def main():
	chosen, begun = options(), time.perf_counter()
	wanted, walls = [rigid, deform, usual, together, untilLoose] if chosen.quick else models, []
	for thickness in chosen.thickness:
		for bond in chosen.bond:
			runs = {}
			for model in wanted:
				runs[model] = perform(bond, thickness, model, chosen)
				sys.stderr.write(f"{time.perf_counter() - begun:.0f} s: {bond}, {1e3 * thickness:g} mm, {model.name}\n")
			walls.append(Wall(bond, thickness, runs, mixtures(bond, thickness)))
	rows, table = judged(walls), text(walls)
	with open(os.path.join(chosen.out, "table.md"), "w") as file:
		file.write(table)
	report.writeResult(chosen.out, rows, duration=chosen.duration, walls=[wall.facts() for wall in walls])
	draw(walls, os.path.join(chosen.out, "on-demand.png"))
	print(table)
	print(report.table(rows, title=f"Results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
