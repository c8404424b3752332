# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the documentation as HTML, inside YADE, whose classes and our Python package it asks for their docstrings.

    build/yade -n -x -j1 doc/sphinx/build.py [--out DIR] [options of sphinx-build]     scripts/docs.sh does this

Sphinx reads from a folder of links to the repository with the pages of the reference beside them, so that nothing is written into the repository and
links between pages are what they are on a code host. Warnings are errors.
"""

import argparse
import os
import shutil
import sys

here = os.path.dirname(os.path.abspath(sys.argv[0]))  # YADE gives scripts no __file__ of their own
sys.path.insert(0, here)

try:
	from sphinx.cmd.build import main as sphinxBuild
	import myst_parser, sphinx_rtd_theme
except ImportError as problem:
	print(f"{problem}: scripts/docs.sh installs what is missing")
	sys.exit(77)  # which tells ctest that nothing was tested

import pythonModules
import yadeClasses
import yade_brick

repository = os.path.dirname(os.path.dirname(here))

#: Works that docstrings cite.
literature = {
        "Furukawa2014":
                "A. Furukawa, K. Horikawa, J. Kiyono, K. Toki: Seismic behavior analysis of masonry structures using the distinct element method "
                "considering element deformability. Journal of Natural Disaster Science 35(2), 2014, 43-53.",
        "Guyan1965":
                "R. J. Guyan: Reduction of stiffness and mass matrices. AIAA Journal 3(2), 1965, 380."
}

classesText = """Names that a script has as it has YADE's own; ``help(Brick)`` shows the same. Units are SI, [-] is a number without unit.
Attributes that are not read only can be given when an object is made, ``Brick(segments=2)``, and later."""

pythonText = """Units are SI, [-] is a number without unit. After ``import yade_brick`` these have short names, ``yade_brick.engines`` and the like:

"""


def main():
	parser = argparse.ArgumentParser(prog="build.py", description=__doc__.splitlines()[0])
	parser.add_argument("--out", metavar="DIR", default=os.path.join(repository, "build", "doc"), help="folder for the HTML (default: build/doc)")
	chosen, more = parser.parse_known_args()
	out = os.path.abspath(chosen.out)
	source = os.path.join(out, ".source")
	layOut(source)
	status = sphinxBuild(["-b", "html", "-a", "-W", "--keep-going", "-q", "-j1", "-c", os.path.join(repository, "doc"), "-d", os.path.join(out, ".doctrees"),
	                      "-D", "exportedNames=" + ",".join(pythonModules.functionsAndClasses(yade_brick)), *more, source, out])
	writeEntrance(out)
	if status == 0:
		print("The documentation is in " + os.path.join(out, "index.html"))
	sys.exit(status)


def layOut(folder):
	"""The folder that Sphinx reads: links to all that the repository has, and the reference."""
	shutil.rmtree(folder, ignore_errors=True)
	os.makedirs(os.path.join(folder, "reference"))
	for name in os.listdir(repository):
		if not name.startswith(".") and name != "build":
			os.symlink(os.path.join(repository, name), os.path.join(folder, name))
	for name, text in referencePages().items():
		with open(os.path.join(folder, "reference", name + ".rst"), "w") as file:
			file.write(text)


def referencePages():
	"""{name of a page: its text}."""
	classes, modules = sorted(yade_brick._core.classes), pythonModules.modulesOf(yade_brick)
	pages = {name: yadeClasses.page(getattr(yade_brick, name)) for name in classes}
	pages.update({"yade_brick." + name: pythonModules.page(yade_brick, name) for name in modules})
	cited = "\n".join(f".. [{key}] {text}" for key, text in literature.items())
	pages["classes"] = listing("Classes in YADE", classesText, classes, cited)
	pages["python"] = listing("Python package", pythonText + pythonModules.overview(yade_brick) + "\n\nAll modules:", ["yade_brick." + name for name in modules])
	return pages


def listing(title, text, pages, after=""):
	"""A page with links to others."""
	entries = "\n".join("   " + page for page in pages)
	return f"{title}\n{'=' * len(title)}\n\n{text}\n\n.. toctree::\n   :maxdepth: 1\n\n{entries}\n\n{after}\n"


def writeEntrance(folder):
	"""index.html, which leads to the first page: that has the place of the Markdown that it is made from."""
	with open(os.path.join(folder, "index.html"), "w") as file:
		file.write('<!DOCTYPE html>\n<meta charset="utf-8"><title>yade-brick</title>\n<meta http-equiv="refresh" content="0; url=doc/README.html">\n')


main()
