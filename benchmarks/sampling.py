# SPDX-License-Identifier: GPL-2.0-or-later
# Runs measurements: each in a process of its own, on processors of its own, those that are compared in alternation.
"""From rows to samples."""

import json
import os
import shutil
import subprocess
import sys

longest = 900  # of one process [s]


class MeasurementFailed(Exception):
	"""A program has ended without a result."""


class Runner:
	"""Runs measurements on this machine.

	:param yade: the program that runs scenes
	:param programs: folder of the programs that were built from this one
	:param seconds: to be timed by each
	"""

	scenes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")

	def __init__(self, yade, programs, seconds):
		self.places = {"yade": yade, "python": sys.executable, "scenes": self.scenes, "programs": programs, "seconds": f"{seconds:g}"}
		self.processors = sorted(os.sched_getaffinity(0))

	def command(self, measurement):
		"""The words of its command line, pinned to as many processors as it has threads."""
		pin = ["taskset", "-c", ",".join(map(str, self.processors[-measurement.threads:]))] if shutil.which("taskset") else []
		return pin + [word.format(**self.places) for word in measurement.command.split()]

	def missing(self, measurement):
		"""What this machine lacks for it; '' when nothing."""
		if measurement.threads > len(self.processors):
			return f"{measurement.threads} processors are needed"
		return f"{measurement.package} is not installed" if measurement.package and not installed(measurement.package) else ""

	def sample(self, measurement):
		"""Runs it once; the JSON that it prints."""
		return result(self.output(self.command(measurement)))

	def profile(self, measurement):
		"""Time of each engine in a step of its scene [us]."""
		command = self.command(measurement)
		scene = next(i for i, word in enumerate(command) if word.startswith(self.scenes))
		return result(self.output(command[:scene] + [os.path.join(self.scenes, "profiled.py")] + command[scene:]))["profile"]

	@staticmethod
	def output(command):
		try:
			done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace", timeout=longest)
		except (OSError, subprocess.TimeoutExpired) as trouble:
			raise MeasurementFailed(str(trouble)) from None
		if done.returncode:
			raise MeasurementFailed(f"{' '.join(command)} has ended with {done.returncode}: {lastLine(done.stderr) or lastLine(done.stdout)}")
		return done.stdout


def installed(package):
	"""Whether Debian's package manager has it."""
	status = subprocess.run(["dpkg-query", "-W", "-f", "${db:Status-Status}", package], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
	return status.stdout == "installed"


def lastLine(text):
	lines = text.strip().splitlines()
	return lines[-1] if lines else ""


def result(output):
	"""The JSON at the end of what a program has printed: one line, or what begins with a line that is a brace.

	>>> result('Welcome to Yade\\n{"steps": 3}\\n')
	{'steps': 3}
	>>> result('{\\n"benchmarks": []\\n}\\n')
	{'benchmarks': []}
	"""
	lines = output.strip().splitlines()
	begin = lines.index("{") if "{" in lines else len(lines) - 1
	try:
		return json.loads("\n".join(lines[begin:]))
	except ValueError:
		raise MeasurementFailed(f"no result in {lastLine(output)!r}") from None


def sessions(rows):
	"""Measurements in groups that share a row, directly or through others: what is compared with each other, each once."""
	groups = []
	for row in rows:
		joined = [group for group in groups if set(group) & set(row.measurements)]
		merged = list(dict.fromkeys([measurement for group in joined for measurement in group] + row.measurements))
		groups = [merged if group is joined[0] else group for group in groups if group not in joined[1:]] if joined else groups + [merged]
	return groups


def measure(rows, runner, rounds, say):
	"""Samples of all measurements of the rows, each group in turn (A B A B A B), and what went wrong with those that have none.

	:param runner: has sample(measurement), which raises MeasurementFailed
	:returns: {name: [sample, ...]}, {name: message}
	"""
	samples, failed = {}, {}
	for session in sessions(rows):
		for number in range(rounds):
			for measurement in session:
				if measurement.name in failed:
					continue
				say(f"{measurement.name}, {number + 1} of {rounds}")
				try:
					samples.setdefault(measurement.name, []).append(runner.sample(measurement))
				except MeasurementFailed as trouble:
					failed[measurement.name] = str(trouble)
					say(f"failed: {trouble}")
	return samples, failed
