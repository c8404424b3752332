#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Looks for input that ends the process, hangs, gives numbers that are not finite, or is refused without a reason. Installs what is missing, builds, runs.
#   scripts/fuzz.sh [--seed N] [--count N] [--seconds N] [--kind NAME] [--example JSON]     e.g. --seed 7 --count 100000 --seconds 3600
# Without options the examples are those of ctest, always the same. The exit status is 0 when nothing was found.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
"$source/scripts/prepare.sh" overlay
# Debian's Python, which has hypothesis, whichever is first on PATH
exec /usr/bin/python3 "$source/tests/fuzz/fuzz.py" --yade "$build/yade" "$@"
