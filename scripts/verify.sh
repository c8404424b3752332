#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The verification suite: every case against its reference, and one report. Installs what is missing, builds, runs.
#   scripts/verify.sh [--fast] [--out DIR]     --fast leaves out the cases that take minutes; DIR (default build/verification): report.md, plots, result.json
# The exit status is 0 when everything is within its tolerance.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
out=$build/verification
fast=
while [ $# -gt 0 ]; do
	case $1 in
	--fast) fast=yes ;;
	--out)
		[ $# -gt 1 ] || { echo "--out needs a folder" >&2; exit 2; }
		out=$2
		shift
		;;
	*)
		echo "unknown option $1; allowed are --fast and --out DIR" >&2
		exit 2
		;;
	esac
	shift
done
mkdir -p "$out"
out=$(cd "$out" && pwd)

"$source/scripts/prepare.sh"
cd "$build"
# the report judges, also when cases have failed
ctest -j2 --output-on-failure -R '^verification' ${fast:+-LE slow} || true
# Debian's Python, which has the packages, whichever is first on PATH
exec /usr/bin/python3 "$source/tests/verification/report.py" --rows "$build/verification/rows" --out "$out" $([ "$fast" ] || echo --all)
