# SPDX-License-Identifier: GPL-2.0-or-later
# The same wall of YADE's own polyhedra: rigid, without mortar, volumetric contact law.
"""Wall of cubes with straight joints, dry:  build/yade -n -x -j1 benchmarks/scenes/polyhedra.py --columns 24 --courses 24

Cubes stand where the springs of their faces carry their weight, on a fixed course of the same cubes; friction holds them.
"""

import math
import os
import sys

from yade import O, Bo1_Polyhedra_Aabb, ForceResetter, Ig2_Polyhedra_Polyhedra_PolyhedraGeom, InsertionSortCollider, InteractionLoop
from yade import Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys, Law2_PolyhedraGeom_PolyhedraPhys_Volumetric, NewtonIntegrator, PolyhedraMat
from yade import config, log, polyhedra_utils

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import common

chosen = common.options(__doc__, columns=24, courses=24, seconds=2.0, warm=5)
log.setLevel("Default", log.ERROR)  # its geometry warns at every step otherwise

# two equal cubes push each other with young/2 times the volume that they share: as stiff as a brick in series, E A / L
stiffness = common.young * common.side  # of a face [N/m]
material = PolyhedraMat(density=common.density, young=2 * common.young / common.side, poisson=0.01, frictionAngle=common.frictionAngle)
halves = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
corners = [[0.5 * common.side * sign for sign in signs] for signs in halves]


def addCube(column, course):
	"""A cube where its column of the wall carries it; course -1 is fixed."""
	body = polyhedra_utils.polyhedra(material, v=corners, fixed=course < 0)
	settled = common.brickMass * common.gravity / stiffness * sum(chosen.courses - below for below in range(course + 1))
	body.state.pos = (common.side * (column + 0.5), 0, common.side * (course + 0.5) - settled)
	O.bodies.append(body)


for course in range(-1, chosen.courses):
	for column in range(chosen.columns):
		addCube(column, course)
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Polyhedra_Aabb()], verletDist=0.002),
        InteractionLoop(
                [Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
        ),
        NewtonIntegrator(damping=0.3, gravity=(0, 0, -common.gravity)),
]
O.dt = 0.2 * math.sqrt(common.brickMass / stiffness)
timed = common.timedSteps(chosen.seconds, chosen.warm)

carrying = sum(1 for i in O.interactions if i.isReal and i.phys.normalForce.norm() > 0)
if carrying < chosen.columns * chosen.courses:
	sys.exit(f"{carrying} contacts carry a load; every cube has to stand on another")
common.finish(bricks=chosen.columns * chosen.courses, dt=O.dt, interactions=O.interactions.countReal(), yade=config.version, **timed)
