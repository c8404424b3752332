# SPDX-License-Identifier: GPL-2.0-or-later
"""Incremental dynamic analysis: each of six motions is made stronger until a wall falls; how does its drift grow, and when does it fall?

    build/yade -n -x examples/16_incremental_dynamic_analysis.py [--quick] [--jobs N] [--out DIR] [--help]

The runs are rows of a table, each of them shakenWall.py beside this file; which intensity comes next follows from the results so far: upwards in growing steps,
then halving until the collapse is known to 5 %. Interrupt it (Ctrl-C) and start it again: it takes the same way through the results that are there, and goes
on.

Leaves in DIR: walls.table, walls.results/, walls.csv, ida.png (curves of all motions with 16, 50 and 84 % fractiles), result.json (collapse
intensities, their median and dispersion). The motions are synthetic, made by yade_brick.syntheticNearFault. Some minutes; --quick: two motions, a
smaller wall, 30 %.
"""

import argparse
import os
import sys

import numpy as np

from yade_brick import fragility, ida, report

script = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "shakenWall.py")


def options():
	parser = argparse.ArgumentParser(prog="16_incremental_dynamic_analysis.py", description=__doc__.splitlines()[0])
	parser.add_argument("--quick", action="store_true", help="two motions, a smaller wall, collapse to 30 %%")
	parser.add_argument("--jobs", type=int, help="runs at once (default: one a processor)")
	parser.add_argument("--timeout", type=float, default=600, help="seconds after which a run is given up (default: 600)")
	parser.add_argument("--out", metavar="DIR", default="result-16", help="folder for the results (default: result-16)")
	return parser.parse_args()


def judge(curves, plan):
	"""Every motion has led to collapse, which is known as well as was asked for."""
	rows = [report.judgedRow("motions whose analysis ended early", sum(curve.note is not None for curve in curves), limit=0)]
	rows += [
	        report.judgedRow(f"{curve.name}: interval of the collapse over its upper end", 1 - curve.stands / curve.collapses, limit=plan.tolerance)
	        for curve in curves
	]
	return rows


def main():
	chosen = options()
	if chosen.quick:
		plan = ida.HuntAndFill(first=5.0, step=3.0, limit=20.0, tolerance=0.3)
		motions = {f"seed{seed}": {"seed": seed, "columns": 2, "courses": 3, "duration": 3.0} for seed in (1, 2)}
	else:
		plan = ida.HuntAndFill(first=1.0, step=1.0, limit=20.0, growth=0.25, tolerance=0.05, fill=2)
		motions = {f"seed{seed}": {"seed": seed} for seed in range(1, 7)}
	curves = ida.incrementalDynamicAnalysis(os.path.join(chosen.out, "walls.table"), script, motions, "pga", plan, jobs=chosen.jobs, timeout=chosen.timeout)
	for curve in curves:
		print(f"{curve.name}: stands at {curve.stands:g}, collapses at {curve.collapses:g} m/s2{'; ' + curve.note if curve.note else ''}")
	label, title = "peak ground acceleration [m/s$^2$]", "Small wall of rigid bricks under synthetic near-fault motions"
	ida.idaPlot(os.path.join(chosen.out, "ida.png"), curves, label, "largest drift of the top course [-]", title=title)
	runs = [(point.intensity, point.collapsed) for curve in curves for point in curve.points]
	capacities = [curve.capacity for curve in curves if np.isfinite(curve.capacity)]
	median, dispersion = fragility.lognormalCapacity(capacities) if len(capacities) > 1 else (None, None)
	rows = judge(curves, plan)
	report.writeResult(chosen.out, rows, capacities=capacities, median=median, dispersion=dispersion, runs=len(runs))
	print(report.table(rows, title=f"{len(runs)} runs; results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
