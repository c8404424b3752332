# SPDX-License-Identifier: GPL-2.0-or-later
# Fuzzing of what a script can give to the plugin: shapes, materials, scenes and what is done with them, motions, broken files, arguments.
#   python3 tests/fuzz/fuzz.py --yade build/yade [--seed N] [--count N] [--kind NAME] [--seconds N]      a search; without a seed always the same examples
#   python3 tests/fuzz/fuzz.py --yade build/yade --example '{...}'                                       one example again
# Criterion: every example ends in an exception that says what is wrong or in finite numbers, within a time that its few steps cannot need. Never in the end
# of the process, a hang, a number that is not finite, or a message that names nothing. The reason: a simulation of hours must not die of a typing error, and
# NaN that nobody notices is a wrong result.
#
# hypothesis makes the examples here; a YADE of its own tries one after the other and is started anew when it has died. Of findings alike the shortest
# example is printed.
"""Fuzzer; see the head of this file."""

import argparse
import json
import os
import pathlib
import re
import select
import subprocess
import sys
import tempfile
import time
import warnings

import inputs

hangSeconds = 30  # an example does at most some hundred steps of a few bricks, which take less than a second, and may draw a picture
memory = 4 << 30  # bytes a YADE may use: a broken count in a file must not take the machine's memory


class Child:
	"""A YADE that tries examples."""

	def __init__(self, yade):
		self.yade, self.process, self.count = yade, None, 0

	def start(self):
		readHere, writeThere = os.pipe()
		readThere, writeHere = os.pipe()
		self.log = tempfile.TemporaryFile()
		command = ["sh", "-c", f'ulimit -v {memory >> 10}; ulimit -c 0; exec "$@"', "sh", self.yade, "-n", "-x", "-j1", str(inputs.fuzzFolder / "examples.py"),
		        str(readThere), str(writeThere)]
		self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, pass_fds=(readThere, writeThere))
		os.close(readThere)
		os.close(writeThere)
		self.answers, self.examples = os.fdopen(readHere, "rb", buffering=0), os.fdopen(writeHere, "w")

	def tried(self, example):
		"""{'outcome': ...} or {'finding': ...}"""
		if self.process is None:
			self.start()
		self.count += 1
		try:
			self.examples.write(json.dumps(example) + "\n")
			self.examples.flush()
		except BrokenPipeError:
			return self.ended()
		answer, deadline = b"", time.monotonic() + hangSeconds
		while not answer.endswith(b"\n"):
			ready, _, _ = select.select([self.answers], [], [], max(0.0, deadline - time.monotonic()))
			if not ready:
				self.stop()
				return {"finding": f"no answer within {hangSeconds} s"}
			part = self.answers.read(65536)
			if not part:
				return self.ended()
			answer += part
		return json.loads(answer)

	def ended(self):
		"""The process is gone: what it said last."""
		status = self.process.wait()
		self.log.seek(0)
		said = [line for line in self.log.read().decode("utf-8", "replace").splitlines() if line.strip()]
		telling = [line for line in said if re.search(r"what\(\)|ssert|terminate|FATAL|rror", line)] or said
		self.close()
		return {"finding": f"the process ended with status {status}: {' | '.join(telling[-3:])}"}

	def stop(self):
		if self.process is not None:
			self.process.kill()
			self.process.wait()
			self.close()

	def close(self):
		for file in (self.answers, self.log):
			file.close()
		try:
			self.examples.close()
		except BrokenPipeError:
			pass
		self.process = None


def signature(finding):
	"""Findings that differ in numbers only are one."""
	return re.sub(r"[-+]?\d[\d.e+-]*|nan|-?inf|0x[0-9a-f]+", "#", finding["finding"])[:220]


class Search:
	"""Examples of all kinds, what came of them, and the shortest example of each finding."""

	def __init__(self, child, seconds):
		self.child, self.end = child, time.monotonic() + seconds if seconds else None
		self.found, self.outcomes = {}, {}

	def run(self, kind, count, seed):
		from hypothesis import HealthCheck, Phase, given, settings
		from hypothesis import seed as withSeed

		strategy = inputs.kinds[kind][0]

		@settings(max_examples=count, derandomize=seed is None, database=None, deadline=None, phases=[Phase.generate], suppress_health_check=list(HealthCheck))
		@given(strategy)
		def examine(example):
			if self.end is None or time.monotonic() < self.end:
				self.note(kind, inputs.plain(example))

		(examine if seed is None else withSeed(seed)(examine))()

	def note(self, kind, example):
		result = self.child.tried(example)
		outcome = result.get("outcome", "found")
		self.outcomes.setdefault(kind, {}).setdefault(outcome, 0)
		self.outcomes[kind][outcome] += 1
		if outcome != "found":
			return
		key, text = (kind, signature(result)), json.dumps(example)
		if key not in self.found:
			print(f"{kind}: {result['finding']}", flush=True)
		times, known, _ = self.found.get(key, (0, None, None))
		shorter = known is None or len(text) < len(known)
		self.found[key] = (times + 1, text if shorter else known, result["finding"])

	def report(self):
		for kind, outcomes in self.outcomes.items():
			print(f"{kind}: " + ", ".join(f"{count} {name}" for name, count in sorted(outcomes.items())))
		for (kind, _), (times, example, finding) in self.found.items():
			print(f"\n{kind}, {times} times: {finding}\n  {example}")


def main():
	parser = argparse.ArgumentParser(description=__doc__)
	parser.add_argument("--yade", required=True)
	parser.add_argument("--count", type=int, default=1000, help="examples of all kinds together")
	parser.add_argument("--seed", type=int, help="chooses the examples; without it always the same")
	parser.add_argument("--seconds", type=float, help="end after so much time")
	parser.add_argument("--kind", choices=sorted(inputs.kinds), action="append")
	parser.add_argument("--example", help="an example to try again, JSON")
	options = parser.parse_args()
	child = Child(options.yade)
	try:
		if options.example:
			result = child.tried(json.loads(options.example))
			print(result)
			return 1 if "finding" in result else 0
		warnings.simplefilter("ignore")  # hypothesis about strategies
		search, kinds = Search(child, options.seconds), options.kind or list(inputs.kinds)
		total = sum(inputs.kinds[kind][1] for kind in kinds)
		for kind in kinds:
			search.run(kind, max(1, round(options.count * inputs.kinds[kind][1] / total)), options.seed)
		search.report()
		return 1 if search.found else 0
	finally:
		child.stop()


if __name__ == "__main__":
	sys.exit(main())
