// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"

#include <pkg/brick/kernel/MortarLaw.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace brick;

namespace {

constexpr Real below = 1 - 1e-7, above = 1 + 1e-7; ///< wide of the eight digits of the references (dyn.bond)

MortarStrength mortar(Real capShape = 9) { return { pairs::tensile, pairs::cohesive, pairs::friction, pairs::crush, capShape }; }

} // namespace

TEST(MortarLawTest, unstressed_mortar_holds) { EXPECT_EQ(failureMode(mortar(), 0, 0), SegmentState::Intact); }

TEST(MortarLawTest, tension_fails_above_the_tensile_strength)
{
	// at sigma = ft the Coulomb line allows c - ft tan(phi) = 25.6 Pa of shear
	EXPECT_EQ(failureMode(mortar(), pairs::tensile * below, 0), SegmentState::Intact);
	EXPECT_EQ(failureMode(mortar(), pairs::tensile, 0), SegmentState::Intact);
	EXPECT_EQ(failureMode(mortar(), pairs::tensile * above, 0), SegmentState::Tension);
}

TEST(MortarLawTest, shear_fails_on_the_coulomb_line)
{
	const std::pair<Real, Real> row[] = { { 0, 116. }, { 1e3, 140.99477 }, { 5e3, 240.97387 }, { 2e4, 615.89548 }, { 1e5, 2615.4774 } }; // N on 0.04 m2
	for (const auto& r : row) {
		const Real tau = r.second / .04;
		EXPECT_EQ(failureMode(mortar(), -r.first, tau * below), SegmentState::Intact) << r.first;
		EXPECT_EQ(failureMode(mortar(), -r.first, tau * above), SegmentState::Shear) << r.first;
	}
	// exactly on it: numbers without rounding
	const MortarStrength exact { 4, 2, .5, 16, 9 };
	EXPECT_EQ(failureMode(exact, -2, 3), SegmentState::Intact);
	EXPECT_EQ(failureMode(exact, -2, std::nextafter(3., 4.)), SegmentState::Shear);
	EXPECT_EQ(failureMode(exact, -2 * (1 - 1e-15), 3), SegmentState::Shear);
}

TEST(MortarLawTest, compression_fails_beyond_the_cap)
{
	EXPECT_EQ(failureMode(mortar(), -pairs::crush, 0), SegmentState::Intact);
	EXPECT_EQ(failureMode(mortar(), -pairs::crush * above, 0), SegmentState::Compression);
	// dyn.bond, tau_at_half_fm; Coulomb allows 156 kPa there, so that the cap of Cs = 9 decides and that of Cs = 1 does not
	EXPECT_EQ(failureMode(mortar(9), -pairs::crush / 2, 141450.82 * below), SegmentState::Intact);
	EXPECT_EQ(failureMode(mortar(9), -pairs::crush / 2, 141450.82 * above), SegmentState::Compression);
	MortarStrength cohesive = mortar(1);
	cohesive.cohesion       = 1e9;
	EXPECT_EQ(failureMode(cohesive, -pairs::crush / 2, 424352.45 * below), SegmentState::Intact);
	EXPECT_EQ(failureMode(cohesive, -pairs::crush / 2, 424352.45 * above), SegmentState::Compression);
	const MortarStrength exact { 4, 20, .5, 5, 1 }; // 3-4-5
	EXPECT_EQ(failureMode(exact, -3, 4), SegmentState::Intact);
	EXPECT_EQ(failureMode(exact, -3, std::nextafter(4., 5.)), SegmentState::Compression);
}

TEST(MortarLawTest, cap_meets_the_coulomb_line_where_the_reference_says)
{
	struct {
		Real shape, sigma, tau;
	} const corner[] = { { 1, 414235.08, 261742.81 }, { 9, 227004.84, 144748.37 } }; // dyn.bond, cap_Cs1 and cap_Cs9
	for (const auto& c : corner) {
		EXPECT_EQ(failureMode(mortar(c.shape), -c.sigma * below, c.tau * (1 - 3e-7)), SegmentState::Intact) << c.shape;
		EXPECT_EQ(failureMode(mortar(c.shape), -c.sigma * .99, c.tau), SegmentState::Shear) << c.shape;
		EXPECT_EQ(failureMode(mortar(c.shape), -c.sigma * 1.01, c.tau), SegmentState::Compression) << c.shape;
	}
}

TEST(MortarLawTest, cap_is_asked_in_compression_only)
{
	MortarStrength weak = mortar(); // fm below ft: no mortar, but it shows
	weak.compression    = 1;
	EXPECT_EQ(failureMode(weak, 100, 100), SegmentState::Intact);
	EXPECT_EQ(failureMode(weak, 0, 100), SegmentState::Intact);
	EXPECT_EQ(failureMode(weak, -1e-300, 100), SegmentState::Compression);
}

TEST(MortarLawTest, modes_are_asked_in_the_papers_order)
{
	EXPECT_EQ(failureMode(mortar(), 2 * pairs::tensile, 1e6), SegmentState::Tension);
	EXPECT_EQ(failureMode(mortar(), -2 * pairs::crush, 1e6), SegmentState::Shear);
}
