# SPDX-License-Identifier: GPL-2.0-or-later
# The budget of lean scenes: a feature that a scene does not call for must not cost it anything. Runs benchmarks/pay_as_you_go/scene.py under callgrind.
"""Compares what lean scenes cost with what was recorded in budget.json, and scenes where an effect was switched off with those that never had it.

Instructions of the hot path are the same in every run, on every x86-64: the plain instruction set, no vector versions of the C library, one thread, none of
malloc's inner work. Counted again they are the same to 0.01 of 6000 a brick and step; so

- with the compiler of the record, `tolerance` (3 to 5 instructions) is there for other versions of the C and OpenMP libraries. Tried out: one more comparison in
  each joint, of which there are 1.8 for a brick, takes 5.5, a virtual call 13, a branch for every two segments of a cracked joint 75. Where bricks are
  dry it is 140: there a branch for each pair of bricks is not noticed, one for each candidate of the search is
- with another, `otherCompiler`: -O2 instead of -O3 for the kernel's joints takes 7 % more, or 14 % where they have cracked. That notices a loop more, no branch
- two scenes of one run may differ by `noise`: what YADE spends on an engine that is there but dead

Bytes are what malloc has given, which come in chunks of 16: one more number in every joint or brick mostly shows, what Python leaves does not.
"""

import argparse
import json
import pathlib
import platform
import sys
from dataclasses import replace

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "benchmarks" / "pay_as_you_go"))
import counting
from effects import Scene

tolerance, otherCompiler = 0.0005, 0.15  # of the instructions
noise = 1  # instruction of a brick in a step
bytesTolerance = 8  # a brick
recordFile = here / "budget.json"
skipped = 77  # exit status

minimal = Scene(bricks=6)
cracked, dry = replace(minimal, joints="cracked"), Scene(bricks=3, steps=5, joints="dry", contact=True)
lean = {"minimal": minimal, "cracked joints": cracked, "dry": dry}
# each with the scene that never had it
switchedOff = {
        **{name: (replace(minimal, **{name: True, "ended": name}), minimal) for name in ("failure", "ledger", "guard", "motion")},
        **{f"{name} in cracked joints": (replace(cracked, **{name: True, "ended": name}), cracked) for name in ("failure", "friction", "dashpots")},
        **{f"{name} in contacts": (replace(dry, **{name: True, "ended": name}), dry) for name in ("friction", "dashpots")},
}
large = Scene()  # bytes: what a scene has only once counts less

advice = """Find what was added to the hot path, and make it a choice at set-up (an engine, a functor, a variant of the law). Only if every scene is
to pay for it, record anew:
    cmake --build {build} --target recordBudget
and say why where the change is described."""


def counted(options, scenes):
	counts = counting.count(options.yade, options.switch, list(dict.fromkeys(scenes)), options.out, instructionSet=0)
	return needed(counts)


def needed(counts):
	"""Counts, all of which there must be."""
	troubles = [f"{name}: {found.facts['trouble']}" for name, found in counts.items() if "trouble" in found.facts]
	if troubles:
		sys.exit("\n".join(troubles))
	return counts


def allowed(recorded, compiler):
	"""Largest count, and the share that it is above what was recorded."""
	share = tolerance if compiler == recorded["compiler"] else otherCompiler
	return {name: (1 + share) * number for name, number in recorded["instructions"].items()}, share


def grown(functions, recorded):
	"""The functions that have grown most, as lines."""
	least = sum(recorded.values()) / 500  # smaller ones need not be in the record
	more = {name: own - recorded.get(name, 0) for name, own in functions.items() if name in recorded or own > least}
	return [f"    {amount:+10.1f}  {name[:130]}" for name, amount in sorted(more.items(), key=lambda item: -item[1])[:6] if amount > noise / 2]


def checkInstructions(options, recorded):
	counts = counted(options, [*lean.values(), *(scene for pair in switchedOff.values() for scene in pair)])
	limits, share = allowed(recorded, options.compiler)
	print(f"instructions of a brick in a step; recorded with {recorded['compiler']}, this is {options.compiler}: {100 * share:g} % more allowed")
	problems = []
	for name, scene in lean.items():
		found = counts[scene.name]
		print(f"  {name}: got {found.instructions:.2f}, recorded {recorded['instructions'][name]:.2f}, allowed {limits[name]:.2f}")
		if found.instructions > limits[name]:
			problems.append(f"{name}: got {found.instructions:.2f}, allowed {limits[name]:.2f} instructions of a brick in a step. What has grown:")
			problems += grown(found.functions, recorded["functions"][name])
	for name, (off, never) in switchedOff.items():
		got, without = counts[off.name].instructions, counts[never.name].instructions
		print(f"  {name}, off: got {got - without:+.2f}, allowed {noise}")
		if abs(got - without) > noise:
			problems.append(f"{name}, switched off: got {got:.2f}, without it {without:.2f}, allowed is a difference of {noise}. What has grown:")
			problems += grown(counts[off.name].functions, counts[never.name].functions)
	return problems


def checkBytes(options, recorded):
	got, limit = needed(counting.sizes(options.yade, [large]))[large.name].bytes, recorded["bytes"] + bytesTolerance
	print(f"bytes of a brick: got {got:.1f}, recorded {recorded['bytes']:.1f}, allowed {limit:.1f}")
	return [f"got {got:.1f}, allowed {limit:.1f} bytes of a brick"] if got > limit else []


def record(options, _):
	counts = counted(options, lean.values())
	content = {
	        "compiler": options.compiler,
	        "instructions": {name: round(counts[scene.name].instructions, 2) for name, scene in lean.items()},
	        "bytes": round(needed(counting.sizes(options.yade, [large]))[large.name].bytes, 1),
	        "functions": {name: significant(counts[scene.name].functions) for name, scene in lean.items()},
	}
	with open(recordFile, "w") as file:
		json.dump(content, file, indent="\t")
		file.write("\n")
	print(f"recorded in {recordFile}: {content['instructions']}, {content['bytes']} bytes")
	return []


def significant(functions):
	"""Those that take a thousandth or more, the largest first."""
	least = sum(functions.values()) / 1000
	return {name: round(own, 2) for name, own in sorted(functions.items(), key=lambda item: (-item[1], item[0])) if own > least}


def main(words):
	parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
	tasks = {"instructions": checkInstructions, "bytes": checkBytes, "record": record}
	parser.add_argument("task", choices=tasks)
	meanings = {"yade": "program", "switch": "libcallgrindSwitch.so", "compiler": "its name and version", "out": "folder for callgrind's files"}
	for option, meaning in meanings.items():
		parser.add_argument(f"--{option}", required=True, help=meaning)
	options = parser.parse_args(words)
	if platform.machine() != "x86_64":
		print(f"recorded on x86_64; this is {platform.machine()}")
		return skipped
	recorded = json.loads(recordFile.read_text()) if options.task != "record" else None
	problems = tasks[options.task](options, recorded)
	if not problems:
		return 0
	print("\n".join(["", "OVER BUDGET", *problems, "", advice.format(build=pathlib.Path(options.yade).parent)]))
	return 1


if __name__ == "__main__":
	try:
		sys.exit(main(sys.argv[1:]))
	except counting.CountingFailed as trouble:
		sys.exit(str(trouble))
