# SPDX-License-Identifier: GPL-2.0-or-later
# A study of four rows, one of which crashes and one of which is killed: by yade-batch and by runStudy, resumed and collected.
import csv, io, math, os, subprocess, sys, tempfile, unittest

from yade.utils import TableParamReader

from yade_brick import study

import buildYade

here = os.path.dirname(os.path.abspath(sys.modules[__name__].__file__))
script = os.path.join(here, 'studyRow.py')
TABLE = 'walls.table'
ROWS = [dict(height=height, what=what) for height, what in ((1.5, 'well'), (2., 'crash'), (2.5, 'killed'), (.1 + .2, 'well'))]


class Study(unittest.TestCase):

	def setUp(self):
		folder, before = tempfile.TemporaryDirectory(), os.getcwd()
		os.chdir(folder.name)
		self.addCleanup(folder.cleanup)
		self.addCleanup(os.chdir, before)
		study.writeTable(TABLE, ROWS, lambda row: '%s-%g' % (row['what'], row['height']))

	def run_(self):
		shown = io.StringIO()
		return study.runStudy(TABLE, script, jobs=2, stream=shown), shown.getvalue()

	def test_yade_reads_the_table_as_we_do(self):
		yade = TableParamReader(TABLE).paramDict()
		self.assertEqual([(row.line, row.description) for row in study.readTable(TABLE)], [(line, yade[line]['description']) for line in sorted(yade)])
		with open('ours.table', 'w') as file:
			file.write('# comment\na!  b   c\n\npi/2  1 "x"\n=  =  =   # again\n3  1  *\n')
		yade = TableParamReader('ours.table').paramDict()
		rows = study.readTable('ours.table')
		self.assertEqual([(row.line, row.description) for row in rows], [(line, yade[line]['description']) for line in sorted(yade)])
		for row in rows:
			values = {name: eval(text, dict(pi=math.pi)) for name, text in yade[row.line].items() if name != 'description' and text != '*'}
			self.assertEqual(row.parameters, values)

	def test_failures_are_kept_apart_and_resumed(self):
		batch = os.path.join(os.path.dirname(os.environ['YADE_PREFIX']), 'yade-batch')
		process = subprocess.run([batch, '-j1', '-l', '2', '--log', os.path.join(os.getcwd(), '@.log'), TABLE, script], capture_output=True, text=True, timeout=120)
		self.assertIn('well-1.5) done', process.stdout, process.stdout + process.stderr)

		first, shown = self.run_()
		self.assertIn('1 of 4 rows are finished already', shown)  # by yade-batch
		self.assertEqual((first.run, first.finished, first.failed, first.exitStatus), (3, 2, 2, 1))
		self.assertEqual([row['state'] for row in first.rows], ['finished', 'failed', 'failed', 'finished'])
		self.assertEqual(first.rows[1]['reason'], 'exit status 1: RuntimeError: the wall is gone')
		self.assertEqual(first.rows[2]['reason'], 'was ended by SIGKILL')
		for row in first.rows[1:3]:
			self.assertTrue(os.path.exists(row['log']))
			self.assertIn('%(description)s: failed, %(reason)s; see %(log)s' % row, shown)

		open('repaired', 'w').close()
		second, _ = self.run_()
		self.assertEqual((second.run, second.finished, second.failed, second.exitStatus), (2, 4, 0, 0))
		self.assertEqual(second.rows[0], first.rows[0])
		with open('walls.csv', newline='') as file:
			rows = list(csv.DictReader(file))
		self.assertEqual([row['description'] for row in rows], ['well-1.5', 'crash-2', 'killed-2.5', 'well-0.3'])
		for row, found in zip(ROWS, second.rows):
			self.assertEqual(found['result'], {**found['result'], 'what': row['what'], 'threads': 1, 'description': found['description']})
			self.assertEqual(found['parameters'], row)
			self.assertAlmostEqual(found['result']['height'], row['height'] - 9.8 / 2 * .01**2, delta=9.8 * .01 * 1e-3)  # one step of the fall
		self.assertEqual(study.resultOf(study.readTable(TABLE)[0])['height'], float(rows[0]['height']))
		self.assertEqual(self.run_()[0].run, 0)
		process = buildYade.run('-n', '-x', os.path.join(here, '..', '..', 'scripts', 'study.py'), TABLE, script, '--jobs', '1')
		self.assertIn('4 of 4 rows are finished already', process.stdout + process.stderr)
		self.assertEqual(process.returncode, 0)
