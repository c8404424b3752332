// SPDX-License-Identifier: GPL-2.0-or-later
// When a segment of mortar fails.                                                        [Furukawa2014, eqs. (6)-(8)]
//     tension       f1 = sigma - ft
//     shear         f2 = |tau| + sigma tan(phi) - c
//     compression   f3 = sigma^2 + Cs |tau|^2 - fm^2     for sigma < 0
// sigma is positive in tension. A segment fails when one of them is above zero, and stays failed.
#pragma once

#include "Types.hpp"

namespace brick {

enum class SegmentState : int { Intact = 0, Tension = 1, Shear = 2, Compression = 3 };

struct MortarStrength {
	Real tension     = 0; ///< ft [Pa]
	Real cohesion    = 0; ///< c [Pa]
	Real tanFriction = 0; ///< tan(phi)
	Real compression = 0; ///< fm [Pa]
	Real capShape    = 0; ///< Cs
};

/// The mode in which a segment under (sigma, |tau|) [Pa] fails, Intact when it holds. Modes are asked in the paper's order.
inline SegmentState failureMode(const MortarStrength& strength, Real sigma, Real tau)
{
	if (sigma > strength.tension) return SegmentState::Tension;
	if (tau + sigma * strength.tanFriction > strength.cohesion) return SegmentState::Shear;
	if (sigma < 0 && sigma * sigma + strength.capShape * tau * tau > strength.compression * strength.compression) return SegmentState::Compression;
	return SegmentState::Intact;
}

} // namespace brick
