# SPDX-License-Identifier: GPL-2.0-or-later
# Animations from frames at hand: read back with Pillow and ffmpeg, frame by frame.
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
from unittest import mock

import numpy as np
from PIL import Image, ImageSequence

import standalone

animation, picture = standalone.load("animation"), standalone.load("picture")
cube = 0.1 * np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])


def frames(count=3, color=None):
	"""A brick that goes to the right by 0.2 m from frame to frame; a mark appears in the last one."""
	found = []
	for k in range(count):
		marks = picture.Marks([(0.2 * k, 0, 0.2)], [1 if k == count - 1 else 0])
		found.append((0.1 * k, [picture.Patch(cube + (0.2 * k, 0, 0.1), color(k) if color else None)], marks))
	return found


def brickColumns(image):
	"""First and last column of pixels with the tone of a brick: red well above blue."""
	pixels = np.asarray(image.convert("RGB")).astype(int)
	brick = np.flatnonzero((pixels[..., 0] - pixels[..., 2] > 50).sum(axis=0) > 5)
	return brick.min(), brick.max()


class Saving(unittest.TestCase):

	def setUp(self):
		self.folder = pathlib.Path(tempfile.mkdtemp())
		self.addCleanup(shutil.rmtree, self.folder)
		self.small = dict(width=4, dpi=50)

	def save(self, name, given, **options):
		return pathlib.Path(animation.saveFrames(self.folder / name, given, **{**self.small, **options}))

	def images(self, path):
		with Image.open(path) as file:
			return [image.convert("RGB") for image in ImageSequence.Iterator(file)]

	def test_gif_has_all_frames_and_their_pace(self):
		path = self.save("a.gif", frames(), framesPerSecond=12.5)
		with Image.open(path) as image:
			self.assertEqual((image.n_frames, image.info["duration"], image.info["loop"]), (3, 80, 0))

	def test_brick_moves_by_the_same_in_each_frame_since_limits_are_shared(self):
		first, second, third = (brickColumns(image) for image in self.images(self.save("a.gif", frames())))
		# to the pixel
		self.assertAlmostEqual(second[0] - first[0], third[0] - second[0], delta=1)
		self.assertAlmostEqual(second[0] - first[0], first[1] - first[0], delta=2)
		self.assertAlmostEqual(first[1] - first[0], third[1] - third[0], delta=1)

	def test_pictures_in_a_folder_are_numbered_and_alike_in_size(self):
		path = self.save("frames", frames())
		names = sorted(os.listdir(path))
		self.assertEqual(names, ["frame-000000.png", "frame-000001.png", "frame-000002.png"])
		self.assertEqual(len({self.images(path / name)[0].size for name in names}), 1)

	def test_colours_mean_the_same_in_all_frames(self):
		first, second, third = self.images(self.save("a.gif", frames(color=lambda k: float(k)), colorLabel="number"))

		def ofBrick(image, k):
			# the middle of the brick, by the pixels that differ most from the other frames
			others = [np.asarray(other).astype(int) for other in (first, second, third) if other is not image]
			changed = np.min([np.abs(np.asarray(image).astype(int) - other).sum(axis=2) for other in others], axis=0)
			return np.asarray(image)[tuple(np.argwhere(changed > 40).mean(axis=0).astype(int))]

		shades = [int(ofBrick(image, k).sum()) for k, image in enumerate((first, second, third))]
		self.assertGreater(shades[1], shades[2] + 100)  # from light to dark over the shared range

	def test_same_frames_give_the_same_bytes(self):
		self.assertEqual(self.save("a.gif", frames()).read_bytes(), self.save("b.gif", frames()).read_bytes())

	@unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
	def test_mp4_has_all_frames_and_is_the_same_each_time(self):
		path = self.save("a.mp4", frames(4), framesPerSecond=10)
		counted = subprocess.run(
		        ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate,width", "-of", "csv=p=0", path],
		        capture_output=True, text=True, check=True
		).stdout.strip().split(",")
		self.assertEqual(counted, ["200", "10/1", "4"])
		self.assertEqual(path.read_bytes(), self.save("b.mp4", frames(4), framesPerSecond=10).read_bytes())

	def test_mp4_without_ffmpeg_is_refused_before_anything_is_drawn(self):
		with mock.patch.object(animation.shutil, "which", return_value=None):
			with self.assertRaisesRegex(RuntimeError, "ffmpeg.*not installed.*apt-get"):
				self.save("a.mp4", [])

	def test_wrong_arguments_are_told(self):
		for call, text in (
		        (lambda: self.save("a.avi", frames()), "a.avi.*allowed are"), (lambda: self.save("a.gif", []), "nothing to draw"),
		        (lambda: self.save("a.gif", frames(), framesPerSecond=0), "framesPerSecond is 0"),
		        (lambda: self.save("a.gif", frames(), view="above"), "view is 'above'"), (lambda: animation.Film(colors="red"), "colors is 'red'"),
		        (lambda: animation.Film(widest=-1), "widest is -1"),
		):
			with self.assertRaisesRegex(ValueError, text):
				call()


if __name__ == "__main__":
	unittest.main()
