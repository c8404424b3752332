# SPDX-License-Identifier: GPL-2.0-or-later
# A column of bricks of all deformation levels, in mortar, comes to rest under its weight: the ground carries the weight, each joint what is
# above it, and nothing cracks. Script for YADE's --check.
from yade import utils
from yade_brick.build import brick

side, density, gravity = .2, 1800., 9.8
mortar = Mortar(tensileStrength=1e4, cohesion=1e4, frictionAngle=.5585, compressiveStrength=1e6)
O.materials.append(BrickMat(young=9.8e6, poisson=.25, density=density, frictionAngle=.5585, mortar=mortar))
O.bodies.append(utils.wall(0, axis=2, sense=1, material=O.materials[-1]))
for k, level in enumerate(['rigid', 'uniform', 'trilinear', 'trilinear']):
	O.bodies.append(brick((side, side, side), center=(0, 0, side * (k + .5)), material=O.materials[-1], deformation=level, contactThickness=.005))
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Brick_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
        InteractionLoop(
                [Ig2_Brick_Brick_BrickGeom(), Ig2_Wall_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()],
                [Law2_BrickGeom_BrickPhys_Mortar(label='brickLaw')]
        ),
        BrickTimeStepper(),
        BrickDynamics(damping=.3),
        NewtonIntegrator(gravity=(0, 0, -gravity), damping=.3),
]
MortarJoints()()
O.run(12000, True)

weight = density * side**3 * gravity
for k in range(4):
	carried = O.interactions[k, k + 1].phys.normalForce[2]
	if abs(carried - (4 - k) * weight) > 1e-4 * weight:
		raise YadeCheckError('joint %d carries %g N instead of %g N' % (k, carried, (4 - k) * weight))
if abs(O.forces.f(0)[2] + 4 * weight) > 1e-4 * weight: raise YadeCheckError('the ground carries %g N instead of %g N' % (-O.forces.f(0)[2], 4 * weight))
cracked = brickLaw.tensionFailures + brickLaw.shearFailures + brickLaw.compressionFailures
if cracked: raise YadeCheckError('%d segments cracked under self weight' % cracked)
# half of its own weight, on the inner part, which is smaller all round by the contact part
mean, expected = O.bodies[4].shape.stress()[2], -weight / 2 / (side - .01)**2
if abs(mean / expected - 1) > 1e-4: raise YadeCheckError('the mean vertical stress of the uppermost brick is %g Pa instead of %g Pa' % (mean, expected))
