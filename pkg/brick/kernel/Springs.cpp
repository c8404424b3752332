// SPDX-License-Identifier: GPL-2.0-or-later
#include "Springs.hpp"

#include <cmath>

namespace brick {

void PairSprings::setMortar(const Elasticity& mortar, Real thickness)
{
	mortarThickness = thickness;
	mortarNormal = thickness * mortar.normalCompliance() - thickness / 2 * (normalCompliance[0] + normalCompliance[1]);
	mortarShear  = thickness * mortar.shearCompliance() - thickness / 2 * (shearCompliance[0] + shearCompliance[1]);
}

SpotSprings PairSprings::at(Real l0, Real l1) const
{
	SpotSprings s;
	s.normal              = 1 / (l0 * normalCompliance[0] + l1 * normalCompliance[1] + mortarNormal);
	s.shear               = 1 / (l0 * shearCompliance[0] + l1 * shearCompliance[1] + mortarShear);
	const Real massByArea = density[0] * l0 + density[1] * l1;
	s.normalDashpot       = 2 * normalDamping * std::sqrt(massByArea * s.normal);
	s.shearDashpot        = 2 * shearDamping * std::sqrt(massByArea * s.shear);
	return s;
}

} // namespace brick
