# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command of the documentation is run by a test, and every Python block runs here, in YADE.

    python3 tests/docs/testCommands.py [--yade build/yade] [options of unittest]

Shell commands that take long, install or build are run by the tests that coverage.py names; the others are looked at here: that what they run is there
and has the options that they give it. Python blocks of a page are one script, run from top to bottom with the reductions below.
"""

import fnmatch
import os
import re
import subprocess
import sys
import tempfile
import unittest

import coverage
import pages

#: What is made shorter: page, text, what stands there in the test.
reductions = [
        ("README.md", "duration=3", "duration=1"),
        ("doc/accuracy.md", "duration=3", "duration=.02"),
        ("doc/guide/first-scene.md", "duration=3", "duration=.02"),
        ("doc/guide/running.md", "duration=5", "duration=.05"),
        ("doc/guide/running.md", "duration=3", "duration=.02"),
        ("doc/guide/running.md", "duration=1", "duration=.02"),
        ("doc/guide/results.md", "duration=.5", "duration=.1"),
        ("doc/guide/studies.md", "for seed in (1, 2)", "for seed in (2, )"),
]

yade = os.path.join(pages.repository, "build", "yade")


class Commands(unittest.TestCase):

	@classmethod
	def setUpClass(cls):
		cls.commands = pages.commands()

	def none(self, lacks):
		self.assertEqual(lacks, [], "\n" + "\n".join(map(str, lacks)))

	def test_the_commands_are_found(self):
		texts = {command.text for command in self.commands}
		for known in ("scripts/demo.sh", "build/yade -x mywall.py", "cmake --install build", "scripts/stability.sh [--fast]", "ctest -R budget"):
			self.assertIn(known, texts)
		self.assertIn("examples/05_accuracy_versus_time.py", {command.place for command in self.commands})

	def test_what_they_run_is_there(self):
		self.none([command for command in self.commands if (path := pages.program(command)[0]) and not path.is_file()])

	def test_what_they_run_has_the_options(self):
		self.none([
		        f"{command}: {option}" for command in self.commands for option in pages.options(command)
		        if option not in ("--help", ) and not re.search(re.escape(option) + r"\b", pages.sourceOf(pages.program(command)[0]))
		])

	def test_each_is_run_by_a_test(self):
		self.none([command for command in self.commands if rowOf(command) is None and not testsOfExample(command)])

	def test_each_example_is_in_readme_and_says_how_to_run_it(self):
		readme = (pages.repository / "README.md").read_text()
		examples = [f"examples/{file.name}" for file in sorted((pages.repository / "examples").glob("[0-9]*.py"))]
		self.assertGreater(len(examples), 5)
		self.none([example for example in examples if f"| `{example}` |" not in readme])
		self.none([example for example in examples if example not in {command.place for command in self.commands}])

	def test_each_row_of_the_table_has_a_command(self):
		used = {rowOf(command) for command in self.commands}
		self.none([row[0] for row in coverage.covered if row[0] not in used])

	def test_each_row_of_the_table_names_tests_that_exist(self):
		known = testNames()
		self.assertIn("yade.testInstall", known)
		self.none([f"{row[0]}: {name}" for row in coverage.covered for name in row[1] if not fnmatch.filter(known, name)])


def rowOf(command):
	"""The pattern of the first row that a command matches, or None."""
	return next((row[0] for row in coverage.covered if re.match(row[0], command.text)), None)


def testsOfExample(command):
	"""Names of the tests that run the example of a command, or an example that runs it."""
	path, _ = pages.program(command)
	text = (pages.repository / "tests" / "CMakeLists.txt").read_text()
	run = {script: f"example.{name}" for name, script in re.findall(r"^add_example\((\w+) (\S+\.py)", text, re.M)}
	if path is None or path.parent.name != "examples":
		return []
	return [test for script, test in run.items() if script == path.name or path.name in (path.parent / script).read_text()]


def testNames():
	"""Names of ctest, from the files that define them: those given one by one, and one for each file of a folder."""
	tests = pages.repository / "tests"
	text = "\n".join(file.read_text() for file in tests.rglob("CMakeLists.txt"))
	names = set(re.findall(r"add_test\(NAME ([\w.]+)[\s)]", text))
	names |= {f"example.{name}" for name in re.findall(r"^add_example\((\w+)", text, re.M)}
	names |= {f"{folder}.{file.stem}" for folder in ("yade", "verification", "stability") for file in (tests / folder).glob("*.py")}
	names |= {f"docs.figure.{file.stem}" for file in (pages.repository / "doc" / "figures").glob("*.py")}
	return sorted(names)


class Scenes(unittest.TestCase):
	"""Filled below: a test for each page."""

	def run_page(self, scene):
		for page, text, shorter in reductions:
			if page == scene.place:
				self.assertIn(text, scene.code, f"{page} has no {text} any more that could be made shorter")
				scene = scene._replace(code=scene.code.replace(text, shorter))
		with tempfile.TemporaryDirectory() as folder:
			with open(os.path.join(folder, "scene.py"), "w") as file:
				file.write(scene.code)
			command = [os.path.abspath(yade), "-n", "-x", "-j1", "scene.py"]
			process = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
			self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
			for said in scene.said:
				self.assertIn(said, process.stdout)
			return process.stdout, {name: os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder)}

	def test_reductions_are_of_pages_with_scenes(self):
		self.assertLessEqual({page for page, _, _ in reductions}, {scene.place for scene in pages.scenes()})

	def test_blocks_that_other_tests_run_name_them(self):
		self.assertEqual([(scene.place, test) for scene in pages.scenes() for test in scene.runBy if test not in testNames()], [])

	def test_what_scenes_say_is_compared(self):
		self.assertIn("deformation", pages.sceneOf(pages.repository / "doc" / "guide" / "first-scene.md").said[0])

	def test_readme(self):
		"""The wall of README cracks, and a picture is left."""
		said, files = self.run_page(pages.sceneOf(pages.repository / "README.md"))
		self.assertGreater(int(re.search(r"^(\d+) segments failed", said, re.M).group(1)), 0)
		self.assertGreater(files["mywall.png"], 5000)


class Messages(unittest.TestCase):
	"""The messages that the page about troubles explains are those that the code has; '...' stands for what differs."""

	def test_they_are_in_the_code(self):
		files = [file for folder in ("pkg", "py", "cmake") for file in (pages.repository / folder).rglob("*") if file.suffix in (".cpp", ".hpp", ".py", ".cmake")]
		code = re.sub(r"""['"]\s*\n?\s*f?['"]""", "", "\n".join(file.read_text() for file in files))  # texts that go on in the next line
		messages = re.findall(r"^### `(.*)`$", (pages.repository / "doc" / "guide" / "troubleshooting.md").read_text(), re.M)
		self.assertGreater(len(messages), 10)
		self.assertEqual([part for message in messages for part in message.split("...") if part.strip(" .;") and part.strip() not in code], [])


def _addPages():
	for scene in pages.scenes():
		if scene.code and scene.place != "README.md":
			name = "test_" + re.sub(r"\W+", "_", scene.place.removesuffix(".md"))
			setattr(Scenes, name, _testOf(scene))


def _testOf(scene):

	def test(self):
		self.run_page(scene)

	return test


_addPages()

if __name__ == "__main__":
	if "--yade" in sys.argv:
		place = sys.argv.index("--yade")
		yade = sys.argv[place + 1]
		del sys.argv[place:place + 2]
	unittest.main()
