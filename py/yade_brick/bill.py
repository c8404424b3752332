# SPDX-License-Identifier: GPL-2.0-or-later
# What a run cost and where its time went, from YADE's timing of engines and the functors' own clocks. Reads only; clocks tick while a bill is open.
"""The bill of a run: time by stage, what limits the time step, joints and contacts, memory."""

import math
import os
import time

import numpy as np

#: Faces of a brick in the order of BrickTimeStepper.limitingFace, by the corners that they have: see Brick.corners.
_faceCorners = {"-x": (0, 4, 7, 3), "+x": (1, 2, 6, 5), "-y": (0, 1, 5, 4), "+y": (3, 7, 6, 2), "-z": (0, 3, 2, 1), "+z": (4, 5, 6, 7)}

#: Engines whose stage is neither YADE's nor their own name, by their class or one that it derives from.
_stages = {"Collider": "detection", "BrickDynamics": "dynamics", "BrickTimeStepper": "time step", "ForceResetter": "YADE", "NewtonIntegrator": "YADE"}

_outside = "between steps"


class Bill:
	"""What the steps made between `start` and `stop` cost::

		with yade_brick.Bill() as bill:
			yade_brick.runWithProgress(duration=3)
		print(bill.table())

	Stages: detection (collider, geometry functors), joints, contacts (the law), dynamics (BrickDynamics), time step, YADE (Newton, forces, physics
	functors, the loop over interactions), other engines by label or class, and what passes between the steps: Python, callbacks, pictures. They add
	up to the elapsed time. Reading clocks for every interaction costs some tenths of a microsecond each, which is in the bill: a run without one is
	that much faster, and else the same.

	:param scene: YADE's O; by default that of the running YADE
	"""

	def __init__(self, scene=None):
		if scene is None:
			from yade import O as scene
		self._scene, self._begun, self._facts = scene, None, None

	def start(self):
		"""Opens the bill; switches YADE's timing on. Returns the bill.

		:raises RuntimeError: when it is open already, or no InteractionLoop in O.engines has a Law2_BrickGeom_BrickPhys_Mortar
		"""
		if self._begun is not None:
			raise RuntimeError("this bill is open already; stop() it before it is started again")
		_brickLoop(self._scene.engines)
		self._wasEnabled, self._scene.timingEnabled = self._scene.timingEnabled, True
		self._first = [(engine, *_clocks(engine)) for engine in self._scene.engines]
		self._begun = (time.perf_counter(), self._scene.time, self._scene.iter)
		return self

	def stop(self):
		"""Closes the bill; gives YADE's timing back as it was. Returns the bill.

		:raises RuntimeError: when it is not open, when no step was made since, or the engines with the bricks' law are gone
		"""
		if self._begun is None:
			raise RuntimeError("this bill is not open; start() it first")
		ended = (time.perf_counter(), self._scene.time, self._scene.iter)
		elapsed, simulated, steps = (now - before for now, before in zip(ended, self._begun))
		self._close()
		if steps <= 0:
			raise RuntimeError(f"{steps} steps were made while the bill was open; at least one is needed")
		seconds = _stageSeconds(self._spent(), self._scene.numThreads)
		seconds[_outside] = max(0.0, elapsed - sum(seconds.values()))
		self._facts = {**_totals(seconds, simulated, steps, _bricks(self._scene)), **_state(self._scene)}
		return self

	def __enter__(self):
		return self.start()

	def __exit__(self, kind, error, trace):
		# what went wrong inside says more than a bill that could not be made
		if kind is None:
			self.stop()
		else:
			self._close()

	def _close(self):
		self._scene.timingEnabled, self._begun = self._wasEnabled, None

	def _spent(self):
		"""(engine, clocks since the start) of all engines; one that came later starts from zero."""
		before = list(self._first)
		spent = []
		for engine in self._scene.engines:
			known = next((entry for entry in before if entry[0] == engine), None)
			total, inside = _clocks(engine)
			spent.append((engine, total - known[1], {key: value - known[2].get(key, 0) for key, value in inside.items()}) if known else (engine, total, inside))
		_brickLoop([engine for engine, _, _ in spent])
		return spent

	def facts(self):
		"""What it says, as dict for result.json: wallSeconds, simulatedSeconds, secondsPerSimulatedSecond, steps, bricks, microsecondsPerBrickStep, stages (seconds, share,
		microsecondsPerBrickStep of each), deformableShare, dt, limit (None when no BrickTimeStepper set the step; else step, brick, level, face, partners),
		joints, crackedJoints, contacts, residentMemory [bytes].

		:raises RuntimeError: before `stop`
		"""
		if self._facts is None:
			raise RuntimeError("the bill has not been stopped; stop() it first")
		return self._facts

	def table(self):
		"""The same as text for a terminal."""
		return _text(self.facts())


# Time


def _kinds(thing):
	"""Names of the class of an engine or functor and of those that it derives from."""
	return [kind.__name__ for kind in type(thing).__mro__]


def _brickLoop(engines):
	"""The InteractionLoop that has the bricks' law."""
	for engine in engines:
		if "InteractionLoop" in _kinds(engine) and any("Law2_BrickGeom_BrickPhys_Mortar" in _kinds(law) for law in engine.lawDispatcher.functors):
			return engine
	raise RuntimeError("O.engines has no InteractionLoop with a Law2_BrickGeom_BrickPhys_Mortar; a bill is for scenes of bricks: set O.engines before")


def _clocks(engine):
	"""Seconds that an engine took so far, and inside an InteractionLoop, by stage, the sums over threads that its functors keep."""
	inside = {}
	if "InteractionLoop" in _kinds(engine):
		# functors of other shapes and laws keep no clocks: theirs is YADE's part
		inside["detection"] = sum(getattr(functor, "seconds", 0.0) for functor in engine.geomDispatcher.functors)
		for stage, clock in (("joints", "jointSeconds"), ("contacts", "contactSeconds")):
			inside[stage] = sum(getattr(law, clock, 0.0) for law in engine.lawDispatcher.functors)
	return 1e-9 * engine.execTime, inside


def _stageSeconds(spent, threads):
	"""Elapsed seconds by stage, in the order of a table, from (engine, seconds, sums over threads inside it)."""
	seconds = dict.fromkeys(("detection", "joints", "contacts", "dynamics", "time step", "YADE"), 0.0)
	for engine, total, inside in spent:
		if "InteractionLoop" in _kinds(engine):
			# the threads' sums are worth so much of the time that passed; never more than all of it
			scale = 1 / max(threads, sum(inside.values()) / total) if total > 0 else 0.0
			for stage, value in inside.items():
				seconds[stage] += scale * value
				total -= scale * value
		stage = "YADE" if "InteractionLoop" in _kinds(engine) else _stageOf(engine)
		seconds[stage] = seconds.get(stage, 0.0) + total
	return seconds


def _stageOf(engine):
	for kind in _kinds(engine):
		if kind in _stages:
			return _stages[kind]
	return engine.label or type(engine).__name__


def _totals(seconds, simulated, steps, bricks):
	elapsed = sum(seconds.values())
	perBrickStep = 1e6 / (steps * len(bricks)) if bricks else math.nan
	return {
	        "wallSeconds": elapsed, "simulatedSeconds": simulated, "secondsPerSimulatedSecond": elapsed / simulated if simulated > 0 else math.nan,
	        "steps": steps, "bricks": len(bricks), "microsecondsPerBrickStep": perBrickStep * elapsed, "stages": {
	                name: {"seconds": value, "share": value / elapsed, "microsecondsPerBrickStep": perBrickStep * value} for name, value in seconds.items()
	        }, "deformableShare": sum(body.shape.deformation != "rigid" for body in bricks) / len(bricks) if bricks else math.nan
	}


# The state at the end


def _bricks(scene):
	return [body for body in scene.bodies if body is not None and "Brick" in _kinds(body.shape)]


def _state(scene):
	joints = cracked = contacts = 0
	for interaction in scene.interactions:
		if interaction.isReal and "BrickPhys" in _kinds(interaction.phys):
			if interaction.phys.jointed:
				joints += 1
				cracked += any(interaction.phys.segmentState)
			else:
				contacts += 1
	return {
	        "dt": scene.dt, "limit": stepLimit(scene), "joints": joints, "crackedJoints": cracked, "contacts": contacts, "residentMemory": residentMemory()
	}


def residentMemory():
	"""Memory of this process that is in RAM [bytes]."""
	with open("/proc/self/statm") as file:
		return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def stepLimit(scene=None):
	"""What limits the time step.

	:param scene: where the engines and bodies are; None: O
	:returns: None when there is no BrickTimeStepper or it has not worked yet; else dict of step, the bound before BrickTimeStepper.safety [s]; brick,
		the id of the brick that sets it; level, how it deforms, or 'erased'; face, the one of its faces, '-x' to '+z' in its own axes, whose springs hold most of
		the motion that limits (None when not known); partners, the bodies that touch it there, as texts. Without partners the springs
		are those that a brick of its own kind would give.
	"""
	if scene is None:
		from yade import O as scene
	stepper = next((engine for engine in scene.engines if "BrickTimeStepper" in _kinds(engine)), None)
	if stepper is None or not math.isfinite(stepper.limit):
		return None
	face = stepper.limitingFace
	name = list(_faceCorners)[face] if face >= 0 else None
	body = scene.bodies[stepper.limitingBrick]
	if body is None:
		return {"step": stepper.limit, "brick": stepper.limitingBrick, "level": "erased", "face": name, "partners": []}
	partners = _partners(scene, body, name) if name else []
	return {"step": stepper.limit, "brick": body.id, "level": _level(body.shape), "face": name, "partners": partners}


def _level(shape):
	"""How a brick deforms, with the cells along an edge where it is refined."""
	return f"refined {shape.cells}" if shape.deformation == "refined" else shape.deformation


def _partners(scene, body, face):
	"""What touches a brick on a face, in the order of ids. Not what only meets an edge of it, as diagonal neighbours do."""
	corners = np.array([tuple(corner) for corner in body.shape.worldCorners(body.state)])
	touching = [interaction for interaction in scene.interactions.withBody(body.id) if interaction.isReal]
	touching = [interaction for interaction in touching if _nearestFace(corners, np.array(tuple(interaction.geom.contactPoint))) == face]
	largest = max((interaction.geom.area for interaction in touching), default=0)
	ids = sorted(interaction.id1 + interaction.id2 - body.id for interaction in touching if interaction.geom.area >= 0.01 * largest)
	return [_bodyText(scene.bodies[id]) for id in ids]


def _bodyText(body):
	return f"{_level(body.shape)} brick {body.id}" if "Brick" in _kinds(body.shape) else f"{type(body.shape).__name__} {body.id}"


def _nearestFace(corners, point):
	"""Name of the face whose plane is nearest to a point."""
	distances = {}
	for name, nodes in _faceCorners.items():
		a, b, c, d = corners[list(nodes)]
		normal = np.cross(c - a, d - b)
		distances[name] = abs(normal @ (point - (a + b + c + d) / 4)) / np.linalg.norm(normal)
	return min(distances, key=distances.get)


def limitText(limit):
	"""Words for what stepLimit() gives.

	:param limit: that dict, or None
	:returns: text; empty for None
	"""
	if limit is None:
		return ""
	where = f", face {limit['face']} to {' and '.join(limit['partners']) or 'its like'}" if limit["face"] else ""
	return f"{limit['level']} brick {limit['brick']}{where}"


# As text


def _text(facts):
	rows = [("stage", "seconds", "share", "us a brick-step")]
	rows += [
	        (name, f"{stage['seconds']:.3f}", f"{100 * stage['share']:.1f} %", f"{stage['microsecondsPerBrickStep']:.3f}")
	        for name, stage in facts["stages"].items()
	]
	rows.append(("all", f"{facts['wallSeconds']:.3f}", "", f"{facts['microsecondsPerBrickStep']:.3f}"))
	widths = [max(len(row[column]) for row in rows) for column in range(4)]
	lines = ["  ".join([row[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]).rstrip() for row in rows]
	lines.append(
	        f"{facts['steps']} steps of {facts['bricks']} bricks, {100 * facts['deformableShare']:.0f} % deformable; "
	        f"{facts['secondsPerSimulatedSecond']:.3g} s a simulated second; {facts['residentMemory'] / 2**20:.0f} MiB resident"
	)
	limit = f", limited by {limitText(facts['limit'])}" if facts["limit"] else ""
	lines.append(f"dt {facts['dt']:.3g} s{limit}")
	lines.append(f"{facts['joints']} joints, {facts['crackedJoints']} of them cracked; {facts['contacts']} contacts")
	return "\n".join(lines)
