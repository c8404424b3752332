# SPDX-License-Identifier: GPL-2.0-or-later
# A film of a running scene: what it keeps at each call, and that it becomes a file. How files are drawn is tested in tests/python/test_animation.py.
import io, os, tempfile, unittest

from yade import *
from yade import Vector3
import numpy as np
from PIL import Image
from testSnapshot import couplet
from testVtk import scene, column
from yade_brick import animation, brick, Film, runWithProgress, VtkRecorder


class Films(unittest.TestCase):

	def test_keeps_time_bricks_and_failed_segments(self):
		wall = couplet()
		film = Film(colors=lambda body: body.state.pos[2])
		film()
		wall.bodies[1].state.vel = Vector3(0, 0, 1)
		runWithProgress(duration=.01, every=.005, callback=film, stream=io.StringIO())
		times, patches, marks = zip(*film.frames)
		self.assertEqual(len(times), 3)
		np.testing.assert_allclose(np.array(times) - times[0], [0, .005, .01], atol=2.1e-5)  # a step
		self.assertEqual([some[1].color for some in patches][-1], wall.bodies[1].state.pos[2])
		self.assertEqual((set(marks[0].states), set(marks[-1].states) <= {1, 4}), ({0}, True))
		self.assertAlmostEqual(patches[-1][1].corners[:, 2].mean(), wall.bodies[1].state.pos[2], places=9)

	def test_second_frame_of_a_time_replaces_the_first(self):
		couplet()
		film = Film()
		film(), film()
		self.assertEqual(len(film.frames), 1)

	def test_marks_begin_with_the_joints(self):
		couplet()
		for interaction in O.interactions:
			O.interactions.erase(interaction.id1, interaction.id2)
		film = Film()
		film()
		self.assertIsNone(film.frames[0][2])

	def test_becomes_a_gif(self):
		couplet()
		film = Film()
		film()
		O.step()
		film()
		with tempfile.TemporaryDirectory() as folder:
			with Image.open(film.save(os.path.join(folder, 'new', 'film.gif'), width=4, dpi=50)) as image:
				# the pictures differ by their time alone, which shows hundredths of a second
				self.assertEqual(image.size[0], 200)


class FromFiles(unittest.TestCase):

	def test_files_for_paraview_give_the_same_frames(self):
		bodies = scene(lambda clay: column(clay) + [brick((.2, .2, .2), center=(1, 0, .1), material=clay, deformation='refined', cells=2, fixed=True)])
		with tempfile.TemporaryDirectory() as folder:
			name = os.path.join(folder, 'run')
			film, recorder = Film(colors=lambda body: body.shape.stress()[2]), VtkRecorder(name)
			for _ in range(2):
				film(), recorder()
				bodies[2].state.vel = Vector3(0, 0, 1)
				O.run(100, True)
			frames = animation.readFrames(name, 'stress', 2)
			self.assertEqual([time for time, *_ in frames], [time for time, *_ in film.frames])
			for (_, got, marks), (_, expected, expectedMarks) in zip(frames, film.frames):
				for patch, other in zip(got, expected):
					np.testing.assert_allclose(patch.corners, other.corners, atol=1e-14)
					self.assertEqual(patch.support, other.support)
				# upright bricks: the stress along z is that of the world's axes
				np.testing.assert_allclose([patch.color for patch in got[:2]], [patch.color for patch in expected[:2]], rtol=1e-6)
				self.assertEqual((len(marks.states), sorted(marks.states)), (len(expectedMarks.states), sorted(expectedMarks.states)))
			with self.assertRaisesRegex(ValueError, "field is 'strain'"):
				animation.readFrames(name, 'strain')
			with self.assertRaisesRegex(ValueError, 'component is 9'):
				animation.readFrames(name, 'stress', 9)
			with self.assertRaises(FileNotFoundError):
				animation.readFrames(name + 'x')
