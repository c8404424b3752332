# SPDX-License-Identifier: GPL-2.0-or-later
# Reads what the cases of verification and stability have left (see Case in cases.py). Plain Python, for the reports.
import glob, json, os


def readCases(folder):
	"""The cases of a folder, each a dict with the rows that it has left, in the order of files' names."""
	cases = []
	for path in sorted(glob.glob(os.path.join(folder, '*.json'))):
		with open(path) as file:
			cases.append(json.load(file))
	return cases
