# SPDX-License-Identifier: GPL-2.0-or-later
# What the scenes share: the wall's numbers, the clock, the profile and the one line of JSON that each leaves on its standard output.
"""Shared by the scenes of the benchmarks; pure Python but for the parts that step a YADE scene."""

import argparse
import ctypes
import gc
import json
import math
import time

density, young, poisson, frictionAngle = 1800, 9.8e6, 0.25, math.radians(32)  # adobe [kg/m3], [Pa]
side, gravity = 0.2, 9.8  # of a cube [m], [m/s2]
brickMass = density * side**3  # [kg]


def options(description, **defaults):
	"""Options --name with these defaults, whose types they have; a tuple gives the choices, the first by default."""
	parser = argparse.ArgumentParser(description=description)
	for name, default in defaults.items():
		if isinstance(default, tuple):
			parser.add_argument(f"--{name}", choices=default, default=default[0])
		else:
			parser.add_argument(f"--{name}", type=type(default), default=default)
	return parser.parse_args()


def timedSteps(seconds, warm):
	"""`warm` steps that do not count, then steps for about `seconds`, two at least: their number, simulated, CPU and wall time [s].

	Each is a call of O.step, which costs about 1 us: O.run looks only every 40 ms whether it is done.
	"""
	from yade import O, timing
	for _ in range(warm):
		O.step()
	timing.reset()
	steps, started, cpu, wall = 0, O.time, time.process_time(), time.perf_counter()
	while steps < 2 or time.perf_counter() - wall < seconds:
		O.step()
		steps += 1
	cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
	return {"steps": steps, "simulated": O.time - started, "cpu": cpu, "wall": wall}


def profile():
	"""Time of each engine in a step [us] by its class, which YADE counts while O.timingEnabled; engines that have not run are left out."""
	from yade import O
	steps = max(engine.execCount for engine in O.engines)
	return {type(engine).__name__: 1e-3 * engine.execTime / steps for engine in O.engines if engine.execCount}


def residentKilobytes():
	"""Memory of this process in RAM [kB, 1000 bytes], without what has been freed but not yet given back."""
	gc.collect()
	ctypes.CDLL(None).malloc_trim(0)
	with open("/proc/self/status") as status:
		return next(1.024 * int(line.split()[1]) for line in status if line.startswith("VmRSS"))


def finish(**facts):
	"""Prints the result, the last thing that a scene does."""
	print(json.dumps(facts), flush=True)
