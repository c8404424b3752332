// SPDX-License-Identifier: GPL-2.0-or-later
// Functions compiled for several vector instruction sets; the machine's best is chosen when the library is loaded. The kernel is built without contraction of
// products and sums (-ffp-contract=off) and its sums have a fixed order, so all of them give bitwise the same result.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BRICK_ANY_INSTRUCTION_SET __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BRICK_ANY_INSTRUCTION_SET
#endif

/// Of helpers of such functions: inlined into each of their versions.
#define BRICK_INLINE inline __attribute__((always_inline))
