# SPDX-License-Identifier: GPL-2.0-or-later
# The figure of a ground motion is made from any motion that moves, whatever its components.
"""Tests of yade_brick.motionPicture; no YADE needed."""

import os
import unittest

import numpy as np

import standalone
from motionCase import FileCase

motionPicture, pulses, motion = (standalone.load(name) for name in ("motionPicture", "pulses", "motion"))


class MotionPlotTest(FileCase):

	def test_figure_is_written_in_the_size_asked_for(self):
		from matplotlib.image import imread
		path = os.path.join(self.folder.name, "ricker.png")
		ricker = pulses.syntheticRicker(2.0, 1.0)
		motionPicture.motionPlot(path, ricker, target=("target", [0.1, 1.0], [3.0, 4.0]), before=ricker.scaled(1.1), width=6, dpi=100)
		picture = imread(path)
		self.assertEqual(picture.shape[:2], (336, 600))
		self.assertGreater(np.unique(picture.reshape(-1, picture.shape[2]), axis=0).shape[0], 50)

	def test_a_motion_that_does_not_move_is_refused(self):
		self.refused(lambda: motionPicture.motionPlot("any.png", motion.Motion(0.1, np.zeros((3, 3)), "still")), "still", "all accelerations are 0")


if __name__ == "__main__":
	unittest.main()
