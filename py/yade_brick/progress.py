# SPDX-License-Identifier: GPL-2.0-or-later
# Runs one stage of a simulation and shows how far it is and how long it will take: a bar on a terminal, a plain line now and
# then in a log. Every step is a call of O.step(): unlike O.run(n, True), which looks only every 0.04 s whether the simulation has
# stopped, this makes callbacks cheap, raises an engine's error where it happens and can be interrupted, for about 1 us a step.
"""Running a stage of a YADE simulation with progress and time left."""

import math
import sys
import time
from typing import NamedTuple

from .checks import isFinite


class StageReport(NamedTuple):
	"""What a stage took.

	:param steps: steps done
	:param simulated: simulated time [s]
	:param wallSeconds: elapsed time, callbacks included [s]
	:param finished: False when a callback asked to stop before the end
	"""

	steps: int
	simulated: float
	wallSeconds: float
	finished: bool

	@property
	def secondsPerSimulatedSecond(self):
		"""Elapsed time for each simulated second; NaN when no time was simulated."""
		return self.wallSeconds / self.simulated if self.simulated > 0 else math.nan


#: Wall time [s] between two updates of a bar, and between two lines of a log; and between two looks at the clock.
_barSeconds, _lineSeconds, _lookSeconds = 0.2, 5.0, 0.05

#: A stop falls on the first step whose time is later than the time asked for less this share of a step: sums of dt carry round-off
#: (about 1e-16 of the time at each step, 1e-4 of a step after a million), and a whole step more or less would be a different run.
stepShare = 1e-3


def runWithProgress(duration=None, until=None, label="", every=None, callback=None, scene=None, stream=None):
	"""Runs the simulation for `duration` or until the time `until`, with progress, elapsed time and time left on stderr.

	Stops at the first step at or past the time. The result depends neither on the display nor on the machine's speed: a callback
	is called at the first step at or past each multiple of `every` since the start of the stage, and at the end. Since the steps
	are made here, O.pause(), O.stopAtIter and O.stopAtTime do not end a stage; a callback does. Ctrl-C ends it between two steps.

	:param duration: simulated time to run [s], > 0; or
	:param until: simulated time to run to [s], later than now
	:param label: what is going on, for the display
	:param every: simulated time between two callbacks [s], > 0; goes with `callback`
	:param callback: function without arguments; the stage ends early when it returns True (not merely something true)
	:param scene: YADE's O; by default the O of the running YADE
	:param stream: where the display goes; by default stderr
	:returns: StageReport
	:raises ValueError: for other durations, times and intervals, and while O.dt is no number > 0
	:raises RuntimeError: from YADE, while the simulation is running in the background; errors of engines come through as they are
	"""
	if scene is None:
		from yade import O as scene
	end = endOfStage(scene, duration, until)
	checkCallback(every, callback)
	return runStage(scene, end, _stops(scene.time, end, every, callback), label=label, stream=stream)


def runStage(scene, end, stops, look=None, label="", stream=None, begin=None):
	"""Runs to the last of the stops: the loop that stages of every kind share.

	:param scene: YADE's O
	:param end: time at which the stage is complete [s]; the last stop is there
	:param stops: iterable of (time [s], action), rising: the action, a function or None, is called at the first step at or past the time; True ends the stage
		early
	:param look: None, or a function that is called between two steps now and then in wall time; it may not change the scene
	:param label, stream: as in runWithProgress
	:param begin: when the stage began, where an earlier program has run a part of it [s]; by default now
	:returns: StageReport, of this program's part
	"""
	start, firstStep, begun = scene.time, scene.iter, time.perf_counter()
	origin = start if begin is None else begin
	display = _display(label, end - origin, start - origin, stream or sys.stderr)

	def show():
		display.show(scene.time - origin, scene.iter - firstStep)
		if look is not None:
			look()

	finished = True
	try:
		for stop, action in stops:
			_stepTo(scene, stop, show)
			if action is not None and action() is True and stop < end:
				finished = False
				break
	finally:
		display.close()
	return StageReport(scene.iter - firstStep, scene.time - start, time.perf_counter() - begun, finished)


def endOfStage(scene, duration, until):
	if (duration is None) == (until is None):
		raise ValueError(f"duration is {duration} and until is {until}; allowed is exactly one of them")
	if duration is not None and not (isFinite(duration) and duration > 0):
		raise ValueError(f"duration is {duration!r}; allowed is a finite number of seconds > 0")
	if until is not None and not (isFinite(until) and until > scene.time):
		raise ValueError(f"until is {until!r} s; allowed is a finite time later than the present {scene.time:g} s")
	if not (math.isfinite(scene.dt) and scene.dt > 0):
		raise ValueError(f"O.dt is {scene.dt}; set a finite time step > 0 s before running")
	end = until if until is not None else scene.time + duration
	if not end > scene.time:
		raise ValueError(f"duration is {duration} s; after {scene.time:g} s that is less than round-off of the time")
	return end


def checkCallback(every, callback):
	if (every is None) != (callback is None):
		raise ValueError("every and callback go together; one of them is missing")
	if every is not None and not (isFinite(every) and every > 0):
		raise ValueError(f"every is {every!r}; allowed is a finite number of seconds > 0")


def _stops(start, end, every, action):
	"""The times to stop at, each with what is to be done there; the last one is the end."""
	for count in range(1, multiplesBefore(start, end, every) + 1):
		yield start + count * every, action
	yield end, action


def multiplesBefore(start, end, every):
	"""How many times start + count * every, count >= 1, come before the end; none without `every`."""
	# The last multiple may fall on the end, but for round-off.
	return 0 if every is None else int(math.ceil((end - start) / every * (1 - 1e-12))) - 1


def _stepTo(scene, stop, look):
	"""Steps to `stop`; `look` is called now and then, and at the end."""
	target = stop - stepShare * scene.dt
	step, clock = scene.step, time.perf_counter
	nextLook = clock() + _lookSeconds
	while scene.time <= target:
		step()
		if clock() > nextLook:
			look()
			nextLook = clock() + _lookSeconds
	look()


def _display(label, total, done, stream):
	"""What shows the progress of a stage of `total` seconds, of which an earlier program has done some."""
	if stream.isatty():
		try:
			return _BarDisplay(label, total, done, stream)
		except ImportError:
			pass  # without tqdm a terminal gets the lines that a log gets
	return _LineDisplay(label, total, done, stream)


class _BarDisplay:
	"""tqdm's bar, counting simulated seconds."""

	def __init__(self, label, total, done, stream):
		from tqdm import tqdm
		form = "{desc} {percentage:3.0f}%|{bar}| {n:.3f}/{total:.3f} s, {elapsed}<{remaining}{postfix}"
		self.bar = tqdm(total=total, initial=done, desc=label, file=stream, bar_format=form, dynamic_ncols=True)

	def show(self, simulated, steps):
		self.bar.set_postfix_str(f"{steps} steps", refresh=False)
		self.bar.update(min(simulated, self.bar.total) - self.bar.n)

	def close(self):
		self.bar.close()


class _LineDisplay:
	"""A line every few seconds, and one at the end."""

	def __init__(self, label, total, done, stream):
		self.label, self.total, self.done, self.stream = label, total, done, stream
		self.begun = self.shown = time.perf_counter()
		self.simulated, self.steps = done, 0

	def show(self, simulated, steps):
		self.simulated, self.steps = simulated, steps
		if time.perf_counter() - self.shown >= _lineSeconds:
			self._write()

	def close(self):
		self._write()

	def _write(self):
		self.shown = time.perf_counter()
		elapsed = self.shown - self.begun
		share = min(1.0, self.simulated / self.total)
		left = f", {clock(elapsed * (self.total - self.simulated) / (self.simulated - self.done))} left" if self.done < self.simulated < self.total else ""
		self.stream.write(
		        f"{self.label}: {self.simulated:.3f} of {self.total:.3f} s ({100 * share:.0f} %), {self.steps} steps, {clock(elapsed)} elapsed{left}\n"
		)
		self.stream.flush()


def clock(seconds):
	"""Minutes and seconds, with hours where there are any."""
	minutes, seconds = divmod(int(round(seconds)), 60)
	hours, minutes = divmod(minutes, 60)
	return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"
