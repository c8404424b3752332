# SPDX-License-Identifier: GPL-2.0-or-later
# Sphinx's settings for the HTML pages that scripts/docs.sh makes: the Markdown of README.md, doc/ and benchmarks/, and a reference from the docstrings of the
# Python package and of our classes in YADE. doc/sphinx/build.py runs Sphinx with them, inside YADE.
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "sphinx"))

project = "yade-brick"
copyright = "GPL-2.0-or-later"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "names", "contents"]

root_doc = "doc/README"
# the pages, whatever else lies in the folders beside them
include_patterns = ["README.md", "doc/**.md", "benchmarks/README.md", "reference/**.rst"]

# a link to a heading is checked as one to a page is
myst_heading_anchors = 3

default_role = "name"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
# one name each, as the documentation has it
add_module_names = False
nitpicky = True
# of YADE, NumPy and the like, which are documented elsewhere
nitpick_ignore_regex = [("py:.*", r"(?!yade_brick\b).*")]

# YADE's own classes: what `:yref:` names and is not ours
yadeReference = "https://yade-dem.org/doc/yade.wrapper.html#yade.wrapper."

html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3}
html_show_copyright = False
html_copy_source = False
html_title = project
html_static_path = ["sphinx/static"]
html_css_files = ["pages.css"]
# (---) is a corner of a brick
smartquotes = False
# the only thing from elsewhere: the pages can be read without a network, with formulas as they are written
mathjax_path = "https://cdn.jsdelivr.net/npm/mathjax@3/es5/tex-mml-chtml.js"
