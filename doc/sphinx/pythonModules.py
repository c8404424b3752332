# SPDX-License-Identifier: GPL-2.0-or-later
# Pages in reST about the Python package: one for each of its modules, found by themselves, and a table of the names that `yade_brick` itself has.
"""The Python package as pages in reST."""

import pkgutil
import re


def modulesOf(package):
	"""Names of the modules of a package, in alphabetical order; private ones left out."""
	return sorted(module.name for module in pkgutil.iter_modules(package.__path__) if not module.name.startswith("_"))


def functionsAndClasses(package):
	"""{name: object} of the package's own public functions and Python classes, not of YADE's."""
	exported = {name: getattr(package, name) for name in package.__all__}
	return {name: thing for name, thing in exported.items() if (getattr(thing, "__module__", None) or "").startswith(package.__name__ + ".")}


def page(package, name):
	"""A page about one module."""
	title = f"yade_brick.{name}"
	return f"{title}\n{'=' * len(title)}\n\n.. automodule:: {title}\n"


def overview(package):
	"""A list of the functions and classes that the package itself has, with the first sentence of each."""
	lines = []
	for name, thing in sorted(functionsAndClasses(package).items(), key=lambda item: (isinstance(item[1], type), item[0].lower())):
		lines.append(f"- :py:obj:`{name} <{thing.__module__}.{thing.__qualname__}>`: {_summary(thing)}")
	return "\n".join(lines)


def _summary(thing):
	"""First sentence of a docstring, in one line."""
	paragraph = " ".join((thing.__doc__ or "").strip().split("\n\n")[0].split())
	return re.split(r"[.:] (?=[A-Z])", paragraph)[0].rstrip(".:")
