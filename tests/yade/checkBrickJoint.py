# SPDX-License-Identifier: GPL-2.0-or-later
# Two bricks in mortar are pulled apart: the joint carries the tensile strength times its area, then breaks and carries nothing. Script for YADE's --check.
from yade_brick.build import brick

side, strength = .2, 4.6e3
mortar = Mortar(tensileStrength=strength, cohesion=1e4, frictionAngle=.5585, compressiveStrength=1e6)
O.materials.append(BrickMat(young=9.8e6, poisson=.25, density=1800, frictionAngle=.5585, mortar=mortar))
O.bodies.append(brick((side, side, side), material=O.materials[-1], deformation='rigid', fixed=True))
O.bodies.append(brick((side, side, side), center=(0, 0, side), material=O.materials[-1], deformation='trilinear', contactThickness=.005))
MortarJoints()()
O.bodies[1].state.blockedDOFs = 'xyzXYZ'
O.bodies[1].state.vel = (0, 0, 1e-4)
O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Brick_Aabb()], verletDist=0),
        InteractionLoop([Ig2_Brick_Brick_BrickGeom()], [Ip2_BrickMat_BrickMat_BrickPhys()], [Law2_BrickGeom_BrickPhys_Mortar(label='brickLaw')]),
        BrickDynamics(damping=.3),
        NewtonIntegrator(damping=0),
]
O.dt = 1e-4
largest = 0
while O.bodies[1].state.displ()[2] < 4e-4:
	O.step()
	largest = max(largest, -O.forces.f(1)[2])
# in a step the force grows by about 1e-4 m/s * 1e-4 s * kn A, half a percent of the whole at most
if abs(largest / (strength * side**2) - 1) > 5e-3: raise YadeCheckError('the joint carried %g N instead of %g N' % (largest, strength * side**2))
if brickLaw.tensionFailures != 16: raise YadeCheckError('%d segments failed in tension instead of 16' % brickLaw.tensionFailures)
if O.forces.f(1).norm() > 0: raise YadeCheckError('the broken joint carries %g N' % O.forces.f(1).norm())
