# SPDX-License-Identifier: GPL-2.0-or-later
# YADE's 3-D window: bricks, fields, deformation, cracked joints and forces are where they should be, in pictures of a real window under a virtual screen.
# windowScene.py draws; here places in the scene are projected by the camera that the view tells, and the pixels there are looked at.
import json, math, os, subprocess, tempfile, unittest

import numpy as np
from matplotlib.image import imread

import yade.config
import yade_brick
from buildYade import build
from yade import O
from yade_brick import *

here = os.path.dirname(os.path.abspath(__file__))
fieldOfView = math.pi / 4  # of the view's camera, vertical: QGLViewer's own value


def inWindow(*arguments, program=os.path.join(build, 'yade'), timeout=120, **environment):
	"""The finished process of a YADE that has a window."""
	inherited = {k: v for k, v in os.environ.items() if k not in ('YADE_PREFIX', 'PYTHONPATH', 'OMP_NUM_THREADS', 'DISPLAY')}
	screen = ['timeout', '--kill-after=5', str(timeout), 'xvfb-run', '-a', '-s', '-screen 0 1280x1024x24']
	return subprocess.run(
	        screen + [program, '-x', '-j1', *arguments], env=dict(inherited, LIBGL_ALWAYS_SOFTWARE='1', OMP_WAIT_POLICY='passive', **environment),
	        capture_output=True, text=True, timeout=timeout + 20
	)


class Picture:
	"""A picture of the window with the camera that took it."""

	def __init__(self, folder, name, facts):
		self.pixels = imread(os.path.join(folder, name + '.png'))[:, :, :3]
		self.__dict__.update(facts[name])
		eye, direction, up = (np.array(self.camera[k]) for k in ('eye', 'direction', 'up'))
		self.eye, self.axes = eye, np.array([np.cross(direction, up), up, direction])

	def place(self, point):
		"""Row and column of a point of the scene."""
		height, width = self.pixels.shape[:2]
		x, y, depth = self.axes @ (np.array(point) - self.eye)
		pixels = height / 2 / math.tan(fieldOfView / 2) / depth
		return int(height / 2 - y * pixels), int(width / 2 + x * pixels)

	def at(self, point):
		"""Colour, the median of 3 x 3 pixels."""
		row, column = self.place(point)
		return np.median(self.pixels[row - 1:row + 2, column - 1:column + 2].reshape(-1, 3), axis=0)

	def has(self, color, lower, upper):
		"""How many pixels of a box have (nearly) the hue of a colour. It is compared without brightness, which depends on the light."""
		(bottom, left), (top, right) = self.place(lower), self.place(upper)
		box = self.pixels[top:bottom + 1, left:right + 1].reshape(-1, 3)
		return sum(sameHue(pixel, color) for pixel in box)


def hue(color):
	"""Direction away from grey; zero for greys."""
	away = np.array(color) - np.mean(color)
	return away / np.linalg.norm(away) if np.linalg.norm(away) > .08 else 0 * away


def sameHue(one, other):
	return hue(one) @ hue(other) > .95  # within 18 degrees in the plane of hues; the colours used are 40 degrees apart at least


class Drawn(unittest.TestCase):

	@classmethod
	def setUpClass(cls):
		cls.folder = tempfile.TemporaryDirectory()
		cls.process = inWindow(os.path.join(here, 'windowScene.py'), cls.folder.name)
		if cls.process.returncode != 0: raise AssertionError(cls.process.stdout[-3000:] + cls.process.stderr[-3000:])
		with open(os.path.join(cls.folder.name, 'facts.json')) as f:
			cls.facts = json.load(f)

	@classmethod
	def tearDownClass(cls):
		cls.folder.cleanup()

	def picture(self, name):
		return Picture(self.folder.name, name, self.facts)

	def assertHue(self, picture, point, color):
		self.assertTrue(sameHue(picture.at(point), color), '%s at %s, expected the hue of %s' % (picture.at(point), point, color))

	def assertWhite(self, picture, point):
		self.assertGreater(picture.at(point).min(), .99, 'at %s' % (point, ))

	def test_bricks_have_their_own_colours_and_are_where_they_should_be(self):
		picture = self.picture('color')
		for x in (-.32, -.25, -.18):
			self.assertHue(picture, (x, -.1, .07), (.8, .1, .1))
			self.assertHue(picture, (-x, -.1, -.07), (.1, .6, .1))
		# beside the bricks: in the middle, and just outside of each edge; the sides that face each other are seen, too
		for x, z in ((0, 0), (-.37, 0), (.37, 0), (.25, .12), (.25, -.12), (-.25, .12), (-.25, -.12)):
			self.assertWhite(picture, (x, -.1, z))

	def test_edges_are_dark(self):
		picture = self.picture('color')
		row, column = picture.place((-.35, -.1, 0))
		self.assertLess(picture.pixels[row, column - 2:column + 3].max(axis=1).min(), .35)

	def test_a_wire_frame_is_empty(self):
		picture = self.picture('wire')
		self.assertWhite(picture, (-.25, -.1, .03))
		self.assertGreater(picture.has((.8, .1, .1), (-.37, -.1, -.12), (-.13, -.1, .12)), 50)

	def test_a_field_goes_from_blue_to_yellow(self):
		picture = self.picture('speed')
		self.assertEqual(picture.shownRange, [0, 5])
		self.assertHue(picture, (-.25, -.1, .05), (.07, .10, .36))
		self.assertHue(picture, (.25, -.1, .05), (1, .93, .36))

	def test_a_given_range_is_used(self):
		picture = self.picture('range')
		self.assertEqual(picture.shownRange, [0, 10])
		self.assertHue(picture, (-.25, -.1, .05), (.07, .10, .36))
		color = picture.at((.25, -.1, .05))  # half way is the grey in the middle of the map
		self.assertLess(np.ptp(color), .12)

	def test_every_field_of_bricks_at_rest_has_a_range(self):
		fields = self.facts['fields']
		self.assertEqual({name: fields[name] for name in ('level', 'utilisation', 'failed')}, {'level': [0, 3], 'utilisation': [0, 1], 'failed': [0, 1]})
		self.assertEqual(fields['displacement'], [0, 0])
		# before the first step stresses are not known
		for name in ('meanStress', 'verticalStress', 'principalStress', 'vonMisesStress'):
			self.assertTrue(all(math.isnan(end) for end in fields[name]), name)

	def test_vertical_stress_is_that_of_the_bricks(self):
		picture = self.picture('column')
		# the axes of the bricks are those of the world
		np.testing.assert_allclose(picture.shownRange, picture.stress, rtol=1e-12)
		self.assertLess(picture.stress[0], picture.stress[1])
		self.assertHue(picture, (0, -.1, -.1), (.07, .10, .36))
		self.assertHue(picture, (0, -.1, .1), (1, .93, .36))

	def test_deformation_is_magnified(self):
		plain, magnified = self.picture('column'), self.picture('magnified')
		self.assertGreater(magnified.bulge, .01)
		for picture, bulge, toViewer in ((plain, 0, 0), (magnified, magnified.bulge, magnified.toViewer)):
			row = picture.place((0, -.1, -.1))[0]
			left, right = np.flatnonzero(picture.pixels[row].min(axis=1) < .5)[[0, -1]]
			expected = [picture.place((x, -.1 - toViewer, -.1))[1] for x in (-.1 - bulge, .1 + bulge)]
			# outlines are 1.5 pixels wide, and places are cut to whole pixels
			self.assertLessEqual(np.abs(np.array((left, right)) - expected).max(), 2)

	def test_failed_segments_have_the_colour_of_their_mode(self):
		picture = self.picture('joints')
		self.assertEqual(picture.failures, [16, 16, 0])  # all 4 x 4 segments of two joints
		tension, shear = (.07, .71, .90), (1, .82, .25)
		found = [[picture.has(color, (x - .09, -.1, -.02), (x + .09, -.1, .02)) for color in (tension, shear)] for x in picture.places]
		(torn, slid, held) = found
		self.assertGreater(torn[0], 50)
		self.assertGreater(slid[1], 50)
		self.assertEqual([torn[1], slid[0], *held], [0, 0, 0, 0])

	def test_what_holds_is_left_out_on_demand(self):
		both, cracks = self.picture('joints'), self.picture('cracksOnly')
		middle = (.35, -.105, 0)
		self.assertGreater(both.at(middle).min(), .45)  # light mortar
		self.assertLess(cracks.at(middle).min(), .45)  # the edges of two bricks
		self.assertGreater(cracks.has((.07, .71, .90), (-.44, -.1, -.02), (-.26, -.1, .02)), 50)

	def test_forces_are_arrows(self):
		picture = self.picture('forces')
		self.assertGreater(picture.largestForce, 0)
		arrow = sum(picture.has(color, (.25, -.1, -.25), (.45, -.1, .25)) for color in ((.16, .33, .78), (.85, .25, .10)))
		self.assertGreater(arrow, 0)

	def test_it_is_painted_while_bricks_change_and_joints_fail(self):
		running = self.facts['running']
		self.assertGreaterEqual(running['time'], .6)
		self.assertGreater(running['painted'], 3)
		self.assertGreater(running['failed'], 10)


class ImportedLate(unittest.TestCase):

	def test_a_window_that_was_open_before_the_import_draws_bricks_and_its_display_tab_offers_how(self):
		# YADE's own program, whose renderer collected its functors before the script; without the flag that Module.cpp clears it would abort
		with tempfile.TemporaryDirectory() as folder:
			script = os.path.join(folder, 'late.py')
			with open(script, 'w') as f:
				f.write(
				        'from yade import qt\nqt.View()\nimport yade_brick\nfrom yade_brick import window\n'
				        'O.bodies.append(yade_brick.brick((.2, .2, .2), material=BrickMat(young=1e7, poisson=.25, density=2000, frictionAngle=.5), color=(.8, .1, .1)))\n'
				        'window.openView("elevation", size=(200, 200))\nwindow.saveView(%r)\n'
				        'for name in ("Gl1_Brick", "Gl1_BrickGeom", "Gl1_BrickPhys"):\n\tassert qt.controller.displayCombo.findText(name) >= 0\n'
				        '\tqt.controller.displayComboSlot(name)\n'
				        '\tassert all(entry.widget for entry in qt.controller.displayArea.widget().entries)\n' % os.path.join(folder, 'late.png')
				)
			package = os.path.dirname(os.path.dirname(os.path.abspath(yade_brick._core.__file__)))
			process = inWindow(script, program='yade', PYTHONPATH=package)
			self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
			self.assertTrue(sameHue(imread(os.path.join(folder, 'late.png'))[100, 100, :3], (.8, .1, .1)))


class Attributes(unittest.TestCase):

	def tearDown(self):
		Gl1_Brick.field, Gl1_Brick.range = 'color', (math.nan, math.nan)

	def test_a_field_that_does_not_exist_is_refused(self):
		with self.assertRaisesRegex((ValueError, TypeError), 'allowed are color, displacement, speed' if yade_brick._core.headers == 'yade-abi' else ''):
			Gl1_Brick.field = 'pressure'
		self.assertEqual(str(Gl1_Brick.field), 'color')

	def test_attributes_are_of_the_class_and_of_all_its_objects(self):
		Gl1_Brick.field = 'speed'
		self.assertEqual(str(Gl1_Brick().field), 'speed')
		Gl1_Brick(field='level', deformationScale=3)
		self.assertEqual((str(Gl1_Brick.field), Gl1_Brick.deformationScale), ('level', 3))
		Gl1_Brick.deformationScale = 1
		Gl1_Brick.range[1] = 7
		self.assertEqual(Gl1_Brick().range[1], 7)

	def test_every_attribute_is_documented(self):
		for kind in (Gl1_Brick, Gl1_BrickGeom, Gl1_BrickPhys):
			for name in kind().dict():
				if name != 'label': self.assertIn('.. ystaticattr:: %s.%s(=' % (kind.__name__, name), kind.__doc__)

	def test_a_field_without_mortar_or_steps_does_no_harm_without_a_window(self):
		self.assertFalse(O.running)
		self.assertEqual(Gl1_Brick().dict()['deformationScale'], 1)


class Window(unittest.TestCase):

	def test_without_a_screen_it_says_what_to_do(self):
		from yade_brick import window
		O.reset()
		O.bodies.append(yade_brick.brick((1, 1, 1), material=BrickMat(young=1e7, poisson=.25, density=2000, frictionAngle=.5)))
		for call in (window.openView, lambda: window.saveView('view.png')):
			with self.assertRaisesRegex(RuntimeError, 'xvfb-run'):
				call()

	def test_what_cannot_be_is_refused(self):
		from yade_brick import window
		O.reset()
		for options, words in ((dict(look='above'), 'look'), (dict(look=((0, 0, 1), (0, 0, 2))), 'parallel'), (dict(around=((0, 0, 0), (1, 1, 0))), 'around'),
		                       (dict(around=((0, 0, 0), (1, 1, math.nan))), 'around'), (dict(), 'no brick'),
		                       (dict(around=((0, 0, 0), (1, 1, 1)), size=(0, 10)), 'size'), (dict(around=((0, 0, 0), (1, 1, 1)), background=(0, 0, 2)), 'background')):
			with self.assertRaisesRegex(ValueError, words):
				window.openView(**options)
		with self.assertRaisesRegex(ValueError, 'folder'):
			window.saveView('/nowhere/view.png')
