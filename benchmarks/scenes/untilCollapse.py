# SPDX-License-Identifier: GPL-2.0-or-later
# The wall of examples/02_straight_joint_wall.py, shaken until it collapses. The example records what happens every 5 ms, which has a cost of its own: the
# clock keeps the steps and the recording apart.
"""The paper's wall until collapse:  build/yade -n -x -j1 benchmarks/scenes/untilCollapse.py --thickness 0.001 --segments 10

Takes the options of the example, of which it writes nothing.
"""

import os
import sys
import time

here = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [here, os.path.join(here, "..", "..", "examples")]
import common
import paperWall
from yade import O, config
from yade_brick import build


class ClockedRecorder(paperWall.Recorder):
	"""Records as the example does, and stops the run when a brick has come down by half its height: what the example calls collapse."""

	seconds = 0.0

	def look(self):
		begun = time.process_time()
		super().look()
		self.seconds += time.process_time() - begun
		return any(first[2] - last[2] > paperWall.side / 2 for first, last in zip(self.displacements[0], self.displacements[-1]))


paperWall.Recorder = ClockedRecorder
chosen = paperWall.options(__doc__, out="")
bricks = build.straightJointWall(paperWall.columns, paperWall.courses, 3 * (paperWall.side,), **paperWall.brickOptions(chosen))
run = paperWall.WallRun(bricks, chosen)
run.settle()
motion, begun = paperWall.groundMotion(chosen), time.process_time()
run.shake(motion)
spent, recording, stage = time.process_time() - begun, run.recorder.seconds, run.stage
if stage.finished:
	sys.exit(f"the wall has not collapsed in {stage.simulated:g} s")
common.finish(
        bricks=len(bricks.bodies),
        steps=stage.steps,
        simulated=stage.simulated,
        dt=O.dt,
        failed=sum(paperWall.failures(run.law).values()),
        cpu=spent - recording,
        wall=stage.wallSeconds,
        recording=recording,
        yade=config.version
)
