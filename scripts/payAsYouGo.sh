#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# What each effect costs where it is on and where it is off: instructions and bytes of a brick, counted by callgrind, as the Markdown table of doc/effects.md.
# Installs what is missing, builds, counts.
#   scripts/payAsYouGo.sh [--only WORD,..] [--instruction-set 0|1] [--out DIR]
# --only effects whose names contain a word; DIR (default build/payAsYouGo): payAsYouGo.md, payAsYouGo.json. The exit status is 0 when everything could be
# counted. Takes about five minutes, and does not mind what else the machine does.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
if [ "${1-}" = --help ]; then
	exec /usr/bin/python3 "$source/benchmarks/pay_as_you_go/payAsYouGo.py" --help
fi

"$source/scripts/prepare.sh"
cmake "$build" >/dev/null # looks again for valgrind
cmake --build "$build" --target callgrindSwitch
# Debian's Python, whichever is first on PATH
exec /usr/bin/python3 "$source/benchmarks/pay_as_you_go/payAsYouGo.py" --yade "$build/yade" --switch "$build/benchmarks/libcallgrindSwitch.so" \
	--out "$build/payAsYouGo" "$@"
