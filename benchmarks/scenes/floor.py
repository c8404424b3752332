# SPDX-License-Identifier: GPL-2.0-or-later
# YADE's floor: what its loop costs when there is next to nothing to compute.
"""Separate spheres of a brick's mass at rest on a wall:  build/yade -n -x -j1 benchmarks/scenes/floor.py --bodies 576

One contact a sphere with the leanest law, and the same collider and engines as the wall of bricks.
"""

import math
import os
import sys

from yade import O, Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop
from yade import Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator, config
from yade.utils import sphere, wall

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import common

chosen = common.options(__doc__, bodies=576, seconds=2.0, warm=50)

radius, apart = (3 * common.side**3 / (4 * math.pi))**(1 / 3), 1.5 * common.side
material = FrictMat(young=common.young, poisson=common.poisson, density=common.density, frictionAngle=common.frictionAngle)
columns = math.ceil(math.sqrt(chosen.bodies))
# they sink in by what carries them: Ip2_FrictMat_FrictMat_FrictPhys gives young times the diameter between equal materials
stiffness = 2 * common.young * radius
sunk = common.brickMass * common.gravity / stiffness
O.bodies.append(wall(0, axis=2, sense=1, material=material))
for i in range(chosen.bodies):
	O.bodies.append(sphere((apart * (i % columns), apart * (i // columns), radius - sunk), radius, material=material))
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.01),
        InteractionLoop([Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
        NewtonIntegrator(damping=0, gravity=(0, 0, -common.gravity)),
]
O.dt = 0.2 * math.sqrt(common.brickMass / stiffness)
timed = common.timedSteps(chosen.seconds, chosen.warm)

contacts = O.interactions.countReal()
if contacts != chosen.bodies:
	sys.exit(f"{contacts} contacts of {chosen.bodies} spheres that all have to rest on the wall")
common.finish(bricks=chosen.bodies, dt=O.dt, interactions=contacts, yade=config.version, **timed)
