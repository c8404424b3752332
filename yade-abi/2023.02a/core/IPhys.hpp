// SPDX-License-Identifier: GPL-2.0-or-later
//
// Physics of a contact: stiffness, forces, state.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IPhys : public Serializable, public Indexable {
public:
	IPhys() { }
	YADE_HOST_CLASS(IPhys)
	YADE_HOST_ARCHIVE(Serializable, )
	YADE_HOST_INDEX_TOP
};
YADE_ABI_SIZE(IPhys, 32)
REGISTER_SERIALIZABLE(IPhys)

} // namespace yade
