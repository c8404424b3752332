// SPDX-License-Identifier: GPL-2.0-or-later
//
// Geometry of a body.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
public:
	shared_ptr<BoundFunctor>         boundFunctor;         // dispatch cache, filled by YADE
	shared_ptr<InternalForceFunctor> internalforcefunctor; // likewise
	Vector3r                         color { 1, 1, 1 };
	bool                             wire      = false;
	bool                             highlight = false;

	Shape() { }
	YADE_HOST_CLASS(Shape)
	YADE_HOST_ARCHIVE(Serializable, (color)(wire)(highlight))
	YADE_HOST_INDEX_TOP
};
YADE_ABI_SIZE(Shape, 96)
YADE_ABI_OFFSET(Shape, color, 64)
YADE_ABI_OFFSET(Shape, wire, 88)
YADE_ABI_OFFSET(Shape, highlight, 89)
REGISTER_SERIALIZABLE(Shape)

} // namespace yade
