// SPDX-License-Identifier: GPL-2.0-or-later
//
// Engine that acts on the bodies it names.
#pragma once

#include <core/Body.hpp>
#include <core/Engine.hpp>

namespace yade {

class PartialEngine : public Engine {
public:
	std::vector<int> ids;

	PartialEngine() { }
	YADE_HOST_CLASS(PartialEngine)
	YADE_HOST_ARCHIVE(Engine, (ids))
};
YADE_ABI_SIZE(PartialEngine, 128)
YADE_ABI_OFFSET(PartialEngine, ids, 104)
REGISTER_SERIALIZABLE(PartialEngine)

} // namespace yade
