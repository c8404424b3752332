# SPDX-License-Identifier: GPL-2.0-or-later
# Loads one module of the Python package by itself. Importing the package would load the plugin into YADE; the modules
# tested here need neither, and run in plain python3:  python3 -m unittest discover -s tests/python
"""Access to single modules of yade_brick without YADE."""

import importlib.util
import pathlib
import sys

packageDir = pathlib.Path(__file__).resolve().parents[2] / "py" / "yade_brick"


def load(name):
	"""The module `name` of the package, as a top-level module of the same name."""
	spec = importlib.util.spec_from_file_location(f"standalone_{name}", packageDir / f"{name}.py")
	module = importlib.util.module_from_spec(spec)
	sys.modules[spec.name] = module
	spec.loader.exec_module(module)
	return module
