// SPDX-License-Identifier: GPL-2.0-or-later
//
// Box with its own axes.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Box : public Shape {
public:
	Vector3r extents = Vector3r(NaN, NaN, NaN); // half sizes [m]

	Box() { createIndex(); }
	YADE_HOST_CLASS(Box)
	YADE_HOST_ARCHIVE(Shape, (extents))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(Box, 120)
YADE_ABI_OFFSET(Box, extents, 96)
REGISTER_SERIALIZABLE(Box)

} // namespace yade
