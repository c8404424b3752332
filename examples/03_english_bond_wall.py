# SPDX-License-Identifier: GPL-2.0-or-later
"""A masonry wall of deformable bricks with staggered joints settles under its weight, is shaken in its plane, and cracks.

    build/yade -n -x examples/03_english_bond_wall.py [--model rigid|deform] [--motion FILE] [--duration S] [--out DIR] [--help]

       z   +-+---+---+---+---+---+-+     What the paper calls English bond: cubes of 0.2 m, and half bricks of 0.1 x 0.2 x 0.2 m at the
     1.2 m |A|   |   |   |   |   |B|     ends of every other course, so that head joints are staggered and every brick lies on two
           +-+-+-+-+-+-+-+-+-+-+-+-+     (Furukawa et al. 2014, section 4.2, Fig. 7 (b), Tables 1 and 3). Which courses have the
           |   |   |   |   |   |   |     half bricks, and which bricks are A and B, is our choice: the paper's text does not say.
            ...
           +---+---+---+---+---+---+
         ========================== ---> x, direction of the ground motion

Leaves in DIR what 02 does, and has the same options. Its parts are in paperWall.py beside this file.
"""

import os
import sys

from yade_brick import build

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import paperWall

chosen = paperWall.options(__doc__, out="result-03")
motion = paperWall.groundMotion(chosen)
side = paperWall.side
bricks = build.englishBondWall(paperWall.columns, paperWall.courses, (side, side, side), **paperWall.brickOptions(chosen))

run = paperWall.WallRun(bricks, chosen)
run.settle()
run.shake(motion)
sys.exit(run.write())
