#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# All tests but those that take minutes (see verify.sh). Installs what is missing, builds, runs ctest.
#   scripts/test.sh [options of ctest]     e.g. -R kernel, -j4
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
"$source/scripts/prepare.sh"
cd "$build"
exec ctest -j2 --output-on-failure -LE slow "$@"
