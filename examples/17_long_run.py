# SPDX-License-Identifier: GPL-2.0-or-later
"""A long run that may be interrupted at any time and goes on where it was: checkpoints, restart, and the proof that not a bit is different.

    build/yade -n -x examples/17_long_run.py [--demonstrate] [--duration S] [--save-every S] [--out DIR] [--help]

Shakes a wall of deformable bricks. Press Ctrl-C, or kill the program, and start it with the same command again: it says from where it goes on. With
--demonstrate the example does that to itself: one run to the end, and one that is killed (SIGKILL) twice on the way, and compares the two.

Leaves in DIR: run/ (the checkpoints, of which YADE opens any: O.load('DIR/run/checkpoint-.../scene.yade.gz')), history.png and history.csv (whole, in spite of
interruptions), result.json. To be seen with --demonstrate: histories of both runs, one over the other, and a difference of zero in the table.
"""

import argparse
import math
import os
import shutil
import signal
import subprocess
import sys

import numpy as np

import yade_brick
from yade_brick import build, checkpoint, picture, report, syntheticNearFault

gravity, side = 9.8, 0.2  # [m/s2], edge of a brick [m]
every = 0.01  # between two samples of the history [s]


def options():
	parser = argparse.ArgumentParser(prog="17_long_run.py", description=__doc__.splitlines()[0])
	parser.add_argument("--duration", type=float, default=4.0, help="seconds of shaking (default: 4)")
	parser.add_argument("--save-every", type=float, default=0.25, help="simulated seconds between checkpoints (default: 0.25)")
	parser.add_argument("--kill-at", type=float, help="kill this program at that simulated time, as a power failure would")
	parser.add_argument("--demonstrate", action="store_true", help="compare a run that is killed twice with one that is not")
	parser.add_argument("--out", metavar="DIR", default="result-17", help="folder for the results (default: result-17)")
	chosen = parser.parse_args()
	for name in ("duration", "save_every"):
		if not (math.isfinite(getattr(chosen, name)) and getattr(chosen, name) > 0):
			parser.error(f"--{name.replace('_', '-')} is {getattr(chosen, name)}; allowed is a finite number of seconds > 0")
	return chosen


def wallAtRest():
	"""Makes the scene: called only when there is no checkpoint to go on from."""
	phi = math.radians(32)
	mortar = Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	adobe = BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=phi, mortar=mortar)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	O.bodies.append(build.straightJointWall(3, 4, (side, side, side), material=adobe, contactThickness=4e-3).bodies)
	shaking = syntheticNearFault(duration=5.0, pulsePeriod=0.8, pulseVelocity=0.4, phaseTimes=(1.2, 2.8), peak=0.5 * gravity, seed=3)
	O.engines = yade_brick.engines(gravity=(0, 0, -gravity), motion=shaking)
	MortarJoints()()
	StaticEquilibrium()()
	O.step()  # finds the time step


def run(chosen):
	"""The run, or what is left of it; its history goes on with it, since it is in `memory`."""
	memory = {"time": [], "moved": []}

	def look():
		memory["time"].append(O.time)
		memory["moved"].append(list(O.bodies[len(O.bodies) - 1].state.displ()))  # the last brick: a name that wallAtRest made would be unknown after a restart
		if chosen.kill_at is not None and O.time >= chosen.kill_at:
			os.kill(os.getpid(), signal.SIGKILL)

	yade_brick.runWithCheckpoints(
	        wallAtRest, os.path.join(chosen.out, "run"), duration=chosen.duration, saveEvery=chosen.save_every, label="shaking", every=every, callback=look,
	        memory=memory
	)
	return memory


def again(chosen, out, killAt=None):
	"""The same in a program of its own, which may be killed."""
	command = [sys.yade_argv[0], "-n", "-x", sys.argv[0], "--duration", str(chosen.duration), "--save-every", str(chosen.save_every), "--out", out]
	return subprocess.run(command + (["--kill-at", str(killAt)] if killAt else [])).returncode


def demonstrate(chosen, memory):
	"""Rows that compare the run with one that was killed twice; and that one's history."""
	out = os.path.join(chosen.out, "interrupted")
	shutil.rmtree(out, ignore_errors=True)
	killed = [again(chosen, out, share * chosen.duration) for share in (0.4, 0.75)]
	status = again(chosen, out)
	time, *moved = np.loadtxt(os.path.join(out, "history.csv"), delimiter=",", skiprows=1).T
	whole = np.loadtxt(os.path.join(chosen.out, "history.csv"), delimiter=",", skiprows=1).T
	scenes = [checkpoint.checkpoints(os.path.join(folder, "run"))[-1] for folder in (chosen.out, out)]
	rows = [
	        report.judgedRow("times that the run was killed", sum(code == -signal.SIGKILL for code in killed), expected=2, tolerance=0),
	        report.judgedRow("exit status of the run that went on to the end", status, limit=0),
	        report.judgedRow("samples missing in the history", whole.shape[1] - len(time), expected=0, tolerance=0),
	        report.judgedRow("bits of the last scene that differ", differingBits(scenes), limit=0),
	]
	return rows, time, np.transpose(moved)


def differingBits(scenes):
	"""Of all bodies' positions, orientations and velocities, and of what deforms in bricks, in two saved scenes."""
	states = []
	for path in scenes:
		O.load(os.path.join(path, "scene.yade.gz"))
		numbers = [O.time, O.dt, O.iter]
		for body in O.bodies:
			vectors = [body.state.pos, body.state.vel, body.state.angVel]
			numbers += [vector[axis] for vector in vectors for axis in range(3)] + [body.state.ori[k] for k in range(4)]
			numbers += list(getattr(body.shape, "amplitudes", ())) + list(getattr(body.shape, "rates", ()))
		states.append(np.array(numbers, dtype=float).view(np.uint64))
	first, second = states
	return int(sum(bin(a ^ b).count("1") for a, b in zip(first.tolist(), second.tolist()))) if len(first) == len(second) else math.nan


def main():
	chosen = options()
	memory = run(chosen)
	moved = np.array(memory["moved"])
	columns = {"time [s]": memory["time"], **{f"u{axis} [m]": moved[:, k] for k, axis in enumerate("xyz")}}
	report.writeHistories(os.path.join(chosen.out, "history.csv"), columns)
	histories, styles, rows = {"uninterrupted": moved}, {}, None
	if chosen.demonstrate:
		rows, _, histories["killed twice"] = demonstrate(chosen, memory)
		styles = {"uninterrupted": {"linewidth": 4, "color": "#c9d6e4"}, "killed twice": {"linewidth": 1.2, "color": "#1f4e79"}}
	picture.historyPlot(
	        os.path.join(chosen.out, "history.png"), memory["time"], histories, title="Last brick of the top course; synthetic near-fault motion", styles=styles
	)
	kept = checkpoint.checkpoints(os.path.join(chosen.out, "run"))
	size = max(sum(entry.stat().st_size for entry in os.scandir(path)) for path in kept)
	report.writeResult(chosen.out, rows, samples=len(moved), checkpoints=len(kept), bytesOfACheckpoint=size)
	title = f"{len(moved)} samples, checkpoints of {size / 1e3:.0f} kB; results in {chosen.out}"
	print(report.table(rows, title) if rows else title)
	sys.exit(report.exitStatus(rows or []))


main()
