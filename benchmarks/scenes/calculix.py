# SPDX-License-Identifier: GPL-2.0-or-later
# The same wall as one elastic continuum in CalculiX: explicit dynamics, one hexahedron a brick, glued, without contact.
"""Elastic wall under its weight:  python3 benchmarks/scenes/calculix.py --columns 12 --courses 12 --simulated 2

The cost is that of a long run less that of a short one, so that reading, set-up and writing do not count. CalculiX chooses its steps itself.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import common

shortRun = 0.05  # [s] simulated


def block(numbers, width=12):
	"""Numbers as lines of an input file."""
	return [",".join(map(str, numbers[i:i + width])) for i in range(0, len(numbers), width)]


def deck(columns, courses, duration):
	"""CalculiX input of a wall of cubes that stands on fixed nodes."""

	def node(i, j, k):
		return 1 + i + (columns + 1) * (j + 2 * k)

	nodes = [(i, j, k) for k in range(courses + 1) for j in range(2) for i in range(columns + 1)]
	cubes = [(i, k) for k in range(courses) for i in range(columns)]
	ring = ((0, 0), (1, 0), (1, 1), (0, 1))
	lines = ["*NODE,NSET=ALL"]
	lines += ["{},{:.9g},{:.9g},{:.9g}".format(node(*place), *(common.side * index for index in place)) for place in nodes]
	lines += ["*ELEMENT,TYPE=C3D8,ELSET=WALL"]
	for number, (i, k) in enumerate(cubes, 1):
		lines += block([number] + [node(i + di, dj, k + dk) for dk in range(2) for di, dj in ring])
	lines += ["*NSET,NSET=GROUND", *block([node(i, j, 0) for j in range(2) for i in range(columns + 1)]), "*NSET,NSET=TOP", str(node(columns, 1, courses))]
	lines += ["*MATERIAL,NAME=ADOBE", "*ELASTIC", f"{common.young},{common.poisson}", "*DENSITY", str(common.density)]
	lines += ["*SOLID SECTION,ELSET=WALL,MATERIAL=ADOBE", "*BOUNDARY", "GROUND,1,3", "*STEP,INC=1000000", "*DYNAMIC,EXPLICIT"]
	# the first step is a guess, which it replaces by its own
	lines += [f"0.001,{duration:.9g}", "*DLOAD", f"WALL,GRAV,{common.gravity},0,0,-1", "*NODE PRINT,NSET=TOP,FREQUENCY=1000000", "U", "*END STEP"]
	return "\n".join(lines) + "\n"


def run(columns, courses, duration):
	"""CPU and wall time of one run [s]."""
	with tempfile.TemporaryDirectory() as folder:
		with open(os.path.join(folder, "wall.inp"), "w") as file:
			file.write(deck(columns, courses, duration))
		wall, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
		oneThread = {**os.environ, "OMP_NUM_THREADS": "1"}
		done = subprocess.run(["ccx", "-i", "wall"], cwd=folder, env=oneThread, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
		wall, after = time.perf_counter() - wall, resource.getrusage(resource.RUSAGE_CHILDREN)
		if "Job finished" not in done.stdout:
			sys.exit("ccx has not finished: " + done.stdout[-600:])
		checkSettlement(os.path.join(folder, "wall.dat"))
	return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def checkSettlement(path):
	"""The top of a wall let go under its weight sinks: a run that did not load it would be no measurement."""
	with open(path) as file:
		sunk = float(file.read().split()[-1])
	if not -common.side < sunk < 0:
		sys.exit(f"the top of CalculiX's wall has moved by {sunk} m")


chosen = common.options(__doc__, columns=12, courses=12, simulated=2.0)
short, long = (run(chosen.columns, chosen.courses, duration) for duration in (shortRun, shortRun + chosen.simulated))
common.finish(bricks=chosen.columns * chosen.courses, simulated=chosen.simulated, cpu=long[0] - short[0], wall=long[1] - short[1])
