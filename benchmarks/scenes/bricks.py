# SPDX-License-Identifier: GPL-2.0-or-later
# A wall of mortared bricks that stays intact, under its weight or nearly without.
"""Wall of cubes with straight joints:  build/yade -n -x -j1 benchmarks/scenes/bricks.py --columns 24 --courses 24 --model deform

At rest under its weight (`--load weight`, StaticEquilibrium), or let go under a hundredth of it (`--load slight`): a large wall is then as intact as a
small one, and needs no static solution.
"""

import os
import sys

from yade import O, Bo1_Wall_Aabb, ForceResetter, InsertionSortCollider, InteractionLoop, NewtonIntegrator, config
from yade.utils import wall as supportingWall

import yade_brick

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import common

chosen = common.options(__doc__, columns=24, courses=24, model=("deform", "rigid"), segments=4, load=("weight", "slight"), seconds=2.0, warm=50)
memory = {"before": common.residentKilobytes()}

# ten times as strong as the paper's, which shears where the lower courses of a wall of 4.8 m spread over the ground
mortar = yade_brick.Mortar(tensileStrength=4.6e4, cohesion=2.9e4, frictionAngle=common.frictionAngle, compressiveStrength=4.9e6)
adobe = yade_brick.BrickMat(
        young=common.young, poisson=common.poisson, density=common.density, frictionAngle=common.frictionAngle, mortar=mortar
)
O.bodies.append(supportingWall(0, axis=2, sense=1, material=adobe))
O.bodies.append(
        yade_brick.straightJointWall(
                chosen.columns,
                chosen.courses,
                size=3 * (common.side,),
                material=adobe,
                deformation="rigid" if chosen.model == "rigid" else "trilinear",
                contactThickness=5e-3,
                segments=chosen.segments,
        ).bodies
)
memory["bodies"] = common.residentKilobytes()

law = yade_brick.Law2_BrickGeom_BrickPhys_Mortar()
O.engines = [
        ForceResetter(),
        InsertionSortCollider([yade_brick.Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0.01),
        InteractionLoop(
                [yade_brick.Ig2_Brick_Brick_BrickGeom(), yade_brick.Ig2_Wall_Brick_BrickGeom()],
                [yade_brick.Ip2_BrickMat_BrickMat_BrickPhys()],
                [law],
        ),
        yade_brick.BrickTimeStepper(),
        yade_brick.BrickDynamics(),
        NewtonIntegrator(damping=0, gravity=(0, 0, -common.gravity * (1 if chosen.load == "weight" else 0.01))),
]
yade_brick.MortarJoints()()
memory["mortar"] = common.residentKilobytes()
if chosen.load == "weight":
	yade_brick.StaticEquilibrium()()
timed = common.timedSteps(chosen.seconds, chosen.warm)
memory["steps"] = common.residentKilobytes()

failed = law.tensionFailures + law.shearFailures + law.compressionFailures
if failed:
	sys.exit(f"{failed} segments have failed in a wall that has to stay intact")
common.finish(bricks=chosen.columns * chosen.courses, dt=O.dt, interactions=O.interactions.countReal(), memory=memory, yade=config.version, **timed)
