// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contact with friction.
#pragma once

#include <pkg/common/NormShearPhys.hpp>

namespace yade {

class FrictPhys : public NormShearPhys {
public:
	Real tangensOfFrictionAngle = NaN;

	FrictPhys() { createIndex(); }
	YADE_HOST_CLASS(FrictPhys)
	YADE_HOST_ARCHIVE(NormShearPhys, (tangensOfFrictionAngle))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(FrictPhys, 104)
YADE_ABI_OFFSET(FrictPhys, tangensOfFrictionAngle, 96)
REGISTER_SERIALIZABLE(FrictPhys)

} // namespace yade
