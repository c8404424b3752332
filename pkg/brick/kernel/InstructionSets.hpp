// SPDX-License-Identifier: GPL-2.0-or-later
// Code compiled for several vector instruction sets; the machine's best is chosen when the library runs. The kernel is built without contraction of products and
// sums (-ffp-contract=off) and its sums have an order that does not depend on the width of a vector, so all sets give bitwise the same result.
//
// Such code stands in a file of its own that is included once for each set, from the types of vectors on: clones of a function (target_clones) would compare and
// choose lanes number by number.
//
//     #define BRICK_LANES_FILE "ThisAndThatLanes.hpp"      // functions, no includes; vectors of BRICK_WIDTH numbers
//     #include "ForEachInstructionSet.hpp"                 // makes namespaces wide (8 numbers), middle (4) and narrow (2)
//     BRICK_BEST_INSTRUCTION_SET(function)(arguments)
#pragma once

#include <algorithm>
#include <cstdlib>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BRICK_X86_SETS 1
#define BRICK_BEST_INSTRUCTION_SET(function) (brick::instructionSet() == 2 ? wide::function : brick::instructionSet() == 1 ? middle::function : narrow::function)
#else
#define BRICK_X86_SETS 0
#define BRICK_BEST_INSTRUCTION_SET(function) (narrow::function)
#endif

/// Of helpers of such functions: inlined into each of their versions.
#define BRICK_INLINE inline __attribute__((always_inline))

namespace brick {

/// 0: any, 1: x86-64-v3 (AVX2), 2: x86-64-v4 (AVX-512); the machine's best, or what the environment variable YADE_BRICK_INSTRUCTION_SET limits it to.
inline int instructionSet()
{
#if BRICK_X86_SETS
	static const int chosen = [] {
		const int   best  = __builtin_cpu_supports("x86-64-v4") ? 2 : __builtin_cpu_supports("x86-64-v3") ? 1 : 0;
		const char* limit = std::getenv("YADE_BRICK_INSTRUCTION_SET");
		return limit ? std::min(best, std::atoi(limit)) : best;
	}();
	return chosen;
#else
	return 0;
#endif
}

} // namespace brick
