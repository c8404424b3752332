# SPDX-License-Identifier: GPL-2.0-or-later
# Histories without YADE: names, and the figure from a CSV file.
import doctest
import pathlib
import tempfile
import unittest

import numpy as np
from PIL import Image

import standalone

histories, report = standalone.load("histories"), standalone.load("report")
columns = {
        "time [s]": [0, 1, 2], "top displacement [m]": [0, 0.01, 0.02], "base shear [N]": [0, 2000, float("nan")], "failed in tension [-]": [0, 1, 1],
        "failed in shear [-]": [0, 0, 5]
}


class Names(unittest.TestCase):

	def test_examples_of_the_docstrings(self):
		self.assertEqual(doctest.testmod(histories).failed, 0)

	def test_columns_of_a_panel_share_words(self):
		for names, expected in (
		        (["kinetic energy", "elastic energy"], ("energy", ["kinetic", "elastic"])),
		        (["failed in shear", "failed in tension"], ("failed in", ["shear", "tension"])), (["drift", "drift 1"], ("drift", ["drift", "1"])),
		        (["base shear", "axial load"], ("", ["base shear", "axial load"])), (["drift"], ("drift", ["drift"])),
		):
			self.assertEqual(histories._sharedName(names), expected)


class Figures(unittest.TestCase):

	def test_figure_of_a_csv_file_has_a_panel_for_each_that_was_asked_for(self):
		with tempfile.TemporaryDirectory() as folder:
			path = pathlib.Path(folder) / "histories.csv"
			report.writeHistories(path, columns)
			read = histories.readHistories(path)
			for heading, values in columns.items():
				np.testing.assert_array_equal(read[heading], values)
			heights = []
			for panels in (None, [["top displacement"]], [["top displacement"], ["failed in tension", "failed in shear [-]"]]):
				histories.historyFigure(path.with_suffix(".png"), read, panels)
				with Image.open(path.with_suffix(".png")) as image:
					heights.append(image.height)
		# each panel has the same height above the strip of the time axis
		self.assertAlmostEqual((heights[2] - heights[1]) * 3, heights[0] - heights[1], delta=3)  # whole pixels

	def test_panels_that_cannot_be_drawn_are_told(self):
		with self.assertRaisesRegex(ValueError, "units N, m"):
			histories.historyFigure("never.png", columns, [["base shear", "top displacement"]])
		with self.assertRaisesRegex(KeyError, "overturning"):
			histories.historyFigure("never.png", columns, [["overturning"]])
		with self.assertRaisesRegex(ValueError, "no sample"):
			histories.historyFigure("never.png", {"time [s]": []})


if __name__ == "__main__":
	unittest.main()
