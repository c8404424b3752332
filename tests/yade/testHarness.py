# SPDX-License-Identifier: GPL-2.0-or-later
# build/yade: options and exit status pass through, and a failing check is reported.
import os, subprocess, tempfile, unittest

import yade.config
from buildYade import build, run


class Program(unittest.TestCase):

	def script(self, text, *arguments, options=('-n', '-x')):
		with tempfile.NamedTemporaryFile('w', suffix='.py') as f:
			f.write(text)
			f.flush()
			return run(*options, f.name, *arguments)

	def test_it_is_the_installed_yade(self):
		self.assertIn(yade.config.version, run('--version').stdout)

	def test_options_and_arguments_pass_through(self):
		process = self.script('import sys\nprint(O.numThreads, sys.argv[1:])\n', '--out', 'a b', options=('-n', '-x', '-j2'))
		self.assertIn("2 ['--out', 'a b']", process.stdout)

	def test_exit_status_passes_through(self):
		self.assertEqual(self.script('import sys\nsys.exit(3)').returncode, 3)
		self.assertEqual(self.script('1 / 0').returncode, 1)

	def test_classes_are_there_without_import(self):
		self.assertEqual(self.script('BrickMat(hn=.2)').returncode, 0)


class Checks(unittest.TestCase):

	def check(self, text):
		"""Runs YADE's `--check` with one check of the given text, and the plugin of this build."""
		with tempfile.TemporaryDirectory() as prefix:
			ours = os.path.join(build, 'prefix', yade.config.libPATH, 'yade-double')
			folder = os.path.join(prefix, yade.config.libPATH, 'yade-double')
			checks = os.path.join(folder, 'py', 'yade', 'tests', 'checks')
			os.makedirs(checks)
			for name in os.listdir(ours):
				if name.endswith('.so'): os.symlink(os.path.join(ours, name), os.path.join(folder, name))
			for name in ('__init__.py', 'tests/checks/checkList.py'):
				os.symlink(os.path.join(ours, 'py/yade', name), os.path.join(folder, 'py/yade', name))
			with open(os.path.join(checks, 'checkOwn.py'), 'w') as f:
				f.write(text)
			environment = dict(os.environ, YADE_PREFIX=prefix)
			return subprocess.run(['yade', '--check', '-n'], env=environment, capture_output=True, text=True, timeout=120)

	def test_passing_check(self):
		process = self.check('if BrickMat(hn=.2).hn != .2: raise YadeCheckError("hn")\n')
		self.assertEqual(process.returncode, 0, process.stdout)

	def test_failing_check(self):
		process = self.check('raise YadeCheckError("on purpose")\n')
		self.assertEqual(process.returncode, 1, process.stdout)
		self.assertIn('checkOwn.py', process.stdout)

	def test_our_checks_are_beside_yades(self):
		there = set(os.listdir(os.path.join(build, 'prefix', yade.config.libPATH, 'yade-double/py/yade/tests/checks')))
		own = set(n for n in os.listdir(os.path.dirname(os.path.abspath(__file__))) if n.startswith('check'))
		host = set(n for n in os.listdir('/usr/' + yade.config.libPATH + '/yade-double/py/yade/tests/checks') if n.endswith('.py'))
		self.assertLessEqual(own | host, there)
