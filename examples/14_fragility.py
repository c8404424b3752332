# SPDX-License-Identifier: GPL-2.0-or-later
"""A fragility curve: how probable is it that a wall falls, against the peak ground acceleration?

    build/yade -n -x examples/14_fragility.py [--quick] [--jobs N] [--out DIR] [--help]

Five intensities times ten synthetic motions, made by yade_brick.syntheticNearFault with ten seeds: a table of 50 rows, whose script is shakenWall.py
beside this file. Interrupt it (Ctrl-C) and start it again: rows that are finished are not run again. `build/yade-batch DIR/walls.table examples/shakenWall.py`
would run the same table.

Leaves in DIR: walls.table, walls.results/ (a folder for each row, with its log), walls.csv and walls.json (all results), fragility.png, result.json. To be seen
in the figure: the share of walls that fell at each intensity, the lognormal curve of greatest likelihood, and how much 50 runs leave open. Some minutes;
--quick: 4 runs, which determine no curve, and the figure says so.
"""

import argparse
import os
import sys

from yade_brick import fragility, report, study

script = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "shakenWall.py")
intensities, seeds = (3.0, 4.0, 5.0, 6.0, 7.0), range(1, 11)  # [m/s2]
quickIntensities, quickSeeds, quickWall = (1.5, 9.0), (1, 2), {"columns": 2, "courses": 3, "duration": 3.0}


def options():
	parser = argparse.ArgumentParser(prog="14_fragility.py", description=__doc__.splitlines()[0])
	parser.add_argument("--quick", action="store_true", help="four runs of a smaller wall")
	parser.add_argument("--jobs", type=int, help="runs at once (default: one a processor)")
	parser.add_argument("--timeout", type=float, default=600, help="seconds after which a run is given up (default: 600)")
	parser.add_argument("--out", metavar="DIR", default="result-14", help="folder for the results (default: result-14)")
	return parser.parse_args()


def table(quick):
	"""The rows: each intensity with each seed."""
	if quick:
		return [{"pga": pga, "seed": seed, **quickWall} for pga in quickIntensities for seed in quickSeeds]
	return [{"pga": pga, "seed": seed} for pga in intensities for seed in seeds]


def describe(row):
	return f"pga={row['pga']:g},seed={row['seed']}"


def judge(runs, fit):
	"""Every run has a result, and the strongest shaking brings down more walls than the weakest."""
	share = fit.collapsed / fit.runs
	return [
	        report.judgedRow("runs without result", len(runs.rows) - runs.finished, limit=0),
	        report.judgedRow("collapse at the weakest less that at the strongest shaking", share[0] - share[-1], limit=-0.5),
	]


def main():
	chosen = options()
	walls = study.writeTable(os.path.join(chosen.out, "walls.table"), table(chosen.quick), describe)
	runs = study.runStudy(walls, script, jobs=chosen.jobs, timeout=chosen.timeout)
	found = [row for row in runs.rows if row["result"]]
	if not found:
		sys.exit("no run has a result; the logs say why")
	fit = fragility.fitFragility([row["parameters"]["pga"] for row in found], [row["result"]["collapsed"] for row in found])
	title = "Small wall of rigid bricks under synthetic near-fault motions"
	fragility.fragilityPlot(os.path.join(chosen.out, "fragility.png"), fit, "peak ground acceleration [m/s$^2$]", title=title)
	rows = judge(runs, fit)
	report.writeResult(chosen.out, rows, fragility=fit.facts())
	curve = fit.note or f"median {fit.median:.3g} m/s2, dispersion {fit.dispersion:.2f}"
	print(report.table(rows, title=f"{curve}; results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
