// SPDX-License-Identifier: GPL-2.0-or-later
//
// Checks of the material data. They run whenever an attribute is set, so that a wrong value raises at once.

#include "BrickMat.hpp"

#include <cmath>
#include <sstream>

namespace yade {
namespace {

	[[noreturn]] void reject(const std::string& what, Real value, const std::string& allowed)
	{
		std::ostringstream text;
		text << what << " = " << value << " is not allowed: it must be " << allowed;
		throw std::invalid_argument(text.str());
	}

	void requireNotNegative(const char* what, Real value)
	{
		if (!(value >= 0) || std::isinf(value)) reject(what, value, "finite and not negative");
	}

	void requirePositive(const char* what, Real value)
	{
		if (!(value > 0) || std::isinf(value)) reject(what, value, "finite and positive");
	}

	void requirePoisson(const char* what, Real value)
	{
		if (!(value > -1 && value < .5)) reject(what, value, "between -1 and 0.5, both excluded");
	}

	void requireFrictionAngle(const char* what, Real value)
	{
		if (!(value >= 0 && value < M_PI / 2)) reject(what, value, "an angle in radians from 0 to below pi/2");
	}

	bool given(Real value) { return !std::isnan(value); }

} // namespace

void Mortar::postLoad(Mortar&)
{
	if (given(young)) requirePositive("Mortar.young [Pa]", young);
	if (given(poisson)) requirePoisson("Mortar.poisson", poisson);
	requireNotNegative("Mortar.thickness [m]", thickness);
	if (given(tensileStrength)) requireNotNegative("Mortar.tensileStrength [Pa]", tensileStrength);
	if (given(cohesion)) requireNotNegative("Mortar.cohesion [Pa]", cohesion);
	if (given(frictionAngle)) requireFrictionAngle("Mortar.frictionAngle", frictionAngle);
	if (given(compressiveStrength)) requirePositive("Mortar.compressiveStrength [Pa]", compressiveStrength);
	requireNotNegative("Mortar.Cs", Cs);
}

void BrickMat::postLoad(BrickMat&)
{
	requirePositive("BrickMat.young [Pa]", young);
	requirePoisson("BrickMat.poisson", poisson);
	requirePositive("BrickMat.density [kg/m3]", density);
	requireFrictionAngle("BrickMat.frictionAngle", frictionAngle);
	requireNotNegative("BrickMat.hn", hn);
	requireNotNegative("BrickMat.hs", hs);
	requireNotNegative("BrickMat.dampingRatio", dampingRatio);
	if (dampingRatio >= 1) reject("BrickMat.dampingRatio", dampingRatio, "below 1 (critical)");
}

YADE_PLUGIN((Mortar)(BrickMat))

} // namespace yade
