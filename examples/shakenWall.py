# SPDX-License-Identifier: GPL-2.0-or-later
"""One run of a small wall of rigid bricks under a synthetic motion: a row of the tables of examples 14 and 16, and a scene of its own.

    build/yade -n -x examples/shakenWall.py            alone, with the defaults below
    build/yade-batch walls.table examples/shakenWall.py     for each row of a table with any of the columns below

Reads its parameters as YADE's scripts do (readParamsFromTable) and records what came of it in result.json of its folder: the largest drift of the top course,
the share of failed mortar, whether bricks have fallen. The motion is made by yade_brick.syntheticNearFault: it is no record of any earthquake.
"""

import math

import numpy as np

import yade_brick
from yade_brick import study, syntheticNearFault

readParamsFromTable(
        noTableOk=True,
        pga=4.0,  # peak ground acceleration [m/s2]
        seed=1,  # of the motion
        columns=3, courses=4, side=0.2,  # bricks in a course, courses, edge of a brick [m]
        pulsePeriod=0.8,  # [s]
        duration=5.0  # of the shaking [s]
)
from yade.params.table import *

gravity = 9.8  # [m/s2]
phi = math.radians(32)


def build():
	"""Ground and bricks."""
	mortar = Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=phi, compressiveStrength=4.9e5)
	adobe = BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=phi, mortar=mortar)
	O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
	masonry = yade_brick.straightJointWall(columns, courses, (side, side, side), material=adobe, deformation="rigid", contactThickness=2e-3)
	O.bodies.append(masonry.bodies)
	return masonry


def groundMotion():
	"""The motion in its shape, which the seed chooses, scaled to the peak ground acceleration."""
	shape = syntheticNearFault(duration=5.0, pulsePeriod=pulsePeriod, pulseVelocity=0.4, phaseTimes=(1.5, 2.8), peak=0.8 * gravity, seed=seed)
	return shape.scaled(pga / shape.peak().max())


masonry = build()
loop = O.engines = yade_brick.engines(gravity=(0, 0, -gravity), motion=groundMotion())
MortarJoints()()
StaticEquilibrium()()
O.step()  # finds the time step
top = masonry.courses[-1]
largest = 0.0


def look():
	"""Follows the drift: displacement of the top course over the height of the wall. A wall that has come down is shaken no further."""
	global largest
	largest = max(largest, max(abs(body.state.displ()[0]) for body in top) / (courses * side))
	return fallen() > 0


def fallen():
	"""Bricks whose centre has come down by more than half a brick."""
	return sum(body.state.displ()[2] < -0.5 * side for body in masonry.bodies)


stage = yade_brick.runWithProgress(duration=duration, label=O.tags["description"] if "description" in O.tags.keys() else "shaking", every=0.01, callback=look)
failed = loop.law.tensionFailures + loop.law.shearFailures + loop.law.compressionFailures
study.record({"collapsed": fallen() > 0, "drift": largest, "failedSegments": failed, "fallen": fallen(), "steps": O.iter, "wallSeconds": stage.wallSeconds})
