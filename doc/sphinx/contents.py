# SPDX-License-Identifier: GPL-2.0-or-later
# The navigation of the HTML pages is the list of links in doc/README.md: one list, for readers on a code host and for Sphinx. A page that the list lacks is
# a warning of Sphinx, and so an error.
"""Sphinx extension: tables of contents from lists of links."""

import re

#: Pages that build.py makes.
reference = ["/reference/python", "/reference/classes"]

_entry = re.compile(r"^[-|*\s]*\[[^]]+\]\(([^)#:]+)\.md\)")


def addContents(app, docname, source):
	"""Adds to the first page a toctree for each heading, of the pages that are linked in the lines below it."""
	if docname != app.config.root_doc:
		return
	trees, caption, pages = [], "", []
	for line in source[0].splitlines() + ["## "]:
		if line.startswith("## "):
			if pages:
				trees.append(toctree(caption, pages))
			caption, pages = line[3:], []
		elif entry := _entry.match(line):
			pages.append(entry.group(1))
	trees.append(toctree("Reference", reference))
	source[0] += "\n" + "\n".join(trees)


def toctree(caption, pages):
	"""A toctree in MyST's Markdown."""
	return "\n".join(["```{toctree}", ":hidden:", ":maxdepth: 2", f":caption: {caption}", "", *pages, "```", ""])


def setup(app):
	app.connect("source-read", addContents)
	return {"parallel_read_safe": True}
