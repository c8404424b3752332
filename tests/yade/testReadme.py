# SPDX-License-Identifier: GPL-2.0-or-later
# The scene script in README.md runs as it stands: it says what README shows, the wall cracks and a picture is left.
import os, re, tempfile, unittest

from buildYade import run

readme = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'README.md')


class Readme(unittest.TestCase):

	def test_scene_of_your_own(self):
		with open(readme) as file:
			text = file.read()
		script, = re.findall(r'```python\n(.*?)```', text, re.S)
		said, = re.findall(r'```text\n(.*?)```', text, re.S)
		with tempfile.TemporaryDirectory() as folder:
			with open(os.path.join(folder, 'mywall.py'), 'w') as file:
				file.write(script)
			process = run('-n', '-x', 'mywall.py', cwd=folder)
			self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
			self.assertIn(said, process.stdout)
			failed = re.search(r'^(\d+) segments failed', process.stdout, re.M)
			self.assertGreater(int(failed.group(1)), 0)
			self.assertGreater(os.path.getsize(os.path.join(folder, 'mywall.png')), 5000)
