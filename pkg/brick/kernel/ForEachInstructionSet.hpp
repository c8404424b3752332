// SPDX-License-Identifier: GPL-2.0-or-later
// Includes BRICK_LANES_FILE once for each instruction set: see InstructionSets.hpp. May be included once in a source file, inside of no namespace.
#include "InstructionSets.hpp"

#if BRICK_X86_SETS
#pragma GCC push_options
#pragma GCC target("arch=x86-64-v4")
#define BRICK_WIDTH 8
namespace brick {
namespace {
namespace wide {
#include BRICK_LANES_FILE
}
}
}
#undef BRICK_WIDTH
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("arch=x86-64-v3")
#define BRICK_WIDTH 4
namespace brick {
namespace {
namespace middle {
#include BRICK_LANES_FILE
}
}
}
#undef BRICK_WIDTH
#pragma GCC pop_options
#endif

#define BRICK_WIDTH 2
namespace brick {
namespace {
namespace narrow {
#include BRICK_LANES_FILE
}
}
}
#undef BRICK_WIDTH
