# SPDX-License-Identifier: GPL-2.0-or-later
# What is measured and what has to come out: the programs that run, the figures read from what they print, and the rows of the table, each with its target.
"""Measurements and rows of the benchmarks. Nothing is run here."""

from dataclasses import dataclass, field
from statistics import median
from typing import Callable


@dataclass(frozen=True)
class Measurement:
	"""A program that runs in a process of its own and prints what it has measured.

	:param command: with {yade}, {python}, {scenes}, {programs} and {seconds}, which whoever runs it fills in
	:param package: Debian package without which it cannot run
	"""

	name: str
	command: str
	threads: int = 1
	package: str = ""


@dataclass(frozen=True)
class Figure:
	"""A number with a unit that is in each sample of a measurement."""

	label: str
	unit: str
	measurement: Measurement
	read: Callable


def ratio(first, second, *_):
	"""The value of most rows."""
	return first / second


@dataclass(frozen=True)
class Row:
	"""A line of the table.

	:param figures: the arguments of `value`, then those that are only shown
	:param limit: the target
	:param atLeast: the value has to be at least the limit, not at most
	:param profiled: scenes whose engines are timed when the target is missed
	"""

	name: str
	what: str
	figures: tuple
	limit: float
	atLeast: bool = False
	unit: str = ""
	value: Callable = ratio
	profiled: tuple = ()

	@property
	def measurements(self):
		"""Each once, in the order of the figures."""
		return list(dict.fromkeys(figure.measurement for figure in self.figures))

	@property
	def target(self):
		return f"{'>=' if self.atLeast else '<='} {inUnit(self.limit, self.unit)}"

	def meets(self, value):
		"""Whether a value is on the right side of the limit; NaN never is."""
		return value >= self.limit if self.atLeast else value <= self.limit


@dataclass
class Outcome:
	"""What came out of a row.

	:param samples: of each measurement by name, one a round
	:param trouble: why there is no value: 'skipped: ...' or 'failed: ...'
	:param profiles: of its scenes, when the target is missed: {measurement name: {engine: microseconds a step}}
	"""

	row: Row
	samples: dict = field(default_factory=dict)
	trouble: str = ""
	profiles: dict = field(default_factory=dict)

	def figureSamples(self, figure):
		return [figure.read(sample) for sample in self.samples[figure.measurement.name]]

	@property
	def medians(self):
		"""Of the figures, in their order."""
		return [median(self.figureSamples(figure)) for figure in self.row.figures]

	@property
	def value(self):
		return self.row.value(*self.medians)

	@property
	def range(self):
		"""Least and largest value that one round alone gives."""
		rounds = [self.row.value(*figures) for figures in zip(*(self.figureSamples(figure) for figure in self.row.figures))]
		return min(rounds), max(rounds)

	@property
	def verdict(self):
		return self.trouble or ("met" if self.row.meets(self.value) else "missed")

	@property
	def measured(self):
		"""The value, and its range where there was more than one round."""
		if self.trouble:
			return "-"
		least, most = self.range
		return inUnit(self.value, self.row.unit) + (f" ({short(least)} to {short(most)})" if most > least else "")

	@property
	def figures(self):
		"""The figures behind the value, as text."""
		if self.trouble:
			return []
		return [f"{figure.label} {inUnit(value, figure.unit)}" for figure, value in zip(self.row.figures, self.medians)]


def short(number):
	"""Three digits."""
	return f"{number:.0f}" if abs(number) >= 100 else f"{number:.3g}"


def inUnit(number, unit):
	return f"{short(number)} {unit}".strip()


# What is read from a sample


def perBrickStep(sample):
	"""CPU time of a step for each brick [us]."""
	return 1e6 * sample["cpu"] / sample["steps"] / sample["bricks"]


def wallPerStep(sample):
	"""[ms]"""
	return 1e3 * sample["wall"] / sample["steps"]


def perSimulatedSecond(sample):
	"""CPU time [s/s]."""
	return sample["cpu"] / sample["simulated"]


def recordingPerSimulatedSecond(sample):
	"""CPU time of what is not the simulation [s/s]."""
	return sample["recording"] / sample["simulated"]


def stepSize(sample):
	"""[ms]"""
	return 1e3 * sample["dt"]


def memoryTaken(sample):
	"""By the wall, from before it was made until after the timed steps [MB]."""
	return 1e-3 * (sample["memory"]["steps"] - sample["memory"]["before"])


def memoryOf(stage, before):
	"""Reader of what one stage of the set-up has taken for each brick [kB]."""
	return lambda sample: (sample["memory"][stage] - sample["memory"][before]) / sample["bricks"]


def counted(benchmark, counter="items_per_second", scale=1e-6):
	"""Reader of a result of Google Benchmark; 0 for what the machine cannot run."""

	def read(sample):
		entry = next(entry for entry in sample["benchmarks"] if entry["name"] == benchmark)
		return 0 if entry.get("error_occurred") else scale * entry[counter]

	return read


def ofLeanRoofline(sample):
	"""As ofRoofline, with the operations of the leanest form of the same update that we know."""
	peak = max(counted(f"peak/{width}")(sample) for width in ("avx2", "avx512"))
	return counted("segmentUpdates/4")(sample) * counted("segmentUpdates/4", "leanFlopsPerSegment", 1)(sample) / peak


# What runs


def scene(name, script, options, threads=1):
	"""A scene in YADE."""
	return Measurement(name, f"{{yade}} -n -x -j{threads} {{scenes}}/{script} {options}", threads)


def bricks(name, columns, courses, options="", threads=1):
	"""A wall of bricks all of whose joints hold."""
	return scene(name, "bricks.py", f"--columns {columns} --courses {courses} --seconds {{seconds}} {options}".strip(), threads)


polyhedra = scene("polyhedra", "polyhedra.py", "--columns 24 --courses 24 --seconds {seconds}")
floor = scene("floor", "floor.py", "--bodies 576 --seconds {seconds}")
deformable, rigid = bricks("deformable", 24, 24), bricks("rigid", 24, 24, "--model rigid")
fine = bricks("fine", 24, 24, "--segments 32")
slight = "--load slight --warm 10"
small, middle, large = bricks("small", 24, 24, slight), bricks("middle", 120, 75, slight), bricks("large", 240, 150, slight)
oneThread, twoThreads = (bricks(f"{threads}-thread", 48, 48, slight, threads) for threads in (1, 2))
deformable144, rigid144 = bricks("deformable-144", 12, 12), bricks("rigid-144", 12, 12, "--model rigid")
bullet = Measurement("bullet", "{programs}/bulletBoxes 12 12 {seconds}", package="libbullet-dev")
calculix = Measurement("calculix", "{python} {scenes}/calculix.py --columns 12 --courses 12 --simulated {seconds}", package="calculix-ccx")
cracked = Measurement("cracked", "{programs}/segmentUpdates --benchmark_format=json --benchmark_min_time=0.3", package="libbenchmark-dev")
paper = scene("paper", "untilCollapse.py", "--thickness 0.001 --segments 10")

# The rows


def itself(number, *_):
	"""For rows whose first figure is the value."""
	return number


def ofRoofline(updates, avx2, avx512, flops, *_):
	"""Updated segments [M/s] over those that the multiply-adds of the core [GFLOP/s] allow."""
	return updates * flops / (1e3 * max(avx2, avx512))


def perAddedBrick(more, fewer, *_):
	"""Memory [kB] of each brick that the large wall has more than the middle one, of theirs [MB]."""
	return 1e3 * (more - fewer) / (240 * 150 - 120 * 75)


def brickStep(label, measurement):
	return Figure(label, "us", measurement, perBrickStep)


def simulated(label, measurement):
	return Figure(label, "s/s", measurement, perSimulatedSecond)


def fromBenchmark(label, unit, *which):
	return Figure(label, unit, cracked, counted(*which))


rows = (
        Row(
                "polyhedra-deformable",
                "576 mortared bricks, deformable: how many times cheaper a brick and step than YADE's Polyhedra",
                (brickStep("Polyhedra", polyhedra), brickStep("bricks", deformable)),
                limit=200,
                atLeast=True,
                profiled=(deformable, ),
        ),
        Row(
                "polyhedra-rigid",
                "the same, rigid",
                (brickStep("Polyhedra", polyhedra), brickStep("bricks", rigid)),
                limit=400,
                atLeast=True,
                profiled=(rigid, ),
        ),
        Row(
                "floor-deformable",
                "576 mortared bricks, deformable, over YADE's floor (spheres at rest on a wall), a brick and step",
                (brickStep("bricks", deformable), brickStep("spheres", floor)),
                limit=8,
                profiled=(deformable, floor),
        ),
        Row(
                "floor-rigid",
                "the same, rigid",
                (brickStep("bricks", rigid), brickStep("spheres", floor)),
                limit=4,
                profiled=(rigid, floor),
        ),
        Row(
                "segments",
                "step of an intact wall, 32 x 32 segments a face over 4 x 4",
                (brickStep("32 x 32", fine), brickStep("4 x 4", deformable)),
                limit=1.1,
                profiled=(fine, deformable),
        ),
        Row(
                "cracked",
                "cracked everywhere: updated segments a second over the roofline of the same core",
                (
                        fromBenchmark("4 x 4 segments", "M/s", "segmentUpdates/4"),
                        fromBenchmark("peak with AVX2", "GFLOP/s", "peak/avx2", "items_per_second", 1e-9),
                        fromBenchmark("with AVX-512", "GFLOP/s", "peak/avx512", "items_per_second", 1e-9),
                        fromBenchmark("a segment", "flop", "segmentUpdates/4", "flopsPerSegment", 1),
                        fromBenchmark("10 x 10 segments", "M/s", "segmentUpdates/10"),
                        fromBenchmark("4 x 4, a joint", "ns", "segmentUpdates/4", "nanosecondsPerJoint", 1),
                        fromBenchmark("of which its faces", "ns", "facesOfTheSameJoints", "nanosecondsPerJoint", 1),
                        Figure("over the roofline of the leanest form", "", cracked, ofLeanRoofline),
                ),
                limit=1 / 3,
                atLeast=True,
                value=ofRoofline,
        ),
        Row(
                "size",
                "36 000 deformable bricks over 576, a brick and step",
                (brickStep("36 000", large), brickStep("576", small)),
                limit=1.5,
                profiled=(large, small),
        ),
        Row(
                "memory",
                "memory of a deformable, intact brick, from 9 000 to 36 000",
                (
                        Figure("36 000", "MB", large, memoryTaken),
                        Figure("9 000", "MB", middle, memoryTaken),
                        Figure("of 36 000, each: body", "kB", large, memoryOf("bodies", "before")),
                        Figure("mortar", "kB", large, memoryOf("mortar", "bodies")),
                        Figure("steps", "kB", large, memoryOf("steps", "mortar")),
                ),
                limit=6,
                unit="kB",
                value=perAddedBrick,
        ),
        Row(
                "threads",
                "2304 deformable bricks, how many times faster with 2 threads than with 1",
                (Figure("1 thread", "ms a step", oneThread, wallPerStep), Figure("2 threads", "ms a step", twoThreads, wallPerStep)),
                limit=1.7,
                atLeast=True,
                profiled=(oneThread, twoThreads),
        ),
        Row(
                "bullet",
                "144 bricks, rigid, over Bullet's rigid boxes, a simulated second",
                (
                        simulated("bricks", rigid144),
                        simulated("Bullet", bullet),
                        Figure("bricks: step", "ms", rigid144, stepSize),
                        brickStep("a brick and step", rigid144),
                ),
                limit=1,
                profiled=(rigid144, ),
        ),
        Row(
                "calculix",
                "144 bricks, deformable, over CalculiX, explicit, a hexahedron a brick, no contact, a simulated second",
                (
                        simulated("bricks", deformable144),
                        simulated("CalculiX", calculix),
                        Figure("bricks: step", "ms", deformable144, stepSize),
                        brickStep("a brick and step", deformable144),
                ),
                limit=1,
                profiled=(deformable144, ),
        ),
        Row(
                "paper",
                "the paper's 6 x 6 DEFORM wall, r = 1 mm, 10 x 10 segments, until collapse, over real time",
                (
                        simulated("steps", paper),
                        Figure("not counted: the example's recording", "s/s", paper, recordingPerSimulatedSecond),
                        Figure("collapse at", "s", paper, lambda sample: sample["simulated"]),
                        Figure("step", "ms", paper, stepSize),
                ),
                limit=0.5,
                value=itself,
                profiled=(paper, ),
        ),
)
