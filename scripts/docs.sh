#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# The documentation as HTML: the guide, the pages of doc/, and a reference generated from the docstrings. Installs what is missing, builds, writes.
#   scripts/docs.sh [--out DIR] [options of sphinx-build]     DIR (default build/doc): index.html
# A warning of Sphinx is an error. The first time takes half a minute.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
packages='python3-sphinx python3-myst-parser python3-sphinx-rtd-theme'

"$source/scripts/prepare.sh" overlay
if ! dpkg -s $packages >/dev/null 2>&1; then
	as_root=
	[ "$(id -u)" = 0 ] || as_root=sudo
	$as_root apt-get update -q
	$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $packages
fi
exec "$build/yade" -n -x -j1 "$source/doc/sphinx/build.py" --out "$build/doc" "$@"
