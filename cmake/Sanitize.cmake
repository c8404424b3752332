# SPDX-License-Identifier: GPL-2.0-or-later
#
# yade_flags with address and undefined sanitizers and the checks of the standard library. YADE itself has none: it has to be started with libasan preloaded
# (scripts/sanitize.sh does). Not with _GLIBCXX_SANITIZE_VECTOR: YADE and GoogleTest resize the same vectors without it.
target_compile_options(
	yade_flags
	INTERFACE
		-O1 -g1 -fno-omit-frame-pointer # after -O2 of the build type, so this counts; lines are enough, variables double the time to compile
		-fsanitize=address,undefined,float-cast-overflow
)
target_compile_definitions(yade_flags INTERFACE _GLIBCXX_ASSERTIONS)
# Functions of templates that YADE has too are taken from our library, or checks would be left out in YADE's. Data stay shared.
target_link_options(yade_flags INTERFACE -fsanitize=address,undefined,float-cast-overflow -Wl,-Bsymbolic-functions)
