# SPDX-License-Identifier: GPL-2.0-or-later
"""A masonry wall of 6 x 6 deformable bricks settles under its weight, is shaken in its plane, cracks and falls.

    build/yade -n -x examples/02_straight_joint_wall.py [--model rigid|deform] [--motion FILE] [--duration S] [--out DIR] [--help]

       z   +---+---+---+---+---+---+     Straight joints: cubes of 0.2 m, joined to each other and to the ground by mortar
     1.2 m | A |   |   |   |   | B |     (Furukawa et al. 2014, section 4.2, Fig. 7 (a), Tables 1 and 3). A and B, whose
           +---+---+---+---+---+---+     displacement relative to the ground is recorded, are our choice: the paper's text
           |   |   |   |   |   |   |     does not say which upper bricks it means.
            ...
           +---+---+---+---+---+---+
         ========================== ---> x, direction of the ground motion

Leaves in DIR: histories.csv (A and B, failed segments), histories.png, wall.png (the wall at chosen times), wall.npz (all of it as arrays),
result.json. The default motion is synthetic, made by yade_brick.syntheticNearFault: it is no record of any earthquake.

Materials, engines, settling and recording are in paperWall.py beside this file, in the order in which they happen.
"""

import os
import sys

from yade_brick import build

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import paperWall

chosen = paperWall.options(__doc__, out="result-02")
motion = paperWall.groundMotion(chosen)
side = paperWall.side
bricks = build.straightJointWall(paperWall.columns, paperWall.courses, (side, side, side), **paperWall.brickOptions(chosen))

run = paperWall.WallRun(bricks, chosen)  # bricks, ground, mortar and engines are in the scene
run.settle()
run.shake(motion)

# The default motion throws this wall down; how many bricks of it is a matter of chance.
expectCollapse = motion.synthetic and chosen.motion is None and chosen.direction == "x" and chosen.scale >= 1 and chosen.duration >= 6
sys.exit(run.write(leastFallen=6 if expectCollapse else 0))
