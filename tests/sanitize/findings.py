#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What sanitizers and memcheck have found in our code, each place once.

	findings.py file...     *.xml of memcheck, any other file with the output of a program that has sanitizers

The exit status is 1 when there is any. The sanitizers see our code only. Memcheck sees all of a process: a finding is ours when one of its stacks goes through our
library or our tests, so that memory which we left without a value and YADE reads is found too; what Python, YADE and the dynamic linker do among themselves is not.
A leak is ours when our code asked for the memory, which is lost for certain; not what Boost and Python asked for when our code called them.
"""
import re
import sys
import xml.etree.ElementTree as ElementTree

OURS = re.compile(r"(libpkg_brick\.so|_core\.so|kernel_tests)$")
ALLOCATORS = re.compile(r"(vgpreload_\w+-amd64-linux|libstdc\+\+|libc)\.so[.\d]*$")
SHOWN = 8  # frames of a stack


def frames(stack):
	"""(function, file, line, library) of each frame of a stack of memcheck."""
	return [tuple(frame.findtext(tag, "") for tag in ("fn", "file", "line", "obj")) for frame in stack.iter("frame")]


def ownFrames(kind, stacks):
	"""The frames that make an error ours."""
	if not kind.startswith("Leak_"):
		return [frame for stack in stacks for frame in stack if OURS.search(frame[3])]
	asking = next((frame for frame in stacks[0] if not ALLOCATORS.search(frame[3])), None)
	return [asking] if kind == "Leak_DefinitelyLost" and asking and OURS.search(asking[3]) else []


def ofMemcheck(path):
	"""{what and where: text} of a file of memcheck; where is the innermost place in our code."""
	try:
		root = ElementTree.parse(path).getroot()
	except ElementTree.ParseError as broken:
		return {path: f"memcheck did not come to its end: {broken}"}
	found = {}
	for error in root.iter("error"):
		kind, stacks = error.findtext("kind", ""), [frames(stack) for stack in error.iter("stack")]
		own = ownFrames(kind, stacks)
		if not own:
			continue
		what = error.findtext("what") or error.findtext("xwhat/text", "")
		text = "\n".join([what] + ["    %.120s (%s:%s)" % frame[:3] for frame in stacks[0][:SHOWN]] + [x.text for x in error.findall("auxwhat")])
		found.setdefault((kind,) + own[0][:3], text)
	return found


def ofSanitizers(path):
	"""The same of a file of the sanitizers."""
	with open(path, errors="replace") as log:
		lines = log.read().splitlines()
	found = {}
	for number, line in enumerate(lines):
		if re.search(r": runtime error: |ERROR: \w+Sanitizer", line):
			stack = [x for x in lines[number + 1:number + 1 + 2 * SHOWN] if re.match(r"\s*(#\d+ |[A-Z][a-z]+ of size)", x)][:SHOWN]
			found.setdefault(re.sub(r"==\d+==|0x[0-9a-f]+", "", line), "\n".join([line] + stack))
	return found


def main(paths):
	found = {}
	for path in paths:
		found.update(ofMemcheck(path) if path.endswith(".xml") else ofSanitizers(path))
	for text in found.values():
		print(text)
	return 1 if found else 0


if __name__ == "__main__":
	sys.exit(main(sys.argv[1:]))
