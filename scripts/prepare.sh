#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Installs what is missing (Debian 12 packages) and builds into build/. Called by demo.sh and test.sh; cheap to call again.
#   scripts/prepare.sh [target]      BRICK_BUILD=<folder> to build elsewhere; target overlay: build/yade, without what only tests need
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}

packages='yade g++ cmake ninja-build libeigen3-dev libboost-python-dev libboost-serialization-dev libpython3-dev libgl-dev libgtest-dev
	python3-matplotlib python3-numpy python3-scipy python3-tqdm python3-meshio python3-pil python3-hypothesis xvfb xauth'
for_tests='valgrind libgl1-mesa-dri python3-sphinx python3-myst-parser python3-sphinx-rtd-theme'

installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

if [ "${1-}" != overlay ]; then
	packages="$packages $for_tests"
	# tests read files for ParaView with VTK's Python, which ParaView's own brings too; the two packages exclude each other
	installed python3-paraview || packages="$packages python3-vtk9"
fi
missing=
for package in $packages; do
	installed "$package" || missing="$missing $package"
done
if [ -n "$missing" ]; then
	echo "Installing:$missing"
	as_root=
	[ "$(id -u)" = 0 ] || as_root=sudo
	$as_root apt-get update -q
	$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
fi

# a folder that another generator has filled is used as it is
[ -f "$build/CMakeCache.txt" ] || cmake -S "$source" -B "$build" -G Ninja
exec cmake --build "$build" --parallel "$(nproc)" ${1:+--target "$1"}
