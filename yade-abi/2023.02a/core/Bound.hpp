// SPDX-License-Identifier: GPL-2.0-or-later
//
// Volume around a body, for the collider. In periodic scenes min and max are in unsheared coordinates.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Bound : public Serializable, public Indexable {
public:
	int      lastUpdateIter = 0;
	Vector3r refPos { NaN, NaN, NaN };
	Real     sweepLength = 0;
	Vector3r color { 1, 1, 1 };
	Vector3r min { NaN, NaN, NaN };
	Vector3r max { NaN, NaN, NaN };

	Bound() { }
	YADE_HOST_CLASS(Bound)
	YADE_HOST_ARCHIVE(Serializable, (lastUpdateIter)(refPos)(sweepLength)(color))
	YADE_HOST_INDEX_TOP
};
YADE_ABI_SIZE(Bound, 144)
YADE_ABI_OFFSET(Bound, refPos, 40)
YADE_ABI_OFFSET(Bound, sweepLength, 64)
YADE_ABI_OFFSET(Bound, min, 96)
YADE_ABI_OFFSET(Bound, max, 120)
REGISTER_SERIALIZABLE(Bound)

} // namespace yade
