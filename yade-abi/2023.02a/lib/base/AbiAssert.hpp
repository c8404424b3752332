// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compile-time checks of the layout that the installed YADE has. They hold only with the compiler flags of the target
// `yade_flags` (see CMakeLists.txt). YADE_ABI_UNCHECKED turns them off: for the test that builds a plugin the wrong way on
// purpose, so that the check at load time (HostCheck.cpp) has something to refuse.
#pragma once

#include <cstddef>

#ifdef YADE_ABI_UNCHECKED
#define YADE_ABI_ASSERT(condition, message)
#else
#define YADE_ABI_ASSERT(condition, message) static_assert(condition, "layout differs from YADE's: " message);
#endif

/// Size of a class and offset of one of its members. GCC and clang allow offsetof on classes with virtual functions.
#define YADE_ABI_SIZE(Class, bytes) YADE_ABI_ASSERT(sizeof(Class) == bytes, #Class)
#define YADE_ABI_OFFSET(Class, member, bytes)                                                                                                                  \
	_Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Winvalid-offsetof\"") YADE_ABI_ASSERT(                                               \
	        offsetof(Class, member) == bytes, #Class "::" #member) _Pragma("GCC diagnostic pop")
