# SPDX-License-Identifier: GPL-2.0-or-later
# The same scene on one and on two threads, and with any vector instructions: the same result to the last bit.
import os, re, unittest

from buildYade import run

folder = os.path.dirname(os.path.abspath(__file__))


class Threads(unittest.TestCase):

	def collapse(self, threads, *scene, **environment):
		"""Runs collapse.py in a YADE of its own; dict of what it prints."""
		scene = [str(x) for x in scene]
		process = run('-n', '-x', '-j%d' % threads, os.path.join(folder, 'collapse.py'), *scene, timeout=600, **environment)
		self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
		found = dict(re.findall(r'^(threads|failures|fingerprint) (\w+)$', process.stdout, re.M))
		self.assertEqual(int(found['threads']), threads)
		return found

	def check(self, *scene):
		one, two = self.collapse(1, *scene), self.collapse(2, *scene)
		self.assertGreater(int(one['failures']), 0)
		self.assertEqual(two['fingerprint'], one['fingerprint'])

	def test_collapse(self):
		self.check(5000, 0, 4, 4)

	def test_collapse_with_verlet_distance(self):
		self.check(3000, .02, 4, 4)

	def test_collapse_with_changes_of_level(self):
		self.check(3000, .02, 4, 4, 'onDemand')

	def test_more_bricks_than_one_thread_moves_alone(self):
		self.check(250, .02, 16, 14)

	def test_collapse_with_other_vector_instructions(self):
		best = self.collapse(1, 3000, .02, 4, 4)
		for limit in '01':
			self.assertEqual(self.collapse(1, 3000, .02, 4, 4, YADE_BRICK_INSTRUCTION_SET=limit)['fingerprint'], best['fingerprint'])


class Repeated(unittest.TestCase):

	def test_two_runs_of_one_program_on_two_threads_are_the_same(self):
		import collapse
		prints = []
		for _ in range(2):
			collapse.build()
			collapse.O.run(1500, True)
			prints.append(collapse.fingerprint())
		self.assertEqual(prints[0], prints[1])
