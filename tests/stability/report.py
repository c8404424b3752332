# SPDX-License-Identifier: GPL-2.0-or-later
# Prints the table of the hard cases from what they have left (see Case in ../verification/cases.py). Plain Python.
#     python3 tests/stability/report.py --rows FOLDER [--out FILE]
# The exit status is 0 when every row is ok and every case came to its end.
import argparse, os, sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'verification'))
from rows import readCases


def options():
	parser = argparse.ArgumentParser(description='Table of the hard cases.')
	parser.add_argument('--rows', required=True, help='folder in which the cases have left their rows')
	parser.add_argument('--out', help='file for the table, as Markdown')
	return parser.parse_args()


def share(row):
	"""How much of what is allowed a row takes; 1 is the limit."""
	got, allowed = (row['got'], row['limit']) if 'limit' in row else (abs(row['error']), row['tolerance'])
	if allowed > 0: return got / allowed
	return 0. if got <= allowed else float('inf')


def line(case, row):
	allowed = '<= %.3g' % row['limit'] if 'limit' in row else '%.4g +- %.2g%s' % (row['expected'], row['tolerance'], ' of it' if row['expected'] else '')
	margin = 'none' if not row['ok'] else '%.1f' % (1 / share(row)) if share(row) > 1e-6 else '> 1e6'
	return '| %s | %s | %.4g | %s | %s |' % (case['group'], row['id'].replace('|', '/'), row['got'], allowed, margin)


def table(cases):
	"""A line for the tightest row of every case, and one for each row that is not ok."""
	text = ['| case | criterion | measured | allowed | margin |', '|---|---|---|---|---|']
	for case in cases:
		if not case['passed'] and all(row['ok'] for row in case['rows']):
			text.append('| %s | %s: came to its end | no | yes | none |' % (case['group'], case['case']))
		worst = max(case['rows'], key=share, default=None)
		text += [line(case, row) for row in case['rows'] if not row['ok'] or row is worst]
	return '\n'.join(text) + '\n'


def main():
	chosen = options()
	cases = sorted(readCases(chosen.rows), key=lambda case: (case['group'], case['case']))
	if not cases:
		sys.exit('no rows in %s: run the hard cases first (scripts/stability.sh)' % chosen.rows)
	text = table(cases)
	print(text)
	if chosen.out:
		with open(chosen.out, 'w') as file:
			file.write(text)
	failed = [case for case in cases if not case['passed']]
	print('%d cases, %d rows, %d cases not ok' % (len(cases), sum(len(case['rows']) for case in cases), len(failed)))
	sys.exit(1 if failed else 0)


if __name__ == '__main__':
	main()
