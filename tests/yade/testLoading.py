# SPDX-License-Identifier: GPL-2.0-or-later
# How the plugin gets into YADE: by import in a plain YADE and by lying in the plugin folder; and when it must not.
# Each case runs in a process of its own.
import json, os, subprocess, sys, tempfile, unittest

import yade.config
import yade_brick

# the library as it is built; the one built with the wrong flags lies in wrongFlags/ beside it
library = os.path.realpath(yade_brick._core.__file__)
package = os.path.dirname(os.path.abspath(yade_brick._core.__file__))
hostLibraries = '/usr/' + yade.config.libPATH + '/yade-double'
python = sys.executable


def run(script, prefix=None, packages=None, program=('yade', '-n', '-x')):
	"""Run a script in a YADE of its own; by default one that has our package in the path and nothing in its plugin folder."""
	environment = dict(os.environ, PYTHONPATH=packages or os.path.dirname(package), OMP_WAIT_POLICY='passive')
	environment.pop('YADE_PREFIX', None)
	if prefix: environment['YADE_PREFIX'] = prefix
	with tempfile.TemporaryDirectory() as folder:
		path = os.path.join(folder, 'script.py')
		with open(path, 'w') as f:
			f.write(script)
		return subprocess.run(list(program) + [path], env=environment, capture_output=True, text=True, timeout=120)


def variant(folder, core=library):
	"""A copy of the package in `folder`, made of links, with another library. Returns the folder, to be put in the path."""
	target = os.path.join(folder, 'yade_brick')
	os.makedirs(target)
	for name in os.listdir(package):
		if name.endswith('.py'): os.symlink(os.path.realpath(os.path.join(package, name)), os.path.join(target, name))
	os.symlink(core, os.path.join(target, '_core.so'))
	return folder


def prefixWith(folder, core):
	"""A prefix in `folder` whose plugin folder has YADE's libraries and `core`."""
	plugins = os.path.join(folder, yade.config.libPATH, 'yade-double')
	os.makedirs(plugins)
	for name in os.listdir(hostLibraries):
		os.symlink(os.path.join(hostLibraries, name), os.path.join(plugins, name))
	os.symlink(core, os.path.join(plugins, os.path.basename(core)))
	return folder


wrongFlags = os.path.join(os.path.dirname(library), 'wrongFlags', os.path.basename(library))

# prints what came of an import, as one line of JSON
TRY = '''
import json
before = set(O.plugins())
try:
	import yade_brick
	error = None
except ImportError as e:
	error = str(e)
from yade import wrapper
added = set(O.plugins()) - before
print('RESULT ' + json.dumps(dict(error=error, added=sorted(added), material=hasattr(wrapper, 'BrickMat'))))
'''


def result(process):
	lines = [line for line in process.stdout.splitlines() if line.startswith('RESULT ')]
	if not lines: raise AssertionError('no result\n%s\n%s' % (process.stdout, process.stderr))
	return json.loads(lines[-1][7:])


class ImportInPlainYade(unittest.TestCase):

	def test_exactly_our_classes_are_registered(self):
		got = result(run(TRY))
		self.assertIsNone(got['error'])
		self.assertEqual(got['added'], sorted(yade_brick._core.classes))
		self.assertIn('BrickMat', got['added'])

	def test_nothing_is_printed_and_nothing_warns(self):
		process = run('import sys, warnings\nwarnings.simplefilter("error")\n'
		              'for f in (sys.stdout, sys.stderr): print("BEFORE", file=f, flush=True)\n'
		              'import yade_brick\n'
		              'for f in (sys.stdout, sys.stderr): print("AFTER", file=f, flush=True)\n')
		for text in (process.stdout, process.stderr):
			self.assertIn('BEFORE\nAFTER', text)
		self.assertEqual(process.returncode, 0)

	def test_classes_are_names_as_yades_own(self):
		process = run('import yade_brick, yade\nfrom yade import wrapper, system\n'
		              'assert BrickMat is yade_brick.BrickMat is yade.BrickMat is wrapper.BrickMat\n'
		              'assert "BrickMat" in system.childClasses("ElastMat")\n'
		              'assert O.isChildClassOf("BrickMat", "Material")\n'
		              'assert isinstance(BrickMat(), FrictMat)\n')
		self.assertEqual(process.returncode, 0, process.stderr)

	def test_star_import_gives_the_classes(self):
		process = run('names = {}\nexec("from yade_brick import *", names)\nimport yade_brick\nassert set(yade_brick._core.classes) <= set(names) and "O" not in names\n')
		self.assertEqual(process.returncode, 0, process.stderr)

	def test_reload_is_harmless(self):
		process = run('import importlib, yade_brick\nbefore, Class = O.plugins(), BrickMat\nimportlib.reload(yade_brick)\n'
		              'assert O.plugins() == before and BrickMat is Class\nBrickMat(hn=.2)\n')
		self.assertEqual(process.returncode, 0, process.stderr)
		self.assertNotIn('already registered', process.stderr)

	def test_a_running_scene_is_left_alone(self):
		process = run('O.bodies.append(sphere((0, 0, 0), 1))\nO.dt = 1e-3\nO.step()\nimport yade_brick\nassert O.iter == 1 and len(O.bodies) == 1\nO.step()\n')
		self.assertEqual(process.returncode, 0, process.stderr)

	def test_works_in_plain_python_after_import_yade(self):
		packages = os.path.dirname(package) + ':' + hostLibraries + '/py'
		process = run('import yade, yade_brick\nprint(yade_brick.BrickMat().hn)\n', program=(python,), packages=packages)
		self.assertEqual(process.returncode, 0, process.stderr)
		self.assertIn('0.1', process.stdout)


class PluginFolder(unittest.TestCase):

	def test_classes_are_there_without_import(self):
		with tempfile.TemporaryDirectory() as folder:
			process = run('assert BrickMat(hn=.2).hn == .2\nimport yade_brick\nassert yade_brick.BrickMat is BrickMat\n'
			              'print("SAME", yade_brick.__all__ == %r)\n' % yade_brick.__all__,
			              prefix=prefixWith(folder, library))
		self.assertEqual(process.returncode, 0, process.stderr)
		self.assertIn('SAME True', process.stdout)
		self.assertNotIn('already registered', process.stderr)

	def test_wrong_flags_are_refused_while_yade_starts(self):
		with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as other:
			got = result(run(TRY, prefix=prefixWith(folder, wrongFlags), packages=variant(other, wrongFlags)))
		self.assertIn('bytes', got['error'])
		self.assertFalse(got['material'])


class Refusal(unittest.TestCase):

	def refused(self, process, *says):
		got = result(process)
		self.assertEqual((got['added'], got['material']), ([], False))
		for words in says + ('Build',):
			self.assertIn(words, got['error'])

	def test_another_version_of_yade(self):
		self.refused(run('import yade.config\nyade.config.version = "2031.01z"\n' + TRY), '2031.01z', yade.config.version)

	def test_another_version_is_seen_by_the_library_itself(self):
		# as when YADE is replaced under an installed plugin: the Python package is not asked
		script = 'import yade.config\nyade.config.version = "2031.01z"\n' + TRY.replace('import yade_brick', 'import _core')
		self.refused(run(script, packages=package), '2031.01z', yade.config.version)

	def test_library_built_with_the_wrong_flags(self):
		with tempfile.TemporaryDirectory() as folder:
			self.refused(run(TRY, packages=variant(folder, wrongFlags)), 'State', 'bytes')

	def test_import_before_yade(self):
		packages = os.path.dirname(package) + ':' + hostLibraries + '/py'
		process = run('import yade_brick\n', program=(python,), packages=packages)
		self.assertEqual(process.returncode, 1)
		self.assertIn('ImportError', process.stderr)
		self.assertIn('import yade', process.stderr)
