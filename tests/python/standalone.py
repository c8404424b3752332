# SPDX-License-Identifier: GPL-2.0-or-later
# Loads modules of the Python package by themselves. Importing the package would load the plugin into YADE; the modules tested here
# need neither, and run in plain python3:  python3 -m unittest discover -s tests/python
"""Access to single modules of yade_brick without YADE."""

import importlib
import pathlib
import sys
import types

# A package of the same modules that runs nothing when it is imported: in it they find each other.
_package = types.ModuleType("standalone_yade_brick")
_package.__path__ = [str(pathlib.Path(__file__).resolve().parents[2] / "py" / "yade_brick")]
sys.modules[_package.__name__] = _package


def load(name):
	"""The module `name` of the package, with those that it imports from there."""
	return importlib.import_module(f"{_package.__name__}.{name}")
