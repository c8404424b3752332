# SPDX-License-Identifier: GPL-2.0-or-later
# One row of the study of testStudy.py: a brick that falls for a while. Rows 'crash' and 'killed' do not get to their end before the file 'repaired' is there.
import os, signal

readParamsFromTable(noTableOk=True, height=1., what='well', duration=.01)
from yade.params.table import *
import yade_brick

O.bodies.append(yade_brick.brick((.1, .1, .1), center=(0, 0, height), material=BrickMat(young=1e7, poisson=.25, density=1800), deformation='rigid'))
O.engines = yade_brick.engines(gravity=(0, 0, -9.8))
O.dt = 1e-3
yade_brick.runWithProgress(duration=duration, label='falling')
if not os.path.exists('repaired'):
	if what == 'crash': raise RuntimeError('the wall is gone')
	if what == 'killed': os.kill(os.getpid(), signal.SIGKILL)
yade_brick.study.record(dict(height=O.bodies[0].state.pos[2], what=what, threads=O.numThreads, description=O.tags['description']))
