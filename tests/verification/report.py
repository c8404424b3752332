# SPDX-License-Identifier: GPL-2.0-or-later
# Makes one report of what the verification cases have left (see Case in cases.py): report.md with plots, and result.json. Plain Python.
#     python3 tests/verification/report.py --rows FOLDER --out FOLDER [--all]
# The exit status is 0 when every judged row is ok, every case came to its end and, with --all, every reference was used.
import argparse, json, os, re, sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(here, '..', 'python'))
import standalone
from rows import readCases

results = standalone.load('report')  # of the package, without YADE

#: Order of the groups; others follow by name.
GROUPS = (
        'Patch tests', 'Poisson cube', 'Locking', 'Cantilever and frequencies', 'Statics and rest', 'Self weight of the walls', 'Wave arrival', 'Mortar strength',
        'Sliding blocks', 'Rocking blocks', 'Overhang', 'Tilting table', 'Arch of voussoirs', 'Restitution', 'Free spin', 'Time step'
)


def options():
	parser = argparse.ArgumentParser(description='Report of the verification cases.')
	parser.add_argument('--rows', required=True, help='folder in which the cases have left their rows')
	parser.add_argument('--out', required=True, help='folder for report.md, plots and result.json')
	parser.add_argument('--all', action='store_true', help='all cases were run, slow ones too: every reference has to be used')
	return parser.parse_args()


def place(case):
	"""Where a case stands in the report: sorts."""
	return GROUPS.index(case['group']) if case['group'] in GROUPS else len(GROUPS), case['group'], case['module'], case['case']


# result.json


def judgedRows(cases, unused):
	"""All judged rows under ids that are unique; one for each case that did not come to its end; one for references without a case."""
	rows, seen = [], {}
	for case in cases:
		for row in case['rows']:
			id = '%s.%s: %s' % (case['module'], case['case'], row['id'])
			seen[id] = seen.get(id, 0) + 1
			rows.append(dict(row, id=id if seen[id] == 1 else '%s (%d)' % (id, seen[id])))
		if not case['passed'] and all(row['ok'] for row in case['rows']):
			rows.append(results.judgedRow('%s.%s: errors' % (case['module'], case['case']), 1, limit=0))
	if unused is not None:
		rows.append(results.judgedRow('references without a case', len(unused), limit=0))
	return rows


def references():
	with open(os.path.join(here, 'references.json')) as file:
		return json.load(file)


def unusedReferences(cases):
	used = {id for case in cases for id in case['references']}
	return [row['id'] for row in references() if row['id'] not in used and 'notJudged' not in row]


# report.md


def cell(text):
	return str(text).replace('|', '\\|').replace('\n', ' ')


def number(value):
	return '%.6g' % value if isinstance(value, (int, float)) else str(value)


def markdownTable(heading, lines):
	text = ['| ' + ' | '.join(heading) + ' |', '|' + '---|' * len(heading)]
	return '\n'.join(text + ['| ' + ' | '.join(cell(entry) for entry in line) + ' |' for line in lines]) + '\n'


def percent(value, relative):
	return '' if value is None else '%.2g %%' % (100 * value) if relative else '%.2g' % value


def rowLine(row):
	wanted = number(row['expected']) if 'expected' in row else '≤ ' + number(row['limit'])
	relative = bool(row.get('expected'))
	return (
	        row['id'], wanted, number(row['got']), percent(row.get('error'), relative), percent(row.get('tolerance'), relative), 'ok' if row['ok'] else '**NOT OK**',
	        row['reason']
	)


def comparisonLine(row):
	error = (row['got'] - row['truth']) / abs(row['truth']) if row['truth'] else row['got']
	return row['id'], number(row['truth']), number(row['got']), percent(error, bool(row['truth'])), row['reason']


def folded(title, table, count):
	"""A long table, folded away."""
	return '<details><summary>%s (%d)</summary>\n\n%s\n</details>\n' % (title, count, table) if count > 12 else table


def caseSection(case, figures):
	text = ['### %s\n' % case['case'].replace('test_', '', 1).replace('_', ' '), case['about'] + '\n']
	if not case['passed']:
		text.append('**This case failed.**\n')
	if case['rows']:
		table = markdownTable(('', 'expected', 'got', 'error', 'tolerance', '', 'reason of the tolerance'), map(rowLine, case['rows']))
		text.append(folded('Judged rows', table, len(case['rows'])))
	if case['comparisons']:
		text.append('The method against the truth (not judged):\n')
		table = markdownTable(('', 'truth', 'method', 'difference', 'why'), map(comparisonLine, case['comparisons']))
		text.append(folded('Comparisons', table, len(case['comparisons'])))
	text += ['![%s](%s)\n' % (title, file) for title, file in figures]
	if case['references']:
		text.append('<sub>References: %s. `%s.%s`</sub>\n' % (shortened(case['references']), case['module'], case['case']))
	return '\n'.join(text)


def shortened(ids):
	"""Ids of references, a long list by their common beginnings."""
	if len(ids) <= 8:
		return ', '.join(ids)
	counts = {}
	for id in ids:
		beginning = '.'.join(id.split('.')[:2])
		counts[beginning] = counts.get(beginning, 0) + 1
	return ', '.join('%s.* (%d)' % item for item in counts.items())


def summary(cases):
	lines = []
	for group in dict.fromkeys(case['group'] for case in cases):
		members = [case for case in cases if case['group'] == group]
		rows = [row for case in members for row in case['rows']]
		shares = [abs(row['error']) / row['tolerance'] for row in rows if row.get('tolerance')]
		failed = sum(not row['ok'] for row in rows) + sum(not case['passed'] and all(row['ok'] for row in case['rows']) for case in members)
		lines.append((
		        '[%s](#%s)' % (group, group.lower().replace(' ', '-')), len(members), len(rows), failed, sum(len(case['comparisons']) for case in members),
		        '%.0f %%' % (100 * max(shares)) if shares else ''
		))
	return markdownTable(('group', 'cases', 'judged rows', 'not ok', 'comparisons', 'largest error, of its tolerance'), lines)


def coverage(cases, unused):
	used = {id for case in cases for id in case['references']}
	known = references()
	text = ['%d of %d reference rows are used by these cases.\n' % (len(used), len(known))]
	left = [(row['id'], row['notJudged']) for row in known if 'notJudged' in row and row['id'] not in used]
	if left:
		text.append('Not judged:\n')
		text.append(markdownTable(('reference', 'why'), left))
	if unused:
		text.append('**Without a case:** ' + ', '.join(unused) + '\n')
	return '\n'.join(text)


introduction = '''# Verification of yade-brick

Each case is run inside YADE or on the library's own matrices, and compared with values that have nothing to do with this code: closed forms, high-order finite
elements, other codes, an independent solution of the same discrete model (`tests/verification/references.json` has them with their sources).

- **Judged rows** test the implementation: what it has to give, whatever the method's merits. Each has a tolerance with its reason.
- **Comparisons** show the method itself against the truth: one hexahedron a brick, compliant contact parts. They are not judged; judged rows beside them show that
  refinement (of the contact part r, of segments, of the brick into smaller ones) takes the difference away.

Errors and tolerances are relative, absolute where the expected value is 0.
'''


def writeReport(out, cases, figures, unused):
	text = [introduction, '## Summary\n', summary(cases)]
	for group in dict.fromkeys(case['group'] for case in cases):
		text.append('## %s\n' % group)
		text += [caseSection(case, figures[case['module'], case['case']]) for case in cases if case['group'] == group]
	text += ['## References\n', coverage(cases, unused)]
	path = os.path.join(out, 'report.md')
	with open(path, 'w') as file:
		file.write('\n'.join(text))
	return path


# Plots


def draw(out, case):
	"""The figures of a case: list of (title, file)."""
	drawn = []
	for title in dict.fromkeys(curve['figure'] for curve in case['curves']):
		curves = [curve for curve in case['curves'] if curve['figure'] == title]
		figure, axes = plt.subplots(figsize=(7, 4.2), layout='constrained')
		for place, curve in enumerate(curves):
			style = dict(linestyle='-', marker='' if len(curve['x']) > 25 else '.') if curve['line'] else dict(linestyle='', marker='osD^vPX<>*'[place % 10], fillstyle='none')
			axes.plot(curve['x'], curve['y'], label=curve['series'], **style)
		first = curves[0]
		axes.set(xlabel=first['xLabel'], ylabel=first['yLabel'], title=title, xscale='log' if first['logX'] else 'linear', yscale='log' if first['logY'] else 'linear')
		axes.grid(alpha=.3)
		axes.legend(fontsize='small')
		name = re.sub(r'[^A-Za-z0-9]+', '-', '%s-%s-%s' % (case['module'], case['case'], title)).strip('-') + '.png'
		figure.savefig(os.path.join(out, name), dpi=110)
		plt.close(figure)
		drawn.append((title, name))
	return drawn


def main():
	chosen = options()
	cases = sorted(readCases(chosen.rows), key=place)
	if not cases:
		sys.exit('no rows in %s: run the verification cases first (scripts/verify.sh)' % chosen.rows)
	os.makedirs(chosen.out, exist_ok=True)
	unused = unusedReferences(cases) if chosen.all else None
	rows = judgedRows(cases, unused)
	figures = {(case['module'], case['case']): draw(chosen.out, case) for case in cases}
	path = writeReport(chosen.out, cases, figures, unused)
	comparisons = [dict(row, id='%s.%s: %s' % (case['module'], case['case'], row['id'])) for case in cases for row in case['comparisons']]
	results.writeResult(chosen.out, rows, comparisons=comparisons, unusedReferences=unused or [])
	failed = [row for row in rows if not row['ok']]
	print('%d cases, %d judged rows, %d not ok, %d comparisons: %s' % (len(cases), len(rows), len(failed), len(comparisons), path))
	if failed:
		print(results.table(failed))
	sys.exit(results.exitStatus(rows))


if __name__ == '__main__':
	main()
