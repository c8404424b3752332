#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The hard cases, and their table: criterion, measured, allowed, margin. Installs what is missing, builds, runs.
#   scripts/stability.sh [--fast]     --fast leaves out the cases that take minutes; the table is also left in build/stability/table.md
# The exit status is 0 when every case is within its limits.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
case ${1-} in
'' | --fast) ;;
*)
	echo "unknown option $1; allowed is --fast" >&2
	exit 2
	;;
esac

"$source/scripts/prepare.sh"
cd "$build"
# the table judges, also when cases have failed
ctest -j2 --output-on-failure -R '^stability' ${1:+-LE slow} || true
exec /usr/bin/python3 "$source/tests/stability/report.py" --rows "$build/stability/rows" --out "$build/stability/table.md"
