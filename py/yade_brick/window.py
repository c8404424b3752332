# SPDX-License-Identifier: GPL-2.0-or-later
# YADE's 3-D window from a script: opened with a camera that is told, not found by hand, and saved at once and without loss. YADE's own saveSnapshot notes the
# file's name for the next painting, which a script that goes on computing never lets happen, and then writes JPEG whatever the name.
"""YADE's 3-D view: opening it, pointing its camera, saving what it shows."""

import math
import os
import time

from .checks import isFinite

#: Directions in which the camera looks, and what is up in the picture.
directions = {"elevation": ((0, 1, 0), (0, 0, 1)), "side": ((-1, 0, 0), (0, 0, 1)), "plan": ((0, 0, -1), (0, 1, 0)), "3d": ((-0.45, 0.82, -0.35), (0, 0, 1))}


def openView(look="3d", around=None, size=(960, 640), background=(1, 1, 1)):
	"""Opens YADE's 3-D view, or takes the one that is open, and points its camera. Run YADE without -n; without a screen: ``xvfb-run -a build/yade script.py``.

	Axes, scale and time, which YADE writes over the picture, are switched off; ``view.axes = True``, ``view.timeDisp = 'v'`` bring them back.

	:param look: 'elevation' (along y, x to the right, z up), 'side' (y to the right), 'plan' (from above), '3d', or (direction of looking, direction that is up)
	:param around: ((x, y, z), (x, y, z)), lower and upper corner of the box that fills the view [m]; by default around all bricks
	:param size: (width, height) of the view [pixels], at least 16 each
	:param background: colour, red, green and blue from 0 to 1
	:returns: the view, as ``yade.qt.View()``; ``yade.qt.Renderer()`` has the other settings, such as intrGeom
	:raises ValueError: for another `look`, a box without extent, a size or colour that cannot be, and when there is no brick and no box
	:raises RuntimeError: without a window, that is in ``yade -n`` or where no screen is
	"""
	direction, up = _checkedLook(look)
	lower, upper = _checkedBox(around) if around is not None else _boxOfBricks()
	if len(tuple(size)) != 2 or not all(isinstance(pixels, int) and 16 <= pixels <= 8192 for pixels in size):
		raise ValueError(f"size is {size!r}; allowed are two whole numbers of pixels, 16 to 8192")
	if len(tuple(background)) != 3 or not all(isFinite(part) and 0 <= part <= 1 for part in background):
		raise ValueError(f"background is {background!r}; allowed are three numbers from 0 to 1")
	qt = _qt()
	views = qt.views()
	view = views[0] if views else qt.View()
	qt.Renderer().bgColor = background
	view.screenSize = size
	processEvents()  # the size first: what fits into the view depends on its shape
	view.axes, view.scale, view.timeDisp, view.orthographic = False, False, "", False
	view.sceneRadius = math.dist(lower, upper) / 2
	view.viewDir, view.upVector = direction, up
	view.fitAABB(lower, upper)
	qt.Renderer().lightPos = _lightOf(lower, upper, view)
	return view


def saveView(path):
	"""Paints the open view anew and saves it.

	:param path: PNG file; its folder must exist
	:returns: the path
	:raises ValueError: for a folder that does not exist
	:raises RuntimeError: when no view is open
	:raises OSError: when the file cannot be written
	"""
	if not os.path.isdir(os.path.dirname(os.path.abspath(path))):
		raise ValueError(f"path is {path!r}; its folder does not exist")
	_qt()
	processEvents()  # what has been asked of the window, such as another size
	image = _viewWidget().grabFramebuffer()
	if image.isNull() or not image.save(path, "PNG"):
		raise OSError(f"the view could not be written to {path!r}")
	return path


def processEvents(seconds=0.02):
	"""Lets the window work: a script that computes in the foreground calls it now and then, or the window stands still.

	:param seconds: real time given to it [s]
	"""
	from PyQt5.QtWidgets import QApplication
	until = time.monotonic() + seconds
	while True:
		QApplication.processEvents()
		if time.monotonic() >= until:
			return
		time.sleep(0.002)


def _qt():
	try:
		from yade import qt
	except ImportError as problem:
		raise RuntimeError(f"YADE has no window here ({problem}); run it without -n, and without a screen under xvfb-run -a") from None
	from PyQt5.QtWidgets import QApplication
	if QApplication.instance() is None:
		raise RuntimeError("YADE has no window here; run it without -n, and without a screen under xvfb-run -a")
	return qt


def _viewWidget():
	"""Qt's object of the open view."""
	from PyQt5.QtWidgets import QApplication, QOpenGLWidget
	for widget in QApplication.topLevelWidgets():
		if isinstance(widget, QOpenGLWidget) and widget.isVisible():
			return widget
	raise RuntimeError("no 3-D view is open; call openView first")


def _checkedVector(values, name):
	try:
		vector = tuple(float(value) for value in values)
	except (TypeError, ValueError):
		vector = ()
	if len(vector) != 3 or not all(isFinite(value) for value in vector):
		raise ValueError(f"{name} is {values!r}; allowed are three finite numbers")
	return vector


def _checkedLook(look):
	if isinstance(look, str):
		if look not in directions:
			raise ValueError(f"look is {look!r}; allowed are {', '.join(map(repr, directions))} or (direction, up)")
		look = directions[look]
	if len(tuple(look)) != 2:
		raise ValueError(f"look is {look!r}; allowed are {', '.join(map(repr, directions))} or (direction, up)")
	direction, up = (_checkedVector(vector, "a direction of look") for vector in look)
	across = math.hypot(*(direction[i - 2] * up[i - 1] - direction[i - 1] * up[i - 2] for i in range(3)))
	if across <= 1e-6 * math.hypot(*direction) * math.hypot(*up):
		raise ValueError(f"look is {look!r}; the direction and what is up must not be parallel, or zero")
	return direction, up


def _checkedBox(around):
	if len(tuple(around)) != 2:
		raise ValueError(f"around is {around!r}; allowed are the lower and the upper corner of a box [m]")
	lower, upper = (_checkedVector(corner, "a corner of around") for corner in around)
	if not all(low < high for low, high in zip(lower, upper)):
		raise ValueError(f"around is {around!r}; each coordinate of the lower corner must be below that of the upper")
	return lower, upper


def _boxOfBricks():
	from yade import Brick, O
	corners = [corner for b in O.bodies if isinstance(b.shape, Brick) for corner in b.shape.worldCorners(b.state)]
	if not corners:
		raise ValueError("around is not given, and there is no brick to point the camera at")
	ends = [[pick(corner[k] for corner in corners) for k in range(3)] for pick in (min, max)]
	margin = 0.03 * math.dist(*ends)
	return tuple(low - margin for low in ends[0]), tuple(high + margin for high in ends[1])


def _lightOf(lower, upper, view):
	"""From behind the camera, to its left and from above, far enough that faces which are parallel are equally bright."""
	from yade import Vector3
	size, middle = math.dist(lower, upper), 0.5 * (Vector3(*lower) + Vector3(*upper))
	back, up = -view.viewDir, view.upVector
	return middle + 20 * size * (back + 0.5 * up + 0.3 * back.cross(up))
