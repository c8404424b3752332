# SPDX-License-Identifier: GPL-2.0-or-later
# Parameter studies the way YADE knows them: a table whose columns are parameters, and a script that reads one row of it (readParamsFromTable), runs,
# and records its result. `yade-batch table script` runs the rows, or runStudy does, which goes on where it was interrupted.
#
# What is where:  a table walls.table has its results in walls.results/, a folder for each row, named by the row's description, with result.json,
# log.txt, and failure.json if the last attempt left no result; all rows together in walls.csv and walls.json.
"""Studies: tables of parameters, runs that resume, results in one table."""

import csv
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from typing import NamedTuple

from . import files, progress, report
from .checks import isFinite


class Row(NamedTuple):
	"""A row of a table.

	:param line: its line in the file, from 1
	:param description: its name, unique in the table
	:param parameters: dict from column to value, as readParamsFromTable has them; without the columns left at the script's default (*)
	:param folder: where its results are
	:param settings: dict of the columns that are for yade-batch itself, such as !THREADS
	"""

	line: int
	description: str
	parameters: dict
	folder: str
	settings: dict


class StudyReport(NamedTuple):
	"""What runStudy has found and done.

	:param rows: list of dicts in the table's order: description, state ('finished', 'failed' or 'open'), reason, log, parameters, result
	:param finished, failed: how many rows have a result, and have none because their run failed
	:param run: how many runs were made now
	:param wallSeconds: elapsed time [s]
	"""

	rows: list
	finished: int
	failed: int
	run: int
	wallSeconds: float

	@property
	def exitStatus(self):
		"""0 when every row has its result, else 1: for sys.exit."""
		return 0 if self.finished == len(self.rows) else 1

	def table(self):
		"""A summary: how many rows have a result, and the reason and log of each that has none."""
		lines = [f"{self.finished} of {len(self.rows)} rows finished ({self.run} runs now, {progress.clock(self.wallSeconds)})"]
		lines += [f"  {row['description']}: {row['state']}, {row['reason']}; see {row['log']}" for row in self.rows if row["state"] != "finished"]
		return "\n".join(lines)


# Tables


#: What a column may be called: a name in Python, as scripts use it; YADE's own columns begin with an exclamation mark (!THREADS, ...).
_columnName = re.compile(r"[A-Za-z_]\w*")

#: What has no place in the name of a folder, in a shell or in a browser.
_unsafe = re.compile(r"[^A-Za-z0-9_.,=+@^-]")


def writeTable(path, rows, describe=None):
	"""Writes a table for yade-batch and runStudy. A file that is there is replaced; nothing of a study's results is lost by that.

	:param path: the file, usually *.table
	:param rows: list of dicts from column to value, all of the same columns: numbers, True, False, None, and texts without blanks and #
	:param describe: function from a row to its description, which names its folder and log; by default 'pga=2.5,seed=3'. What is unsafe in a path becomes _ there
	:returns: path
	:raises ValueError: naming row, column and value: other columns than in the first row, values that a table cannot hold, descriptions that repeat

	>>> import tempfile, os
	>>> path = writeTable(os.path.join(tempfile.mkdtemp(), "walls.table"), [{"pga": 2.5, "seed": 3}, {"pga": 5.0, "seed": 3}])
	>>> [row.parameters for row in readTable(path)]
	[{'pga': 2.5, 'seed': 3}, {'pga': 5.0, 'seed': 3}]
	"""
	rows = list(rows)
	if not rows:
		raise ValueError("rows is empty; a table needs at least one row")
	columns = list(rows[0])
	wrong = [name for name in columns if not isinstance(name, str) or not _columnName.fullmatch(name.lstrip("!")) or name == "description"]
	if wrong or not columns:
		raise ValueError(f"columns are {columns}; allowed are names such as Python's, at least one, and not 'description'")
	lines = [["description", *columns]]
	for number, row in enumerate(rows, 1):
		if list(row) != columns:
			raise ValueError(f"row {number} has the columns {list(row)}; allowed are those of the first row, {columns}")
		cells = {name: _cell(value, number, name) for name, value in row.items()}
		description = describe(row) if describe is not None else _describe(cells)
		lines.append([description, *cells.values()])
	_checkDescriptions(path, {number: line[0] for number, line in enumerate(lines[1:], 1)}, "row")
	widths = [max(map(len, column)) for column in zip(*lines)]
	with files.replacing(path) as file:
		for line in lines:
			file.write("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() + "\n")
	return path


def _describe(cells):
	return _unsafe.sub("_", ",".join(f"{name}={cell}" for name, cell in cells.items()).replace("'", ""))


def _cell(value, number, name):
	"""A value as YADE's table reader takes it: an expression without blanks."""
	plain = report.plain(value, f"row {number}, {name}")
	if plain is None and value is not None:
		raise ValueError(f"row {number}, {name} is {value!r}; allowed are finite numbers")
	text = plain if name.startswith("!") else repr(plain)
	if isinstance(plain, (list, dict)) or re.search(r"[\s#]", str(text)) or not str(text):
		raise ValueError(f"row {number}, {name} is {value!r}; allowed are numbers, truth values, None, and texts without blanks and #")
	return str(text)


def readTable(path):
	"""The rows of a table, by the rules of readParamsFromTable, but for errors, which are said.

	The first line that is not empty has the columns; # begins a comment; `=` repeats the value of the row above; `*` is the script's default; a column with ! at
	its end makes up the description where there is none of that name. Values are expressions of Python with the names of `math`.

	:param path: the file
	:returns: list of Row
	:raises ValueError: naming file, line, what was found and what is allowed
	:raises OSError: for a file that cannot be read
	"""
	if ":" in path:
		raise ValueError(f"path is {path!r}; allowed are paths without a colon, as YADE puts one between table and line")
	with open(path, encoding="utf-8") as file:
		text = file.read()
	if text and not text.endswith("\n"):
		raise ValueError(f"{path}: the last line has no end; YADE would leave out its last character, so put a line break there")
	lines = [(number, line.split("#")[0].split()) for number, line in enumerate(text.splitlines(), 1)]
	lines = [(number, cells) for number, cells in lines if cells]
	if len(lines) < 2:
		raise ValueError(f"{path}: {len(lines)} lines found; a table has a line of columns and at least one row")
	headings = lines[0][1]
	columns = [heading[0] + heading[1:].rstrip("!") for heading in headings]
	naming = [heading[:-1] for heading in headings if heading.endswith("!")] or columns
	rows, above = {}, None
	for number, cells in lines[1:]:
		if len(cells) != len(columns):
			raise ValueError(f"{path}, line {number}: {len(cells)} values found; allowed are {len(columns)}, as there are columns")
		if above is None and "=" in cells:
			raise ValueError(f"{path}, line {number}: = found in the first row; there is no row above to repeat")
		above = rows[number] = {name: above[name] if cell == "=" else cell for name, cell in zip(columns, cells)}
	descriptions = _descriptions(rows, naming)
	_checkDescriptions(path, descriptions, "line")
	found = []
	for number, cells in rows.items():
		settings = {name: text for name, text in cells.items() if name.startswith("!")}
		place = os.path.join(resultsFolder(path), _folderName(descriptions[number]))
		found.append(Row(number, descriptions[number], _parameters(path, number, cells), place, settings))
	return found


def resultsFolder(table):
	"""The folder of a table's results: walls.results for walls.table."""
	return os.path.splitext(table)[0] + ".results"


def _descriptions(rows, naming):
	"""The description of each row: its own, or put together as YADE does."""
	found, seen = {}, set()
	for number, cells in rows.items():
		text = cells.get("description") or ",".join(f"{name}={cells[name]}" for name in naming).replace("!", "").replace("'", "").replace('"', "")
		if "description" not in cells and text in seen:
			text += f"__line={number}__"
		seen.add(text)
		found[number] = text
	return found


def _folderName(description):
	name = _unsafe.sub("_", description)
	return "_" + name[1:] if name.startswith(".") else name


def _checkDescriptions(path, descriptions, place):
	seen = {}
	for number, text in descriptions.items():
		if not isinstance(text, str) or not text or re.search(r"[\s#]", text) or len(text) > 200:
			raise ValueError(f"{path}, {place} {number}: the description is {text!r}; allowed are 1 to 200 characters without blanks and #, as it names a folder")
		name = _folderName(text)
		if name in seen:
			raise ValueError(f"{path}, {place} {number}: the description {text!r} names the same folder as that of {place} {seen[name]}; allowed is one row of a name")
		seen[name] = number


def _parameters(path, number, cells):
	values = {}
	for name, text in cells.items():
		if name == "description" or name.startswith("!") or text == "*":
			continue
		try:
			values[name] = report.plain(eval(text, dict(vars(math))), name)  # as YADE does
		except Exception as error:
			raise ValueError(f"{path}, line {number}: {name} is {text!r}, which is no value of Python ({error}); texts need quotes") from None
	return values


# Within a run


def row():
	"""The row of the table that this run is for, whether runStudy or yade-batch has started it; None for a run by itself."""
	place = os.environ.get("YADE_BATCH")
	if not place:
		return None
	table, _, line = place.rpartition(":")
	return next(found for found in readTable(table) if found.line == int(line))


def folder(alone="result"):
	"""The folder for what this run leaves behind, made if absent: pictures, histories, checkpoints.

	:param alone: folder of a run by itself, for no table
	"""
	current = row()
	path = current.folder if current else alone
	os.makedirs(path, exist_ok=True)
	return path


def record(result, dependsOn=(), alone="result"):
	"""Records the result of this run in result.json of its folder: the last thing that a script does.

	Beside the result stands what it is the result of: the row's parameters and the script's defaults, and the checksums of the script, of the modules beside it
	that it has imported, and of the files in `dependsOn`. A row whose result fits its table and these files is finished; any other is run.

	:param result: dict of what was found, such as dict(collapsed=True, drift=0.04); contents as in report.writeResult
	:param dependsOn: further files that the result depends on, such as a motion's
	:param alone: folder of a run by itself, for no table
	:returns: path of the file
	:raises ValueError: for a result that JSON cannot hold
	:raises OSError: for a file of dependsOn that is not there
	"""
	if not isinstance(result, dict):
		raise ValueError(f"result is {result!r}; allowed is a dict from names to what was found")
	given = _given()
	used = getattr(sys.modules.get("yade.params.table"), "__all__", ())
	defaults = {name: getattr(sys.modules["yade.params.table"], name) for name in used if name not in given}
	place = folder(alone)
	sums = _checksums(dependsOn, place)
	content = {"row": given, "defaults": {name: value for name, value in defaults.items() if _isPlain(value)}, "files": sums, "result": result}
	return report.writeJson(os.path.join(place, "result.json"), content)


def checkpointFolder(dependsOn=(), alone="result"):
	"""The folder for runWithCheckpoints within this run's folder: another one for other parameters of the row, another script or module, so that a run goes on
	from its own past only. Those of an earlier script are removed.

	:param dependsOn, alone: as in `record`
	:returns: path, not made yet
	"""
	place = folder(alone)
	identity = json.dumps([_given(), _checksums(dependsOn, place)], sort_keys=True)
	name = f"run-{hashlib.sha256(identity.encode()).hexdigest()[:12]}"
	for other in os.listdir(place):
		if re.fullmatch(r"run-[0-9a-f]{12}", other) and other != name:
			shutil.rmtree(os.path.join(place, other))
	return os.path.join(place, name)


def _given():
	"""The parameters of this run's row."""
	current = row()
	return current.parameters if current else {}


def _checksums(dependsOn, place):
	"""Of the script, the modules beside it and further files, by path from the folder `place`: a study that is moved as a whole stays finished."""
	script = os.path.abspath(sys.argv[0])
	sources = {script, *_modulesBeside(script), *map(os.path.abspath, dependsOn)}
	return {os.path.relpath(path, place): files.checksum(path) for path in sorted(sources)}


def _modulesBeside(script):
	"""Files of the imported modules in the script's folder and below."""
	beside = os.path.dirname(script) + os.sep
	paths = (getattr(module, "__file__", None) for module in list(sys.modules.values()))
	return {os.path.abspath(path) for path in paths if path and path.endswith(".py") and os.path.abspath(path).startswith(beside)}


def _isPlain(value):
	try:
		report.plain(value, "value")
	except ValueError:
		return False
	return True


# The state of a study


def resultOf(row, script=None):
	"""The result of a row as `record` was given it; None unless there is one that fits the row's parameters and the files as they are now.

	:param script: the script that has to have left it; by default any
	"""
	content = files.readJson(os.path.join(row.folder, "result.json"))
	if not isinstance(content, dict) or not {"row", "files", "result"} <= set(content) or content["row"] != row.parameters:
		return None
	if script is not None and os.path.relpath(script, row.folder) not in content["files"]:
		return None
	try:
		unchanged = all(files.checksum(os.path.join(row.folder, path)) == expected for path, expected in content["files"].items())
	except OSError:
		return None
	return content["result"] if unchanged else None


def collect(table, script=None):
	"""The state of every row, also written as CSV and JSON beside the table: walls.csv and walls.json for walls.table.

	The CSV has description, state, reason and the parameters, and a column for each number, text and truth value of the results; the JSON has all of them.

	:param table: path of the table
	:param script: as in resultOf
	:returns: list of dicts as in StudyReport
	"""
	return _written(table, [_state(found, script) for found in readTable(table)])


def _state(row, script):
	result, failure = resultOf(row, script), files.readJson(os.path.join(row.folder, "failure.json"))
	state, reason = ("finished", "") if result is not None else ("failed", failure["reason"]) if failure else ("open", "not run yet")
	return {
	        "description": row.description, "state": state, "reason": reason, "log": os.path.join(row.folder, "log.txt"), "parameters": row.parameters,
	        "result": result
	}


def _written(table, rows):
	base = os.path.splitext(table)[0]
	report.writeJson(base + ".json", {"rows": rows})
	flat = [{**{key: row[key] for key in ("description", "state", "reason")}, **row["parameters"], **_scalars(row["result"] or {})} for row in rows]
	columns = list(dict.fromkeys(name for row in flat for name in row))
	with files.replacing(base + ".csv") as file:
		writer = csv.DictWriter(file, columns, lineterminator="\n")
		writer.writeheader()
		writer.writerows(flat)
	return rows


def _scalars(result):
	return {name: value for name, value in result.items() if value is None or isinstance(value, (int, float, str))}


# Running


def runStudy(table, script, jobs=None, timeout=None, threads=1, executable=None, rerun=False, stream=None):
	"""Runs the script for every row of the table that has no valid result yet, several at once, and collects the results.

	It may be interrupted (Ctrl-C, SIGTERM, a crash) and called again at any time: rows that are finished are not run again, rows that have failed, and those whose
	parameters or script have changed since, are; see `record` for what counts. A run that fails does not touch the others: a crash, an exception, a time-out or a
	missing result is recorded as its reason with the path of its log. Programs may share a table, also with runs that outlived a program that was killed: each row
	is run by one of them.

	Each run is a YADE of its own, started in the present folder as yade-batch does: with YADE_BATCH=table:line in its environment, no display, output in log.txt
	of its folder.

	:param table: path of a table, such as writeTable makes
	:param script: path of the script, which calls yade_brick.study.record
	:param jobs: runs at once, >= 1; by default as many as there are processors for this program, over threads
	:param timeout: a run that takes longer is ended and failed [s], > 0; None for no limit
	:param threads: threads of each run (-j of YADE), >= 1
	:param executable: list of the program and its options; by default the YADE that runs this, with -n
	:param rerun: True runs all rows again
	:param stream: where the display goes; by default stderr
	:returns: StudyReport
	:raises ValueError: for arguments outside these and tables that cannot be read
	"""
	_checkStudy(script, jobs, timeout, threads, executable)
	rows = readTable(table)
	settings = sorted({name for row in rows for name in row.settings})
	if settings:
		raise ValueError(f"{table} has the columns {', '.join(settings)}, which are for yade-batch; threads and script are arguments here")
	waiting = [row for row in rows if rerun or resultOf(row, script) is None]
	jobs = jobs or max(1, len(os.sched_getaffinity(0)) // threads)
	command = [*(executable or [sys.yade_argv[0], "-n"]), f"-j{threads}", "-x", script]
	runs = _Runs(table, script, command, timeout, rerun, _Display(os.path.basename(table), len(rows), len(rows) - len(waiting), stream or sys.stderr))
	begun = time.perf_counter()
	with _terminationAsInterrupt():
		runs.work(waiting, jobs)
	states = collect(table, script)
	counts = [sum(state["state"] == name for state in states) for name in ("finished", "failed")]
	found = StudyReport(states, *counts, runs.count, time.perf_counter() - begun)
	runs.display.write(found.table())
	return found


def _checkStudy(script, jobs, timeout, threads, executable):
	if not os.path.isfile(script):
		raise ValueError(f"script is {script!r}; there is no such file")
	for name, value in (("jobs", jobs), ("threads", threads)):
		if not (value is None and name == "jobs") and (not isinstance(value, int) or isinstance(value, bool) or value < 1):
			raise ValueError(f"{name} is {value!r}; allowed is a whole number >= 1")
	if timeout is not None and not (isFinite(timeout) and timeout > 0):
		raise ValueError(f"timeout is {timeout!r}; allowed is a finite number of seconds > 0, or None")
	if executable is not None and (isinstance(executable, str) or not executable):
		raise ValueError(f"executable is {executable!r}; allowed is a list: a program and its options")


class _terminationAsInterrupt:
	"""While it is entered, SIGTERM ends this program as Ctrl-C does, so that it can end its runs first."""

	def __enter__(self):
		try:
			self.former = signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
		except ValueError:
			self.former = None  # not the main thread

	def __exit__(self, *error):
		if self.former is not None:
			signal.signal(signal.SIGTERM, self.former)


class _Run(NamedTuple):
	row: Row
	process: subprocess.Popen
	begun: float


class _Runs:
	"""The runs that are going on, and how those ended that have."""

	lookSeconds = 0.05

	def __init__(self, table, script, command, timeout, rerun, display):
		self.table, self.script, self.command, self.timeout, self.rerun, self.display = table, script, command, timeout, rerun, display
		self.going, self.elsewhere, self.count = [], set(), 0

	def work(self, rows, jobs):
		"""Runs the rows, at most `jobs` at once; when it is interrupted it ends those that are going on."""
		waiting = list(rows)
		try:
			while waiting or self.going:
				for row in list(waiting):
					if len(self.going) < jobs and self.start(row):
						waiting.remove(row)
				time.sleep(self.lookSeconds)
				self.look()
		finally:
			if waiting or self.going:
				self.display.write(f"interrupted with {len(waiting) + len(self.going)} rows left; the same call goes on with them")
			for run in self.going:
				run.process.terminate()
			for run in self.going:
				_end(run.process)

	def start(self, row):
		"""Whether the row has been started, or has its result by now: not while another program runs it."""
		# The run inherits the lock and so holds it as long as it lives, even when this program is killed.
		held = files.lock(os.path.join(row.folder, ".lock"))
		if held is None:
			if row.description not in self.elsewhere:
				self.display.write(f"{row.description} is being run by another program; waiting for it")
			self.elsewhere.add(row.description)
			return False
		with held:
			if (row.description in self.elsewhere or not self.rerun) and resultOf(row, self.script) is not None:
				self.display.done(row, None)
			else:
				self.going.append(self.run(row, held))
				self.count += 1
		return True

	def run(self, row, held):
		with open(os.path.join(row.folder, "log.txt"), "w") as log:
			for name in ("result.json", "failure.json"):
				if os.path.exists(path := os.path.join(row.folder, name)):
					os.remove(path)
			environment = {**os.environ, "YADE_BATCH": f"{self.table}:{row.line}", "DISPLAY": ""}
			process = subprocess.Popen(
			        self.command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, env=environment, pass_fds=[held.fileno()], start_new_session=True
			)
		return _Run(row, process, time.perf_counter())

	def look(self):
		for run in list(self.going):
			seconds = time.perf_counter() - run.begun
			late = self.timeout is not None and seconds > self.timeout
			if run.process.poll() is None and not late:
				continue
			_end(run.process)
			self.going.remove(run)
			reason = f"took longer than {self.timeout:g} s" if late else self.failure(run)
			if reason:
				report.writeJson(os.path.join(run.row.folder, "failure.json"), {"reason": reason, "exitStatus": run.process.returncode, "wallSeconds": seconds})
			self.display.done(run.row, reason)

	def failure(self, run):
		"""Why a run has left no result; None when it has one."""
		if resultOf(run.row, self.script) is not None:
			return None
		status = run.process.returncode
		said = _lastLine(os.path.join(run.row.folder, "log.txt"))
		if status < 0:
			return f"was ended by {signal.Signals(-status).name}"
		return f"exit status {status}: {said}" if status else f"recorded no result of this row and script (yade_brick.study.record): {said}"


def _end(process):
	"""Ends a run with all that it has started, if it has not ended by itself."""
	if process.poll() is None:
		os.killpg(process.pid, signal.SIGTERM)
		try:
			process.wait(timeout=20)  # a run with checkpoints saves one
		except subprocess.TimeoutExpired:
			os.killpg(process.pid, signal.SIGKILL)
			process.wait()


def _lastLine(path):
	with open(path, errors="replace") as file:
		lines = [line.strip() for line in file if line.strip()]
	return lines[-1][:200] if lines else "nothing was said"


class _Display:
	"""A line for each run that has ended, with the time left."""

	def __init__(self, name, total, before, stream):
		self.name, self.total, self.before, self.stream, self.count, self.begun = name, total, before, stream, 0, time.perf_counter()
		if before:
			self.write(f"{before} of {total} rows are finished already")

	def done(self, row, problem):
		self.count += 1
		elapsed, rest = time.perf_counter() - self.begun, self.total - self.before - self.count
		left = f", {progress.clock(elapsed / self.count * rest)} left" if rest else ""
		self.write(f"{self.before + self.count} of {self.total} rows, {progress.clock(elapsed)} elapsed{left}: {row.description} {problem or 'finished'}")

	def write(self, text):
		self.stream.write(f"{self.name}: {text}\n")
		self.stream.flush()
