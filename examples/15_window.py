# SPDX-License-Identifier: GPL-2.0-or-later
"""A small wall cracks in YADE's own 3-D window: bricks coloured by a field, joints by how their segments fail.

    build/yade examples/15_window.py [--field NAME] [--duration S]
    xvfb-run -a build/yade -x examples/15_window.py --snapshot FILE [--out DIR]     without a screen: saves the last view and ends

       z   +---+---+---+---+---+
       ^   |   |   |   |   |   |    5 x 4 cubes of adobe of 0.2 m with straight joints, on the ground, shaken along the wall by
       |   +---+---+---+---+---+    cycles of 2 Hz that grow; deformation is drawn 60 times as large as it is.
       +-> ======================   In the window: dark blue bricks are pressed most, yellow ones least, or pulled;
           x                        between them mortar that holds is light, failed in tension cyan, in shear yellow.

To be changed while it runs, in YADE's prompt or in the controller's display tab:

    Gl1_Brick.field = 'speed'            # displacement, verticalStress, principalStress, vonMisesStress, level, utilisation, failed, color
    Gl1_Brick.range = (-3e4, 0)          # NaN: the least and the largest at present, as shownRange tells
    Gl1_Brick.deformationScale = 200
    Gl1_BrickGeom.intact = False         # cracks only
    yade.qt.Renderer().intrPhys = True   # forces as arrows
"""

import argparse
import sys
from math import nan, pi, radians, sin

import yade_brick
from yade import qt
from yade_brick import report, window

fields = ("color", "displacement", "speed", "meanStress", "verticalStress", "principalStress", "vonMisesStress", "level", "utilisation", "failed")
side, gravity = 0.2, 9.8  # of a brick [m], [m/s2]


def options():
	parser = argparse.ArgumentParser(prog="15_window.py", description=__doc__.splitlines()[0])
	parser.add_argument("--field", choices=fields, default="verticalStress", help="what bricks are coloured by (default: verticalStress)")
	parser.add_argument("--duration", type=float, default=1.2, help="seconds of shaking (default: 1.2)")
	parser.add_argument("--snapshot", metavar="FILE", help="run to the end at once, save the view as this PNG file and end")
	parser.add_argument("--out", metavar="DIR", default="result-15", help="with --snapshot: folder for result.json (default: result-15)")
	return parser.parse_args()


def buildWall():
	"""The wall at rest under its weight, and the engines that will shake it; the law."""
	mortar = Mortar(tensileStrength=8e3, cohesion=12e3, frictionAngle=radians(32), compressiveStrength=4.9e5)
	adobe = BrickMat(young=9.8e6, poisson=0.25, density=1800, frictionAngle=radians(32), mortar=mortar)
	O.materials.append(adobe)
	ground = wall(0, axis=2, sense=1, material=adobe)
	ground.shape.wire, ground.shape.color = True, (0.6, 0.6, 0.6)
	O.bodies.append(ground)
	O.bodies.append(yade_brick.straightJointWall(5, 4, (side, side, side), material=adobe, contactThickness=2e-3).bodies)
	shake = yade_brick.Motion(0.01, [(5 * sin(4 * pi * 0.01 * i) * min(1, 0.01 * i), 0, 0) for i in range(301)], name="growing cycles of 2 Hz")  # [m/s2]
	O.engines = loop = yade_brick.engines(gravity=(0, 0, -gravity), motion=shake)
	MortarJoints()()
	StaticEquilibrium()()
	O.step()
	return loop.law


def openWindow(field):
	"""The view, and what it draws."""
	Gl1_Brick.field, Gl1_Brick.deformationScale, Gl1_Brick.range = field, 60, (nan, nan)
	qt.Renderer().intrGeom = True
	window.openView("3d", around=((0.02, -0.1, 0), (0.98, 0.2, 0.78)))


def runInForeground(duration):
	"""Steps and paintings in turn."""
	end = O.time + duration
	while O.time < end:
		O.run(200, True)
		window.processEvents(0)


chosen = options()
law = buildWall()
openWindow(chosen.field)
if chosen.snapshot is None:
	O.stopAtTime = O.time + chosen.duration
	O.run()  # in the background; the window and YADE's prompt stay alive
else:
	runInForeground(chosen.duration)
	window.saveView(chosen.snapshot)
	joints = [i.phys for i in O.interactions if i.isReal and i.phys.segmentState]
	segments = sum(len(phys.segmentState) for phys in joints)
	failed = sum(state != 0 for phys in joints for state in phys.segmentState)
	rows = [report.judgedRow("share of segments that hold: the wall has cracked", 1 - failed / segments, limit=0.999)]
	failures = dict(tension=law.tensionFailures, shear=law.shearFailures, compression=law.compressionFailures)
	report.writeResult(chosen.out, rows, failures=failures, shownRange=list(Gl1_Brick.shownRange))
	print(report.table(rows, title=f"View saved as {chosen.snapshot}"))
	sys.exit(report.exitStatus(rows))
