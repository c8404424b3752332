#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Address and undefined sanitizers, and valgrind's memcheck, on the kernel tests and on a short life of a scene in YADE. Installs what is missing, builds, runs.
#   scripts/sanitize.sh [--all] [--no-valgrind]     --all runs the tests of tests/yade under the sanitizers too
# Builds into build/sanitize (sanitizers, the standard library's checks) and build/memcheck (as usual, with line numbers); logs are left in build/sanitize/logs.
# The exit status is 0 when nothing was found in our code and everything came to its end. Takes long: the kernel is compiled twice, and runs tens of times slower.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${BRICK_BUILD:-$source/build}
all= valgrind=yes
for option in "$@"; do
	case $option in
	--all) all=yes ;;
	--no-valgrind) valgrind= ;;
	*)
		echo "unknown option $option; allowed are --all and --no-valgrind" >&2
		exit 2
		;;
	esac
done
sanitized=$build/sanitize ordinary=$build/memcheck logs=$build/sanitize/logs

# Build

export CXXFLAGS=-g1 # read by CMake when it configures the first time
for target in overlay kernel_tests; do
	BRICK_BUILD=$ordinary "$source/scripts/prepare.sh" $target
done
unset CXXFLAGS
if [ "$valgrind" ] && ! dpkg -s valgrind libc6-dbg >/dev/null 2>&1; then
	as_root=
	[ "$(id -u)" = 0 ] || as_root=sudo
	$as_root apt-get update -q
	$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends valgrind libc6-dbg
fi
[ -f "$sanitized/CMakeCache.txt" ] || cmake -S "$source" -B "$sanitized" -G Ninja -D BRICK_SANITIZE=ON
for target in overlay kernel_tests; do
	cmake --build "$sanitized" --parallel "$(nproc)" --target $target
done
rm -rf "$logs"
mkdir -p "$logs"

# What is run

failed=0

# run <name> <command>: its output goes to a file, which is judged with what else the command left in $logs/<name>.*; a line is printed, and what was found.
run() {
	name=$1
	shift
	began=$(date +%s) status=0 found=0
	"$@" >"$logs/$name.out" 2>&1 </dev/null || status=$?
	/usr/bin/python3 "$source/tests/sanitize/findings.py" "$logs/$name".* >"$logs/findings" || found=1
	verdict='nothing found'
	[ $status = 0 ] || verdict="exit status $status, see $logs/$name.out"
	[ $found = 0 ] || verdict='FOUND'
	[ "$verdict" = 'nothing found' ] || failed=1
	printf '%-32s %5d s   %s\n' "$name" $(($(date +%s) - began)) "$verdict"
	cat "$logs/findings"
}

# sanitize <name> <instruction set> <options of the address sanitizer> <command>
sanitize() {
	name=$1 set=$2 options=$3
	shift 3
	run "$name" env YADE_BRICK_INSTRUCTION_SET="$set" ASAN_OPTIONS="$options:detect_stack_use_after_return=1" \
		UBSAN_OPTIONS=print_stacktrace=1 "$@"
}

# memcheck <name> <instruction set> <command>
memcheck() {
	name=$1 set=$2
	shift 2
	run "$name" env YADE_BRICK_INSTRUCTION_SET="$set" PYTHONMALLOC=malloc valgrind --trace-children=yes --num-callers=40 --track-origins=yes \
		--leak-check=full --show-leak-kinds=definite --error-limit=no --xml=yes --xml-file="$logs/$name.%p.xml" "$@"
}

# YADE itself is not sanitized: libasan has to be there before it, and libstdc++ with it, whose exceptions libasan watches. Leaks are not looked for, since Python
# and YADE keep much until the end.
preload="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so.6)"
kernel_options=detect_leaks=1:check_initialization_order=1:strict_init_order=1
yade_options=detect_leaks=0
session=$source/tests/sanitize/session.py
# tests of what is compiled for several instruction sets; one of them does thousands of searches
for_each_set='Contact*:*Joint*:*Modes*:ModeColumns*-ContactSearchTest.spots_of_stacked*'
# large matrices in Eigen's hands; smaller ones go through the same code of ours
slow='ContactSearchTest.spots_of_stacked*:StableStepTest.*refined*:StableStepTest.bound_is_the_truth*:CondensedPartTest.*'

run yade-ordinary "$ordinary/yade" -n -x -j1 "$session" 1
sanitize kernel-sanitized 2 $kernel_options "$sanitized/tests/kernel/kernel_tests" --gtest_brief=1
for set in 0 1; do
	sanitize kernel-sanitized-set$set $set $kernel_options "$sanitized/tests/kernel/kernel_tests" --gtest_brief=1 --gtest_filter="$for_each_set"
done
for set in 0 1 2; do
	sanitize yade-sanitized-set$set $set $yade_options LD_PRELOAD="$preload" "$sanitized/yade" -n -x -j1 "$session" 1
	if [ "$(grep '^fingerprint' "$logs/yade-sanitized-set$set.out")" != "$(grep '^fingerprint' "$logs/yade-ordinary.out")" ]; then
		echo "yade-sanitized-set$set ended otherwise than yade-ordinary: see their .out in $logs"
		failed=1
	fi
done
if [ "$all" ]; then
	for test in "$source"/tests/yade/test*.py; do
		case $test in *testBuild.py | *testInstall.py | *testLoading.py) continue ;; esac # about other builds of the library
		sanitize "yade-$(basename "$test" .py)" 2 $yade_options LD_PRELOAD="$preload" "$sanitized/yade" -n -x -j1 "$source/tests/yade/run.py" "$test"
	done
fi
if [ "$valgrind" ]; then
	# valgrind knows no AVX-512: the library takes AVX2
	memcheck kernel-memcheck 2 "$ordinary/tests/kernel/kernel_tests" --gtest_brief=1 --gtest_filter="-$slow"
	memcheck kernel-memcheck-set0 0 "$ordinary/tests/kernel/kernel_tests" --gtest_brief=1 --gtest_filter="$for_each_set"
	memcheck yade-memcheck 2 "$ordinary/yade" -n -x -j1 "$session" .2
fi
[ $failed = 0 ] && echo 'Nothing was found in our code.'
exit $failed
