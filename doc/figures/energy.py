# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the guide: where the energy of a wall goes that is shaken until bricks fall, by the ledger of the library.

    build/yade -n -x -j1 doc/figures/energy.py [--out DIR]

Above, what is there and what was taken, stacked, is as high as what came in: work of the ground, and of gravity as bricks come down. Below is the
difference, and with it the test of the run.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import drawing
import numpy as np

import yade_brick

#: Entries of O.energy that are drawn together: name, colour, entries. What came in has the opposite sign there.
groups = [("friction", "#c8500a", ["plastDissip"]), ("dashpots and damping", "#e0a458", ["dashpots", "deformDamping", "nonviscDamp"]),
          ("mortar that failed", "#6a0dad", ["fracture"]),
          ("springs and elements", "#5b8c5a", ["elastPotential", "deformElastic", "levelChange", "contactArea"]),
          ("motion", "#0b6fa4", ["kinetic", "deformKinetic"])]
income = ["gravWork", "groundWork", "supportWork"]


def wallShaken():
	"""A wall of 3 x 5 bricks and the motion that brings part of it down."""
	O.reset()
	mortar = Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=math.radians(32), compressiveStrength=4.9e5)
	adobe = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=math.radians(32), mortar=mortar)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	masonry = yade_brick.straightJointWall(columns=3, courses=5, material=adobe, contactThickness=5e-3, segments=2)
	O.bodies.append(masonry.bodies)
	shake = yade_brick.Motion(.01, [(8 * math.sin(2 * math.pi * .01 * i), 0, 0) for i in range(151)], name="one cycle and a half of 1 Hz")
	O.engines = yade_brick.engines(motion=shake, ledger=True)
	MortarJoints()()
	StaticEquilibrium()()


def main():
	wallShaken()
	times, entries = [], []

	def record():
		times.append(O.time)
		entries.append(dict(O.energy.items()))

	O.step()
	yade_brick.runWithProgress(duration=2.5, every=.01, callback=record, label="shaking")
	of = lambda names: np.array([sum(entry.get(name, 0) for name in names) for entry in entries])
	first = {name: of(names)[0] for name, _, names in groups}
	spent = {name: of(names) - first[name] for name, _, names in groups}
	came = -(of(income) - of(income)[0])
	left = sum(spent.values()) - came
	turned = np.abs(came).max()
	assert np.abs(left).max() < .01 * turned, (np.abs(left).max(), turned)

	figure = drawing.figure(8, 4.2)
	above, below = figure.subplots(2, 1, sharex=True, height_ratios=(4, 1))
	above.stackplot(times, *spent.values(), labels=list(spent), colors=[color for _, color, _ in groups])
	above.plot(times, came, color=drawing.ink, lw=1.2, ls="--", label="came in: ground and gravity")
	handles, labels = above.get_legend_handles_labels()
	above.legend(handles[::-1], labels[::-1], frameon=False, fontsize=9, loc="upper left")
	above.set(ylabel="energy [J]", xlim=(0, times[-1]))
	below.plot(times, left, color=drawing.ink, lw=1)
	below.axhline(0, color="#bbbbbb", lw=.6)
	below.set(xlabel="time [s]", ylabel="difference [J]", ylim=np.array([-1, 1]) * 1.3 * np.abs(left).max())
	drawing.save(figure, "energy", __doc__.splitlines()[0])


main()
