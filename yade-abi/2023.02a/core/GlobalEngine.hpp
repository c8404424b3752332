// SPDX-License-Identifier: GPL-2.0-or-later
//
// Engine that acts on the whole scene.
#pragma once

#include <core/Engine.hpp>

namespace yade {

class GlobalEngine : public Engine {
public:
	GlobalEngine() { }
	YADE_HOST_CLASS(GlobalEngine)
	YADE_HOST_ARCHIVE(Engine, )
};
YADE_ABI_SIZE(GlobalEngine, 104)
REGISTER_SERIALIZABLE(GlobalEngine)

} // namespace yade
