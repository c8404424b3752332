# SPDX-License-Identifier: GPL-2.0-or-later
# What the documentation tells a user to type: shell commands and Python scenes, as they stand in Markdown pages, in the heads of examples, figures and scripts.
"""Commands and Python blocks of the documentation."""

import ast
import pathlib
import re
import shlex
from typing import NamedTuple

repository = pathlib.Path(__file__).resolve().parents[2]

#: What a line, or `code` in a sentence, begins with that is a command.
_command = re.compile(r"(build/yade|scripts/\w+\.sh|examples/\w+\.py(?= -)|cmake|ctest|xvfb-run|yade-batch|yade|python3|apt-get|sudo|git)(?=\s|$)(?! import)")
_fence = re.compile(r"^(```+)\s*(\w*).*?\n(.*?)^\1\s*$", re.M | re.S)
_runAfter = re.compile(r"<!-- run after: (\S+) -->\s*\Z")
_runBy = re.compile(r"<!-- run by: (\S+) -->\s*\Z")


class Command(NamedTuple):
	"""A shell command that a page shows.

	:param place: file it stands in
	:param text: in one line, without what follows it as a remark
	"""

	place: str
	text: str


class Scene(NamedTuple):
	"""The Python blocks of a page, one after the other: a user types them in this order.

	:param place: file they stand in
	:param code: a script
	:param said: texts (blocks marked `text`) that the script prints
	:param runBy: tests that run other blocks of the page, which this script cannot: those that need a window
	"""

	place: str
	code: str
	said: list
	runBy: list


def markdownPages():
	"""All pages, README first."""
	return [repository / "README.md", *sorted((repository / "doc").rglob("*.md")), repository / "benchmarks" / "README.md"]


def commands():
	"""All commands of all pages and heads, in order; each once a file."""
	found = []
	for page in markdownPages():
		found += [Command(_name(page), text) for text in _commandsOfMarkdown(page.read_text())]
	for script in [*sorted((repository / "examples").glob("*.py")), *sorted((repository / "doc").rglob("*.py"))]:
		found += [Command(_name(script), text) for text in _commandLines(ast.get_docstring(ast.parse(script.read_text())) or "")]
	for script in sorted((repository / "scripts").glob("*.sh")):
		head = re.split(r"^[^#\n]", script.read_text(), maxsplit=1, flags=re.M)[0]
		found += [Command(_name(script), text) for text in _commandLines(head.replace("#", ""))]
	return list(dict.fromkeys(found))


def scenes():
	"""A scene for each page that has Python blocks."""
	return [scene for page in markdownPages() if (scene := sceneOf(page))]


def sceneOf(page):
	"""The scene of a page, None when it has no Python. A comment before a block, `<!-- run after: FILE -->`, names a script that makes what the block needs;
	`<!-- run by: TEST -->` the test that runs it instead."""
	text, parts, said, runBy = page.read_text(), [], [], []
	for block in _fence.finditer(text):
		if block.group(2) == "text":
			said.append(block.group(3))
		if block.group(2) == "python":
			if test := _runBy.search(text[:block.start()]):
				runBy.append(test.group(1))
				continue
			if before := _runAfter.search(text[:block.start()]):
				parts.append((repository / before.group(1)).read_text())
			parts.append(block.group(3))
	return Scene(_name(page), "\n".join(parts), said, runBy) if parts or runBy else None


def _name(path):
	return str(path.relative_to(repository))


def _commandsOfMarkdown(text):
	found = []
	for block in _fence.finditer(text):
		if block.group(2) in ("sh", "bash", "console"):
			found += [_cleaned(line) for line in _joined(block.group(3)) if line.strip() and not line.lstrip().startswith("#")]
		elif not block.group(2):
			found += _commandLines(block.group(3))
	prose = _fence.sub("", text)
	found += _commandLines("\n".join(line for line in _joined(prose) if line.startswith("    ")))
	found += [_cleaned(code) for code in re.findall(r"(?<!`)`([^`\n]+)`(?!`)", prose) if _command.match(code)]
	return [command for command in found if len(command.split()) > 1 or "/" in command]


def _commandLines(text):
	return [_cleaned(line) for line in _joined(text) if _command.match(line.strip())]


def _joined(text):
	"""Lines, those that end with a backslash together with the next."""
	return re.sub(r"\\\n\s*", "", text).splitlines()


def _cleaned(line):
	"""Without a remark after it: '# so', or whatever stands behind several blanks."""
	return re.split(r"\s+# |\s{2,}", line.strip().removeprefix("$ "))[0]


# What a command says


def program(command):
	"""The file of the repository that a command runs, and the words after it; (None, []) for a command without one."""
	words = _words(command.text)
	for place, word in enumerate(words):
		if re.match(r"(scripts|examples|benchmarks|tests|doc)/.*\.(sh|py)$", word):
			return repository / word, words[place + 1:]
	return None, []


def options(command):
	"""Options that a command gives to a program of the repository."""
	return [word.split("=")[0] for word in program(command)[1] if re.match(r"--[a-z]", word)]


def sourceOf(path, seen=None):
	"""Text of a program and of what it imports beside it or calls, which may be what reads its options."""
	seen = set() if seen is None else seen
	if path in seen or not path.is_file():
		return ""
	seen.add(path)
	text = path.read_text()
	more = [path.parent / f"{name}.py" for name in re.findall(r"^\s*(?:import|from) (\w+)", text, re.M)]
	more += [repository / name for name in re.findall(r"\$source\"?/([\w/]+\.(?:py|sh))", text)]
	return text + "".join(sourceOf(other, seen) for other in more)


def _words(text):
	return shlex.split(re.sub(r"[][|]|\.\.\.", " ", text), posix=False)
