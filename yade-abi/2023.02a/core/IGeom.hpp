// SPDX-License-Identifier: GPL-2.0-or-later
//
// Geometry of a contact.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IGeom : public Serializable, public Indexable {
public:
	IGeom() { }
	YADE_HOST_CLASS(IGeom)
	YADE_HOST_ARCHIVE(Serializable, )
	YADE_HOST_INDEX_TOP
};
YADE_ABI_SIZE(IGeom, 32)
REGISTER_SERIALIZABLE(IGeom)

} // namespace yade
