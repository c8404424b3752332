# SPDX-License-Identifier: GPL-2.0-or-later
# What the figures of the guide share: a canvas without a display, colours that the colour-blind tell apart, and where a figure is saved.
"""Canvas, colours and saving of the figures of the guide."""

import argparse
import os
import sys

from matplotlib import rcParams
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

folder = os.path.dirname(os.path.abspath(__file__))

brick, edge, mortar, ink, accent, second = "#d9a78c", "#4b332a", "#8f8f8f", "#222222", "#0b6fa4", "#c8500a"

rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "font.family": "DejaVu Sans"})


def figure(width, height):
	"""An empty figure of a size [inches]."""
	made = Figure(figsize=(width, height), layout="constrained")
	FigureCanvasAgg(made)
	return made


def save(made, name, about):
	"""Saves a figure as PNG in this folder, or in that of --out.

	:param name: of the file, without its ending
	:param about: one line for --help
	"""
	parser = argparse.ArgumentParser(description=about)
	parser.add_argument("--out", metavar="DIR", default=folder, help="folder for the figure (default: beside the script)")
	chosen = parser.parse_args()
	os.makedirs(chosen.out, exist_ok=True)
	made.savefig(os.path.join(chosen.out, name + ".png"), dpi=120, metadata={"Software": None})
	print(f"{name}.png is in {chosen.out}")
	sys.exit(0)
