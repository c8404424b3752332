# SPDX-License-Identifier: GPL-2.0-or-later
# Runs another scene with YADE's clocks on, and adds where its steps have spent their time.
"""Profile of a scene:  build/yade -n -x -j1 benchmarks/scenes/profiled.py benchmarks/scenes/bricks.py [its options]"""

import os
import runpy
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import common
from yade import O

sys.argv = sys.argv[1:]
O.timingEnabled = True
runpy.run_path(sys.argv[0])
common.finish(profile=common.profile())
