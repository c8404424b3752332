// SPDX-License-Identifier: GPL-2.0-or-later
//
// Anything that has a layout.

#include <core/State.hpp>
