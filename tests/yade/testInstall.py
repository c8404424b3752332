# SPDX-License-Identifier: GPL-2.0-or-later
# `cmake --install`: what goes where, and that it works from there.
import os, shutil, subprocess, tempfile, unittest

import yade.config
from buildYade import build

plugins = os.path.join(yade.config.libPATH, 'yade-double')
SCRIPT = 'import yade_brick\nfrom yade_brick import report\nBrickMat(hn=.2)\nprint("FROM", yade_brick._core.__file__)\n'


def install(*options, **environment):
	subprocess.run(['cmake', '--install', build, *options], check=True, capture_output=True, env=dict(os.environ, **environment))


def script(folder, program, **environment):
	path = os.path.join(folder, 'script.py')
	with open(path, 'w') as f:
		f.write(SCRIPT)
	inherited = {k: v for k, v in os.environ.items() if k not in ('YADE_PREFIX', 'PYTHONPATH')}
	return subprocess.run([program, '-n', '-x', path], env=dict(inherited, **environment), capture_output=True, text=True, timeout=120)


@unittest.skipIf(shutil.which('cmake') is None, 'cmake is not in the path')
class Install(unittest.TestCase):

	def test_import_from_a_scratch_prefix(self):
		with tempfile.TemporaryDirectory() as prefix:
			install('--prefix', prefix)
			packages = os.path.join(prefix, plugins, 'py')
			process = script(prefix, 'yade', PYTHONPATH=packages)
			self.assertEqual(process.returncode, 0, process.stderr)
			self.assertIn('FROM ' + packages, process.stdout)

	def test_default_is_yades_own_folder(self):
		with tempfile.TemporaryDirectory() as root:
			install(DESTDIR=root)
			folder = os.path.join(root, 'usr', plugins)
			self.assertEqual(sorted(os.listdir(folder)), ['libpkg_brick.so', 'py'])
			self.assertTrue(os.path.samefile(os.path.join(folder, 'py/yade_brick/_core.so'), os.path.join(folder, 'libpkg_brick.so')))
			self.assertEqual(os.listdir(os.path.join(folder, 'py')), ['yade_brick'])

	def test_plugin_folder_makes_the_classes_known_at_every_start(self):
		with tempfile.TemporaryDirectory() as prefix:
			install('--prefix', prefix)
			folder = os.path.join(prefix, plugins)
			host = os.path.join('/usr', plugins)
			for name in os.listdir(host):
				if name.endswith('.so'): os.symlink(os.path.join(host, name), os.path.join(folder, name))
			os.symlink(os.path.join(host, 'py', 'yade'), os.path.join(folder, 'py', 'yade'))
			process = script(prefix, 'yade', YADE_PREFIX=prefix, PYTHONPATH=os.path.join(folder, 'py'))
			self.assertEqual(process.returncode, 0, process.stderr)
