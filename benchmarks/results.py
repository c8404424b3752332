# SPDX-License-Identifier: GPL-2.0-or-later
# What is left of a run: a table for people, the same as Markdown, and everything as JSON.
"""Outcomes of rows as text, Markdown and JSON."""

import json
import os
import textwrap

from targets import short

lineLength = 158


def text(outcomes):
	"""The table for a terminal: a line a row, and under it the figures behind its value."""
	heading = ("what", "target", "measured", "")
	cells = [heading] + [(outcome.row.what, outcome.row.target, outcome.measured, outcome.verdict) for outcome in outcomes]
	widths = [max(len(row[column]) for row in cells) for column in range(3)]
	lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)) + "  " + row[3] for row in cells]
	for outcome, place in reversed(list(zip(outcomes, range(2, len(lines) + 1)))):
		lines[place:place] = textwrap.wrap("; ".join(outcome.figures), lineLength, initial_indent="    ", subsequent_indent="    ")
	return "\n".join(line.rstrip() for line in lines)


def markdown(outcomes, machine):
	"""The table, the machine, and the profiles of the rows that are missed."""
	lines = ["# Benchmarks", "", "; ".join(f"{name}: {value}" for name, value in machine.items() if value), ""]
	lines += ["| what | target | measured | | figures |", "|---|---|---|---|---|"]
	lines += [f"| {o.row.what} | {o.row.target} | {o.measured} | {o.verdict} | {'; '.join(o.figures)} |" for o in outcomes]
	lines += profileSection(outcomes)
	return "\n".join(lines) + "\n"


def profileSection(outcomes):
	"""A line a scene, with the missed rows that it is measured for."""
	scenes, rowsOf = {}, {}
	for outcome in outcomes:
		for scene, engines in outcome.profiles.items():
			scenes[scene] = engines
			rowsOf.setdefault(scene, []).append(outcome.row.name)
	if not scenes:
		return []
	lines = ["", "## Where missed rows spend their steps", "", "Microseconds a step by YADE's clocks, which add a little themselves; largest first.", ""]
	lines += ["| scene | of rows | step | engines |", "|---|---|---|---|"]
	return lines + [f"| {scene} | {', '.join(rowsOf[scene])} | {shares(engines)} |" for scene, engines in scenes.items()]


def shares(engines):
	"""Total and shares of a profile, as two cells."""
	total = sum(engines.values())
	parts = sorted(engines.items(), key=lambda part: -part[1])
	return f"{short(total)} us | " + ", ".join(f"{name} {short(time)} ({time / total:.0%})" for name, time in parts)


def asData(outcome):
	"""A row as JSON takes it."""
	row = outcome.row
	data = {"name": row.name, "what": row.what, "atLeast": row.atLeast, "limit": row.limit, "unit": row.unit, "verdict": outcome.verdict}
	if outcome.trouble:
		return data
	figures = [
	        {"label": figure.label, "unit": figure.unit, "measurement": figure.measurement.name, "median": median, "samples": outcome.figureSamples(figure)}
	        for figure, median in zip(row.figures, outcome.medians)
	]
	return {**data, "value": outcome.value, "range": outcome.range, "figures": figures, "microsecondsOfEngines": outcome.profiles}


def write(folder, outcomes, machine, samples, commands):
	"""benchmarks.json and benchmarks.md."""
	os.makedirs(folder, exist_ok=True)
	content = {
	        "machine": machine, "rows": [asData(outcome) for outcome in outcomes],
	        "measurements": {name: {"command": commands[name], "samples": taken} for name, taken in samples.items()}
	}
	with open(os.path.join(folder, "benchmarks.json"), "w") as file:
		json.dump(content, file, indent="\t")
		file.write("\n")
	with open(os.path.join(folder, "benchmarks.md"), "w") as file:
		file.write(markdown(outcomes, machine))
