#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The main example: a wall of deformable bricks is shaken until it falls. Installs what is missing, builds, runs.
#   scripts/demo.sh [options of examples/02_straight_joint_wall.py]     results in build/demo unless --out says otherwise
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
"$source/scripts/prepare.sh" overlay
# one thread: starting and ending parallel regions costs more than a second thread saves on 36 bricks
exec "$build/yade" -n -x -j 1 "$source/examples/02_straight_joint_wall.py" --out "$build/demo" "$@"
