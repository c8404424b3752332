# SPDX-License-Identifier: GPL-2.0-or-later
# A small wall at rest under its weight, ready to run: what fragments of scenes in the documentation are run in (see pages.sceneOf).
from math import radians

import yade_brick

O.reset()
mortar = Mortar(tensileStrength=4.6e3, cohesion=2.9e3, frictionAngle=radians(32), compressiveStrength=4.9e5)
adobe = BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=radians(32), mortar=mortar)
O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
masonry = yade_brick.straightJointWall(columns=2, courses=2, size=(.2, .2, .2), material=adobe, contactThickness=2e-3)
O.bodies.append(masonry.bodies)
loop = yade_brick.engines()
O.engines = loop
MortarJoints()()
StaticEquilibrium()()
