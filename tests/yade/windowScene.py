# SPDX-License-Identifier: GPL-2.0-or-later
# What testWindow.py has YADE draw, in a window:  xvfb-run -a build/yade -x tests/yade/windowScene.py DIR
# Leaves in DIR a picture for each scene, and facts.json: of each the camera, and what the picture must show where.
import json, math, os, sys

import yade_brick
from yade import qt
from yade_brick import window

out, facts = sys.argv[1], {}


def save(name, view, **more):
	window.saveView(os.path.join(out, name + '.png'))
	camera = dict(eye=tuple(view.eyePosition), direction=tuple(view.viewDir), up=tuple(view.upVector))
	facts[name] = dict(camera=camera, shownRange=tuple(Gl1_Brick.shownRange), largestForce=Gl1_BrickPhys.largest, **more)


def openView(**options):
	return window.openView('elevation', around=((-.5, -.1, -.3), (.5, .1, .3)), size=(480, 320), **options)


def bricks(*centres, size=(.2, .2, .2), material=None, **options):
	"""Cubes in the scene, one for each centre; their shapes are deformable."""
	O.reset()
	material = material or BrickMat(young=1e7, poisson=.25, density=2000, frictionAngle=.5)
	O.materials.append(material)
	made = [yade_brick.brick(size, center=centre, material=material, contactThickness=.01, **options) for centre in centres]
	O.bodies.append(made)
	return made


# own colours
left, right = bricks((-.25, 0, 0), (.25, 0, 0))
left.shape.color, right.shape.color = (.8, .1, .1), (.1, .6, .1)
view = openView()
save('color', view)
Gl1_Brick.wire = True
save('wire', view)
Gl1_Brick.wire = False

# a field
left.state.vel, right.state.vel = (0, 0, 0), (3, 0, 4)
Gl1_Brick.field = 'speed'
save('speed', view)
Gl1_Brick.range = (0, 10)
save('range', view)
Gl1_Brick.range = (math.nan, math.nan)
values = {}
for field in ('displacement', 'meanStress', 'verticalStress', 'principalStress', 'vonMisesStress', 'level', 'utilisation', 'failed'):
	Gl1_Brick.field = field
	window.saveView(os.path.join(out, 'field.png'))
	values[field] = tuple(Gl1_Brick.shownRange)
facts['fields'] = values

# deformation: a column under its weight, of elastic bricks glued to the ground
Gl1_Brick.field = 'verticalStress'
strong = Mortar(tensileStrength=1e9, cohesion=1e9, frictionAngle=.5, compressiveStrength=1e9)
adobe = BrickMat(young=1e7, poisson=.25, density=2000, frictionAngle=.5, mortar=strong)
lower, upper = bricks((0, 0, -.1), (0, 0, .1), material=adobe, deformation='refined', segments=4)
O.bodies.append(wall(-.2, axis=2, sense=1, material=lower.material))
O.engines = yade_brick.engines(gravity=(0, 0, -9.81))
MortarJoints()()
StaticEquilibrium()()
O.step()
qt.Renderer().wire = False
view = openView()
save('column', view, stress=[b.shape.stress()[2] for b in (lower, upper)])
Gl1_Brick.deformationScale = 1500
bulge = lower.shape.displacement[15]  # of 26 nodes, that half way up the front edge on the right
save('magnified', view, bulge=1500 * bulge[0], toViewer=-1500 * bulge[1])
Gl1_Brick.deformationScale = 1

# joints: one torn off and one slid off its base altogether, one that holds, under gravity; rigid bricks, free in one direction each, so that all
# segments do the same
Gl1_Brick.field = 'color'
weak = Mortar(tensileStrength=1e4, cohesion=1e4, frictionAngle=.5, compressiveStrength=1e6)
places = (-.35, 0, .35)
adobe = BrickMat(young=1e7, poisson=.25, density=2000, frictionAngle=.5, mortar=weak)
made = bricks(*[(x, 0, z) for x in places for z in (-.1, .1)], material=adobe, deformation='rigid', segments=4)
for b in made: b.shape.color = (.6, .35, .25)
for b in made[::2]: b.state.blockedDOFs = 'xyzXYZ'
O.engines = loop = yade_brick.engines(gravity=(0, 0, -9.81))
MortarJoints()()
torn, slid, held = made[1::2]
torn.state.vel, torn.state.blockedDOFs = (0, 0, .5), 'xyXYZ'
slid.state.vel, slid.state.blockedDOFs = (.5, 0, 0), 'yzXYZ'
loop.stepper.active, O.dt = False, 2e-5
O.run(200, True)  # 2 mm of motion
law = loop.law
qt.Renderer().intrGeom = True
save('joints', view, places=places, failures=(law.tensionFailures, law.shearFailures, law.compressionFailures))
Gl1_BrickGeom.intact = False
save('cracksOnly', view, places=places)
Gl1_BrickGeom.intact = True
qt.Renderer().intrGeom = False
qt.Renderer().intrPhys = True
save('forces', view, places=places)
qt.Renderer().intrPhys = False

# painted while it runs: bricks that change their level, joints that end, contacts that come and go
O.reset()
weak = Mortar(tensileStrength=2e3, cohesion=2e3, frictionAngle=.5, compressiveStrength=4e5)
adobe = BrickMat(young=1e7, poisson=.25, density=1800, frictionAngle=.5, mortar=weak)
O.bodies.append(wall(0, axis=2, sense=1, material=adobe))
masonry = yade_brick.straightJointWall(3, 3, (.2, .2, .2), material=adobe, contactThickness=2e-3)
O.bodies.append(masonry.bodies)
shake = yade_brick.Motion(.01, [(15 * math.sin(20 * i * .01), 0, 0) for i in range(400)], name='sine')
O.engines = loop = yade_brick.engines(gravity=(0, 0, -9.8), motion=shake, onDemand=True)
MortarJoints()()
StaticEquilibrium()()
O.step()
qt.Renderer().intrGeom = qt.Renderer().intrPhys = True
Gl1_BrickGeom.contacts = True
openView()
painted, fields = 0, ('utilisation', 'failed', 'principalStress', 'level')
O.run()
until = O.realtime + 60
while (O.time < .6 or painted < 8) and O.realtime < until:
	Gl1_Brick.field = fields[painted % len(fields)]
	window.saveView(os.path.join(out, 'running.png'))
	painted += 1
O.pause()
O.wait()
levels = sorted(set(len(b.shape.displacement) for b in masonry.bodies))
facts['running'] = dict(painted=painted, time=O.time, failed=loop.law.tensionFailures + loop.law.shearFailures, levels=levels)

with open(os.path.join(out, 'facts.json'), 'w') as file:
	json.dump(facts, file)
