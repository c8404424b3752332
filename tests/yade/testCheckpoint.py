# SPDX-License-Identifier: GPL-2.0-or-later
# Runs with checkpoints: a wall that cracks is interrupted in every way (killed, told to end, checkpoints damaged) and goes on to the same bits.
import io, os, shutil, signal, subprocess, sys, tempfile, threading, unittest

from yade import O, plot

import longRun, yade_brick
from yade_brick import checkpoint

script = os.path.join(os.path.dirname(os.path.abspath(longRun.__file__)), 'longRun.py')
DURATION, KILLED = .22, .13  # [s]


class Checkpoints(unittest.TestCase):

	@classmethod
	def setUpClass(cls):
		"""The run that nothing interrupts."""
		cls.whole = tempfile.mkdtemp()
		cls.addClassCleanup(shutil.rmtree, cls.whole)
		plot.resetData()
		cls.report, memory = longRun.run(cls.whole, DURATION)
		cls.expected = longRun.found(memory)

	def setUp(self):
		self.folder = os.path.join(self.whole, self.id().split('.')[-1])  # inside: what is no checkpoint there does not matter
		self.shown = io.StringIO()

	def run_(self, duration=DURATION, **more):
		"""A call in a program that has nothing in its scene yet."""
		O.reset()
		plot.resetData()
		self.report, self.memory = longRun.run(self.folder, duration, stream=self.shown, **more)

	def check(self):
		"""Not a bit differs from the run that nothing has interrupted."""
		self.assertEqual(longRun.found(self.memory), self.expected)

	def elsewhere(self, *options):
		"""A program of its own, with the YADE that runs this."""
		command = [sys.yade_argv[0], '-n', '-x', '-j1', script, self.folder, str(DURATION), *options]
		return subprocess.run(command, capture_output=True, text=True, timeout=300)

	def copied(self):
		"""The checkpoints of the run as it was at .15 s or before, as after a crash."""
		for path in checkpoint.checkpoints(self.whole)[:-1]:  # but for that of the end
			shutil.copytree(path, os.path.join(self.folder, os.path.basename(path)))
		return checkpoint.checkpoints(self.folder)

	def test_killed_run_goes_on_to_the_same_bits(self):
		process = self.elsewhere('kill', str(KILLED))
		self.assertEqual(process.returncode, -signal.SIGKILL, process.stderr)
		kept = checkpoint.checkpoints(self.folder)
		self.assertEqual(len(kept), 3)
		process = self.elsewhere()
		self.assertIn('wall: goes on from 0.100 s, ' + kept[-1], process.stderr)
		found, = [line[6:] for line in process.stdout.splitlines() if line.startswith('found ')]
		self.assertEqual(found, self.expected)

	def test_checkpoints_change_nothing(self):
		self.run_(saveEvery=.003)
		self.check()
		self.assertEqual(self.report.restartedAt, None)
		self.folder += '-few'
		self.run_(saveEvery=None, saveEveryWall=1e6)
		self.check()
		self.assertEqual(len(checkpoint.checkpoints(self.folder)), 2)  # start and end

	def test_damaged_checkpoints_are_passed_over(self):
		newest, before = self.copied()[::-1]
		path = os.path.join(newest, 'scene.yade.gz')
		with open(path, 'r+b') as file:
			file.truncate(os.path.getsize(path) // 2)
		self.run_()
		self.check()
		self.assertIn('%s is damaged (scene.yade.gz is not what was written); looking for the one before' % newest, self.shown.getvalue())
		self.assertIn('goes on from 0.150 s, ' + before, self.shown.getvalue())

	def test_every_kind_of_damage_is_seen(self):
		for name in ('scene.yade.gz', 'memory.pickle', 'checkpoint.json'):
			for path in self.copied(): os.remove(os.path.join(path, name))
			with self.assertRaisesRegex(RuntimeError, 'none of the 2 checkpoints'): self.run_()
			shutil.rmtree(self.folder)

	def test_what_was_being_written_when_the_power_failed_is_swept_away(self):
		self.copied()
		left = os.path.join(self.folder, '.unfinished-123')
		os.mkdir(left)
		self.run_()
		self.check()
		self.assertFalse(os.path.exists(left))

	def test_finished_run_does_nothing_when_it_is_called_again(self):
		self.copied()
		self.run_()
		steps, calls = O.iter, self.memory['calls']
		self.run_()
		self.assertEqual((O.iter, self.report.steps, self.report.finished), (steps, steps - 1, True))
		self.assertEqual(self.memory['calls'], calls)
		self.assertIn('wall: is complete', self.shown.getvalue())

	def test_finished_run_goes_on_to_a_later_end(self):
		self.run_(duration=.1)
		first = O.time
		extra = self.memory['calls'][-1]
		self.run_()
		self.memory['calls'].remove(extra)  # the callback at the end of the first part is its own; no more is different
		self.check()
		self.assertEqual(self.report.restartedAt, first)
		with self.assertRaisesRegex(ValueError, 'to end at 0.05.* s already'): self.run_(duration=.05)

	def test_callback_that_stops_a_run_stops_it_for_good(self):
		build = lambda: longRun.build()
		stop = dict(build=build, folder=self.folder, duration=DURATION, every=.05, callback=lambda: True, label='wall', stream=self.shown)
		report = yade_brick.runWithCheckpoints(**stop)
		self.assertEqual((report.finished, round(report.simulated, 3)), (False, .05))
		self.assertEqual(yade_brick.runWithCheckpoints(**stop), report._replace(restartedAt=O.time))
		self.assertIn('a callback has stopped it', self.shown.getvalue())

	def test_terminated_run_saves_first(self):
		longRun.build()  # a step takes its time now and not after the signal
		threading.Timer(.3, os.kill, (os.getpid(), signal.SIGINT)).start()
		with self.assertRaises(KeyboardInterrupt): self.run_(duration=50., saveEvery=None, saveEveryWall=1e6)
		self.assertGreater(O.iter, 1)
		self.assertEqual(os.path.basename(checkpoint.checkpoints(self.folder)[-1]), 'checkpoint-%012d' % O.iter)

	def test_checkpoints_by_elapsed_time(self):
		self.run_(saveEvery=None, saveEveryWall=1e-9, keep=1000)
		self.assertGreater(len(checkpoint.checkpoints(self.folder)), 10)

	def test_run_of_other_parameters_is_refused(self):
		self.run_(duration=.02, parameters=dict(pga=3.5, seed=(1, 2)))
		self.run_(duration=.02, parameters=dict(pga=3.5, seed=(1, 2)))
		with self.assertRaisesRegex(ValueError, "'pga': 4.*are of a run with .*'pga': 3.5"): self.run_(duration=.02, parameters=dict(pga=4, seed=(1, 2)))

	def test_two_processes_do_not_share_a_folder(self):
		lock = yade_brick.files.lock(os.path.join(self.folder, '.lock'))
		with lock, self.assertRaisesRegex(RuntimeError, 'another process is running in'): self.run_()

	def test_bad_arguments_are_refused_before_the_scene_is_made(self):
		for more, words in (
		        (dict(duration=0), 'duration is 0'), (dict(until=1.), 'exactly one'), (dict(keep=0), 'keep is 0'), (dict(saveEvery=-1), 'saveEvery is -1'),
		        (dict(saveEvery=None), 'both None'), (dict(memory=[]), 'memory is'), (dict(every=None), 'every and callback'),
		        (dict(parameters={1: 2}), 'parameters has the key 1')
		):
			with self.assertRaisesRegex(ValueError, words): self.run_(**more)
		with self.assertRaisesRegex(ValueError, 'build is'): yade_brick.runWithCheckpoints(None, self.folder, duration=1)
		self.assertEqual(len(O.bodies), 0)
		self.assertFalse(os.path.exists(self.folder))
