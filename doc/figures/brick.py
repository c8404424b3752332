# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the guide: what a brick is made of. A drawing, not to scale: the contact part is a hundredth of a brick, not a tenth.

    build/yade -n -x -j1 doc/figures/brick.py [--out DIR]
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))

import drawing
import numpy as np
from matplotlib.patches import Rectangle

width, height, r, gap, segments = 2.0, 1.3, .16, .16, 4


def brick(ax, x, z):
	"""A brick with its lower left corner at x, z."""
	ax.add_patch(Rectangle((x, z), width, height, fc="#efd5c5", ec=drawing.edge, lw=1.4))
	ax.add_patch(Rectangle((x + r, z + r), width - 2 * r, height - 2 * r, fc=drawing.brick, ec=drawing.edge, lw=1, ls="--"))
	for cx in (x + r, x + width - r):
		for cz in (z + r, z + height - r):
			ax.plot(cx, cz, "o", ms=6, color=drawing.edge)


def spring(ax, x, bottom, top, failed):
	"""Springs of a segment: normal, and shear as a slanted line; a gap where it has failed."""
	z = np.linspace(bottom, top, 9)
	zigzag = x + .035 * np.array([0, 0, 1, -1, 1, -1, 1, 0, 0])
	if failed:
		ax.plot(zigzag[:4], z[:4], color=drawing.second, lw=1.2)
		ax.plot(zigzag[-4:], z[-4:] + .02, color=drawing.second, lw=1.2)
	else:
		ax.plot(zigzag, z, color=drawing.accent, lw=1.2)


def label(ax, text, point, place, **options):
	ax.annotate(text, point, place, arrowprops=dict(arrowstyle="-", color="#555555", lw=.7, shrinkB=1, relpos=(0, .5)), va="center", fontsize=9, **options)


def main():
	figure = drawing.figure(9, 4.1)
	ax = figure.subplots()
	low, high = 0, height + gap
	brick(ax, 0, low)
	brick(ax, 0, high)
	edges = np.linspace(0, width, segments + 1)
	for place, x in enumerate(.5 * (edges[1:] + edges[:-1])):
		spring(ax, x, height, high, failed=place == 3)
	for x in edges:
		ax.plot([x, x], [height - .05, height], color=drawing.ink, lw=1.2)
		ax.plot([x, x], [high, high + .05], color=drawing.ink, lw=1.2)
	text = "brick: a convex hexahedron; its rigid motion is the body's State,\nwith the mass and inertia of the whole solid"
	label(ax, text, (width, high + height - .05), (2.5, high + height - .12))
	text = "inner part: an 8-node element (or several) that deforms relative\nto the rigid motion; here inner='inset', by r inside the faces"
	label(ax, text, (width - r - .15, high + .75), (2.5, high + .78))
	label(ax, "node: its displacement moves the corner beside it", (width - r, high + r), (2.5, high + .42))
	text = "joint: mortar on the overlap of two faces, a normal and a shear\nspring for each segment; one segment here has failed in tension"
	label(ax, text, (edges[-2] + .33, high - gap / 2), (2.5, high - .07), color=drawing.second)
	label(ax, "segments: 4 along each edge of a face, in the plane of the face too", (edges[-2], height - .03), (2.5, height - .28))
	text = "contact part: thickness r, stiff as the brick's material; what presses\non the face is carried by it"
	label(ax, text, (width - .08, .55), (2.5, .52))
	ax.annotate("", (0, .28), (r, .28), arrowprops=dict(arrowstyle="<->", lw=.9, shrinkA=0, shrinkB=0))
	ax.text(-.06, .28, "r", ha="right", va="center", fontsize=11, style="italic")
	ax.set(aspect="equal", xlim=(-.2, 6.3), ylim=(-.06, high + height + .06))
	ax.axis("off")
	drawing.save(figure, "brick", __doc__.splitlines()[0])


main()
