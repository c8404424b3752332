# SPDX-License-Identifier: GPL-2.0-or-later
# A cracking wall run with checkpoints, as a user's script would, for testCheckpoint.py, which interrupts it:
#   build/yade -n -x -j1 tests/yade/longRun.py FOLDER DURATION [kill TIME]      kills itself, as a power failure would, at the first callback past TIME
# Prints the fingerprint of the scene, what callbacks and PyRunner have gathered, and the report.
import json, os, signal, sys

from yade import O, plot
from yade.wrapper import PyRunner

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import collapse
import yade_brick

EVERY, SAVE = .0137, .05  # between callbacks and between checkpoints: no multiples of each other or of the time step [s]


def build():
	"""The wall, with a history by an engine."""
	collapse.build(columns=3, courses=3, verletDist=.02)
	O.engines = O.engines + [PyRunner(command='from yade import plot; plot.addData(t=O.time, x=O.bodies[9].state.pos[0])', virtPeriod=.01)]
	O.step()  # finds the time step


def run(folder, duration, kill=None, **more):
	"""(report, memory) of the run, gone on with as far as it had come."""
	memory = {'calls': []}

	def look():
		memory['calls'].append((O.iter, sum(collapse.failures())))
		if kill is not None and O.time > kill: os.kill(os.getpid(), signal.SIGKILL)

	arguments = dict(duration=duration, saveEvery=SAVE, saveEveryWall=None, every=EVERY, callback=look, memory=memory, label='wall')
	return yade_brick.runWithCheckpoints(build, folder, **dict(arguments, **more)), memory


def found(memory):
	"""All that has to be the same in every bit, as text. Not O.energy, which is not exact over saving and loading (see BrickDynamics)."""
	return json.dumps([collapse.fingerprint(), memory, {name: list(values) for name, values in sorted(plot.data.items())}])


if __name__ == '__main__':
	report, memory = run(sys.argv[1], float(sys.argv[2]), float(sys.argv[4]) if 'kill' in sys.argv else None)
	print('found', found(memory))
	print('report', json.dumps(report._asdict()))
