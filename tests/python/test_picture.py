# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures: a PNG of the size asked for, with what was given in it and nearer bricks in front; no window system touched.
"""Tests of yade_brick.picture; no YADE needed."""

import itertools
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np
from matplotlib.colors import to_rgb

import standalone

picture = standalone.load("picture")

signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def cuboid(centre, size=(0.2, 0.2, 0.2), turn=0.0):
	"""Corners of a cuboid, turned about z [rad]."""
	c, s = np.cos(turn), np.sin(turn)
	return 0.5 * signs * size @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre


def wall():
	return [(cuboid((0.1 + 0.2 * i, 0.1, 0.1 + 0.2 * j)), None) for j in range(6) for i in range(6)]


class PictureTest(unittest.TestCase):

	def setUp(self):
		folder = tempfile.TemporaryDirectory()
		self.addCleanup(folder.cleanup)
		self.path = os.path.join(folder.name, "picture.png")

	def size(self):
		"""Width and height in pixels, from the file's own header; checks that it is a PNG."""
		with open(self.path, "rb") as file:
			head = file.read(24)
		self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
		return struct.unpack(">II", head[16:24])

	def share(self, color, tolerance=0.02):
		"""Share of the pixels that have a colour, to within the tolerance in each channel."""
		pixels = matplotlib.image.imread(self.path)[:, :, :3]
		return np.mean((np.abs(pixels - np.array(to_rgb(color))) < tolerance).all(axis=2))

	def test_wall_becomes_a_png_of_the_width_asked_for(self):
		picture.wallPicture(self.path, wall(), title="wall", time=1.5, width=6, dpi=100)
		width, height = self.size()
		self.assertEqual(width, 600)
		# The wall and its margins are about as high as wide; title and axis labels come on top.
		self.assertTrue(1.0 < height / width < 1.3)

	def test_all_views_are_drawn(self):
		for view in (*picture.views, (30, 40)):
			picture.wallPicture(self.path, wall(), view=view, dpi=50)
			self.assertEqual(self.size()[0], 400)

	def test_series_has_all_its_frames_at_one_scale(self):
		frames = [(0.5 * i, [(cuboid((0, 0, 0.1)), "#0000ff")] + [(cuboid((2, 0, 0.1)), "#ff0000")] * i, None) for i in range(2)]
		picture.pictureSeries(self.path, frames, title="two", columns=2, width=10, dpi=60)
		self.assertEqual(self.size()[0], 600)
		# The blue brick is in both frames, the red one, as large, in one.
		self.assertAlmostEqual(self.share("#0000ff") / self.share("#ff0000"), 2, delta=0.3)  # edges and round-off of pixels

	def test_rows_may_be_labelled(self):
		pixels = []
		for labels in ((), ("RIGID", "DEFORM")):
			picture.pictureSeries(self.path, [(0.5 * i, wall(), None) for i in range(4)], columns=2, width=8, dpi=60, rowLabels=labels)
			pixels.append(matplotlib.image.imread(self.path)[:, :, :3].mean(axis=2))
		# Only the titles of the first pictures of the two rows differ: two bands of rows of pixels, all in the left half.
		changed = np.abs(pixels[1] - pixels[0]) > 0.1
		rows = np.flatnonzero(changed.any(axis=1))
		self.assertEqual(np.count_nonzero(np.diff(rows) > 50), 1)
		self.assertFalse(changed[:, changed.shape[1] // 2:].any())

	def test_near_brick_hides_the_far_one_whatever_their_order(self):
		near, far = (cuboid((0, -1, 0.1)), "#0000ff"), (cuboid((0, 1, 0.1)), "#ff0000")
		for bricks in ([near, far], [far, near]):
			picture.wallPicture(self.path, bricks, dpi=60)
			self.assertGreater(self.share("#0000ff"), 0.1)
			self.assertEqual(self.share("#ff0000"), 0)

	def test_failed_segments_are_marked_and_intact_ones_are_not(self):
		points = [(0.1, 0, 0.1 * i) for i in range(1, 5)]
		picture.wallPicture(self.path, wall(), (points, [0, 0, 0, 0]))
		self.assertFalse(any(self.share(color) for color, _ in picture.failureModes.values() if color != "#1a1a1a"))
		picture.wallPicture(self.path, wall(), (points, [0, 1, 2, 3]))
		for mode in (1, 2, 3):
			self.assertGreater(self.share(picture.failureModes[mode][0]), 1e-5)

	def test_numbers_become_colours_with_a_scale(self):
		picture.wallPicture(self.path, [(cuboid((0.2 * i, 0, 0.1)), value) for i, value in enumerate((1.0, 2.0))], colorLabel="stress [Pa]")
		for value in (0.0, 1.0):
			self.assertGreater(self.share(picture._colorScale([0.0, 1.0], None).to_rgba(value)[:3]), 0.01)

	def test_support_does_not_widen_the_picture(self):
		slab = picture.Patch(cuboid((0, 0, -0.1), (100, 1, 0.2)), support=True)
		picture.wallPicture(self.path, [slab, (cuboid((0, 0, 0.1)), "#0000ff")], dpi=60)
		self.assertGreater(self.share("#0000ff"), 0.3)

	def test_nothing_of_pyplot_is_loaded(self):
		program = "import sys, standalone; standalone.load('picture'); sys.exit('matplotlib.pyplot' in sys.modules)"
		folder = os.path.dirname(os.path.abspath(__file__))
		self.assertEqual(subprocess.run([sys.executable, "-c", program], cwd=folder, env={"PATH": os.environ["PATH"]}).returncode, 0)

	def test_bad_input_is_refused_with_the_value(self):
		good = wall()
		for call, words in (
		        (lambda: picture.wallPicture(self.path, []), "nothing to draw"),
		        (lambda: picture.wallPicture(self.path, [(np.zeros((7, 3)), None)]), "brick 0"),
		        (lambda: picture.wallPicture(self.path, [good[0], (np.full((8, 3), np.nan), None)]), "brick 1.*nan"),
		        (lambda: picture.wallPicture(self.path, good, view="front"), "'front'.*'elevation'"),
		        (lambda: picture.wallPicture(self.path, good, limits=(1, 0, 0, 1)), "limits"),
		        (lambda: picture.wallPicture(self.path, good, marks=([(0, 0, 0)], [1, 2])), "1 points"),
		        (lambda: picture.pictureSeries(self.path, [(0, good, None)], columns=0), "columns is 0"),
		        (lambda: picture.wallPicture(self.path, good, dpi=5e-324), "dpi is 5e-324"),
		        (lambda: picture.wallPicture(self.path, good, width=1e6), "pixels"),
		        (lambda: picture.historyPlot(self.path, [0], {"A": [(0, 0, 0)]}, dpi=0), "dpi is 0")
		):
			with self.assertRaisesRegex(ValueError, words):
				call()
		self.assertFalse(os.path.exists(self.path))

	def test_histories_become_a_png(self):
		time = np.linspace(0, 1.5, 50)
		histories = {"A": np.outer(time, [1, 2, 3]), "B": np.full((50, 3), np.nan)}
		picture.historyPlot(self.path, time, histories, title="A and B", timeRange=(0, 1), width=9, dpi=100)
		self.assertEqual(self.size(), (900, 324))

	def test_lines_of_histories_look_as_asked_for(self):
		picture.historyPlot(self.path, [0, 1], {"A": np.zeros((2, 3)), "B": np.ones((2, 3))}, styles={"B": {"color": "#00ff00", "linewidth": 5}})
		self.assertGreater(self.share("#00ff00"), 1e-3)
		self.assertGreater(self.share(picture._lineColors[0]), 1e-4)

	def test_what_stands_still_is_not_magnified(self):
		self.assertEqual(picture._widened((1.0, 3.0), 1.0), (1.0, 3.0))
		self.assertEqual(picture._widened((1.0, 3.0), 4.0), (0.0, 4.0))
		self.assertEqual(picture._widened((-1e-12, 1e-12), 0.0), (-1e-12, 1e-12))

	def test_style_of_an_unknown_history_is_refused(self):
		with self.assertRaisesRegex(ValueError, "'C'.*'A'"):
			picture.historyPlot(self.path, [0, 1], {"A": np.zeros((2, 3))}, styles={"C": {}})

	def test_bad_histories_are_refused(self):
		for histories, words in (({}, "empty"), ({"A": np.zeros((3, 3))}, "'A'.*\\(3, 3\\).*\\(2, 3\\)")):
			with self.assertRaisesRegex(ValueError, words):
				picture.historyPlot(self.path, [0, 1], histories)


class PaintOrderTest(unittest.TestCase):

	def order(self, corners, view):
		right, up, toward = picture._viewAxes(view)
		return picture.paintOrder(np.array(corners), np.column_stack([right, up]), toward)

	def test_small_brick_on_a_long_slab_comes_after_it(self):
		# The slab's centre is nearer to the viewer: an order by centres would paint it over the brick.
		corners = [cuboid((0, 2, 0.1)), cuboid((0, 0, -0.1), (1, 5, 0.2))]
		self.assertEqual(self.order(corners, "3d"), [1, 0])
		self.assertEqual(self.order(corners[::-1], "3d"), [0, 1])

	def test_nearest_brick_of_a_wall_of_two_wythes_is_painted_last_on_every_line_of_sight(self):
		flemish = standalone.load("bonds").bond("Flemish", (0.2, 0.1, 0.1))
		boxes = []
		for course in range(5):
			places = flemish.course(course, 0, 1)
			boxes += [((one, 0.1 + front, 0.1 * course), (other, 0.1 + back, 0.1 * course + 0.1)) for one, other, (front, back) in flemish.pieces(places)]
		low, high = np.array(boxes).transpose(1, 0, 2)
		corners = 0.5 * (low + high)[:, None] + 0.5 * signs * (high - low)[:, None]
		random = np.random.default_rng(1)
		# as laid, and with corners moved as in a wall that has cracked a little: neighbours overlap by less than a line is wide
		for view, moved in itertools.product(("3d", (200, 35), (-30, 5)), (0, 1e-4)):
			toward = picture._viewAxes(view)[2]
			place = np.argsort(self.order(corners + random.normal(0, moved, corners.shape), view))
			for start in random.uniform((0, 0, 0), (1, 0.2, 0.5), (300, 3)):
				# where the line of sight through a point of the wall enters and leaves the slabs between opposite faces of each box
				ends = np.sort([(low - start) / toward, (high - start) / toward], axis=0)
				into, out = ends[0].max(axis=1), ends[1].min(axis=1)
				hit = np.flatnonzero(out > into + max(1e-6, 50 * moved))
				self.assertEqual(hit[place[hit].argmax()], hit[out[hit].argmax()])

	def test_every_brick_comes_once_in_any_view(self):
		corners = [cuboid((0.21 * i, 0.21 * j, 0.21 * k), turn=0.3) for i in range(3) for j in range(3) for k in range(3)]
		for view in (*picture.views, (200, -35)):
			self.assertEqual(sorted(self.order(corners, view)), list(range(27)))

	def test_bricks_that_hide_each_other_in_a_ring_are_all_painted(self):
		# 1 is in front of 0, 2 of 1 and 0 of 2: no order is right everywhere; the farthest comes first and none is lost.
		ring = np.array([[False, True, False], [False, False, True], [True, False, False]])
		self.assertEqual(picture._topologicalOrder(ring, np.array([0.2, 0.1, 0.3])), [1, 2, 0])


if __name__ == "__main__":
	unittest.main()
