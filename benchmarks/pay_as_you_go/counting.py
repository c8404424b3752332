# SPDX-License-Identifier: GPL-2.0-or-later
# Runs scene.py under callgrind, and reads what it has counted. Used by payAsYouGo.py here and by tests/budget.
"""Instructions of a step, and bytes of a scene, by the brick."""

import json
import os
import pathlib
import subprocess
from dataclasses import dataclass, field

script = pathlib.Path(__file__).resolve().parent / "scene.py"
step = "yade::Scene::moveToNextTimeStep()"
longest = 3600  # of one process [s]

# the plain versions of what the C library has for several processors
plain = "glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX2,-AVX,-FMA,-FMA4,-ERMS,-FSRM"
# what malloc does inside hangs on all that was asked for before; that it is called still counts
insideMalloc = ("_int_malloc", "_int_free", "_int_memalign", "malloc_consolidate", "unlink_chunk", "alloc_perturb")


class CountingFailed(Exception):
	"""YADE or callgrind has ended without a result."""


@dataclass
class Count:
	"""What was found of a scene.

	:param facts: the line that scene.py has left, see there
	:param instructions: of one brick in one step; NaN when the scene has failed
	:param functions: the same of each function by itself, without those that it calls
	"""

	facts: dict
	instructions: float = float("nan")
	functions: dict = field(default_factory=dict)

	@property
	def bytes(self):
		"""That malloc has given, by the brick; NaN when the scene has failed."""
		return self.facts.get("bytes", float("nan")) / self.facts.get("bricks", 1)


def count(yade, switch, scenes, folder, instructionSet):
	"""Counts of all scenes, by their names, from one process.

	:param yade: program that runs scripts
	:param switch: libcallgrindSwitch.so
	:param folder: for callgrind's files, made anew; those of former counts are removed
	:param instructionSet: as YADE_BRICK_INSTRUCTION_SET: the same on every machine that has it
	:raises CountingFailed: when there is no valgrind or the process fails
	"""
	folder = pathlib.Path(folder)
	folder.mkdir(parents=True, exist_ok=True)
	for old in folder.glob("callgrind.out.*"):
		old.unlink()
	callgrind = ["valgrind", "--tool=callgrind", "--trace-children=yes", "--instr-atstart=no", f"--toggle-collect={step}"]
	callgrind += [f"--callgrind-out-file={folder}/callgrind.out.%p"]
	lines = run(callgrind + command(yade, scenes), SWITCH=str(switch), YADE_BRICK_INSTRUCTION_SET=str(instructionSet), GLIBC_TUNABLES=plain)
	counts = {line["scene"]: Count(line) for line in lines}
	for path in folder.glob("callgrind.out.*"):
		name, functions = parse(path.read_text())
		if name in counts and "trouble" not in counts[name].facts:
			found = counts[name]
			bricksAndSteps = found.facts["bricks"] * found.facts["steps"]
			found.functions = {function: own / bricksAndSteps for function, own in functions.items() if not function.startswith(insideMalloc)}
			found.instructions = sum(found.functions.values())
	return counts


def sizes(yade, scenes):
	"""The same without instructions: each scene in a process of its own, so that no other's memory is used again. {name: Count}"""
	# nothing that malloc keeps for each thread would count as given
	lines = [line for scene in scenes for line in run(command(yade, [scene]), GLIBC_TUNABLES="glibc.malloc.tcache_count=0")]
	return {line["scene"]: Count(line) for line in lines}


def command(yade, scenes):
	return [str(yade), "-n", "-x", "-j1", str(script)] + [json.dumps(scene.given) for scene in scenes]


def run(words, **environment):
	"""The lines of JSON that a process leaves."""
	environment = {**os.environ, "PYTHONHASHSEED": "0", **environment}
	try:
		done = subprocess.run(words, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=longest)
	except (OSError, subprocess.TimeoutExpired) as trouble:
		raise CountingFailed(str(trouble)) from None
	lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith('{"scene"')]
	if done.returncode or not lines:
		raise CountingFailed(f"{' '.join(words)} has ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
	return lines


def parse(text):
	"""The trigger's name of a file of callgrind's, and what each function has cost by itself.

	>>> parse('desc: Trigger: Client Request: minimal\\nfn=(1) step\\n0 30\\ncfn=(2) sum\\ncalls=2 0\\n0 12\\nfn=(2)\\n0 10\\n+3 2\\n')
	('minimal', {'step': 30, 'sum': 12})
	"""
	name, names, functions, function, inclusive = "", {}, {}, None, False
	for line in text.splitlines():
		if line.startswith("desc: Trigger: Client Request: "):
			name = line.split(": ", 3)[3]
		elif line.startswith(("fn=", "cfn=")):
			key, _, word = line.split("=", 1)[1].partition(" ")
			names.setdefault(key, word)
			function = names[key] if line.startswith("fn=") else function
		elif line.startswith("calls="):
			inclusive = True  # the line that follows is the cost of what was called
		elif line[:1] in "+-*0123456789" and line and function is not None:
			if not inclusive:
				functions[function] = functions.get(function, 0) + int(line.split()[1])
			inclusive = False
	return name, functions
