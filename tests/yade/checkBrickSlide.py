# SPDX-License-Identifier: GPL-2.0-or-later
# A brick on the ground is pushed: below friction it stays, above it slides with what is left of the push. Script for YADE's --check.
import math
from yade import utils
from yade_brick.build import brick

gravity, friction = 9.8, .3
O.materials.append(BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=math.atan(friction), dampingRatio=.1))
O.bodies.append(utils.wall(0, axis=2, sense=1, material=O.materials[-1]))
O.bodies.append(brick((.4, .2, .1), center=(0, 0, .05), material=O.materials[-1], contactThickness=.005))
block = O.bodies[1]
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
        InteractionLoop([Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar()]),
        BrickTimeStepper(),
        BrickDynamics(damping=.3),
        NewtonIntegrator(gravity=(0, 0, -gravity), damping=.3),
]
O.run(4000, True)
# not by label: all checks share one namespace, in which names of earlier ones live on
O.engines[-1].damping = O.engines[-2].damping = 0
for share in (.95, 1.5):
	O.forces.setPermF(1, (share * friction * block.state.mass * gravity, 0, 0))
	O.run(2000, True)
	speedBefore, timeBefore = block.state.vel[0], O.time
	O.run(1000, True)
	acceleration = (block.state.vel[0] - speedBefore) / (O.time - timeBefore)
	expected = max(0, share - 1) * friction * gravity
	if abs(acceleration - expected) > 1e-2 * friction * gravity:
		raise YadeCheckError('at %g of friction the brick accelerates by %g m/s2 instead of %g m/s2' % (share, acceleration, expected))
	if share < 1 and block.state.displ()[0] > 1e-4: raise YadeCheckError('below friction the brick moved by %g m' % block.state.displ()[0])
