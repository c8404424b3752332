# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the guide: what a step consists of. The engines and functors are those that yade_brick.engines puts into a loop.

    build/yade -n -x -j1 doc/figures/step.py [--out DIR]
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import drawing
from matplotlib.patches import FancyBboxPatch

import yade_brick

#: What each engine does in a step, and what to say of its functors.
words = {
        "ForceResetter": "forces of the last step away",
        "InsertionSortCollider": "which boxes are near; sleeps while nothing has moved by its stride",
        "InteractionLoop": "for each joint and each pair that is near:",
        "BrickTimeStepper": "step: share of a proven bound",
        "DeformationOnDemand": "which bricks are to deform",
        "BrickDynamics": "forces summed for each body; every brick's deformation moved on",
        "GroundMotion": "- m z'' on what is free to move",
        "NewtonIntegrator": "rigid motion of every body; gravity"
}
functorWords = [("Ig2", "where faces are, which segments touch, how deep"), ("Ip2", "springs, dashpots, friction of a new contact"),
                ("Law2", "stress of each segment; mortar that fails; friction")]


def loop():
	"""The loop of a scene that has all of it."""
	O.reset()
	adobe = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.56)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	O.bodies.append(yade_brick.brick((.2, .2, .2), center=(0, 0, .1), material=adobe))
	return yade_brick.engines(motion=yade_brick.Motion(.01, [(0, 0, 0), (1, 0, 0)], name="any"), onDemand=True)


def box(ax, x, y, width, height, title, text, color):
	ax.add_patch(FancyBboxPatch((x, y), width, height, boxstyle="round,pad=0,rounding_size=.08", fc=color, ec=drawing.edge, lw=.9))
	ax.text(x + .12, y + height - .18, title, va="center", fontsize=9, family="DejaVu Sans Mono")
	ax.text(x + .12, y + height - .41, text, va="center", fontsize=8.5, color="#444444")


def main():
	engines = loop()
	figure = drawing.figure(8, 6.2)
	ax = figure.subplots()
	y, ours = 0, set(yade_brick._core.classes)
	for engine in engines:
		name = type(engine).__name__
		height = .62 if name != "InteractionLoop" else .62 + .62 * len(functorWords)
		y -= height
		box(ax, 0, y, 7.4, height, name, words[name], "#f3e3d8" if name in ours else "#eef0f2")
		if name == "InteractionLoop":
			for place, (kind, text) in enumerate(functorWords):
				names = [type(functor).__name__ for functor in engines.functors if type(functor).__name__.startswith(kind)]
				title = names[0] + (f", {len(names) - 1} more for supports" if len(names) > 1 else "")
				box(ax, .45, y + .1 + .62 * (len(functorWords) - 1 - place), 6.8, .55, title, text, "#f3e3d8")
		if engine is not engines[-1]:
			ax.annotate("", (.3, y - .2), (.3, y), arrowprops=dict(arrowstyle="-|>", color=drawing.ink, shrinkA=0, shrinkB=0))
		y -= .2
	ax.text(7.4, .12, "shaded: of this plugin; the others are YADE's", ha="right", fontsize=8.5, color="#444444")
	ax.set(xlim=(-.05, 7.5), ylim=(y + .1, .3))
	ax.axis("off")
	drawing.save(figure, "step", __doc__.splitlines()[0])


main()
