# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run leaves behind: histories with a figure, files for ParaView, an animation.

    build/yade -n -x examples/13_results.py [--pga 5] [--duration 1.2] [--frames 24] [--out DIR]

A small wall in English bond is shaken by one synthetic pulse until it cracks. Three recorders look on:

- `wallHistories`: drift, base shear, cracks, energies, to yade.plot, histories.csv and histories.png;
- `VtkRecorder`: wall-bricks.pvd, wall-joints.pvd and wall-contacts.pvd, to be opened with ParaView: stress in the deformed bricks (colour by stress or
  principalStress), segments by state or opening (Threshold with state > 0 shows the cracks), forces of contacts (Glyph);
- `Film`: wall.gif, bricks by their displacement.

Then the files are read back and compared with the scene and with balances that must hold: the lowest joints carry the weight, the base shear has the impulse
that the wall's momentum and the ground's acceleration leave to it, the cracks in the file are those of the law. Some seconds.
"""

import argparse
import glob
import math
import os
import sys

import meshio
import numpy as np
from PIL import Image

import yade_brick
from yade import O
from yade_brick import histories, paraview, report, snapshot

side, gravity = (0.2, 0.1, 0.1), 9.81  # of a brick [m], [m/s2]
sampleEvery = 0.002  # between two samples of the histories [s]


def options():
	parser = argparse.ArgumentParser(prog="13_results.py", description=__doc__.splitlines()[0])
	parser.add_argument("--pga", type=float, default=5, help="peak acceleration of the pulse [m/s2] (default: 5)")
	parser.add_argument("--duration", type=float, default=1.2, help="seconds of shaking (default: 1.2)")
	parser.add_argument("--frames", type=int, default=24, help="frames for ParaView and the animation after the first one (default: 24)")
	parser.add_argument("--out", metavar="DIR", default="result-13", help="folder for the results (default: result-13)")
	chosen = parser.parse_args()
	if not (math.isfinite(chosen.duration) and chosen.duration > 0 and chosen.frames > 0):
		parser.error(f"--duration is {chosen.duration} and --frames {chosen.frames}; allowed are numbers > 0")
	return chosen


def pulse(pga):
	"""One cycle of 1.5 Hz."""
	samples = [(pga * math.sin(2 * math.pi * 1.5 * 0.01 * i) if i < 67 else 0, 0, 0) for i in range(80)]
	return yade_brick.Motion(0.01, samples, "one synthetic cycle of 1.5 Hz")


def buildWall(motion):
	"""The wall at rest on the ground under its weight, ready to be shaken."""
	phi = math.radians(32)
	mortar = yade_brick.Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	adobe = yade_brick.BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=phi, mortar=mortar)
	O.bodies.append(yade_brick.brick((1.2, 0.4, 0.1), center=(0.4, 0.05, -0.05), material=adobe, deformation="rigid", fixed=True))
	masonry = yade_brick.englishBondWall(4, 6, side, material=adobe, contactThickness=2e-3)
	O.bodies.append(masonry.bodies)
	O.engines = yade_brick.engines(gravity=(0, 0, -gravity), motion=motion, ledger=True)
	yade_brick.MortarJoints()()
	yade_brick.StaticEquilibrium()()
	O.step()
	return masonry


class Record:
	"""The three recorders, each at its own interval."""

	def __init__(self, masonry, chosen):
		self.histories = yade_brick.wallHistories(masonry)
		self.film = yade_brick.Film(colors=lambda body: 1e3 * body.state.displ()[0] if body.dynamic else None)
		course = {body.id: number for number, bodies in enumerate(masonry.courses, 1) for body in bodies}
		self.vtk = yade_brick.VtkRecorder(os.path.join(chosen.out, "wall"), brickData={"course": lambda body: course.get(body.id, 0)})
		self.pending, self.kept = (O.time + np.linspace(0, chosen.duration, chosen.frames + 1)).tolist(), []
		self.look()

	def look(self):
		self.histories()
		cracks = sum(self.histories[f"failed in {mode}"] for mode in ("tension", "shear", "compression"))
		if cracks[-2:-1].sum() < cracks[-1]:
			self.vtk.look(), self.film.look()  # how joints fail that are gone by the next frame
		if self.pending and O.time >= self.pending[0] - O.dt:
			self.pending.pop(0)
			self.vtk(), self.film()
			self.kept.append(O.time)


def momentum(bodies):
	"""Along the wall [N s]."""
	return sum(body.state.mass * body.state.vel[0] for body in bodies)


def judgedHistories(record, masonry, startMomentum, path):
	"""Rows about the histories: the wall at rest, and the balance of momentum over the whole run."""
	weight = gravity * sum(body.state.mass for body in masonry.bodies)
	columns = histories.readHistories(path)
	time, shear, ground = (columns[name] for name in ("time [s]", "base shear [N]", "ground acceleration [m/s2]"))
	given = weight / gravity * np.trapz(ground, time)
	passed = np.trapz(np.abs(shear), time)
	left = momentum(masonry.bodies) - startMomentum + given + np.trapz(shear, time)
	lost = max(np.abs(columns[heading] - values).max() / max(1, np.abs(values).max()) for heading, values in record.histories.columns.items())
	return [
	        report.judgedRow("axial load at rest over weight", columns["axial load [N]"][0] / weight, expected=1.0, tolerance=1e-4),
	        # samples every 2 ms of a base shear that steps when joints crack
	        report.judgedRow("momentum that is missing, of what the base has passed on", abs(left) / passed, limit=0.02),
	        report.judgedRow("error of histories.csv", lost, limit=1e-8),  # nine digits
	]


def judgedFiles(record, masonry, out):
	"""Rows about the files for ParaView, read back."""
	frames = {kind: paraview.readPvd(os.path.join(out, f"wall-{kind}.pvd")) for kind in ("bricks", "joints", "contacts")}
	wrongTimes = sum([time for time, _ in some] != record.kept for some in frames.values())
	first, last = ({kind: meshio.read(os.path.join(out, frames[kind][at][1])) for kind in ("bricks", "joints")} for at in (0, -1))
	scene = np.concatenate([snapshot.worldCorners(body) for body in O.bodies if isinstance(body.shape, yade_brick.Brick)])
	law = yade_brick.Loop(O.engines).law
	failed = law.tensionFailures + law.shearFailures + law.compressionFailures
	joints = first["joints"].cell_data
	lowest = joints["id1"][0] == 0  # on the foundation
	carried = -(joints["normalStress"][0] * joints["area"][0])[lowest].sum()
	weight = gravity * sum(body.state.mass for body in masonry.bodies)
	return [
	        report.judgedRow("series with other times than those of the frames", wrongTimes, limit=0),
	        report.judgedRow("largest error of a corner in the last frame [m]", np.abs(last["bricks"].points - scene).max(), limit=1e-12),
	        report.judgedRow("load of the lowest joints over weight", carried / weight, expected=1.0, tolerance=1e-4),
	        report.judgedRow("segments failed in the last frame", int((last["joints"].cell_data["state"][0] > 0).sum()), expected=failed, tolerance=0),
	        report.judgedRow("segments that hold", int((last["joints"].cell_data["state"][0] == 0).sum()), limit=len(lowest) - 1),
	]


def main():
	chosen = options()
	motion = pulse(chosen.pga)
	masonry = buildWall(motion)
	record, startMomentum = Record(masonry, chosen), momentum(masonry.bodies)
	yade_brick.runWithProgress(duration=chosen.duration, every=sampleEvery, callback=record.look, label="shaking")
	out = chosen.out
	record.histories.write(os.path.join(out, "histories.csv"))
	record.histories.figure(os.path.join(out, "histories.png"), title=f"Wall of 6 courses, {motion.name}")
	film = record.film.save(os.path.join(out, "wall.gif"), title="Synthetic pulse", colorLabel="displacement [mm]", limits=(-0.3, 1.3, -0.15, 0.9))
	rows = judgedHistories(record, masonry, startMomentum, os.path.join(out, "histories.csv")) + judgedFiles(record, masonry, out)
	with Image.open(film) as image:
		rows.append(report.judgedRow("frames of the animation", image.n_frames, expected=len(record.kept), tolerance=0))
	facts = {name: float(record.histories[name][-1]) for name in ("drift", "dissipated energy", "fallen bricks")}
	report.writeResult(out, rows, peakBaseShearCoefficient=float(np.abs(record.histories["base shear coefficient"]).max()), **facts)
	size = sum(map(os.path.getsize, glob.glob(os.path.join(out, "wall-frames", "*.vtu")))) / len(record.kept)
	print(report.table(rows, title=f"Results in {out}; {size / 1e3:.0f} kB a frame for ParaView"))
	sys.exit(report.exitStatus(rows))


main()
