# SPDX-License-Identifier: GPL-2.0-or-later
# What each effect costs: runs the scenes of effects.py, prints the table as Markdown, and leaves it in files. scripts/payAsYouGo.sh builds everything first.
"""Counts what effects cost where they are on, and where they are off: instructions of a brick in a step (callgrind) and bytes of a brick (malloc)."""

import argparse
import json
import math
import os
import pathlib
import sys

import counting
import effects

headings = ("effect", "on: instructions", "bytes", "off: instructions", "bytes", "left out of the full scene: instructions", "bytes")


def options(words):
	parser = argparse.ArgumentParser(prog="scripts/payAsYouGo.sh", description=__doc__)
	build = pathlib.Path(__file__).resolve().parents[2] / "build"
	parser.add_argument("--only", metavar="WORD,..", default="", help="only effects whose names contain one of these words")
	parser.add_argument("--instruction-set", type=int, choices=(0, 1), default=1, help="0: any x86-64, 1: AVX2 (default); valgrind knows no AVX-512")
	parser.add_argument("--yade", metavar="PROGRAM", default=build / "yade", help="YADE with the plugin (default: build/yade)")
	switch = build / "benchmarks" / "libcallgrindSwitch.so"
	parser.add_argument("--switch", metavar="LIBRARY", default=switch, help="default: build/benchmarks/libcallgrindSwitch.so")
	parser.add_argument("--out", metavar="DIR", default=build / "payAsYouGo", help="folder for payAsYouGo.md and payAsYouGo.json")
	chosen = parser.parse_args(words)
	asked = [word for word in chosen.only.split(",") if word]
	chosen.effects = [effect for effect in effects.effects if not asked or any(word in effect.what for word in asked)]
	if not chosen.effects:
		parser.error(f"--only: no effect has {chosen.only} in its name; there are: {'; '.join(effect.what for effect in effects.effects)}")
	return chosen


def signed(number):
	"""A whole number with its sign, and none for 0.

	>>> signed(12.6), signed(-0.2)
	('+13', '0')
	"""
	return "?" if math.isnan(number) else f"{number:+.0f}" if round(number) else "0"


def difference(counts, scene, base):
	"""Two cells: instructions, with their share of the base, and bytes, of a scene above another."""
	if scene is None:
		return "", ""
	first, second = counts[scene.name], counts[base.name]
	more = first.instructions - second.instructions
	share = f" ({100 * more / second.instructions:+.1f} %)" if abs(more) >= 0.5 else ""
	return signed(more) + share, signed(first.bytes - second.bytes)


def row(effect, counts):
	cells = [difference(counts, scene, base) for scene, base in ((effect.on, effect.without), (effect.off, effect.without), (effect.leftOut, effects.full))]
	return (effect.what, ) + sum(cells, ())


def whole(name, found):
	return (name, f"{found.instructions:.0f}", f"{found.bytes:.0f}", "", "", "", "")


def table(rows, counts):
	"""Markdown whose columns stand below each other."""
	cells = [headings, whole("**minimal scene**", counts["minimal"]), whole("**full scene**", counts[effects.full.name])]
	cells += [row(effect, counts) for effect in rows]
	widths = [max(len(line[column]) for line in cells) for column in range(len(headings))]
	lines = [f"| {' | '.join(word.ljust(width) for word, width in zip(line, widths))} |" for line in cells]
	return "\n".join([lines[0], "|" + "---|" * len(headings)] + lines[1:])


def asData(found):
	largest = sorted(found.functions.items(), key=lambda item: -item[1])[:20]
	return {**found.facts, "instructions": found.instructions, "bytesOfABrick": found.bytes, "functions": dict(largest)}


def main(words):
	chosen = options(words)
	scenes = effects.scenesOf(chosen.effects)
	os.makedirs(chosen.out, exist_ok=True)
	print(f"{len(scenes)} scenes, some minutes ...", file=sys.stderr, flush=True)
	try:
		counts = counting.count(chosen.yade, chosen.switch, scenes, pathlib.Path(chosen.out) / "callgrind", chosen.instruction_set)
		for name, found in counting.sizes(chosen.yade, scenes).items():
			counts[name].facts.update(found.facts)
	except counting.CountingFailed as trouble:
		sys.exit(str(trouble))
	text = table(chosen.effects, counts)
	with open(os.path.join(chosen.out, "payAsYouGo.json"), "w") as file:
		json.dump({"instructionSet": chosen.instruction_set, "scenes": {name: asData(found) for name, found in counts.items()}}, file, indent="\t")
	with open(os.path.join(chosen.out, "payAsYouGo.md"), "w") as file:
		file.write(text + "\n")
	print(text)
	troubles = [f"{name}: {found.facts['trouble']}" for name, found in counts.items() if "trouble" in found.facts]
	return "\n".join(troubles)


if __name__ == "__main__":
	sys.exit(main(sys.argv[1:]))
