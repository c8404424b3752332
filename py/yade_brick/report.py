# SPDX-License-Identifier: GPL-2.0-or-later
# What a command leaves behind: result.json with judged rows and facts, the exit status that follows from the rows, tables for
# people, and histories as CSV. Every example, check suite and benchmark reports through here, so that their results read alike.
"""Results of a command: judged rows, result.json, tables and CSV histories."""

import json
import math
import os

import numpy as np

from .checks import isNumber
from .files import replacing


def judgedRow(id, got, expected=None, tolerance=None, limit=None, **more):
	"""One judged row of a result: `got` against an expected value or a limit.

	:param id: short name, unique in its result
	:param got: the number obtained; NaN and infinity are never ok
	:param expected: ok when abs(got - expected) <= tolerance * abs(expected), or <= tolerance where expected is 0
	:param tolerance: relative (absolute for expected = 0), >= 0; goes with `expected`
	:param limit: ok when got <= limit; instead of `expected`
	:param more: further entries of the row, such as unit="m"
	:returns: dict with id, expected and tolerance or limit, got, error where there is an expected value, ok
	:raises ValueError: unless exactly one of expected (with a tolerance) and limit is given, finite

	>>> judgedRow("u_A", 1.01, expected=1.0, tolerance=0.02)["ok"], judgedRow("drift", float("nan"), limit=1.0)["ok"]
	(True, False)
	"""
	if not isNumber(got):
		raise ValueError(f"row {id!r}: got is {got!r}; allowed is a number")
	if (expected is None) == (limit is None):
		raise ValueError(f"row {id!r}: expected is {expected} and limit is {limit}; allowed is exactly one of them")
	if limit is not None:
		_checkFinite(id, "limit", limit)
		return {"id": id, "limit": limit, "got": got, "ok": bool(math.isfinite(got) and got <= limit), **more}
	_checkFinite(id, "expected", expected)
	if not isNumber(tolerance) or not (math.isfinite(tolerance) and tolerance >= 0):
		raise ValueError(f"row {id!r}: tolerance is {tolerance!r}; allowed is a finite number >= 0")
	error = (got - expected) / abs(expected) if expected else got
	return {"id": id, "expected": expected, "tolerance": tolerance, "got": got, "error": error, "ok": bool(abs(error) <= tolerance), **more}


def _checkFinite(id, name, value):
	if not isNumber(value) or not math.isfinite(value):
		raise ValueError(f"row {id!r}: {name} is {value!r}; allowed is a finite number")


def writeResult(outDir, rows=None, **facts):
	"""Writes outDir/result.json: the facts and, where the command judges, its rows. Replaces the file at once, so that an interrupted
	run never leaves half of one.

	:param outDir: folder, made if absent
	:param rows: None, or a list of dicts with at least id, expected or limit, got, ok (see judgedRow)
	:param facts: anything made of numbers (numpy's too), strings, booleans, None, lists, tuples, arrays and dicts with text keys; NaN and
		infinity, which JSON lacks, are written as null
	:returns: path of the file
	:raises ValueError: for a row without these entries, with an ok that is no truth value or stands beside a `got` that is not finite,
		for two rows of one id, and for a fact that JSON cannot hold
	"""
	content = {} if rows is None else {"rows": _checkedRows(rows)}
	content.update(facts)
	return writeJson(os.path.join(outDir, "result.json"), content, "result")


def writeJson(path, content, name="content"):
	"""Writes facts as JSON, the whole file at once; contents and errors as in writeResult. Returns the path.

	:param name: what the content is called in an error
	"""
	text = json.dumps(plain(content, name), indent="\t", allow_nan=False) + "\n"
	with replacing(path) as file:
		file.write(text)
	return path


def _checkedRows(rows):
	seen = set()
	for row in rows:
		missing = [key for key in ("id", "got", "ok") if key not in row]
		if missing or not ("expected" in row or "limit" in row):
			raise ValueError(f"row {row!r} lacks {', '.join(missing) or 'expected or limit'}; every row has id, expected or limit, got and ok")
		if not isinstance(row["ok"], (bool, np.bool_)):
			raise ValueError(f"row {row['id']!r}: ok is {row['ok']!r}; allowed are True and False")
		if row["ok"] and isinstance(row["got"], (float, np.floating)) and not math.isfinite(row["got"]):
			raise ValueError(f"row {row['id']!r} is ok although got is {row['got']}; a value that is not finite is never ok")
		if row["id"] in seen:
			raise ValueError(f"two rows have the id {row['id']!r}; allowed is one")
		seen.add(row["id"])
	return list(rows)


def plain(value, place):
	"""The value in types that JSON knows; `place` says in an error where it is."""
	if isinstance(value, dict):
		wrong = [key for key in value if not isinstance(key, str)]
		if wrong:
			raise ValueError(f"{place} has the key {wrong[0]!r}; allowed are texts")
		return {key: plain(entry, f"{place}[{key!r}]") for key, entry in value.items()}
	if isinstance(value, np.ndarray):
		return plain(value.tolist(), place)
	if isinstance(value, (list, tuple)):
		return [plain(entry, f"{place}[{i}]") for i, entry in enumerate(value)]
	if isinstance(value, np.generic):
		return plain(value.item(), place)
	if isinstance(value, float):
		return value if math.isfinite(value) else None
	if value is None or isinstance(value, (bool, int, str)):
		return value
	raise ValueError(f"{place} is {value!r} of type {type(value).__name__}; allowed are numbers, texts, truth values, None, lists, arrays and dicts")


def exitStatus(rows):
	"""What a command that judges gives back to the shell: 0 when every one of its rows is ok, else 1."""
	return 0 if all(row["ok"] for row in rows) else 1


def table(rows, title=None):
	"""The rows as text for a terminal, under a title: id, expected or limit, got, relative error, tolerance, ok. Columns are as wide as needed."""
	lines = [("", "expected", "got", "error", "tolerance", "")]
	for row in rows:
		wanted = _number(row["expected"]) if "expected" in row else f"<= {_number(row['limit'])}"
		lines.append((str(row["id"]), wanted, _number(row["got"]), _percent(row, "error"), _percent(row, "tolerance"), "ok" if row["ok"] else "NOT OK"))
	widths = [max(len(line[column]) for line in lines) for column in range(6)]
	text = ["  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(line[1:], widths[1:])]).rstrip() for line in lines]
	return "\n".join(([title] if title else []) + text)


def _number(value):
	return f"{value:.6g}" if isinstance(value, (int, float, np.number)) and not isinstance(value, bool) else str(value)


def _percent(row, key):
	"""An error or tolerance relative to the expected value in percent; absolute where the expected value is 0; blank where there is none."""
	if row.get(key) is None:
		return ""
	return f"{100 * row[key]:.3g} %" if row.get("expected") else f"{row[key]:.3g}"


def writeHistories(path, columns):
	"""Writes histories as CSV: one line of headings, then a row for each sample, numbers to 9 digits.

	:param path: the file; its folder is made if absent
	:param columns: dict from heading to values (n,); each heading ends with its unit in brackets, as in 'time [s]' or 'failed segments [-]'
	:raises ValueError: for a heading without unit or with a comma, for columns of different lengths, for none
	"""
	if not columns:
		raise ValueError("columns is empty; at least one history is needed")
	for heading in columns:
		if not heading.endswith("]") or "[" not in heading or "," in heading:
			raise ValueError(f"heading {heading!r}; allowed is a name without comma and a unit in brackets, as in 'time [s]'")
	arrays = {heading: np.asarray(values, dtype=float) for heading, values in columns.items()}
	length = len(next(iter(arrays.values())))
	for heading, values in arrays.items():
		if values.shape != (length,):
			raise ValueError(f"history {heading!r} has the shape {values.shape}; allowed is ({length},), as in the first one")
	os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
	with open(path, "w") as file:
		file.write(",".join(arrays) + "\n")
		for row in zip(*arrays.values()):
			file.write(",".join(f"{value:.9g}" for value in row) + "\n")
