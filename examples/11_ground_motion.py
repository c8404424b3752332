# SPDX-License-Identifier: GPL-2.0-or-later
"""A ground motion from its file to what a scene can take: read, corrected, cut, scaled; its figure, measures and spectrum; and one made for a spectrum.

    build/yade -n -x examples/11_ground_motion.py [--motion FILE [--units g]] [--peak G] [--quick] [--out DIR] [--help]

Without a file it takes the synthetic near-fault motion (no record of any earthquake) with an error as an instrument makes it: an offset of 0.2 % of g and a
slow tilt of the sensor. After two integrations the ground has run away by 4 m. Then, step by step:

    record -> high-pass 0.1 Hz -> its strong part -> tapered -> baseline corrected, so that it ends at rest -> scaled to a PGA -> 200 samples a second

The second motion is noise that is matched to the elastic spectrum of EN 1998-1 (type 1, ground B), within 10 % from 0.1 to 3 s. Its peak
acceleration is not asked for: shorter periods would have to be matched for that.

Leaves in DIR: record.png (as read), processed.png, matched.png, processed.txt and matched.txt (columns that readColumns reads back),
result.json. No scene and no step of YADE; about 5 s.
"""

import argparse
import os
import sys

import numpy as np

import yade_brick
from yade_brick import report
from yade_brick.intensity import intensity
from yade_brick.motion import standardGravity as g
from yade_brick.spectrumCompatible import mismatch


def record(chosen):
	"""The motion of the file, or the synthetic one as a faulty instrument would have recorded it."""
	if chosen.motion is None:
		clean = yade_brick.syntheticNearFault(duration=20, phaseTimes=(6, 9), ratios=(1, 0.6, 0))
		error = 0.002 * g * (1 + 0.5 * np.sin(0.3 * clean.times()))
		return yade_brick.Motion(clean.dt, clean.acceleration + np.outer(error, (1, -0.7, 0)), "synthetic near-fault motion with an instrument's error", True)
	if chosen.motion.lower().endswith(".at2"):
		return yade_brick.readAt2(chosen.motion)
	return yade_brick.readColumns(chosen.motion, chosen.units)


def processed(raw, peak):
	"""The motion as a scene takes it: it ends at rest, has the wanted peak, and 200 samples a second."""
	passed = raw.highPassed(0.1)
	strong = intensity(raw)
	moving = raw.peak() > 0
	quiet = (len(passed) - len(raw)) / 2 * raw.dt  # zeros that the filter has put in front
	begin = max(0.0, strong.significantBegin[moving].min() + quiet - 4)
	end = min(passed.duration, (strong.significantBegin + strong.significantDuration)[moving].max() + quiet + 6)
	cut = passed.between(begin, end)
	return cut.tapered(0.05 * cut.duration).baselineCorrected(degree=2, endDisplacement=True).scaledToPeak(peak).resampled(0.005)


def judged(raw, ready, peak):
	left = ready.residual()
	return [
	        report.judgedRow("processed: last velocity over the largest", left.share, limit=1e-3),
	        report.judgedRow("processed: last velocity over that of the record", left.share / max(raw.residual().share, 1e-9), limit=1.0),
	        report.judgedRow("processed: peak acceleration [m/s2]", ready.peakOf("largest"), expected=peak, tolerance=0.02)
	]


def main():
	parser = argparse.ArgumentParser(prog="11_ground_motion.py", description=__doc__.splitlines()[0])
	parser.add_argument("--motion", metavar="FILE", help="PEER AT2 file, or columns of time and up to three accelerations; default: synthetic")
	parser.add_argument("--units", choices=("m/s2", "g", "cm/s2"), help="of a file of columns that does not say its own")
	parser.add_argument("--peak", type=float, default=0.3, metavar="G", help="largest acceleration of the processed motion [g] (default: 0.3)")
	parser.add_argument("--quick", action="store_true", help="without the motion that is matched to a spectrum")
	parser.add_argument("--out", metavar="DIR", default="result-11", help="folder for the results (default: result-11)")
	chosen = parser.parse_args()
	os.makedirs(chosen.out, exist_ok=True)
	path = lambda name: os.path.join(chosen.out, name)

	raw = record(chosen)
	yade_brick.motionPlot(path("record.png"), raw)
	ready = processed(raw, chosen.peak * g)
	yade_brick.motionPlot(path("processed.png"), ready, title="Processed")
	yade_brick.writeColumns(ready, path("processed.txt"))
	rows = judged(raw, ready, chosen.peak * g)
	print(f"{ready.name}\n{intensity(ready)}\n")

	if not chosen.quick:
		periods = np.geomspace(0.1, 3.0, 100)
		target = yade_brick.elasticSpectrum(periods, chosen.peak * g, ground="B")
		matched = yade_brick.syntheticFromSpectrum(periods, target, duration=15, seed=1, name="EN 1998-1 type 1, ground B")
		yade_brick.motionPlot(path("matched.png"), matched, target=("EN 1998-1, ground B", periods, target))
		yade_brick.writeColumns(matched, path("matched.txt"))
		rows.append(report.judgedRow("matched: largest mismatch of the spectrum", mismatch(matched, periods, target), limit=0.1))
		rows.append(report.judgedRow("matched: last velocity over the largest", matched.residual().share, limit=1e-9))
		print(f"{matched.name}\n{intensity(matched)}\n")

	report.writeResult(chosen.out, rows, record=raw.name, processed=ready.name)
	print(report.table(rows, title=f"Results in {chosen.out}"))
	sys.exit(report.exitStatus(rows))


main()
