# SPDX-License-Identifier: GPL-2.0-or-later
# What the fuzzer tries, as hypothesis strategies. An example is plain data (numbers, texts, lists, dicts), so that it can be handed to a YADE as JSON,
# printed and tried again: {'kind': ..., ...}; examples.py says what each kind does.
#
# Left out is what YADE itself does not survive, without any brick either: bodies without state, an InteractionLoop that lacks the physics or law of bodies
# that touch, a Wall across no axis, a periodic cell smaller than a body, a TimeStepper that works every 0 steps, a permanent force on a body that was added
# since the last step, files that are broken but no XML (.yade, .bz2). And what a saved file says of the inside of
# joints, which is taken as it is.
"""Strategies for examples of good, odd and broken input."""

import json
import math
import pathlib

from hypothesis import strategies as st

fuzzFolder = pathlib.Path(__file__).resolve().parent

nan, inf = math.nan, math.inf

#: Numbers that are at an edge of something.
edges = st.sampled_from((0.0, -0.0, 1.0, -1.0, nan, inf, -inf, 1e308, -1e308, 1e-308, 5e-324, 1e-30, 1e30, 1e154, 1e-9, 1e9, 0.5, 0.49999999))
oddNumbers = st.one_of(edges, st.floats())
oddCounts = st.one_of(st.integers(-3, 12), st.sampled_from((64, 65, 10**6, -(2**31), 2**31 - 1, 2**31, 2**63, 10**30)))
oddTexts = st.sampled_from(("", "x", "rigid", "full", "\n", "nan", "\u00e9\u2028", "a" * 300))
#: Anything at all where a number, a vector or a name belongs.
anything = st.one_of(
        oddNumbers, oddCounts, oddTexts, st.none(), st.booleans(), st.lists(oddNumbers, max_size=4), st.just({}),
        st.lists(st.lists(oddNumbers, max_size=3), max_size=3)
)
oddVectors = st.lists(oddNumbers, min_size=3, max_size=3)


def logarithmic(low, high):
	"""Numbers that are evenly spread over powers of ten."""
	return st.floats(low, high).map(lambda exponent: 10.0 ** exponent)


def mostly(usual, odd, oddInTen=1):
	"""The usual, and now and then the odd."""
	return st.integers(0, 9).flatmap(lambda i: odd if i >= 10 - oddInTen else usual)


def options(**choices):
	"""dict with some of the keys."""
	return st.fixed_dictionaries({}, optional=choices)


levels = st.sampled_from(("rigid", "uniform", "trilinear", "refined"))
elements = st.sampled_from(("full", "incompatible", "bbar"))
inners = st.sampled_from(("inset", "full"))

# Corners

_signs = ((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1))
_small = st.floats(-1.5, 1.5)


@st.composite
def corners(draw):
	"""Corners of a hexahedron: a cuboid of any size, then sheared, cut obliquely, flattened, moved, broken, or left as it is."""
	size = draw(st.one_of(st.tuples(*[logarithmic(-2, 0.5)] * 3), st.tuples(*[logarithmic(-12, 12)] * 3), st.tuples(*[logarithmic(-160, 160)] * 3)))
	points = [[0.5 * s * length for s, length in zip(signs, size)] for signs in _signs]
	for change in draw(st.lists(st.sampled_from(("shear", "taper", "turn", "shift", "flatten", "corner", "swap", "value", "missing", "extra", "order")),
	        max_size=2)):
		k, j = draw(st.permutations(range(3)))[:2]
		corner = draw(st.integers(0, len(points) - 1))
		amount = draw(_small)
		if change == "shear":
			points = [[x + amount * p[j] if axis == k else x for axis, x in enumerate(p)] for p in points]
		elif change == "taper":
			points = [[x * (1 + 0.9 * amount * p[j] / (size[j] or 1)) if axis == k else x for axis, x in enumerate(p)] for p in points]
		elif change == "turn":
			c, s = math.cos(amount), math.sin(amount)
			turned = [list(p) for p in points]
			for p, q in zip(points, turned):
				q[k], q[j] = c * p[k] - s * p[j], s * p[k] + c * p[j]
			points = turned
		elif change == "shift":
			shift = amount * draw(logarithmic(-3, 9))
			points = [[x + shift if axis == k else x for axis, x in enumerate(p)] for p in points]
		elif change == "flatten":
			factor = draw(st.sampled_from((0.0, 1e-300, 1e-12, 1e-5, -1.0)))
			points = [[x * factor if axis == k else x for axis, x in enumerate(p)] for p in points]
		elif change == "corner":
			points[corner] = [x + amount * length for x, length in zip(points[corner], size)]
		elif change == "swap":
			other = draw(st.integers(0, len(points) - 1))
			points[corner], points[other] = points[other], points[corner]
		elif change == "value":
			points[corner] = [draw(oddNumbers) if axis == k else x for axis, x in enumerate(points[corner])]
		elif change == "missing":
			points = points[:corner]
			if not points:
				return points
		elif change == "extra":
			points = points + [points[corner]]
		elif change == "order":
			points = [points[i] for i in draw(st.permutations(range(len(points))))]
	return points


shapeOptions = options(
        deformation=mostly(levels, oddTexts), element=mostly(elements, oddTexts), inner=mostly(inners, oddTexts),
        contactThickness=st.one_of(logarithmic(-4, -1), oddNumbers),
        segments=mostly(st.sampled_from((1, 2, 4, 6)), oddCounts), cells=mostly(st.sampled_from((1, 2, 3)), st.sampled_from((0, -1, 9, 2**31, 10**30)))
)
shapes = st.fixed_dictionaries({"kind": st.just("shape"), "corners": corners(), "options": shapeOptions, "young": st.one_of(logarithmic(0, 12), oddNumbers),
                                "poisson": st.one_of(st.floats(-0.99, 0.4999), oddNumbers), "nodes": corners()})

# Materials

_goodMaterial = {
        "young": logarithmic(4, 11), "poisson": st.floats(-0.9, 0.4999), "density": logarithmic(1, 4), "frictionAngle": st.floats(0, 1.5),
        "hn": st.floats(0, 2), "hs": st.floats(0, 2), "dampingRatio": st.floats(0, 0.99)
}
_goodMortar = {
        "young": logarithmic(4, 11), "poisson": st.floats(-0.9, 0.4999), "thickness": st.sampled_from((0.0, 1e-4, 1e-3)),
        "tensileStrength": st.one_of(st.just(0.0), logarithmic(0, 8)),
        "cohesion": st.one_of(st.just(0.0), logarithmic(0, 8)), "frictionAngle": st.floats(0, 1.5), "compressiveStrength": logarithmic(0, 9),
        "Cs": st.floats(0, 20)
}
_strengths = {name: _goodMortar[name] for name in ("tensileStrength", "cohesion", "frictionAngle", "compressiveStrength")}
_anyMaterial = options(**{name: mostly(good, oddNumbers) for name, good in _goodMaterial.items()})
_anyMortar = options(**{name: mostly(good, oddNumbers) for name, good in _goodMortar.items()})
materials = st.fixed_dictionaries({"kind": st.just("material"), "brick": _anyMaterial, "mortar": st.one_of(st.none(), _anyMortar), "set": st.lists(
        st.tuples(st.sampled_from(("brick", "mortar")), st.sampled_from(sorted({*_goodMaterial, *_goodMortar, "mortar", "label"})),
        st.one_of(oddNumbers, anything)), max_size=3)})

_plainMaterial = {"young": 9.8e6, "poisson": 0.25, "density": 1800.0, "frictionAngle": 0.5}
_plainMortar = {"tensileStrength": 2e3, "cohesion": 2e3, "frictionAngle": 0.5, "compressiveStrength": 5e5}
_usualMaterials = st.one_of(st.just(_plainMaterial), options(**_goodMaterial))
_moreOfMortar = {name: good for name, good in _goodMortar.items() if name not in _strengths}
_usualMortars = st.one_of(st.just(_plainMortar), st.none(), st.fixed_dictionaries(_strengths, optional=_moreOfMortar))

# Scenes: bodies, engines, and a list of things done

_quaternions = st.one_of(st.just([1.0, 0.0, 0.0, 0.0]), st.lists(st.floats(-1, 1), min_size=4, max_size=4))
_velocities = st.lists(st.one_of(st.just(0.0), st.floats(-5, 5), st.sampled_from((100.0, -1e4))), min_size=3, max_size=3)
_bricks = st.fixed_dictionaries(
        {"side": st.sampled_from(("+x", "+z", "+y", "-x", "free")), "gap": st.sampled_from((0.0, 0.0, 0.0, 1e-9, 1e-3, -1e-3, -0.02, -0.1, 0.3))}, optional={
                "size": st.lists(st.one_of(st.just(0.2), st.sampled_from((0.1, 0.4)), logarithmic(-2, 1)), min_size=3, max_size=3),
                "slip": st.floats(-0.3, 0.3), "turn": _quaternions,
                "level": levels, "element": elements, "inner": inners, "segments": st.sampled_from((1, 2, 4, 6)), "cells": st.sampled_from((1, 2)),
                "thickness": logarithmic(-4, -1.3), "fixed": st.booleans(),
                "vel": _velocities, "angVel": _velocities, "material": st.sampled_from((0, 0, 0, 1))
        }
)
_usualEngines = ("ForceResetter", "InsertionSortCollider", "InteractionLoop", "BrickTimeStepper", "BrickDynamics", "GroundMotion", "NewtonIntegrator")
engineNames = _usualEngines[:4] + ("DeformationOnDemand", ) + _usualEngines[4:]
_engineLists = st.one_of(
        st.just(list(_usualEngines)), st.lists(st.sampled_from(engineNames), max_size=8), st.permutations(engineNames),
        st.sets(st.sampled_from(engineNames), max_size=2).map(lambda gone: [name for name in engineNames if name not in gone])
)
_functors = st.one_of(st.just([]), st.lists(st.sampled_from(("Bo1_Brick_Aabb", "Bo1_Wall_Aabb", "Bo1_Box_Aabb", "Ig2_Brick_Brick_BrickGeom",
        "Ig2_Wall_Brick_BrickGeom",
                                              "Ig2_Box_Brick_BrickGeom")), max_size=2))
_supports = st.one_of(st.none(), st.just({"shape": "wall"}), st.fixed_dictionaries({"shape": st.sampled_from(("wall", "box"))}, optional={
        "material": st.sampled_from(("brick", "frict", "elast", "none")), "axis": st.integers(0, 2), "sense": st.integers(-2, 2),
        "extents": st.lists(oddNumbers, min_size=3, max_size=3)}))

_booleans = mostly(st.booleans(), anything)
_terms = options(failure=_booleans, friction=_booleans, dashpots=_booleans)
_levelTimes = st.sampled_from((0.0, 1e-5, 1e-4, 1e-3))
_onDemand = options(
        level=mostly(st.sampled_from(("uniform", "trilinear")), st.one_of(levels, anything)), utilisation=mostly(logarithmic(-8, 0), oddNumbers),
        stress=mostly(st.one_of(st.just(nan), logarithmic(-1, 6)), oddNumbers), release=mostly(st.floats(0, 1), oddNumbers),
        patience=mostly(st.sampled_from((0.0, 1e-5, 1e-4)), oddNumbers), interval=mostly(st.integers(1, 5), oddCounts),
        ids=mostly(st.just([]), st.one_of(st.lists(st.integers(0, 4), max_size=3), anything))
)
#: Levels that a brick can change to, and now and then one that it cannot.
_newLevels = options(
        deformation=mostly(levels, anything), contactThickness=mostly(logarithmic(-4, -1.3), oddNumbers), element=mostly(elements, anything),
        inner=mostly(inners, anything), cells=mostly(st.sampled_from((1, 2, 3)), oddCounts),
        segments=mostly(st.sampled_from((2, 4, 6)), st.sampled_from((0, 3)))
)
_motions = st.fixed_dictionaries({"dt": st.one_of(st.just(0.01), oddNumbers), "acceleration": st.lists(st.one_of(_velocities, oddVectors), max_size=4)})
_functorNames = (
        "Bo1_Brick_Aabb", "Bo1_Wall_Aabb", "Bo1_Box_Aabb", "Bo1_Sphere_Aabb", "Ig2_Brick_Brick_BrickGeom", "Ig2_Wall_Brick_BrickGeom",
        "Ig2_Box_Brick_BrickGeom", "Ip2_BrickMat_BrickMat_BrickPhys", "Ip2_FrictMat_BrickMat_BrickPhys", "Ip2_FrictMat_FrictMat_FrictPhys",
        "Law2_BrickGeom_BrickPhys_Mortar", "Law2_ScGeom_FrictPhys_CundallStrack"
)
#: Arguments of yade_brick.engines.
_loops = options(
        gravity=mostly(st.one_of(st.none(), st.just([0.0, 0.0, -9.81]), _velocities), st.one_of(oddVectors, anything)),
        damping=mostly(st.floats(0, 0.9), anything), dt=mostly(st.one_of(st.none(), st.sampled_from((1e-6, 1e-5))), anything),
        safety=mostly(st.floats(0.1, 1), anything),
        motion=mostly(st.one_of(st.none(), st.builds(lambda motion, engine: {**motion, "engine": engine}, _motions, st.booleans())), anything),
        failure=_booleans, friction=_booleans, dashpots=_booleans, contact=_booleans, onDemand=mostly(st.one_of(st.booleans(), _onDemand), anything),
        ledger=_booleans, guard=_booleans, stopFile=mostly(st.sampled_from(("", "stopped.yade.gz")), anything),
        verletDist=mostly(st.one_of(st.none(), logarithmic(-4, -1)), anything),
        functors=mostly(st.just([]), st.one_of(st.lists(st.sampled_from(_functorNames), max_size=4), anything))
)

_place = st.integers(0, 4)  # of a brick among those that there are
_stateAttributes = ("pos", "vel", "angVel", "angMom", "inertia", "refPos", "mass", "densityScaling", "blockedDOFs", "ori")
_sets = st.one_of(
        st.tuples(st.just("state"), _place, st.sampled_from(("pos", "vel", "angVel", "angMom", "inertia")), st.one_of(_velocities, oddVectors)),
        st.tuples(st.just("state"), _place, st.sampled_from(("mass", "densityScaling")), oddNumbers),
        st.tuples(st.just("state"), _place, st.just("blockedDOFs"), st.sampled_from(("", "x", "xyzXYZ", "q"))),
        st.tuples(st.just("state"), _place, st.just("ori"), st.lists(oddNumbers, min_size=4, max_size=4)),
        st.tuples(st.just("shape"), _place, st.sampled_from(("deformation", "element", "inner")), st.one_of(levels, elements, inners, anything)),
        st.tuples(st.just("shape"), _place, st.sampled_from(("contactThickness", )), st.one_of(logarithmic(-4, -1), oddNumbers)),
        st.tuples(st.just("shape"), _place, st.sampled_from(("segments", "cells")), st.one_of(st.integers(1, 6), st.sampled_from((0, -1, 65, 2**31)))),
        st.tuples(st.just("shape"), _place, st.just("corners"), corners()),
        st.tuples(st.just("material"), _place, st.sampled_from(sorted(_goodMaterial)), oddNumbers),
        st.tuples(st.just("mortar"), _place, st.sampled_from(sorted(_goodMortar)), oddNumbers),
        st.tuples(st.just("body"), _place, st.just("material"), st.sampled_from(("brick", "frict", "elast", "none"))),
        st.tuples(st.just("body"), _place, st.sampled_from(("dynamic", "bounded", "aspherical")), st.booleans()),
        st.tuples(st.just("engine"), st.just("BrickDynamics"), st.just("damping"), oddNumbers),
        st.tuples(st.just("engine"), st.just("BrickDynamics"), st.just("levelTime"), mostly(_levelTimes, oddNumbers)),
        _onDemand.filter(len).flatmap(lambda given: st.sampled_from(sorted(given))
        .map(lambda name: ("engine", "DeformationOnDemand", name, given[name]))),
        st.tuples(st.just("engine"), st.just("BrickTimeStepper"), st.sampled_from(("safety", "active")), st.one_of(oddNumbers, st.booleans())),
        st.tuples(st.just("engine"), st.just("GroundMotion"), st.sampled_from(("dt", "startTime")), oddNumbers),
        st.tuples(st.just("engine"), st.just("GroundMotion"), st.just("ids"), st.lists(st.integers(-1, 7), max_size=2)),
        st.tuples(st.just("engine"), st.just("GroundMotion"), st.just("acceleration"), st.lists(oddVectors, max_size=3)),
        st.tuples(st.just("engine"), st.just("NewtonIntegrator"), st.just("gravity"), oddVectors),
        st.tuples(st.just("engine"), st.sampled_from(engineNames), st.just("dead"), st.booleans()),
        st.tuples(st.just("scene"), st.just(0), st.just("dt"), st.one_of(st.sampled_from((1e-6, 1e-5, 1e-3, 0.1)), oddNumbers)),
        st.tuples(st.just("scene"), st.just(0), st.sampled_from(("trackEnergy", "timingEnabled")), st.booleans()),
)
_actions = st.one_of(
        st.tuples(st.just("step"), st.sampled_from((1, 1, 2, 5, 20))), st.tuples(st.just("run"), st.sampled_from((1, 5))),
        st.tuples(st.just("joints"), options(tolerance=st.one_of(st.sampled_from((1e-6, 1e-3)), oddNumbers),
        normal=st.one_of(st.just([0, 0, 1]), oddVectors), ids=st.lists(st.integers(-1, 6), max_size=3))),
        st.tuples(st.just("equilibrium"), options(tolerance=oddNumbers, mostIterations=st.integers(-1, 20), gravity=oddVectors)),
        st.tuples(st.just("set"), _sets), st.tuples(st.just("set"), _sets),
        st.tuples(st.just("saved"), st.sampled_from((".xml", ".yade", ".xml.bz2"))), st.tuples(st.just("erase"), _place),
        st.tuples(st.just("unjoin"), _place), st.tuples(st.just("again"), _place),
        st.tuples(st.just("motion"), _motions), st.tuples(st.just("level"), st.one_of(st.none(), _place), _newLevels),
        _levelTimes.map(lambda time: ("set", ("engine", "BrickDynamics", "levelTime", time))), st.tuples(st.sampled_from(("settle", "effects"))),
        st.tuples(st.just("terms"), _terms), st.tuples(st.just("loop"), _loops), st.tuples(st.just("onDemand"), _onDemand),
        st.tuples(st.just("force"), _place, oddVectors), st.tuples(st.sampled_from(("assembled", "frequencies", "rest", "record", "picture", "bill",
        "limit", "stresses", "clear", "solve", "progress", "reset"))),
)


def _usualStart(lists):
	"""Mortar and some steps first, as in any scene, before things go wrong."""
	return st.booleans().flatmap(lambda usual: lists.map(lambda rest: [["joints", {}], ["step", 2]] + rest) if usual else lists)


scenes = st.fixed_dictionaries(
        {
                "kind": st.just("scene"), "materials": st.lists(st.tuples(_usualMaterials, _usualMortars), min_size=2, max_size=2), "support": _supports,
                "bricks": st.lists(_bricks, min_size=1, max_size=4),
                "engines": mostly(st.just(list(_usualEngines)), _engineLists, 3), "without": mostly(st.just([]), _functors, 2),
                "verletDist": st.sampled_from((0.0, 0.01, -0.05, 0.2)),
                "actions": _usualStart(st.lists(_actions, min_size=1, max_size=8))
        }, optional={"loop": _loops, "terms": _terms, "onDemand": _onDemand}
)

# Files

_floatsInText = st.one_of(st.floats(-20, 20).map(lambda x: f"{x:.5E}"), st.sampled_from(("nan", "inf", "1e400", "--3", "1.2.3", "", "1,5", "1D-3", "x",
        "0x10", "1_0")))
_breaks = st.lists(st.tuples(st.sampled_from(("cut", "flip", "insert", "delete", "double", "line")), st.integers(0, 10**6), st.integers(0, 255)), max_size=4)


def _at2Text(count, interval, rows, unit):
	header = f"PEER NGA STRONG MOTION DATABASE RECORD\nEvent, station\nACCELERATION TIME SERIES IN UNITS OF {unit}\nNPTS={count}, DT={interval} SEC\n"
	return header + "\n".join("  ".join(row) for row in rows) + "\n"


_at2 = st.builds(
        _at2Text, st.one_of(st.integers(0, 12), st.sampled_from(("", "nan", 10**12, -4, "8.0"))), st.one_of(st.just(".0050"), _floatsInText),
        st.lists(st.lists(_floatsInText, min_size=1, max_size=5), max_size=4),
        st.sampled_from(("G", "G", "CM/S2", ""))
)
_columns = st.builds(
        lambda head, separator, rows: head + "\n".join(separator.join(row) for row in rows),
        st.sampled_from(("", "# name: x\n", "t ax ay\n", "# synthetic: yes\n", "t,a\nx,y\n")), st.sampled_from((" ", ",", ";", "\t")),
        st.lists(st.lists(_floatsInText, min_size=2, max_size=2), max_size=5)
)
files = st.fixed_dictionaries({
        "kind": st.just("file"), "text": st.one_of(st.just((fuzzFolder.parent / "python" / "pulse.at2").read_text()), _at2, _columns), "breaks": _breaks,
        "reader": st.sampled_from(("at2", "columns")),
        "options": options(units=mostly(st.sampled_from(("g", "m/s2", "cm/s2")), anything), dt=st.one_of(st.none(), st.just(0.01), anything),
        axes=st.one_of(st.none(), st.sampled_from(("x", "xy", "xx", "q", "")), anything),
                           axis=st.one_of(st.sampled_from(("x", "z")), anything), name=st.one_of(st.none(), oddTexts))
})

#: Scenes saved by YADE, then broken. Values of attributes are changed in the XML.
savedScenes = st.fixed_dictionaries({
        "kind": st.just("saved"), "when": st.integers(0, 3), "format": st.just(".xml"), "breaks": st.one_of(st.just([]), _breaks),
        "values": st.lists(st.tuples(st.integers(0, 10**6), st.sampled_from(("0", "1", "-1", "7", "nan", "inf", "-1e30", "1e30", "2147483647",
        "-2147483648", "99999999999", "x", "", "4"))), max_size=3),
        "steps": st.integers(0, 20)
})

# Arguments of the package's functions

_brickArguments = options(
        size=mostly(st.lists(logarithmic(-2, 1), min_size=3, max_size=3), anything), center=mostly(oddVectors, anything),
        orientation=st.one_of(_quaternions, anything), material=st.one_of(st.just("good"), anything),
        deformation=st.one_of(levels, anything), element=st.one_of(elements, anything), inner=st.one_of(inners, anything),
        contactThickness=st.one_of(logarithmic(-4, -1), anything), segments=st.one_of(st.integers(1, 6), anything),
        cells=st.one_of(st.none(), st.integers(1, 3), anything), fixed=anything, color=st.one_of(st.none(), anything),
        corners=st.one_of(st.none(), corners(), anything)
)
_few = st.integers(-1, 4)
_calls = st.one_of(
        st.tuples(st.just("brick"), _brickArguments), st.tuples(st.sampled_from(("straightJointWall", "englishBondWall")), st.builds(
                lambda a, b: {**a, **b}, _brickArguments, options(columns=mostly(_few, anything.filter(lambda v: not isinstance(v, int) or v < 5)),
                courses=mostly(_few, anything.filter(lambda v: not isinstance(v, int) or v < 5)),
                                                                  origin=st.one_of(oddVectors, anything), halfBricksFirst=anything))),
        st.tuples(st.just("Motion"), st.fixed_dictionaries({"dt": st.one_of(st.just(0.01), anything),
        "acceleration": st.one_of(st.lists(oddVectors, max_size=4), anything), "name": st.one_of(st.just("a motion"), anything)},
                                                           optional={"synthetic": anything})),
        st.tuples(st.just("syntheticNearFault"), options(
                duration=st.one_of(st.floats(5, 12), oddNumbers.filter(lambda v: not 100 < v < inf)),
                dt=st.one_of(st.sampled_from((0.01, 0.02)), oddNumbers.filter(lambda v: not 0 < v < 0.002)), peak=st.one_of(st.floats(1, 20), anything),
                pulsePeriod=st.one_of(st.floats(0.1, 4), anything), pulseVelocity=st.one_of(st.floats(0, 2), anything),
                phaseTimes=st.one_of(st.just([3.0, 5.0]), anything), ratios=st.one_of(st.lists(st.floats(0, 1), min_size=3, max_size=3), anything),
                seed=st.one_of(st.integers(0, 9), anything))),
        st.tuples(st.just("resampled"), st.fixed_dictionaries({"dt": st.one_of(st.floats(0.001, 0.01),
        anything.filter(lambda v: not isinstance(v, (int, float)) or not 0 < v < 1e-4))})),
        st.tuples(st.just("scaled"), st.fixed_dictionaries({"factor": anything})),
        st.tuples(st.just("runWithProgress"), options(duration=anything, until=anything, every=anything, callback=st.none())),
        st.tuples(st.just("isAtRest"), options(energyRatio=anything, imbalance=anything)),
        st.tuples(st.just("GroundMotion"), options(dt=anything, acceleration=anything, startTime=anything, ids=anything)),
        st.tuples(st.just("wallPicture"), options(view=st.one_of(st.sampled_from(("side", "plan", "3d")), anything), time=st.one_of(st.none(), anything),
        ground=st.one_of(st.none(), anything), limits=st.one_of(st.none(), st.lists(oddNumbers, min_size=4, max_size=4), anything),
                                                  colorRange=st.one_of(st.none(), anything), title=st.one_of(st.none(), anything),
                                                  marks=st.one_of(st.none(), anything), width=st.one_of(st.just(3.0), st.floats(max_value=5), oddTexts),
                                                  dpi=st.one_of(st.just(50), st.floats(max_value=100), oddTexts),
                                                  bricks=st.one_of(st.lists(corners().map(lambda c: [c, None]), min_size=1, max_size=2), anything))),
        st.tuples(st.just("historyPlot"), options(time=st.one_of(st.just([0.0, 1.0]), anything), histories=st.one_of(st.just({"A": [[0, 0, 0], [1, 1, 1]]}),
        st.fixed_dictionaries({"A": st.lists(oddVectors, min_size=2, max_size=2)}), anything), timeRange=st.one_of(st.none(), anything))),
        st.tuples(st.just("engines"), _loops), st.tuples(st.just("effects"), options(engines=anything)), st.tuples(st.just("DeformationOnDemand"), _onDemand),
        st.tuples(st.just("judgedRow"), st.fixed_dictionaries({"id": anything, "got": anything},
        optional={"expected": anything, "tolerance": anything, "limit": anything})),
        st.tuples(st.just("frequencies"), st.fixed_dictionaries({"count": anything})),
        st.tuples(st.just("solve"), st.fixed_dictionaries({"loads": anything})), st.tuples(st.just("place"), st.fixed_dictionaries({"id": anything})),
        st.tuples(st.just("patches"), st.fixed_dictionaries({"colors": anything})),
)
calls = st.fixed_dictionaries({"kind": st.just("call"), "call": _calls})

#: By name, with the share of all examples that each gets.
kinds = {"shape": (shapes, 0.15), "material": (materials, 0.1), "scene": (scenes, 0.4), "file": (files, 0.1), "saved": (savedScenes, 0.1),
        "call": (calls, 0.15)}


def plain(example):
	"""As it comes out of JSON: what is handed to a YADE, and printed, is the same."""
	return json.loads(json.dumps(example))
