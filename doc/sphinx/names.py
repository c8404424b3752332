# SPDX-License-Identifier: GPL-2.0-or-later
# Names in the text become links to the reference: YADE's roles (`:yref:` and those at the end of attributes), and every `code` on a page that is the name of
# something documented. So pages can be written in plain Markdown, to be read on a code host as well.
"""Sphinx extension: links from names; magnitudes in docstrings."""

import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.docutils import SphinxRole
from sphinx.util.nodes import make_refnode

_targetAndText = re.compile(r"^(.*)<(.+)>$", re.S)
_call = re.compile(r"^([\w.]+)(\(.*\))?$", re.S)


class YadeReference(SphinxRole):
	"""`:yref:`Class`` or `:yref:`text<Class.attribute>``: a link to our reference, or to YADE's for a class of its own."""

	def run(self):
		found = _targetAndText.match(self.text)
		text, target = found.groups() if found else (self.text, self.text)
		node = nodes.literal(text, text)
		node["reference"] = target
		return [node], []


class Name(SphinxRole):
	"""`text` in single quotes: code, and a link when it is a name of the reference."""

	def run(self):
		return [nodes.literal(self.text, self.text)], []


class Links(SphinxPostTransform):
	"""Makes links of literals that name something of the reference."""

	default_priority = 5

	def run(self):
		names = _names(self.app)
		for literal in list(self.document.findall(nodes.literal)):
			if _hasLink(literal):
				continue
			wanted = literal.get("reference")
			target = wanted or _nameIn(literal.astext())
			if target in names:
				document, anchor = names[target]
				if document != self.env.docname or wanted:
					literal.replace_self(make_refnode(self.app.builder, self.env.docname, document, anchor, literal.deepcopy()))
			elif wanted:
				literal.replace_self(nodes.reference("", "", literal.deepcopy(), refuri=self.env.config.yadeReference + wanted, internal=False))


def _hasLink(node):
	while node is not None:
		if isinstance(node, (nodes.reference, nodes.title)):
			return True
		node = node.parent
	return False


def _nameIn(text):
	"""'Brick.share' of `Brick.share`, 'engines' of `yade_brick.engines(contact=False)`, nothing of what is no name."""
	found = _call.match(text)
	return found.group(1) if found else None


def _names(app):
	"""(page, anchor) of each name as it is written in texts: Brick, Brick.share, yade_brick.engines, engines, report.judgedRow, ..."""
	if not hasattr(app, "referenceNames"):
		app.referenceNames = names = {}
		objects = app.env.get_domain("py").objects
		exported = app.config.exportedNames
		for full, entry in objects.items():
			names.setdefault(full, (entry.docname, entry.node_id))
			module, _, name = full.rpartition(".")
			if module.startswith("yade_brick.") and entry.objtype in ("function", "class", "exception"):
				names.setdefault(f"{module.rpartition('.')[2]}.{name}", (entry.docname, entry.node_id))
				if name in exported:
					names.setdefault(f"yade_brick.{name}", (entry.docname, entry.node_id))
					names.setdefault(name, (entry.docname, entry.node_id))
		for full, entry in objects.items():
			parts = full.split(".")
			if parts[0] == "yade_brick" and len(parts) == 4 and parts[2] in exported:
				names.setdefault(".".join(parts[2:]), (entry.docname, entry.node_id))
	return app.referenceNames


def escapeMarks(app, what, name, thing, options, lines):
	"""In docstrings |x| is a magnitude and a lone * itself, where reST has a substitution and emphasis."""
	for place, line in enumerate(lines):
		if not line.lstrip().startswith((">>>", "|")):
			parts = line.split("``")
			lines[place] = "``".join(part if inside % 2 else _escaped(part) for inside, part in enumerate(parts))


def _escaped(text):
	return re.sub(r"(?<![*\w\\])\*(?![*\w])", r"\\*", text.replace("|", r"\|"))


def setup(app):
	app.add_config_value("yadeReference", "", "env")
	app.add_config_value("exportedNames", [], "env")
	app.add_role("yref", YadeReference())
	app.add_role("name", Name())
	app.add_post_transform(Links)
	app.connect("autodoc-process-docstring", escapeMarks)
	return {"parallel_read_safe": True}
