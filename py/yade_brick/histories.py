# SPDX-License-Identifier: GPL-2.0-or-later
# Histories of a run: what is measured, when asked, kept in yade.plot under short names and written as CSV with units; ready measures of walls (drift, base
# shear, cracks, energies), and a figure of them. Reading only: nothing here changes the simulation.
"""Histories of a run: `Histories`, and `wallHistories`, which sets up those of a wall in one call."""

import math
import os

import numpy as np

from . import rest
from .checks import isFinite
from .report import writeHistories
from .snapshot import numbers

axes = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class Histories:
	"""Columns that are measured at each call: now, as ``PyRunner(command='histories()', virtPeriod=.01)``, or as callback of `runWithProgress`.

	Each sample also goes to yade.plot, so that plot.plots and plot.saveDataTxt work: under `plotName` of its heading, 'base shear [N]' as baseShear, time
	as t. A second call at the same time replaces the sample.

	:param columns: dict from heading, a name with its unit in brackets such as 'top displacement [m]', to a function without arguments that returns a number
	:param plot: whether samples go to yade.plot too
	:param panels: which columns `figure` shows, by default one panel for each
	:raises ValueError: for a heading without unit, two that have one name in yade.plot, and for what cannot be called

	Columns may be added between samples by item, ``histories['crack width [m]'] = function``; samples before are NaN.
	"""

	def __init__(self, columns=None, plot=True, panels=None):
		self._measures, self._samples, self.plot, self.panels = {}, {timeHeading: []}, plot, panels
		if columns is not None and not isinstance(columns, dict):
			raise ValueError(f"columns is {columns!r}; allowed is a dict from headings to functions")
		for heading, measure in (columns or {}).items():
			self[heading] = measure

	def __setitem__(self, heading, measure):
		if not isinstance(heading, str) or not heading.endswith("]") or " [" not in heading or "," in heading:
			raise ValueError(f"heading {heading!r}; allowed is a name without comma and a unit in brackets, as in 'base shear [N]'")
		if not callable(measure):
			raise ValueError(f"column {heading!r} is {measure!r}; allowed is a function without arguments that returns a number")
		taken = next((other for other in self._samples if other != heading and plotName(other) == plotName(heading)), None)
		if taken or heading == timeHeading:
			name = plotName(heading)
			raise ValueError(f"heading {heading!r} has the name {name} in yade.plot, as {taken or timeHeading!r}; allowed are different ones")
		self._measures[heading] = measure
		self._samples[heading] = [math.nan] * len(self)

	def __getitem__(self, heading):
		"""The samples of a column as array; by its heading, or by its name without the unit."""
		found = [column for column in self._samples if heading in (column, column.rpartition(" [")[0])]
		if not found:
			raise KeyError(f"there is no column {heading!r}; there are {', '.join(map(repr, self._samples))}")
		return np.array(self._samples[found[0]])

	def __len__(self):
		return len(self._samples[timeHeading])

	@property
	def time(self):
		"""Times of the samples [s]."""
		return self[timeHeading]

	@property
	def columns(self):
		"""Dict from heading to samples as array, the time first."""
		return {heading: np.array(values) for heading, values in self._samples.items()}

	def __call__(self):
		"""Takes a sample of the scene as it is."""
		from yade import O
		row = {heading: _measured(heading, measure) for heading, measure in self._measures.items()}
		again = len(self) > 0 and self._samples[timeHeading][-1] == O.time
		for heading, value in {timeHeading: O.time, **row}.items():
			self._samples[heading][-1 if again else len(self._samples[heading]):] = [value]
		if self.plot:
			self._give(again)

	def _give(self, again):
		"""The last sample to yade.plot."""
		from yade import plot
		names = {heading: plotName(heading) for heading in self._samples}
		if again and len(plot.data.get("t", ())) and plot.data["t"][-1] == self._samples[timeHeading][-1]:
			for heading, name in names.items():
				plot.data[name][-1] = self._samples[heading][-1]
			return
		plot.addData({name: self._samples[heading][-1] for heading, name in names.items()})
		plot.labels.update((name, heading) for heading, name in names.items())

	def write(self, path):
		"""Writes all columns as CSV, see report.writeHistories."""
		writeHistories(path, self._samples)

	def readBack(self, path):
		"""Takes the samples of a CSV file that `write` has left, up to but without the present time: a run that was continued goes on with its histories.

		:raises ValueError: when there are samples already, or the file has other columns
		"""
		from yade import O
		if len(self):
			raise ValueError(f"there are {len(self)} samples already; read back before the first one")
		columns = readHistories(path)
		if list(columns) != list(self._samples):
			raise ValueError(f"{path} has the columns {', '.join(columns)}; allowed are {', '.join(self._samples)}")
		for row in range(int((columns[timeHeading] < O.time * (1 - 1e-8)).sum())):  # the file has nine digits
			for heading, values in columns.items():
				self._samples[heading].append(float(values[row]))
			if self.plot:
				self._give(False)

	def figure(self, path, panels=None, title=None, width=7.0, dpi=150):
		"""Saves a figure of panels over one time axis.

		:param path: PNG, PDF or SVG file
		:param panels: list of lists of headings (or names without unit) of one unit, a panel each; by default as the histories were made with
		:param title: text above; None: none
		:param width: [inches]
		:param dpi: pixels per inch of a PNG
		:raises ValueError: for no sample, or columns of several units in a panel
		:raises KeyError: for a column that is not there
		"""
		historyFigure(path, self.columns, self.panels if panels is None else panels, title, width, dpi)


timeHeading = "time [s]"


def plotName(heading):
	"""Name of a column in yade.plot.

	>>> plotName("base shear [N]"), plotName("time [s]"), plotName("failed in tension [-]")
	('baseShear', 't', 'failedInTension')
	"""
	if heading == timeHeading:
		return "t"
	first, *others = heading.rpartition(" [")[0].split()
	return first + "".join(word[:1].upper() + word[1:] for word in others)


def _measured(heading, measure):
	value = measure()
	try:
		return float(value)
	except (TypeError, ValueError):
		raise ValueError(f"the function of column {heading!r} has returned {value!r}; allowed is a number") from None


def readHistories(path):
	"""The columns of a CSV file of report.writeHistories: dict from heading to array."""
	with open(path) as file:
		headings = file.readline().rstrip("\n").split(",")
		rows = [[float(value) for value in line.split(",")] for line in file]
	return dict(zip(headings, np.array(rows).reshape(-1, len(headings)).T))


# Measures: functions that return a function without arguments


def direction(along):
	"""A direction as unit vector: 'x', 'y', 'z', or three numbers."""
	if isinstance(along, str) and along in axes:
		return np.array(axes[along])
	try:
		vector = np.array([float(value) for value in along]) if not isinstance(along, str) else np.empty(0)
	except (TypeError, ValueError):
		vector = np.empty(0)
	if vector.shape != (3,) or not np.isfinite(vector).all() or not vector.any():
		raise ValueError(f"direction is {along!r}; allowed are 'x', 'y', 'z' or three finite numbers that are not all zero")
	return vector / np.linalg.norm(vector)


def displacement(bodies, along="x", corner=None, ground=None):
	"""Measures the mean displacement of bodies from where they were laid (State.refPos) [m].

	:param bodies: a body, or a list of them
	:param along: direction
	:param corner: None for their centres, or 0 to 7 for that corner of bricks, deformation included
	:param ground: a body that moves with the ground, whose displacement is taken off; None where the ground stands still
	"""
	bodies, along = _bodies(bodies, "bodies"), direction(along)
	if corner is not None and corner not in range(8):
		raise ValueError(f"corner is {corner!r}; allowed are 0 to 7, or None for the centre")
	starts = [_laid(body, corner) @ along for body in bodies]
	restGround = _laid(ground) @ along if ground is not None else 0

	def measure():
		moved = np.mean([_present(body, corner) @ along - at for body, at in zip(bodies, starts)])
		return moved - (_present(ground) @ along - restGround if ground is not None else 0)

	return measure


def drift(upper, lower, along="x"):
	"""Measures the drift between two levels: by how much the upper has moved against the lower, by the height between them [-].

	:param upper, lower: a body each, or lists of them, of which the means count; of fixed bodies too
	"""
	upper, lower = _bodies(upper, "upper"), _bodies(lower, "lower")
	height = np.mean([_laid(body)[2] for body in upper]) - np.mean([_laid(body)[2] for body in lower])
	if not height > 0:
		raise ValueError(f"the upper level is {height:g} m above the lower one; allowed is a height > 0")
	above, below = displacement(upper, along), displacement(lower, along)
	return lambda: (above() - below()) / height


def baseShear(supports, along="x"):
	"""Measures the force of the structure on its supports along a direction, by joints and contacts of the last step [N].

	It is positive when the structure pushes its supports that way. With z'' the ground acceleration in a scene that is seen from the ground, the momentum
	balance  sum m (a + z'') + V = 0  holds for the bodies between the supports, gravity left out: V is what earthquake engineering calls base shear.

	:param supports: a body or a list of them
	"""
	supports, along = _bodies(supports, "supports"), direction(along)

	def measure():
		return float(_forceOn(supports) @ along)

	return measure


def axialLoad(supports):
	"""Measures the load that the structure puts on its supports, downward [N]."""
	return baseShear(supports, (0, 0, -1))


def _forceOn(supports):
	"""Force of joints and contacts on bodies, world axes [N]; what two of them do to each other cancels."""
	from yade import BrickPhys
	total = np.zeros(3)
	for body in supports:
		for interaction in body.intrs():
			phys = interaction.phys
			if isinstance(phys, BrickPhys):
				force = np.array(numbers(phys.normalForce)) + numbers(phys.shearForce)  # on id2
				total += force if interaction.id2 == body.id else -force
	return total


def cracks(mode):
	"""Measures the number of segments of mortar that have failed so far in a mode: 'tension', 'shear' or 'compression' [-]."""
	if mode not in ("tension", "shear", "compression"):
		raise ValueError(f"mode is {mode!r}; allowed are 'tension', 'shear', 'compression'")
	return lambda: sum(getattr(law, f"{mode}Failures") for law in _laws())


def _laws():
	from yade import InteractionLoop, Law2_BrickGeom_BrickPhys_Mortar, O
	loops = [engine for engine in O.engines if isinstance(engine, InteractionLoop)]
	return [functor for loop in loops for functor in loop.lawDispatcher.functors if isinstance(functor, Law2_BrickGeom_BrickPhys_Mortar)]


#: What has taken energy for good, as O.energy names it.
dissipations = ("fracture", "plastDissip", "dashpots", "deformDamping", "nonviscDamp", "contactArea", "levelChange")


def dissipated(names=dissipations):
	"""Measures what cracks, friction, dashpots and damping have taken of the energy so far [J]; NaN unless O.trackEnergy.

	:param names: of O.energy that count
	"""
	names = list(names)

	def measure():
		from yade import O
		known = dict(O.energy.items()) if O.trackEnergy else None
		return math.nan if known is None else sum(known.get(name, 0) for name in names)

	return measure


def storedEnergy(kind, bodies):
	"""Measures the 'kinetic' energy of the scene, or the 'elastic' energy of its bricks, joints and contacts, see restState [J]; NaN before the first step.

	:param bodies: the scene's bricks
	"""
	if kind not in ("kinetic", "elastic"):
		raise ValueError(f"kind is {kind!r}; allowed are 'kinetic' and 'elastic'")
	shapes, energy = [body.shape for body in _bodies(bodies, "bodies")], {"kinetic": rest.kineticEnergy, "elastic": rest.elasticEnergy}[kind]

	def measure():
		try:
			return energy(shapes)
		except RuntimeError:  # the geometry of joints is not known yet
			return math.nan

	return measure


def groundAcceleration(along="x"):
	"""Measures the acceleration of the ground by all GroundMotion engines [m/s2]; 0 without."""
	along = direction(along)

	def measure():
		from yade import GroundMotion, O
		grounds = [engine for engine in O.engines if isinstance(engine, GroundMotion) and not engine.dead]
		return float(sum(np.array(numbers(ground.groundAcceleration(O.time))) @ along for ground in grounds))

	return measure


def fallen(bodies, depth=None):
	"""Measures how many bricks have come down [-].

	:param depth: by how much their centre has to have sunk from where they were laid [m]; None: half the height of each
	"""
	bodies = _bodies(bodies, "bodies")
	if depth is not None and not (isFinite(depth) and depth > 0):
		raise ValueError(f"depth is {depth!r}; allowed is a finite number > 0 m, or None")
	heights = [_laid(body)[2] for body in bodies]
	depths = [depth if depth is not None else _height(body) / 2 for body in bodies]
	return lambda: sum(height - body.state.pos[2] > limit for body, height, limit in zip(bodies, heights, depths))


def unbalancedForce():
	"""YADE's measure of rest [-]; NaN where nothing touches."""
	from yade.utils import unbalancedForce as measure
	return measure()


def _bodies(bodies, name):
	from yade import Body
	found = [bodies] if isinstance(bodies, Body) else list(bodies) if isinstance(bodies, (list, tuple)) else []
	if not found or not all(isinstance(body, Body) for body in found):
		raise ValueError(f"{name} is {bodies!r}; allowed is a Body, or a list of at least one")
	return found


def _laid(body, corner=None):
	"""Where a body, or a corner of a brick, was laid [m]."""
	place = np.array(numbers(body.state.refPos))
	return place if corner is None else place + numbers(body.state.refOri * body.shape.corners[corner])


def _present(body, corner=None):
	return np.array(numbers(body.state.pos if corner is None else body.shape.worldCorners(body.state)[corner]))


def _height(body):
	heights = [(body.state.refOri * corner)[2] for corner in body.shape.corners]
	return max(heights) - min(heights)


# Walls


def wallHistories(masonry, along="x", supports=None, storeys=None, gravity=None, plot=True):
	"""Histories of a wall or house, ready to be called; to be made when bodies, joints and engines are in the scene.

	Columns, with u the mean displacement of the highest course along `along`, all relative to the ground, which moves where a support does:
	top displacement [m], drift [-] (u by the height from the supports' top), drift 1 [-] ... of the storeys, ground acceleration [m/s2], base shear [N] (see
	`baseShear`), base shear coefficient [-] (by the weight), axial load [N], failed in tension, shear, compression [-] (segments so far), kinetic energy,
	elastic energy [J], dissipated energy [J] (only when O.trackEnergy is on by now), unbalanced force [-], fallen bricks [-].

	:param masonry: Masonry, or a list of courses from below, each a list of bodies
	:param along: 'x', 'y', or three numbers
	:param supports: bodies that carry it; by default all that are held by all their degrees of freedom and are joined to or touch a brick that is not
	:param storeys: levels between which storey drift is wanted: lists of bodies, from below, at least two
	:param gravity: [m/s2] > 0, for the weight; by default that of the NewtonIntegrator
	:param plot: whether samples go to yade.plot too
	:returns: Histories
	:raises ValueError: naming the argument, its value and what is allowed; when there is no support, or no gravity and none given
	"""
	courses = [_bodies(list(course), "a course") for course in getattr(masonry, "courses", masonry)]
	bricks = [body for course in courses for body in course]
	free = [body for body in bricks if not _held(body)]
	if not free:
		raise ValueError("no brick of the masonry is free to move; histories need one")
	supports = _supports(free) if supports is None else _bodies(supports, "supports")
	along, ground = direction(along), supports[0]
	weight = sum(body.state.mass for body in free) * _gravity(gravity)
	top, base, shear = displacement(courses[-1], along, ground=ground), max(_topOf(body) for body in supports), baseShear(supports, along)
	height = np.mean([_laid(body)[2] for body in courses[-1]]) - base
	columns = {"top displacement [m]": top, "drift [-]": lambda: top() / height}
	levels = storeys or []
	for number, (lower, upper) in enumerate(zip(levels, levels[1:]), 1):
		columns[f"drift {number} [-]"] = drift(upper, lower, along)
	columns["ground acceleration [m/s2]"] = groundAcceleration(along)
	columns.update({"base shear [N]": shear, "base shear coefficient [-]": lambda: shear() / weight, "axial load [N]": axialLoad(supports)})
	columns.update((f"failed in {mode} [-]", cracks(mode)) for mode in ("tension", "shear", "compression"))
	columns.update((f"{kind} energy [J]", storedEnergy(kind, bricks)) for kind in ("kinetic", "elastic"))
	from yade import O
	if O.trackEnergy:
		columns["dissipated energy [J]"] = dissipated()
	columns.update({"unbalanced force [-]": unbalancedForce, "fallen bricks [-]": fallen(bricks)})
	return Histories(columns, plot, [[name for name in panel if name in columns] for panel in _wallPanels])


#: What the figure of a wall shows.
_wallPanels = (
        ["ground acceleration [m/s2]"], ["top displacement [m]"], ["base shear coefficient [-]"],
        [f"failed in {mode} [-]" for mode in ("tension", "shear", "compression")], [f"{kind} energy [J]" for kind in ("kinetic", "elastic", "dissipated")]
)


def _held(body):
	"""Whether forces do not move a body at all."""
	return not body.dynamic or set(body.state.blockedDOFs) == set("xyzXYZ")


def _supports(free):
	from yade import O
	partners = {other for body in free for i in body.intrs() for other in (i.id1, i.id2)}
	found = [O.bodies[id] for id in sorted(partners) if _held(O.bodies[id])]
	if not found:
		raise ValueError("no fixed body touches the masonry; lay the mortar first (MortarJoints), or give supports")
	return found


def _topOf(body):
	"""Height of the top of a support where it was laid [m]."""
	from yade import Box, Brick
	if isinstance(body.shape, Brick):
		return max(_laid(body, corner)[2] for corner in range(8))
	return _laid(body)[2] + (body.shape.extents[2] if isinstance(body.shape, Box) else 0)


def _gravity(given):
	from yade import NewtonIntegrator, O
	if given is None:
		newton = next((engine for engine in O.engines if isinstance(engine, NewtonIntegrator)), None)
		given = newton.gravity.norm() if newton is not None else 0
		if not given > 0:
			raise ValueError("no NewtonIntegrator with gravity is in O.engines; give `gravity` for the weight [m/s2]")
	if not (isFinite(given) and given > 0):
		raise ValueError(f"gravity is {given!r}; allowed is a finite number > 0 m/s2")
	return given


# Figure

_lineColors, _fontSize = ("#1f4e79", "#c0562f", "#3d7a4a", "#7b4b94", "#8a6d1f"), 9

#: Units that are shown by a smaller one where all values are below the limit: limit, factor, name.
_smallerUnits = {"m": (0.1, 1e3, "mm"), "N": (None, 1e-3, "kN")}


def historyFigure(path, columns, panels=None, title=None, width=7.0, dpi=150):
	"""Saves histories as a figure of panels over one time axis, see Histories.figure.

	:param columns: dict from heading to samples, 'time [s]' among them, as `readHistories` gives them
	"""
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	time = np.asarray(columns[timeHeading])
	if not len(time):
		raise ValueError("there is no sample to draw; at least one is needed")
	panels = _checkedPanels(columns, panels)
	figure = Figure(figsize=(width, 1.15 * len(panels) + 0.9), dpi=dpi, layout="constrained")
	FigureCanvasAgg(figure)
	allAxes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
	for ax, headings in zip(allAxes, panels):
		_drawPanel(ax, time, {heading: np.asarray(columns[heading], dtype=float) for heading in headings})
	allAxes[-1].set_xlabel("time [s]", fontsize=_fontSize)
	if time[-1] > time[0]:
		allAxes[-1].set_xlim(time[0], time[-1])
	figure.align_ylabels(allAxes)
	if title:
		figure.suptitle(title, fontsize=_fontSize + 2)
	figure.savefig(path, metadata={"CreationDate": None} if str(path).lower().endswith(".pdf") else None)


def _unit(heading):
	return heading.rpartition("[")[2].rstrip("]")


def _checkedPanels(columns, panels):
	"""Panels with full headings, each of one unit."""
	names = {key: heading for heading in columns for key in (heading, heading.rpartition(" [")[0])}
	if panels is None:
		return [[heading] for heading in columns if heading != timeHeading]
	found = []
	for panel in panels:
		unknown = [name for name in panel if name not in names]
		if unknown or isinstance(panel, str):
			raise KeyError(f"panel {panel!r}; allowed are lists of {', '.join(map(repr, columns))}")
		found.append([names[name] for name in panel])
		units = {_unit(heading) for heading in found[-1]}
		if len(units) != 1:
			raise ValueError(f"panel {panel!r} has the units {', '.join(sorted(units)) or 'of nothing'}; allowed is one")
	return found


def _drawPanel(ax, time, columns):
	unit = _unit(next(iter(columns)))
	largest = max((np.nanmax(np.abs(values), initial=0.0) for values in columns.values()), default=0.0)
	limit, factor, name = _smallerUnits.get(unit, (None, 1, unit))
	if unit in _smallerUnits and (largest >= limit if limit else largest < 1000):
		factor, name = 1, unit
	counts = unit == "-" and all(np.array_equal(values, np.round(values), equal_nan=True) for values in columns.values())
	names = [heading.rpartition(" [")[0] for heading in columns]
	shared, own = _sharedName(names)
	for values, label, color in zip(columns.values(), own, _lineColors * len(columns)):
		ax.plot(time, factor * values, color=color, linewidth=1.0, label=label, drawstyle="steps-post" if counts else "default")
	name = name.replace("m/s2", "m/s²")
	ax.set_ylabel(f"{_twoLines(shared)}\n[{name}]" if name != "-" else _twoLines(shared), fontsize=_fontSize)
	ax.tick_params(labelsize=_fontSize - 1, direction="in")
	ax.grid(color="#e4e4e4", linewidth=0.6)
	ax.set_axisbelow(True)
	ax.margins(y=0.12)
	for side in ("top", "right"):
		ax.spines[side].set_visible(False)
	if len(columns) > 1:
		ax.legend(fontsize=_fontSize - 1.5, frameon=False, ncols=len(columns), loc="best")


def _sharedName(names):
	"""What several names begin or end with, and what is left of each: 'kinetic energy' and 'elastic energy' are 'energy', 'kinetic' and 'elastic'."""
	if len(names) == 1:
		return names[0], names
	words = [name.split() for name in names]
	begun = len(os.path.commonprefix(words))
	if begun:
		return " ".join(words[0][:begun]), [" ".join(each[begun:]) or name for each, name in zip(words, names)]
	ended = len(os.path.commonprefix([each[::-1] for each in words]))
	return " ".join(words[0][len(words[0]) - ended:]), [" ".join(each[:len(each) - ended]) or name for each, name in zip(words, names)]


def _twoLines(text):
	"""A text whose words are put on two lines about as long."""
	words = text.split()
	cut = min(range(1, len(words)), key=lambda k: abs(len(" ".join(words[:k])) - len(" ".join(words[k:]))), default=None)
	return text if cut is None or len(text) < 12 else " ".join(words[:cut]) + "\n" + " ".join(words[cut:])
