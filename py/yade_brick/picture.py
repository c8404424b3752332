# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures without a display: a set of bricks as seen from a direction, a series of such pictures, and displacement histories.
# Only arrays come in (snapshot reads them from a scene), and matplotlib's Agg canvas is used directly, never pyplot, so that neither
# a window system nor the backend of the calling script matters.
"""Pictures of bricks and plots of histories, saved as PNG."""

import heapq
import math
import numbers
from typing import NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon, Rectangle

from .build import edgeNodes
from .checks import isFinite


class Patch(NamedTuple):
	"""A brick to draw.

	:param corners: (8, 3) [m], in the node order of Brick.corners
	:param color: None (a brick tone), a matplotlib colour, or a number that is shown by a colour scale
	:param support: True for a foundation: drawn in grey, and not counted when the picture's limits are chosen
	"""

	corners: np.ndarray
	color: object = None
	support: bool = False


class Marks(NamedTuple):
	"""Points of joints to mark by their state.

	:param points: (k, 3) [m]
	:param states: (k,), 0 intact (not drawn), 1 failed in tension, 2 in shear, 3 in compression, 4 failed in a way that was not seen
	"""

	points: np.ndarray
	states: np.ndarray


#: Directions from the scene towards the viewer: azimuth from x towards y and height above the horizon [degrees].
views = {"elevation": (-90, 0), "side": (0, 0), "plan": (-90, 90), "3d": (-62, 22)}

#: Nodes of each face of a brick, counter-clockwise from outside: the kernel's table.
faceNodes = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))

#: Bricks whose outlines overlap by less than this share of the picture, which is less than a line is wide, are taken to touch.
lineShare = 1e-3

#: Colour and name of each way to fail; told apart on brick and in grey, and by the colour-blind.
failureModes = {1: ("#12b5e5", "failed in tension"), 2: ("#ffd23f", "failed in shear"), 3: ("#6a0dad", "failed in compression"), 4: ("#1a1a1a", "failed")}

_brickTones = ("#b5785f", "#bd8166", "#ad7058", "#b97b5c", "#b27a67")
_supportColor, _edgeColor, _groundColor, _groundEdge = "#a3a19b", "#4b332a", "#d9d5cb", "#b8b3a6"
_fontSize = 11
_markSize = 4.5  # [points] in a picture 8 inches wide


def wallPicture(
        path, bricks, marks=None, view="elevation", title=None, time=None, ground=0.0, limits=None, colorLabel=None, colorRange=None, width=8.0, dpi=150,
        legend=()
):
	"""Saves a picture of bricks, seen from far away without perspective; what is in front hides what is behind.

	:param path: PNG file
	:param bricks: list of Patch, or of (corners, color)
	:param marks: Marks; drawn over the bricks, also where a brick is in front
	:param view: 'elevation' (x to the right, z up), 'side' (y, z), 'plan' (x, y), '3d', or (azimuth, height) in degrees
	:param title: text above; a motion made by us has to be called synthetic there too
	:param time: simulated time [s], added to the title
	:param ground: height of the ground [m], None for none; in an oblique view it is drawn only where no brick is a support
	:param limits: (left, right, bottom, top) [m] in the picture's plane; by default around the bricks
	:param colorLabel: what the numbers are that colour the bricks, with unit
	:param colorRange: (lowest, highest) of the colour scale; by default those of the bricks
	:param width: [inches]; the height follows
	:param dpi: pixels per inch
	:param legend: states of marks to explain below also where there are none, so that pictures of a series are laid out alike
	:raises ValueError: for no brick, corners of another shape or not finite, an unknown view, empty limits, states without points
	"""
	pictureSeries(path, [(time, bricks, marks)], view, title, ground, limits, colorLabel, colorRange, 1, width, dpi, legend=legend)


def pictureSeries(
        path, frames, view="elevation", title=None, ground=0.0, limits=None, colorLabel=None, colorRange=None, columns=3, width=12.0, dpi=120, rowLabels=(),
        legend=()
):
	"""Saves several pictures side by side, in the same scale and limits.

	:param frames: list of (time [s] or None, bricks, marks or None), as in wallPicture
	:param columns: pictures in a row, >= 1
	:param rowLabels: texts before the titles of the first pictures of the rows, such as the names of two models
	:param width: of the whole [inches]; the others as in wallPicture
	"""
	frames = [(_checkedNumber(time, "time", None), _checkedPatches(bricks), _checkedMarks(marks)) for time, bricks, marks in _sequence(frames, "frames")]
	_needBricks(frames)
	if not isinstance(columns, numbers.Integral) or columns < 1:
		raise ValueError(f"columns is {columns!r}; allowed is a whole number, at least 1")
	_checkSize(width, dpi)
	ground = _checkedNumber(ground, "ground", None)
	right, up, toward = _viewAxes(view)
	plane = np.column_stack([right, up])
	limits = _checkedLimits(limits) if limits is not None else _limitsAround([brick for _, bricks, _ in frames for brick in bricks], plane, ground, up)
	scale = _colorScale([brick.color for _, bricks, _ in frames for brick in bricks], colorRange)
	figure, axes = _panels(len(frames), columns, width, limits, dpi)
	labels = dict(zip(range(0, len(frames), columns), rowLabels))
	for index, (ax, (time, bricks, marks)) in enumerate(zip(axes, frames)):
		_drawGround(ax, ground, limits, bricks, plane)
		_drawBricks(ax, bricks, plane, toward, scale)
		_drawMarks(ax, marks, plane, _markSize * min(1.0, math.sqrt(width / min(columns, len(frames)) / 8)))
		_dressAxes(ax, limits, right, up, toward)
		texts = [title if len(frames) == 1 else None, labels.get(index), f"t = {time:.2f} s" if time is not None else None]
		ax.set_title(",  ".join(text for text in texts if text), fontsize=_fontSize + 1)
	if title and len(frames) > 1:
		figure.suptitle(title, fontsize=_fontSize + 3)
	_addLegends(figure, axes, {*legend, *(state for _, _, marks in frames for state in marks.states.tolist())}, scale, colorLabel)
	figure.savefig(path, format="png")


def sharedLimits(frames, view="elevation", ground=0.0):
	"""Limits that hold all bricks of all frames, for pictures of a series: (left, right, bottom, top) in the picture's plane [m].

	:param frames, view, ground: as in pictureSeries
	"""
	frames = [(None, _checkedPatches(bricks), None) for _, bricks, _ in _sequence(frames, "frames")]
	_needBricks(frames)
	right, up, _ = _viewAxes(view)
	return _limitsAround([brick for _, bricks, _ in frames for brick in bricks], np.column_stack([right, up]), _checkedNumber(ground, "ground", None), up)


# What is given


def _needBricks(frames):
	if not frames or not all(bricks for _, bricks, _ in frames):
		raise ValueError("there is nothing to draw; at least one frame with at least one brick is needed")


def _checkedNumber(value, name, default):
	if value is None:
		return default
	if not isFinite(value):
		raise ValueError(f"{name} is {value!r}; allowed is a finite number, or None")
	return value


def _sequence(values, name):
	"""The values as a list; ValueError for what is none."""
	try:
		return list(values)
	except TypeError:
		raise ValueError(f"{name} is {values!r}; allowed is a list") from None


def _array(values, allowed):
	"""Nested sequences of numbers, YADE's vectors too, as an array; ValueError that says what is allowed."""
	try:
		return np.array([tuple(row) for row in values], dtype=float)
	except (TypeError, ValueError, OverflowError):
		raise ValueError(f"{values!r} given; allowed are {allowed}") from None


def _checkedPatches(bricks):
	return [_checkedPatch(brick, index) for index, brick in enumerate(_sequence(bricks, "bricks"))]


def _checkedPatch(brick, index):
	parts = _sequence(brick, f"brick {index}")
	if not 1 <= len(parts) <= 3:
		raise ValueError(f"brick {index} is {brick!r}; allowed is a Patch, or (corners, color)")
	corners = _array(parts[0], f"8 points of 3 finite coordinates [m] as the corners of brick {index}")
	if corners.shape != (8, 3) or not np.isfinite(corners).all():
		raise ValueError(f"corners of brick {index} are {corners.tolist()}; allowed are 8 points of 3 finite coordinates [m]")
	return Patch(*parts)._replace(corners=corners)


def _checkedMarks(marks):
	if marks is None:
		return Marks(np.empty((0, 3)), np.empty(0, dtype=int))
	parts = _sequence(marks, "marks")
	if len(parts) != 2:
		raise ValueError(f"marks is {marks!r}; allowed are Marks, that is points and states")
	points = _array(parts[0], "points of 3 coordinates as the first part of marks")
	if points.size and (points.ndim != 2 or points.shape[1] != 3):
		raise ValueError(f"points of marks have the shape {points.shape}; allowed is (k, 3)")
	points = points.reshape(-1, 3)
	states = _array([_sequence(parts[1], "states of marks")], "whole numbers as the second part of marks")[0]
	if states.shape != (len(points),):
		raise ValueError(f"marks have {len(points)} points and states of the shape {states.shape}; allowed is one state a point")
	if not np.isin(states, (0, *failureModes)).all():
		raise ValueError(f"states of marks are {states.tolist()}; allowed are 0 to {max(failureModes)}")
	return Marks(points, states.astype(int))


def _viewAxes(view):
	"""Unit vectors to the picture's right, up, and toward the viewer."""
	if isinstance(view, str):
		if view not in views:
			raise ValueError(f"view is {view!r}; allowed are {', '.join(map(repr, views))} or (azimuth, height) in degrees")
		view = views[view]
	angles = _sequence(view, "view")
	if len(angles) != 2 or not all(isFinite(angle) for angle in angles):
		raise ValueError(f"view is {view!r}; allowed are {', '.join(map(repr, views))} or (azimuth, height) in degrees")
	azimuth, height = (math.radians(angle) for angle in angles)
	toward = np.array([math.cos(height) * math.cos(azimuth), math.cos(height) * math.sin(azimuth), math.sin(height)])
	right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
	return right, np.cross(toward, right), toward


def _checkedLimits(limits):
	values = _sequence(limits, "limits")
	if len(values) != 4 or not all(isFinite(value) for value in values) or not (values[0] < values[1] and values[2] < values[3]):
		raise ValueError(f"limits is {limits!r}; allowed is (left, right, bottom, top), finite, with left < right and bottom < top")
	return tuple(values)


def _limitsAround(bricks, plane, ground, up):
	"""Limits around the bricks that are no supports (or all), with a margin and, in a view from the side, some ground."""
	counted = [brick for brick in bricks if not brick.support] or bricks
	points = np.vstack([brick.corners for brick in counted]) @ plane
	low, high = points.min(axis=0), points.max(axis=0)
	margin = 0.08 * (high - low).max()
	bottom = low[1] if ground is None else min(low[1], ground * up[2])
	# An oblique view has its scale and its axes in a strip below.
	strip = margin if _seenLevel(plane) else 2.2 * margin
	return low[0] - margin, high[0] + margin, bottom - strip, high[1] + margin


# Drawing order


def _faceNormals(corners):
	"""Outward normals of all faces, (n, 6, 3), from the faces' diagonals."""
	face = corners[:, faceNodes]
	normals = np.cross(face[:, :, 2] - face[:, :, 0], face[:, :, 3] - face[:, :, 1])
	return normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-300)


def paintOrder(corners, plane, toward):
	"""Order in which convex bricks have to be painted so that none is painted over one in front of it.

	Two convex bricks that do not interpenetrate are separated by (nearly always) a face plane of one of them; the one on the viewer's
	side of it is in front. Pairs that do not overlap in the picture do not matter. Where that leaves a cycle, the farthest goes first.

	:param corners: (n, 8, 3) [m]
	:param plane: (3, 2), the picture's axes
	:param toward: (3,), the direction towards the viewer
	:returns: list of n indices, farthest first
	"""
	one, other = _overlappingInPicture(corners @ plane)
	normals, centres = _faceNormals(corners), corners[:, faceNodes].mean(axis=2)

	def separation(these, those):
		"""How far all of those are beyond a face of these, the face that separates best, and how much it faces the viewer."""
		heights = np.einsum("pfk,pfk->pf", normals[these], centres[these])
		beyond = np.min([np.einsum("pfk,pk->pf", normals[these], corners[those, node]) for node in range(8)], axis=0) - heights
		best = (np.arange(len(these)), beyond.argmax(axis=1))
		return beyond[best], (normals[these] @ toward)[best]

	gap, facing = separation(one, other)
	gapBack, facingBack = separation(other, one)
	# the other is in front of the one, by the better of the two separations; edge-on planes decide nothing
	toFront = np.where(gap >= gapBack, facing, -facingBack)
	front = np.zeros((len(corners), len(corners)), dtype=bool)  # [i, j]: j is in front of i
	front[one[toFront > 1e-6], other[toFront > 1e-6]] = True
	front[other[toFront < -1e-6], one[toFront < -1e-6]] = True
	return _topologicalOrder(front, corners.mean(axis=1) @ toward)


def _overlappingInPicture(flat):
	"""Pairs of bricks whose outlines overlap in the picture, as two arrays of indices. Outlines that only touch do not: an order between such bricks is none
	that is seen, and too many of them make cycles.

	:param flat: corners in the picture (n, 8, 2)
	"""
	low, high = flat.min(axis=1), flat.max(axis=1)
	margin = lineShare * (high.max(axis=0) - low.min(axis=0)).max()
	one, other = np.nonzero(np.triu(((low[:, None] < high[None] - margin) & (low[None] < high[:, None] - margin)).all(axis=2), 1))
	apart = np.zeros(len(one), dtype=bool)
	for these in (one, other):
		for begin, end in edgeNodes:
			# two convex outlines that are apart are so across an edge of one of them, which is an edge of its brick
			edge = flat[these, end] - flat[these, begin]
			length = np.linalg.norm(edge, axis=1)
			across = np.column_stack([-edge[:, 1], edge[:, 0]]) / np.where(length > margin, length, np.nan)[:, None]
			first, second = (np.einsum("pnk,pk->pn", flat[indices], across) for indices in (one, other))
			apart |= (first.max(axis=1) < second.min(axis=1) + margin) | (second.max(axis=1) < first.min(axis=1) + margin)
	return one[~apart], other[~apart]


def _topologicalOrder(front, depth):
	waiting = front.sum(axis=0)
	ready = [(depth[i], i) for i in np.flatnonzero(waiting == 0)]
	heapq.heapify(ready)
	left, order = set(range(len(depth))), []
	while left:
		index = int(heapq.heappop(ready)[1]) if ready else min(left, key=lambda i: depth[i])
		if index not in left:
			continue
		left.remove(index)
		order.append(index)
		waiting[front[index]] -= 1
		for other in np.flatnonzero(front[index] & (waiting == 0)):
			heapq.heappush(ready, (depth[other], other))
	return order


# Drawing


def _drawBricks(ax, bricks, plane, toward, scale):
	corners = np.array([brick.corners for brick in bricks])
	normals = _faceNormals(corners)
	right, up = plane.T
	light = toward + 0.6 * up - 0.35 * right
	light /= np.linalg.norm(light)
	polygons, colors = [], []
	for index in paintOrder(corners, plane, toward):
		base = _brickColor(bricks[index], index, scale)
		for face, normal in zip(faceNodes, normals[index]):
			if normal @ toward > 1e-3:
				polygons.append(corners[index][list(face)] @ plane)
				# A face towards the viewer keeps its colour; others are lighter or darker with their tilt to the light.
				shade = 1 + 0.45 * (max(0.0, normal @ light) - toward @ light)
				colors.append(np.clip(np.array(base) * shade, 0, 1))
	ax.add_collection(PolyCollection(polygons, facecolors=colors, edgecolors=_edgeColor, linewidths=0.8, joinstyle="round", zorder=2))


def _brickColor(brick, index, scale):
	if isinstance(brick.color, (int, float, np.number)) and not isinstance(brick.color, bool):
		return scale.to_rgba(brick.color)[:3]
	if brick.color is not None:
		return to_rgb(brick.color)
	return to_rgb(_supportColor if brick.support else _brickTones[(31 * index * index + 17 * index) % 23 % len(_brickTones)])


def _colorScale(colors, colorRange):
	"""The colour scale of the bricks that are coloured by a number, or None."""
	values = [float(color) for color in colors if isinstance(color, (int, float, np.number)) and not isinstance(color, bool)]
	if not values:
		return None
	ends = (min(values), max(values)) if colorRange is None else _sequence(colorRange, "colorRange")
	if len(ends) != 2 or not all(isFinite(end) for end in ends):
		raise ValueError(f"colorRange is {colorRange!r}, the colours are {values}; allowed are a lowest and a highest finite number")
	low, high = ends
	return ScalarMappable(Normalize(low, high if high > low else low + 1), "YlOrBr")


def _drawMarks(ax, marks, plane, size):
	for state, (color, _) in failureModes.items():
		flat = marks.points[marks.states == state] @ plane
		ax.scatter(flat[:, 0], flat[:, 1], s=size ** 2, color=color, edgecolors="#2b2b2b", linewidths=0.4, zorder=3)


def _drawGround(ax, ground, limits, bricks, plane):
	if ground is None:
		return
	left, rightEnd, bottom, _ = limits
	if _seenLevel(plane):
		soil = {"facecolor": _groundColor, "edgecolor": _groundEdge, "hatch": "////", "linewidth": 0}
		ax.add_patch(Rectangle((left, bottom), rightEnd - left, ground - bottom, zorder=0, **soil))
		ax.axhline(ground, color="#5d5a52", linewidth=1.2, zorder=1)
		return
	if any(brick.support for brick in bricks):
		return
	# A piece of floor under bricks without a support: it shows in an oblique view which of them are in the air.
	points = np.vstack([brick.corners for brick in bricks])[:, :2]
	low, high = points.min(axis=0), points.max(axis=0)
	margin = 0.15 * (high - low).max()
	floor = [(x, y, ground) for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
	outward = margin * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
	ax.add_patch(Polygon((floor + outward) @ plane, closed=True, facecolor=_groundColor, edgecolor=_groundEdge, linewidth=0.8, zorder=0))


def _seenLevel(plane):
	"""Whether the view is level: the vertical is the picture's up, and the ground a line."""
	return abs(plane[2, 1]) > 1 - 1e-9


def _dressAxes(ax, limits, right, up, toward):
	ax.set_xlim(limits[0], limits[1])
	ax.set_ylim(limits[2], limits[3])
	ax.set_aspect("equal")
	ax.grid(False)  # which yade.plot switches on for all
	names = [_axisName(right), _axisName(up)]
	if all(names):
		ax.set_xlabel(f"{names[0]} [m]", fontsize=_fontSize)
		ax.set_ylabel(f"{names[1]} [m]", fontsize=_fontSize)
		ax.tick_params(labelsize=_fontSize - 1)
		for side in ("top", "right"):
			ax.spines[side].set_visible(False)
		return
	ax.set_xticks([])
	ax.set_yticks([])
	_scaleBar(ax, limits)
	_axisArrows(ax, limits, right, up, toward)


def _axisName(direction):
	"""The world axis that a picture axis is along, or None for an oblique view."""
	axis = int(np.argmax(np.abs(direction)))
	return "xyz"[axis] if direction[axis] > 1 - 1e-9 else None


def _scaleBar(ax, limits):
	span = limits[1] - limits[0]
	power = 10 ** math.floor(math.log10(0.3 * span))
	length = max(step * power for step in (1, 2, 5) if step * power <= 0.3 * span)
	x, y = limits[0] + 0.04 * span, limits[2] + 0.04 * span
	ax.plot([x, x + length], [y, y], color="black", linewidth=3, solid_capstyle="butt", zorder=4)
	ax.text(x + 0.5 * length, y + 0.015 * span, f"{length:g} m", ha="center", va="bottom", fontsize=_fontSize, zorder=4)


def _axisArrows(ax, limits, right, up, toward):
	size = 0.06 * (limits[1] - limits[0])
	origin = np.array([limits[1] - 2 * size, limits[2] + 0.7 * size])
	for axis, name in enumerate("xyz"):
		tip = size * np.array([right[axis], up[axis]])
		if np.linalg.norm(tip) > 0.1 * size:
			ax.annotate("", origin + tip, origin, arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0}, zorder=4)
			ax.text(*(origin + 1.25 * tip), name, ha="center", va="center", fontsize=_fontSize, zorder=4)


def _checkSize(width, dpi):
	for name, value, least in (("width", width, 0), ("dpi", dpi, 1)):
		if not (isFinite(value) and value > 0 and value >= least):
			raise ValueError(f"{name} is {value!r}; allowed is a finite number {'>= 1' if least else '> 0'}")
	if not 16 <= width * dpi <= 30000:
		raise ValueError(f"width is {width!r} and dpi {dpi!r}, which makes {width * dpi:g} pixels; allowed are 16 to 30000")


def _panels(count, columns, width, limits, dpi):
	"""A figure with `count` equal panels that fit the limits' proportions."""
	columns = min(columns, count)
	rows = -(-count // columns)
	aspect = (limits[3] - limits[2]) / (limits[1] - limits[0])
	panel = (width - 0.8 * columns) / columns
	figure = Figure(figsize=(width, rows * (min(2.5, max(0.25, aspect)) * panel + 0.9) + 0.6), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	grid = figure.subplots(rows, columns, squeeze=False).ravel()
	for ax in grid[count:]:
		ax.set_axis_off()
	return figure, list(grid[:count])


def _addLegends(figure, axes, states, scale, colorLabel):
	handles = [
	        Line2D([], [], linestyle="", marker="o", markersize=7, color=color, markeredgecolor="#2b2b2b", label=name)
	        for state, (color, name) in failureModes.items() if state in states
	]
	if handles:
		_legendBelow(figure, handles, [handle.get_label() for handle in handles])
	if scale is not None:
		bar = figure.colorbar(scale, ax=axes, shrink=0.8, pad=0.02)
		bar.set_label(colorLabel or "", fontsize=_fontSize)
		bar.ax.tick_params(labelsize=_fontSize - 1)


def _legendBelow(figure, handles, labels):
	"""A legend in a strip of its own below the panels."""
	strip = 0.4 / figure.get_figheight()
	figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
	figure.legend(handles, labels, loc="lower center", ncol=min(len(labels), 6), frameon=False, fontsize=_fontSize)


# Histories

_lineColors = ("#1f4e79", "#c0562f", "#3d7a4a", "#7b4b94", "#8a6d1f", "#555555")


#: A panel shows at least this share of the largest displacement, so that what stands still is drawn as a line and not as round-off.
flatShare = 1e-4

_largestDrawn = 1e100  # far below what matplotlib's axes overflow with [m]


def _widened(limits, span):
	"""The limits, or `span` around their middle if that is wider."""
	low, high = limits
	half = 0.5 * max(high - low, span)
	return 0.5 * (low + high) - half, 0.5 * (low + high) + half


def historyPlot(path, time, histories, title=None, timeRange=None, width=12.0, dpi=120, styles=None):
	"""Saves displacement histories of named bricks, one panel for each of x, y and z, in mm where all stay below 0.1 m.

	:param path: PNG file
	:param time: (n,) [s]
	:param histories: dict from name to displacements (n, 3) [m]
	:param title: text above
	:param timeRange: (begin, end) [s] to show; by default all
	:param width, dpi: of the picture [inches], and points an inch
	:param styles: dict from name to what its line shall look like, in matplotlib's words, such as {"A": {"linestyle": "--", "color": "black"}}
	:raises ValueError: for no history or one of another shape, and for the style of a history that is not there
	"""
	time = _array([_sequence(time, "time")], "numbers as time")[0]
	if not isinstance(histories, dict):
		raise ValueError(f"histories is {histories!r}; allowed is a dict from name to displacements")
	_checkSize(width, dpi)
	arrays = {name: _array(values, f"3 displacements a time as the history of {name!r}") for name, values in histories.items()}
	if not arrays:
		raise ValueError("histories is empty; at least one brick is needed")
	for name, values in arrays.items():
		if values.shape != (len(time), 3):
			raise ValueError(f"history of {name!r} has the shape {values.shape}; allowed is ({len(time)}, 3), as there are {len(time)} times")
	if timeRange is not None and (len(ends := _sequence(timeRange, "timeRange")) != 2 or not all(isFinite(end) for end in ends)):
		raise ValueError(f"timeRange is {timeRange!r}; allowed are two finite times")
	unknown = sorted(set(styles or ()) - set(arrays))
	if unknown:
		raise ValueError(f"styles has {', '.join(map(repr, unknown))}; allowed are the histories {', '.join(map(repr, arrays))}")
	shown = slice(None) if timeRange is None else (time >= timeRange[0]) & (time <= timeRange[1])
	largest = max(np.nanmax(np.abs(values[shown]), initial=0.0) for values in arrays.values())
	if not largest < _largestDrawn:
		raise ValueError(f"histories reach {largest:g} m; allowed are displacements below {_largestDrawn:g} m, and NaN where there is none")
	unit, factor = ("mm", 1e3) if largest < 0.1 else ("m", 1.0)
	figure = Figure(figsize=(width, 0.36 * width), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	for axis, ax in enumerate(figure.subplots(1, 3)):
		for (name, values), color in zip(arrays.items(), _lineColors * len(arrays)):
			ax.plot(time[shown], factor * values[shown, axis], label=name, **{"color": color, "linewidth": 1.4, **(styles or {}).get(name, {})})
		ax.set_ylim(_widened(ax.get_ylim(), flatShare * factor * largest))
		ax.set_title(f"{'xyz'[axis]} direction", fontsize=_fontSize + 1)
		ax.set_xlabel("time [s]", fontsize=_fontSize)
		ax.set_ylabel(f"displacement [{unit}]", fontsize=_fontSize)
		ax.grid(color="#dddddd", linewidth=0.7)
		ax.tick_params(labelsize=_fontSize - 1)
		ax.margins(x=0)
	_legendBelow(figure, *ax.get_legend_handles_labels())
	if title:
		figure.suptitle(title, fontsize=_fontSize + 3)
	figure.savefig(path, format="png")
