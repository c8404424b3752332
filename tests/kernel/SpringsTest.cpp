// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace brick;

namespace {

constexpr Real roundOff = 1e-14; ///< relative, a few roundings
constexpr Real printed  = 2e-8;  ///< relative: references have eight digits

/// E of the paper's bricks; another material, to tell the sides apart.
const Elasticity brickElasticity { pairs::young, pairs::poisson }, other { 3e7, .4 }, mortar { 2e6, .1 };

PairSprings between(const Elasticity& a, const Elasticity& b, Real densityA = 1800, Real densityB = 2400)
{
	PairSprings p;
	p.normalCompliance = { a.normalCompliance(), b.normalCompliance() };
	p.shearCompliance  = { a.shearCompliance(), b.shearCompliance() };
	p.density          = { densityA, densityB };
	return p;
}

} // namespace

TEST(SpringsTest, one_brick_on_a_support_has_the_springs_of_equation_1)
{
	const SpotSprings s = pairs::onSupport(pairs::springs(), 0).at(0, .1);
	EXPECT_NEAR(s.normal, 9.8e6 / ((1 - .25 * .25) * .1), roundOff * s.normal);
	EXPECT_NEAR(s.shear, 9.8e6 / (2 * (1 + .25) * .1), roundOff * s.shear);
}

TEST(SpringsTest, two_bricks_have_the_springs_of_the_reference)
{
	const SpotSprings thin = pairs::springs().at(.001, .001), rigid = pairs::springs().at(.1, .1); // eq. (16), eq. (3)
	EXPECT_NEAR(thin.normal, pairs::knThin, printed * pairs::knThin);
	EXPECT_NEAR(thin.shear, pairs::ksThin, printed * pairs::ksThin);
	EXPECT_NEAR(rigid.normal, pairs::knRigid, printed * pairs::knRigid);
	EXPECT_NEAR(rigid.shear, pairs::ksRigid, printed * pairs::ksRigid);
}

TEST(SpringsTest, mortar_acts_in_series_between_shortened_bricks)
{
	const Real lA = .1, lB = .05, tM = .012;
	auto       p = between(brickElasticity, other);
	p.setMortar(mortar, tM);
	const SpotSprings s = p.at(lA, lB);
	// eq. (2), written out
	const Real normal = (lA - tM / 2) * (1 - .25 * .25) / 9.8e6 + (lB - tM / 2) * (1 - .4 * .4) / 3e7 + tM * (1 - .1 * .1) / 2e6;
	const Real shear  = 2 * (lA - tM / 2) * (1 + .25) / 9.8e6 + 2 * (lB - tM / 2) * (1 + .4) / 3e7 + 2 * tM * (1 + .1) / 2e6;
	EXPECT_NEAR(s.normal, 1 / normal, roundOff / normal);
	EXPECT_NEAR(s.shear, 1 / shear, roundOff / shear);
}

TEST(SpringsTest, mortar_as_thick_as_both_contact_parts_is_all_there_is)
{
	auto p = between(brickElasticity, other);
	p.setMortar(mortar, .002);
	EXPECT_NEAR(p.at(.001, .001).normal, 2e6 / ((1 - .01) * .002), 10 * roundOff * 1e9); // the bricks' shares cancel
	EXPECT_NEAR(p.at(.001, .001).shear, 2e6 / (2.2 * .002), 10 * roundOff * 1e9);
}

TEST(SpringsTest, mortar_of_no_thickness_or_of_the_bricks_own_material_changes_nothing)
{
	const auto plain = between(brickElasticity, brickElasticity);
	auto       none = plain, same = plain;
	none.setMortar(mortar, 0);
	same.setMortar(brickElasticity, .01);
	for (const auto& p : { none, same }) {
		EXPECT_NEAR(p.at(.1, .05).normal, plain.at(.1, .05).normal, roundOff * plain.at(.1, .05).normal);
		EXPECT_NEAR(p.at(.1, .05).shear, plain.at(.1, .05).shear, roundOff * plain.at(.1, .05).shear);
	}
}

TEST(SpringsTest, dashpots_follow_equation_4)
{
	auto p          = between(brickElasticity, other, 1800, 2400);
	p.normalDamping = .05, p.shearDamping = .2;
	p.setMortar(mortar, .01);
	const SpotSprings s    = p.at(.1, .05);
	const Real        mean = 1800 * .1 + 2400 * .05;
	EXPECT_NEAR(s.normalDashpot, 2 * .05 * std::sqrt(mean * s.normal), roundOff * s.normalDashpot);
	EXPECT_NEAR(s.shearDashpot, 2 * .2 * std::sqrt(mean * s.shear), roundOff * s.shearDashpot);
	const SpotSprings without = between(brickElasticity, other).at(.1, .05);
	EXPECT_EQ(without.normalDashpot, 0);
	EXPECT_EQ(without.shearDashpot, 0);
}

TEST(SpringsTest, swapping_the_sides_changes_nothing)
{
	auto a = between(brickElasticity, other, 1800, 2400), b = between(other, brickElasticity, 2400, 1800);
	a.normalDamping = b.normalDamping = a.shearDamping = b.shearDamping = .1;
	a.setMortar(mortar, .01), b.setMortar(mortar, .01);
	const SpotSprings one = a.at(.1, .05), two = b.at(.05, .1);
	EXPECT_NEAR(one.normal, two.normal, roundOff * one.normal); // sums in another order
	EXPECT_NEAR(one.shear, two.shear, roundOff * one.shear);
	EXPECT_NEAR(one.normalDashpot, two.normalDashpot, roundOff * one.normalDashpot);
	EXPECT_NEAR(one.shearDashpot, two.shearDashpot, roundOff * one.shearDashpot);
}
