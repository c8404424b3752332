# SPDX-License-Identifier: GPL-2.0-or-later
"""What accuracy costs in time: how well bricks deform, r, segments and dt factor, against error and seconds of work a simulated second.

    build/yade -n -x examples/05_accuracy_versus_time.py [--case CASE ...] [--quick] [--out DIR] [--page FILE] [--help]

| case | scene | error of | against |
|---|---|---|---|
| cube | Table 2 of the paper: a cube pressed by a smooth rigid plate | change of width at the top, settlement; nu = 0.25 and 0.40 | elasticity |
| cantilever | column of five cubes, bonded | six natural frequencies | elasticity |
| weight | the paper's straight-joint wall under its weight | stress across vertical joints, spread of the edge: the worse | elasticity |
| seismic | the same wall, shaken until it falls | history of an upper brick before the first crack; time of collapse | the finest setting |

Several quantities count by their root mean square. Mortar is unbreakable but in the last case. Every setting runs in a YADE of its own, one after
another. Leaves in DIR: table.md (all rows, a reading derived from them), table.csv, accuracy.json, accuracy.png (error against time, with the Pareto
front), rows/ (each run). --page puts the table of all settings, the reading and the picture into a page such as doc/accuracy.md.

With many cores, and a file system that they share:

    build/yade -n -x examples/05_accuracy_versus_time.py --table DIR/settings.table [--all]
    yade-batch --executable build/yade --log DIR/@.log DIR/settings.table examples/05_accuracy_versus_time.py
    build/yade -n -x examples/05_accuracy_versus_time.py --out DIR --collect

Seconds of work are processor time of one thread, which is the elapsed time of a machine that does nothing else; in the first three cases of the
motion of the loaded scene, the fastest of several measurements. Memory is what a wall of 576 such bricks takes, with joints and interactions.
"""

import argparse
import csv
import ctypes
import gc
import json
import math
import os
import platform
import subprocess
import sys
import time

import numpy as np

import yade_brick
from yade_brick import build, progress
from yade_brick.bill import limitText, stepLimit

script = os.path.abspath(sys.argv[0])
sys.path.insert(0, os.path.dirname(script))
import accuracy
from accuracy import Point, Row

friction = math.radians(32)
memoryColumns = memoryCourses = 24

# Scenes


def startScene(setting, young=9.8e6, poisson=0.25, breakable=False):
	"""A scene with nothing but the ground, and the options of its bricks but for size and contact part."""
	O.reset()
	strength = (4.6e3, 2.9e3, 4.9e5) if breakable else (1e12, 1e12, 1e12)
	mortar = yade_brick.Mortar(tensileStrength=strength[0], cohesion=strength[1], frictionAngle=friction, compressiveStrength=strength[2])
	clay = yade_brick.BrickMat(young=young, poisson=poisson, density=1800, frictionAngle=friction, mortar=mortar)
	O.bodies.append(wall(0, axis=2, sense=1, material=clay))
	cells = setting.cells if setting.level == "refined" else None
	return dict(material=clay, deformation=setting.level, element=setting.element, inner=setting.inner, segments=setting.segments, cells=cells)


def addEngines(setting):
	"""The loop of the bodies that are there."""
	O.engines = loop = yade_brick.engines(gravity=(0, 0, -9.8), safety=setting.safety)
	return loop


def addWall(setting, columns=6, courses=6, **options):
	"""The paper's wall of cubes of 0.2 m, mortared and at rest under its weight; its Masonry."""
	given = startScene(setting, **options)
	masonry = build.straightJointWall(columns, courses, (0.2, 0.2, 0.2), contactThickness=0.2 / setting.thinness, **given)
	O.bodies.append(masonry.bodies)
	addEngines(setting)
	yade_brick.MortarJoints()()
	return masonry


def cornersOf(body):
	return np.array([tuple(corner) for corner in body.shape.worldCorners(body.state)])


# Cases: each builds its scene, finds the error, and leaves the scene to be timed


def cubeCase(row):
	"""The cube on a bonded base under a smooth plate that weighs 20 kg but is pressed by 200 N; no gravity, so that its own weight does not widen it."""
	side, found = 0.1, {}
	for poisson, (width, settlement) in accuracy.cube.items():
		given = startScene(row.setting, young=9.8e7, poisson=poisson)
		cube = build.brick((side,) * 3, center=(0, 0, side / 2), contactThickness=side / row.setting.thinness, **given)
		ground, (brickId,) = 0, O.bodies.append([cube])
		smooth = FrictMat(density=2.0e4, frictionAngle=0)
		plate = O.bodies.append(box((0, 0, 1.5 * side), (0.5 * side,) * 3, material=smooth))
		O.bodies[plate].dynamic = True
		loop = addEngines(row.setting)
		loop.newton.gravity, loop.newton.damping, loop.dynamics.damping = (0, 0, 0), 0.2, 0.2
		yade_brick.MortarJoints(ids=[ground, brickId])()
		O.forces.setPermF(plate, (0, 0, -2.0e4 * side**3 * 10))
		O.step()
		progress.runWithProgress(duration=1, label=f"nu = {poisson}", every=0.002, callback=lambda: unbalancedForce() < 1e-7)
		corners = cornersOf(cube)
		found[f"width, nu = {poisson}"] = (corners[5][0] - corners[4][0] - side) / width - 1
		found[f"settlement, nu = {poisson}"] = (O.bodies[plate].state.pos[2] - 1.5 * side) / settlement - 1
	return {"error": accuracy.meanSquare(list(found.values())), "parts": found}


def cantileverCase(row):
	"""Five cubes on the ground, one above the other; afterwards pushed aside, so that they swing while they are timed."""
	given = startScene(row.setting)
	bricks = [build.brick((0.2,) * 3, center=(0, 0, 0.2 * level + 0.1), contactThickness=0.2 / row.setting.thinness, **given) for level in range(5)]
	O.bodies.append(bricks)
	loop = addEngines(row.setting)
	yade_brick.MortarJoints()()
	errors = yade_brick.assembled().frequencies(len(accuracy.cantilever)) / accuracy.cantilever - 1
	loop.newton.gravity = (0.1, 0, -9.8)
	O.step()
	return {"error": accuracy.meanSquare(errors), "parts": dict(zip(("bending", "torsion", "second bending", "axial"), errors[[0, 2, 3, 5]]))}


def weightCase(row):
	"""The wall in equilibrium under its weight."""
	masonry = addWall(row.setting)
	unloaded = [cornersOf(body) for body in masonry.bodies]
	yade_brick.StaticEquilibrium()()
	O.step()
	moved = np.array([cornersOf(body) for body in masonry.bodies]) - unloaded
	sums = {}
	for joint in (i for i in O.interactions if i.isReal and i.phys.jointed and abs(i.geom.normal[0]) > 0.5):
		x, _, z = joint.geom.contactPoint
		# left and right of the middle are alike
		key = abs(round(x / 0.2) - 3), int(z / 0.2)
		sums.setdefault(key, []).append(np.average(joint.phys.normalStress(joint.geom), weights=joint.phys.segmentArea))
	stress = [[np.mean(sums[place, course]) for course in range(6)] for place in range(3)]
	# corners 6 and 2 are a brick's at high x and y, above and below: the edge where two courses meet is the mean of both
	ends = [masonry.bodies.index(course[-1]) for course in masonry.courses]
	above, below = ([moved[end][corner][0] for end in ends] for corner in (6, 2))
	spread = [np.mean(pair) for pair in zip(above, below[1:])] + [above[-1]]
	found = {"stress across vertical joints": accuracy.relative(stress, accuracy.headStress), "spread": accuracy.relative(spread, accuracy.edgeSpread)}
	return {"error": max(found.values()), "parts": found}


def seismicCase(row):
	"""The wall with the paper's mortar, shaken until a brick has come down by half its height; error later, when the reference is known."""
	masonry = addWall(row.setting, breakable=True)
	yade_brick.StaticEquilibrium()()
	O.step()
	loop = yade_brick.Loop(O.engines)
	loop.insert(loop.index(loop.newton), build.groundMotion(yade_brick.syntheticNearFault().scaled(row.scale), startTime=O.time))
	O.engines, law = loop, loop.law
	followed, start = masonry.courses[-1][0], O.time
	home, heights = followed.state.pos[0], [body.state.pos[2] for body in masonry.bodies]
	found = {"times": [], "displacements": [], "firstCrack": None, "collapse": None}

	def look():
		now = O.time - start
		found["times"].append(now)
		found["displacements"].append(followed.state.pos[0] - home)
		if found["firstCrack"] is None and law.tensionFailures + law.shearFailures + law.compressionFailures > 0:
			found["firstCrack"] = now
		if any(height - body.state.pos[2] > 0.1 for height, body in zip(heights, masonry.bodies)):
			found["collapse"] = now
			return True

	begun = time.process_time()
	stage = progress.runWithProgress(duration=row.seconds, label="shaking", every=accuracy.sampleEvery, callback=look)
	return {**found, "secondsPerSimulatedSecond": (time.process_time() - begun) / stage.simulated}


runners = {"cube": cubeCase, "cantilever": cantileverCase, "weight": weightCase, "seismic": seismicCase}


def secondsOfWork():
	"""Seconds of work a simulated second of the scene as it stands: of fifteen pieces of a twentieth of a second at least, the fastest."""

	def spent(steps):
		begun = time.process_time()
		for _ in range(steps):
			O.step()
		return time.process_time() - begun

	steps = 100
	while spent(steps) < 0.05 and steps < 10**6:
		steps *= 2
	return min(spent(steps) for _ in range(15)) / (steps * O.dt)


class AllocatorState(ctypes.Structure):
	"""struct mallinfo2 of the C library."""

	_fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks", "fordblks", "keepcost")]


def allocatedMemory():
	"""What the process has asked the C library for and not given back [bytes]. What is resident would count free memory of earlier work as none."""
	ask = ctypes.CDLL(None).mallinfo2
	ask.restype = AllocatorState
	state = ask()
	return state.uordblks + state.hblkhd


def memoryPerBrick(setting):
	"""Memory that a brick of a large wall takes, with its joints and YADE's own share [bytes]. What all bricks share is in memory before, with a small wall."""

	def inMemory(columns, courses):
		addWall(setting, columns, courses)
		O.step()
		O.step()
		gc.collect()
		return allocatedMemory()

	before = inMemory(2, 2)
	return (inMemory(memoryColumns, memoryCourses) - before) / (memoryColumns * memoryCourses)


def runRow(row, path):
	"""Runs it in this process and leaves what was measured in the file."""
	memory = memoryPerBrick(row.setting)
	result = runners[row.case](row)
	result.setdefault("secondsPerSimulatedSecond", secondsOfWork() if row.case != "seismic" else None)
	limit = stepLimit()
	result.update(dt=O.dt, limit=limit, limitText=limitText(limit), memoryPerBrick=memory, row={**row._asdict(), "setting": row.setting._asdict()})
	os.makedirs(os.path.dirname(path), exist_ok=True)
	with open(path, "w") as file:
		json.dump(result, file, default=float)


# Running them all


def rowPath(table, line):
	return os.path.join(os.path.dirname(os.path.abspath(table)), "rows", f"{line}.json")


def runLine(tableAndLine):
	"""Runs a line of a table, as `yade-batch` or we ourselves ask for it: FILE:LINE."""
	defaults = {**Row("", accuracy.defaults)._asdict(), **accuracy.defaults._asdict()}
	readParamsFromTable(tableAndLine, noTableOk=False, **{name: value for name, value in defaults.items() if name != "setting"})
	from yade.params import table as given
	table, line = tableAndLine.rsplit(":", 1)
	runRow(accuracy.rowOf(vars(given)), rowPath(table, int(line)))


def runAll(rows, table):
	"""Runs all lines, one after another, each in a YADE of its own; says on stderr how far it is."""
	begun = time.perf_counter()
	for index, row in enumerate(rows):
		line = accuracy.firstLine + index
		path = rowPath(table, line)
		os.makedirs(os.path.dirname(path), exist_ok=True)
		if os.path.exists(path):
			os.remove(path)
		with open(path[:-5] + ".log", "w") as log:
			subprocess.run([sys.yade_argv[0], "-n", "-x", "-j1", script, "--table", table, "--row", str(line)], stdout=log, stderr=subprocess.STDOUT)
		said = "" if os.path.exists(path) else f": FAILED, see {log.name}"
		sys.stderr.write(f"{index + 1} of {len(rows)}, {time.perf_counter() - begun:.0f} s: {row.case}, {accuracy.title(row.setting)}{said}\n")


def results(table):
	"""What the rows of a table have left; the rows that left nothing."""
	found, missing = [], []
	with open(table) as file:
		count = len(file.read().splitlines()) - accuracy.firstLine + 1
	for line in range(accuracy.firstLine, accuracy.firstLine + count):
		path = rowPath(table, line)
		if not os.path.exists(path):
			missing.append(line)
			continue
		with open(path) as file:
			result = json.load(file)
		result["row"] = Row(**{**result["row"], "setting": accuracy.Setting(**result["row"]["setting"])})
		found.append(result)
	return found, missing


# What comes out

panels = {
        "cube": "Poisson cube: width and settlement",
        "cantilever": "Cantilever of five bricks: six frequencies",
        "weight": "Wall under its weight: stress and spread",
        "seismic": "Wall shaken: history before the first crack",
        "collapse": "Wall shaken: time of collapse"
}


def circumstances(found):
	"""What it ran on, for the reader of the seconds, and what the shaken wall is compared with."""
	with open("/proc/cpuinfo") as file:
		models = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
	reference = [f" Reference of the shaken wall: {accuracy.title(result['row'].setting)}." for result in found if result["row"].reference]
	return f"{models[0] if models else platform.machine()}, {os.cpu_count()} cores, one thread." + "".join(reference)


def write(out, found, missing, page):
	"""All files of the results; what the page shows."""
	scatter = accuracy.judgeShaking([result for result in found if result["row"].case == "seismic"]) if any(result["row"].reference for result in found) else None
	found = [result for result in found if "error" in result]
	points = accuracy.pointsOf(found, panels)
	headings, rows = accuracy.fullTable(found)
	text = accuracy.readings(points, panels, scatter)
	with open(os.path.join(out, "table.csv"), "w", newline="") as file:
		csv.writer(file).writerows([headings, *rows])
	with open(os.path.join(out, "table.md"), "w") as file:
		file.write(f"{circumstances(found)}\n\n{accuracy.markdown(headings, rows)}\n{text}")
	fronts = {name: [point._asdict() | {"setting": point.setting._asdict()} for point in accuracy.front(members)] for name, members in points.items()}
	content = {"circumstances": circumstances(found), "scatterOfCollapse": scatter, "fronts": fronts, "rowsWithoutResult": missing}
	content["rows"] = [{**result, "row": {**result["row"]._asdict(), "setting": result["row"].setting._asdict()}} for result in found]
	with open(os.path.join(out, "accuracy.json"), "w") as file:
		json.dump(content, file, indent="\t", default=float)
	picture = os.path.join(out, "accuracy.png")
	draw(points, scatter, picture)
	if page:
		fillPage(page, f"{accuracy.pageTable(found, points)}\n{circumstances(found)}\n", text, picture)
	return text


def fillPage(page, table, text, picture):
	"""Puts table and reading between the marks of a page, and the picture beside it."""
	with open(page) as file:
		content = file.read()
	content = accuracy.withinMarks(accuracy.withinMarks(content, "table", table), "reading", text)
	with open(page, "w") as file:
		file.write(content)
	with open(picture, "rb") as source, open(os.path.join(os.path.dirname(os.path.abspath(page)), "accuracy.png"), "wb") as target:
		target.write(source.read())


# The picture

colors = {"rigid": "#444444", "uniform": "#8a6d3b", "trilinear": "#1f4e79", "refined": "#b03a2e"}
markers = {"full": "s", "bbar": "^", "incompatible": "o"}


def draw(points, scatter, path):
	"""Error against seconds of work, a panel for each case."""
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	from matplotlib.lines import Line2D
	figure = Figure(figsize=(16, 5.2 * math.ceil((len(points) + 1) / 3)), layout="constrained")
	FigureCanvasAgg(figure)
	grid = figure.subplots(math.ceil((len(points) + 1) / 3), 3, squeeze=False).ravel()
	for axes, (name, members) in zip(grid, points.items()):
		drawPanel(axes, members, panels[name])
		if name == "collapse" and scatter:
			lowest = axes.get_ylim()[0]
			axes.axhspan(lowest, scatter, color="#dddddd", zorder=0.1)
			axes.set_ylim(bottom=lowest)
	for axes in grid[len(points):]:
		axes.set_axis_off()
	handles = [Line2D([], [], linestyle="", marker="o", color=color, label=level) for level, color in colors.items()]
	handles += [Line2D([], [], linestyle="", marker=marker, color="#1f4e79", fillstyle="none", label=f"element {element}") for element, marker in markers.items()]
	handles.append(Line2D([], [], color="#2e8b57", label="Pareto front"))
	labels = "base: {}, {},\n{}, {}, {}".format(*accuracy.title(accuracy.better).split(", ")) + "\nother labels: what differs from it"
	labels += "\ngrey: the scatter of repetitions" if scatter else ""
	grid[len(points)].legend(handles=handles, loc="center", frameon=False, title=labels)
	figure.savefig(path, dpi=110)


def drawPanel(axes, points, title):
	axes.set(xscale="log", yscale="log", xlabel="seconds of work a simulated second", ylabel="error", title=title)
	smallest = min((point.error for point in points if point.error > 0), default=1e-6)
	shown = [point._replace(error=max(point.error, smallest)) for point in points]
	for point in shown:
		marker = markers[point.setting.element] if point.setting.level != "rigid" else "o"
		axes.plot(point.time, point.error, marker, color=colors[point.setting.level], fillstyle="full" if point.setting.inner == "full" else "none")
	best = accuracy.front(shown)
	axes.step([point.time for point in best], [point.error for point in best], where="post", color="#2e8b57", lw=1.2, zorder=0.5)
	axes.margins(x=0.2, y=0.12)
	axes.grid(True, which="major", color="#eeeeee")
	axes.set_axisbelow(True)
	label(axes, shown)


def label(axes, points):
	"""Names beside the points, moved up where they would lie on another name or point."""
	axes.figure.canvas.draw()
	places = [tuple(axes.transData.transform((point.time, point.error))) for point in points]
	# left, right, middle, height of what is taken [pixels]
	taken, behind = [(x - 5, x + 5, y, 9) for x, y in places], dict(facecolor="white", edgecolor="none", alpha=0.7, pad=0.5)
	for (x, y), point in sorted(zip(places, points), key=lambda entry: entry[0][1]):
		text = accuracy.shortTitle(point.setting)
		left, right, height = x + 7, x + 7 + 5.6 * len(text), y
		while any(abs(height - middle) < high and begin < right and left < end for begin, end, middle, high in taken):
			height += 2
		taken.append((left, right, height, 12))
		offset = (left - x) * 72 / axes.figure.dpi, (height - y) * 72 / axes.figure.dpi
		axes.annotate(text, (point.time, point.error), offset, textcoords="offset points", va="center", fontsize=7, bbox=behind, zorder=1)


# The command


def options():
	parser = argparse.ArgumentParser(prog=os.path.basename(script), description=__doc__.splitlines()[0])
	parser.add_argument("--case", action="append", choices=accuracy.cases, help="only this case; may be repeated (default: all)")
	parser.add_argument("--quick", action="store_true", help="few settings, and a short shaking: two minutes at most")
	parser.add_argument("--all", action="store_true", help="every combination of the dials, about a thousand settings a case; for --table")
	parser.add_argument("--out", metavar="DIR", default="result-05", help="folder for the results (default: result-05)")
	parser.add_argument("--page", metavar="FILE", help="also put table, reading and picture into this page, such as doc/accuracy.md")
	parser.add_argument("--table", metavar="FILE", help="only write the settings as a table for yade-batch")
	parser.add_argument("--row", type=int, metavar="LINE", help="run this line of --table")
	parser.add_argument("--collect", action="store_true", help="run nothing: DIR has the rows of a yade-batch run of DIR/settings.table")
	chosen = parser.parse_args()
	if chosen.row is not None and chosen.table is None:
		parser.error("--row needs --table: the file that has the line")
	return chosen


def main():
	if os.environ.get("YADE_BATCH"):
		return runLine(os.environ["YADE_BATCH"])
	chosen = options()
	if chosen.row is not None:
		return runLine(f"{chosen.table}:{chosen.row}")
	table = chosen.table or os.path.join(chosen.out, "settings.table")
	if not chosen.collect:
		settings = accuracy.everyCombination() if chosen.all else accuracy.quickSweep() if chosen.quick else accuracy.sweep()
		rows = accuracy.plan(chosen.case or accuracy.cases, settings, chosen.quick)
		os.makedirs(os.path.dirname(os.path.abspath(table)), exist_ok=True)
		with open(table, "w") as file:
			file.write(accuracy.tableText(rows))
		if chosen.table:
			print(f"{len(rows)} lines in {table}")
			return
		runAll(rows, table)
	found, missing = results(table)
	print(write(chosen.out, found, missing, chosen.page))
	print(f"{len(found)} runs, results in {chosen.out}" + (f"; without result: lines {missing} of {table}" if missing else ""))
	sys.exit(1 if missing or not found else 0)


main()
