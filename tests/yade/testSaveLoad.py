# SPDX-License-Identifier: GPL-2.0-or-later
# A collapse saved in the middle and continued from the file is the collapse that was never interrupted, to the last bit.
import os, tempfile, unittest

from yade import O

import collapse

FORMATS = ('xml', 'xml.gz', 'yade', 'yade.gz')


class Continued(unittest.TestCase):

	def setUp(self):
		self.folder = tempfile.TemporaryDirectory()

	def tearDown(self):
		O.reset()
		self.folder.cleanup()

	def saved(self, formats):
		paths = [os.path.join(self.folder.name, 'scene.' + end) for end in formats]
		for path in paths:
			O.save(path)
		return paths

	def finish(self, steps):
		O.run(steps, True)
		return collapse.state()

	def check(self, formats, steps):
		"""Goes on for some steps, uninterrupted and from files of each format: no number differs, none is missing."""
		paths = self.saved(formats)
		expected = self.finish(steps)
		for path in paths:
			O.reset()
			O.load(path)
			got = self.finish(steps)
			self.assertEqual(sorted(got), sorted(expected), path)
			different = [name for name in expected if got[name] != expected[name]]
			self.assertEqual(different, [], path)
		return expected

	def test_from_before_the_first_step(self):
		collapse.build()
		self.check(['xml', 'yade'], 300)

	def test_while_levels_change(self):
		collapse.build(onDemand=True)
		changing = lambda: [b.id for b in O.bodies if isinstance(b.shape, collapse.Brick) and b.shape.share < 1]
		while not changing(): O.step()
		for _ in range(40): O.step()
		self.assertTrue(changing())
		self.check(FORMATS, 1500)

	def test_while_joints_crack(self):
		collapse.build()
		O.run(400, True)
		before = sum(collapse.failures())
		self.assertGreater(before, 0)
		self.assertGreater(collapse.jointCount(), 0)
		self.check(FORMATS, 2000)
		self.assertGreater(sum(collapse.failures()), before, 'nothing cracked after the file was written')

	def test_while_joints_crack_with_verlet_distance(self):
		collapse.build(verletDist=.02)
		O.run(400, True)
		self.check(['xml.gz'], 2000)

	def test_while_bricks_fall_on_each_other(self):
		collapse.build(verletDist=.02)
		O.run(4200, True)
		self.assertEqual(collapse.jointCount(), 0)
		self.assertGreater(sum(1 for i in O.interactions if i.isReal), 0)
		self.check(['yade'], 2500)
