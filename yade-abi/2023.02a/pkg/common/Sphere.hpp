// SPDX-License-Identifier: GPL-2.0-or-later
//
// Sphere.
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Sphere : public Shape {
public:
	Real radius = NaN; // [m]

	Sphere() { createIndex(); }
	YADE_HOST_CLASS(Sphere)
	YADE_HOST_ARCHIVE(Shape, (radius))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(Sphere, 104)
YADE_ABI_OFFSET(Sphere, radius, 96)
REGISTER_SERIALIZABLE(Sphere)

} // namespace yade
