# SPDX-License-Identifier: GPL-2.0-or-later
# Long runs: a stage that leaves checkpoints of the whole scene behind and goes on from the newest when it is started again, after a crash, a
# power failure or the end of a queue's time. The continued run is the uninterrupted one to the last bit.
#
# A checkpoint is a folder: YADE's own file of the scene, what Python has gathered, and checkpoint.json with the checksums of both. It is written
# under another name and renamed when it is whole.
"""Runs with checkpoints, which go on where they were interrupted."""

import contextlib
import heapq
import math
import os
import pickle
import shutil
import signal
import sys
import time
from typing import NamedTuple

from . import files, progress, report
from .checks import isFinite


class LongRunReport(NamedTuple):
	"""What a run with checkpoints took, all programs that worked on it together.

	:param steps: steps done
	:param simulated: simulated time [s]
	:param wallSeconds: elapsed time while it ran; what was lost between the last checkpoint and an interruption is not in it [s]
	:param finished: False when a callback asked to stop before the end
	:param restartedAt: simulated time at which this program took the run up [s]; None when it began it
	"""

	steps: int
	simulated: float
	wallSeconds: float
	finished: bool
	restartedAt: float


_sceneFile, _memoryFile, _factsFile = "scene.yade.gz", "memory.pickle", "checkpoint.json"
_prefix, _unfinishedPrefix = "checkpoint-", ".unfinished-"


def runWithCheckpoints(
        build, folder, duration=None, until=None, saveEvery=None, saveEveryWall=600.0, keep=3, label="", every=None, callback=None, memory=None,
        parameters=None, scene=None, stream=None
):
	"""Runs a stage as runWithProgress does, and keeps checkpoints in a folder: called again after an interruption, by the same script, it goes on from the newest.

	The first call makes the scene with `build`; a later one loads it instead, so that names which `build` made do not exist: bodies are found by
	O.bodies, engines by their labels. What engines and callbacks need besides (functions, plot.plots, ...) is defined outside of `build`. A checkpoint holds
	the whole scene with time, step, engines and tags, the data of yade.plot, and `memory`.

	An interruption changes no bit of the result, provided that callbacks keep in `memory` whatever they carry from one call to the next. (One thing is not saved:
	when the collider, which strides, last looked for new contacts. It looks after loading; that makes no difference, since bricks tell before they leave their
	boxes.) The ledger O.energy is not exact over loading.

	A checkpoint is written at the start, at the intervals, at the end, and when the program is told to end (Ctrl-C, SIGTERM) before it does so; the `keep` newest
	are kept. A damaged one is passed over for the one before, which is said. A finished run that is called again does nothing; with a later end it goes on.

	:param build: function without arguments that makes the scene, ready to run: bodies, engines, joints, self weight
	:param folder: where the checkpoints are, made if absent; a folder belongs to one run
	:param duration: simulated time of the whole run, from what `build` has left [s], > 0; or
	:param until: simulated time to run to [s]
	:param saveEvery: simulated time between checkpoints [s], > 0; None for none
	:param saveEveryWall: elapsed time between checkpoints [s], > 0; None for none
	:param keep: number of checkpoints to keep, >= 1; with 2 or more a damaged one loses little
	:param label: what is going on, for the display
	:param every, callback: as in runWithProgress; multiples count from the start of the whole run, and each is called for once
	:param memory: dict that is saved with each checkpoint and filled again from it, in place: histories, counters; anything that `pickle` can store
	:param parameters: dict of what the run is about, such as dict(pga=3.2, seed=4): a folder of other parameters is refused. Contents as in report.writeResult
	:param scene, stream: as in runWithProgress
	:returns: LongRunReport
	:raises ValueError: for arguments outside these, a folder of a run with other parameters, and an end before the newest checkpoint
	:raises RuntimeError: while another process runs in this folder, and where checkpoints are but none can be read
	"""
	if scene is None:
		from yade import O as scene
	_checkArguments(build, duration, until, saveEvery, saveEveryWall, keep, every, callback, memory)
	run = _Run(scene, folder, keep, label, memory, report.plain(parameters, "parameters"), stream or sys.stderr)
	with _alone(folder):
		if not run.restore():
			build()
			progress.endOfStage(scene, duration, until)
			run.begin()
		end = until if duration is None else run.facts["begin"] + duration
		return run.to(end, saveEvery, saveEveryWall, every, callback)


def checkpoints(folder):
	"""The checkpoints in a folder.

	:param folder: as given to runWithCheckpoints
	:returns: list of their paths, the oldest first; each is a folder with scene.yade.gz, which YADE opens (O.load)
	"""
	names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
	return [os.path.join(folder, name) for name in names if name.startswith(_prefix)]


def _checkArguments(build, duration, until, saveEvery, saveEveryWall, keep, every, callback, memory):
	if not callable(build):
		raise ValueError(f"build is {build!r}; allowed is a function without arguments that makes the scene")
	if (duration is None) == (until is None):
		raise ValueError(f"duration is {duration} and until is {until}; allowed is exactly one of them")
	progress.checkCallback(every, callback)
	for name, value in (("duration", duration), ("until", until), ("saveEvery", saveEvery), ("saveEveryWall", saveEveryWall)):
		if value is not None and not (isFinite(value) and value > 0):
			raise ValueError(f"{name} is {value!r}; allowed is a finite number of seconds > 0")
	if saveEvery is None and saveEveryWall is None:
		raise ValueError("saveEvery and saveEveryWall are both None; at least one of them is needed")
	if not isinstance(keep, int) or isinstance(keep, bool) or keep < 1:
		raise ValueError(f"keep is {keep!r}; allowed is a whole number >= 1")
	if memory is not None and not isinstance(memory, dict):
		raise ValueError(f"memory is {memory!r}; allowed is a dict")


@contextlib.contextmanager
def _alone(folder):
	"""Holds the folder for this process."""
	held = files.lock(os.path.join(folder, ".lock"))
	if held is None:
		raise RuntimeError(f"another process is running in {folder}; wait for it, or choose another folder")
	with held:
		for name in os.listdir(folder):
			if name.startswith(_unfinishedPrefix):
				shutil.rmtree(os.path.join(folder, name))
		yield


class _Run:
	"""A run in its folder; `facts` are those of checkpoint.json: where it began, how often the callback was called, what it took so far."""

	def __init__(self, scene, folder, keep, label, memory, parameters, stream):
		self.scene, self.folder, self.keep, self.label, self.memory, self.stream = scene, folder, keep, label, memory, stream
		self.facts = {"parameters": parameters, "callbacks": 0, "steps": 0, "wallSeconds": 0.0, "stopped": False}
		self.restartedAt, self.spent = None, 0.0
		self.resumed = self.saved = time.perf_counter()

	def say(self, text):
		self.stream.write(f"{self.label}: {text}\n" if self.label else f"{text}\n")
		self.stream.flush()

	# Beginning and going on

	def begin(self):
		self.facts.update(begin=self.scene.time, firstStep=self.scene.iter)
		self.resumed = time.perf_counter()
		self.save()

	def restore(self):
		"""Loads the newest checkpoint that is whole; False where there is none at all."""
		found = checkpoints(self.folder)
		for path in reversed(found):
			damage = _damage(path)
			if damage is None:
				self.load(path)
				return True
			self.say(f"{path} is damaged ({damage}); looking for the one before")
		if found:
			raise RuntimeError(f"none of the {len(found)} checkpoints in {self.folder} can be read; remove the folder to begin anew")
		return False

	def load(self, path):
		facts = files.readJson(os.path.join(path, _factsFile))
		if facts["parameters"] != self.facts["parameters"]:
			raise ValueError(
			        f"parameters is {self.facts['parameters']}; the checkpoints in {self.folder} are of a run with {facts['parameters']}. "
			        f"Choose another folder, or remove this one"
			)
		self.facts, self.spent = facts, facts["wallSeconds"]
		self.scene.load(os.path.join(path, _sceneFile))
		with open(os.path.join(path, _memoryFile), "rb") as file:
			stored = pickle.load(file)
		if self.memory is not None:
			self.memory.clear()
			self.memory.update(stored["memory"])
		if stored["plot"] is not None:
			from yade import plot
			plot.data.clear()
			plot.data.update(stored["plot"])
		self.restartedAt = self.scene.time
		self.say(f"goes on from {self.scene.time:.3f} s, {path}")

	# Running

	def to(self, end, saveEvery, saveEveryWall, every, callback):
		scene, begin = self.scene, self.facts["begin"]
		self.resumed = self.saved = time.perf_counter()
		reached = self.restartedAt is not None and scene.time > end - progress.stepShare * scene.dt
		if reached and scene.time > end + scene.dt:
			raise ValueError(f"the run is to end at {end:g} s; the newest checkpoint in {self.folder} is at {scene.time:g} s already")
		if reached or self.facts["stopped"]:
			self.say(f"is complete: {'a callback has stopped it' if self.facts['stopped'] else 'nothing is left to do'} at {scene.time:.3f} s")
			return self.report()
		calls = self.callbackStops(begin, end, every, callback)
		saves = self.saveStops(begin, end, saveEvery)
		with _Signals() as signals:
			def look():
				if signals.received or saveEveryWall is not None and time.perf_counter() - self.saved >= saveEveryWall:
					self.save()
				signals.obey()

			stage = progress.runStage(scene, end, heapq.merge(calls, saves, key=lambda stop: stop[0]), look, self.label, self.stream, begin)
			self.facts["stopped"] = not stage.finished
			self.save()
			signals.obey()
		return self.report()

	def callbackStops(self, begin, end, every, callback):
		"""The stops for the callback that have not been yet, and the one at the end, which counts only where it is a multiple: the run may be taken further."""

		def call():
			self.facts["callbacks"] += 1
			return callback()

		last = progress.multiplesBefore(begin, end, every)
		for count in range(self.facts["callbacks"] + 1, last + 1):
			yield begin + count * every, call
		endIsMultiple = every is not None and math.isclose(begin + (last + 1) * every, end, rel_tol=1e-9)
		yield end, call if endIsMultiple else callback

	def saveStops(self, begin, end, saveEvery):
		for count in range(1, progress.multiplesBefore(begin, end, saveEvery) + 1):
			if begin + count * saveEvery - progress.stepShare * self.scene.dt >= self.scene.time:
				yield begin + count * saveEvery, self.save

	def report(self):
		facts = self.facts
		return LongRunReport(facts["steps"], self.scene.time - facts["begin"], facts["wallSeconds"], not facts["stopped"], self.restartedAt)

	# Saving

	def save(self):
		"""Writes a checkpoint; the folder of it appears at once and whole. A second one of the same step takes the place of the first."""
		scene, facts = self.scene, self.facts
		facts.update(time=scene.time, iter=scene.iter, steps=scene.iter - facts["firstStep"], wallSeconds=self.spent + time.perf_counter() - self.resumed)
		unfinished = os.path.join(self.folder, f"{_unfinishedPrefix}{os.getpid()}")
		os.mkdir(unfinished)
		scene.save(os.path.join(unfinished, _sceneFile))
		with open(os.path.join(unfinished, _memoryFile), "wb") as file:
			pickle.dump({"memory": self.memory or {}, "plot": _plotData()}, file)
		sums = {name: files.checksum(os.path.join(unfinished, name)) for name in (_sceneFile, _memoryFile)}
		report.writeJson(os.path.join(unfinished, _factsFile), {**facts, "checksums": sums})
		for name in (_sceneFile, _memoryFile, ""):
			files.writeToDisk(os.path.join(unfinished, name))
		self.publish(unfinished, os.path.join(self.folder, f"{_prefix}{scene.iter:012d}"))
		self.saved = time.perf_counter()

	def publish(self, unfinished, path):
		"""Gives a checkpoint its name and removes those that are no longer kept."""
		replaced = f"{unfinished}-replaced"
		if os.path.exists(path):
			os.rename(path, replaced)
		os.rename(unfinished, path)
		files.writeToDisk(self.folder)
		shutil.rmtree(replaced, ignore_errors=True)
		for old in checkpoints(self.folder)[:-self.keep]:
			# under another name first: what is half removed is no checkpoint
			os.rename(old, replaced)
			shutil.rmtree(replaced)


def _damage(path):
	"""What is wrong with a checkpoint, in words; None when it is whole."""
	facts = files.readJson(os.path.join(path, _factsFile))
	if not isinstance(facts, dict) or "checksums" not in facts:
		return f"{_factsFile} cannot be read"
	for name, expected in facts["checksums"].items():
		try:
			found = files.checksum(os.path.join(path, name))
		except OSError as error:
			return f"{name}: {error.strerror}"
		if found != expected:
			return f"{name} is not what was written"
	return None


def _plotData():
	"""What yade.plot has gathered; None where it is not in use."""
	plot = sys.modules.get("yade.plot")
	return dict(plot.data) if plot is not None and plot.data else None


class _Signals:
	"""While it is entered, Ctrl-C and SIGTERM wait until `obey` is called between two steps; a second one does not wait."""

	_numbers = (signal.SIGINT, signal.SIGTERM)

	def __enter__(self):
		self.received, self.former = None, {}
		for number in self._numbers:
			with contextlib.suppress(ValueError):  # only the main thread may set handlers; elsewhere signals do as they always do
				self.former[number] = signal.signal(number, self.receive)
		return self

	def receive(self, number, frame):
		self.received = number
		self.restore()

	def restore(self):
		while self.former:
			number, handler = self.former.popitem()
			signal.signal(number, signal.SIG_DFL if handler is None else handler)

	def obey(self):
		if self.received is not None:
			signal.raise_signal(self.received)

	def __exit__(self, *error):
		self.restore()
