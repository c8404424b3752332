# SPDX-License-Identifier: GPL-2.0-or-later
# The benchmarks: measures what was asked for, prints the table and leaves it in files. scripts/benchmark.sh builds everything first and calls this.
"""Measures the speed of yade-brick beside that of what one would use instead, on this machine, in one run."""

import argparse
import os
import platform
import sys
import time

import results
import targets
from sampling import MeasurementFailed, Runner, measure

source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def options(words):
	parser = argparse.ArgumentParser(prog="scripts/benchmark.sh", description=__doc__)
	names = [row.name for row in targets.rows]
	parser.add_argument("--only", metavar="ROW,..", default="", help=f"only these rows, by name or its beginning: {', '.join(names)}")
	parser.add_argument("--quick", action="store_true", help="one round of short runs: within minutes, and rough")
	parser.add_argument("--out", metavar="DIR", default=os.path.join(source, "build", "benchmarks"), help="folder for benchmarks.json and benchmarks.md")
	parser.add_argument("--yade", metavar="PROGRAM", default=os.path.join(source, "build", "yade"), help="YADE with the plugin (default: build/yade)")
	parser.add_argument("--programs", metavar="DIR", default=os.path.join(source, "build", "benchmarks"), help="folder of the programs built from this folder")
	chosen = parser.parse_args(words)
	asked = [name for name in chosen.only.split(",") if name]
	unknown = [name for name in asked if not any(known.startswith(name) for known in names)]
	if unknown:
		parser.error(f"--only: no row is called {', '.join(unknown)}; there are {', '.join(names)}")
	chosen.rows = [row for row in targets.rows if not asked or row.name.startswith(tuple(asked))]
	return chosen


def machineFacts():
	"""What the figures depend on, besides the code."""
	with open("/proc/cpuinfo") as file:
		model = next((line.split(":", 1)[1].strip() for line in file if line.startswith("model name")), platform.machine())
	return {"processor": model, "cores": os.cpu_count(), "system": platform.platform(), "date": time.strftime("%Y-%m-%d %H:%M"), "load before": os.getloadavg()[0]}


def outcomesOf(rows, missing, samples, failed):
	"""An Outcome for each row.

	:param missing: {measurement name: what this machine lacks}
	"""

	def outcome(row):
		for word, reasons in (("skipped", missing), ("failed", failed)):
			troubles = [reasons[measurement.name] for measurement in row.measurements if reasons.get(measurement.name)]
			if troubles:
				return targets.Outcome(row, trouble=f"{word}: {troubles[0]}")
		return targets.Outcome(row, {measurement.name: samples[measurement.name] for measurement in row.measurements})

	return [outcome(row) for row in rows]


def addProfiles(outcomes, runner, say):
	"""Profiles for the rows that are missed, each scene's once."""
	known = {}
	for outcome in (outcome for outcome in outcomes if outcome.verdict == "missed"):
		for measurement in outcome.row.profiled:
			if measurement.name not in known:
				say(f"{measurement.name}, profile")
				known[measurement.name] = runner.profile(measurement)
			outcome.profiles[measurement.name] = known[measurement.name]


def main(words):
	chosen, begun = options(words), time.perf_counter()

	def say(message):
		print(f"[{time.perf_counter() - begun:5.0f} s] {message}", file=sys.stderr, flush=True)

	machine = machineFacts()
	if machine["load before"] > 0.3:
		say(f"something else is running (load {machine['load before']:.1f}): read the ratios with care, above all that of two threads")
	runner = Runner(chosen.yade, chosen.programs, seconds=0.5 if chosen.quick else 2)
	missing = {measurement.name: runner.missing(measurement) for row in chosen.rows for measurement in row.measurements}
	possible = [row for row in chosen.rows if not any(missing[measurement.name] for measurement in row.measurements)]
	samples, failed = measure(possible, runner, 1 if chosen.quick else 3, say)
	outcomes = outcomesOf(chosen.rows, missing, samples, failed)
	try:
		addProfiles(outcomes, runner, say)
	except MeasurementFailed as trouble:
		failed["profile"] = str(trouble)
		say(f"failed: {trouble}")
	machine.update({"load after": os.getloadavg()[0], "YADE": next((taken[0]["yade"] for taken in samples.values() if "yade" in taken[0]), None)})
	commands = {measurement.name: " ".join(runner.command(measurement)) for row in possible for measurement in row.measurements}
	results.write(chosen.out, outcomes, machine, samples, commands)
	print(results.text(outcomes))
	print(f"Results in {chosen.out}: benchmarks.md, benchmarks.json")
	return 1 if failed else 0


if __name__ == "__main__":
	sys.exit(main(sys.argv[1:]))
