#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The benchmarks: yade-brick beside what one would use instead, as ratios measured in one run. Installs what is missing, builds, runs, prints one table.
#   scripts/benchmark.sh [--only ROW,..] [--quick] [--peers] [--out DIR]
# --only rows by name (--help lists them); --quick one round of short runs; --peers installs Bullet, CalculiX and Google Benchmark too, without which
# their rows are skipped; DIR (default build/benchmarks): benchmarks.md, benchmarks.json. The exit status is 0 when everything was measured, whether or not
# a target is met. Takes about 10 minutes; leave the machine alone meanwhile.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
peers=
for option in "$@"; do
	shift
	case $option in
	--peers) peers='libbullet-dev calculix-ccx libbenchmark-dev' ;;
	--help) exec /usr/bin/python3 "$source/benchmarks/run.py" --help ;;
	*) set -- "$@" "$option" ;;
	esac
done

"$source/scripts/prepare.sh"
if [ "$peers" ] && ! dpkg -s $peers >/dev/null 2>&1; then
	as_root=
	[ "$(id -u)" = 0 ] || as_root=sudo
	$as_root apt-get update -q
	$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $peers
fi
cmake "$build" # looks again for the libraries of peers
cmake --build "$build" --parallel "$(nproc)" --target benchmarks
# Debian's Python, whichever is first on PATH
exec /usr/bin/python3 "$source/benchmarks/run.py" --yade "$build/yade" --programs "$build/benchmarks" --out "$build/benchmarks" "$@"
