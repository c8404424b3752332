// SPDX-License-Identifier: GPL-2.0-or-later
//
// Infinite plane normal to one of the axes; its orientation is ignored.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Wall : public Shape {
public:
	int sense = 0; // side that interacts: -1, 0 (both), 1
	int axis  = 0; // of the normal

	Wall() { createIndex(); }
	YADE_HOST_CLASS(Wall)
	YADE_HOST_ARCHIVE(Shape, (sense)(axis))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(Wall, 104)
YADE_ABI_OFFSET(Wall, sense, 92)
YADE_ABI_OFFSET(Wall, axis, 96)
REGISTER_SERIALIZABLE(Wall)

} // namespace yade
