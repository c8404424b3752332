// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bound with faces parallel to the axes: the one that YADE's colliders use.
#pragma once

#include <core/Bound.hpp>

namespace yade {

class Aabb : public Bound {
public:
	Aabb() { createIndex(); }
	YADE_HOST_CLASS(Aabb)
	YADE_HOST_ARCHIVE(Bound, )
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(Aabb, 144)
REGISTER_SERIALIZABLE(Aabb)

} // namespace yade
