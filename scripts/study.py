# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a script for every row of a yade-batch table, several at once, and goes on where it was interrupted.

    build/yade -n -x scripts/study.py TABLE SCRIPT [--jobs N] [--timeout S] [--threads N] [--rerun]

The script reads its parameters with readParamsFromTable and ends with yade_brick.study.record(...). Rows that have a result of these parameters and this script
are not run again; a run that fails does not touch the others. Results of all rows: TABLE's name with .csv and .json, and .results/ for logs. The exit status is
0 when every row has its result.
"""

import argparse
import sys

from yade_brick import study

parser = argparse.ArgumentParser(prog="study.py", description=__doc__.splitlines()[0])
parser.add_argument("table", metavar="TABLE", help="table of parameters, a row for each run")
parser.add_argument("script", metavar="SCRIPT", help="YADE script that runs one row")
parser.add_argument("--jobs", type=int, help="runs at once (default: one a processor)")
parser.add_argument("--timeout", type=float, help="seconds after which a run is given up (default: none)")
parser.add_argument("--threads", type=int, default=1, help="threads of each run (default: 1)")
parser.add_argument("--rerun", action="store_true", help="run all rows again")
chosen = parser.parse_args()
try:
	found = study.runStudy(chosen.table, chosen.script, chosen.jobs, chosen.timeout, chosen.threads, rerun=chosen.rerun)
except (ValueError, OSError) as error:
	parser.error(str(error))
sys.exit(found.exitStatus)
