// SPDX-License-Identifier: GPL-2.0-or-later
#include <pkg/brick/kernel/InnerPart.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace brick;

namespace {

constexpr Real roundOff = 1e-11; ///< relative, of eigenvalues of 24 x 24 matrices

InnerPartType cube(Inner inner = Inner::Inset, Deformation level = Deformation::Trilinear, Real r = .005)
{
	return { cuboidCorners(Vector3r::Constant(.2)), level, Element::Full, inner, r, 9.8e6, .25, 1800 };
}

} // namespace

TEST(InnerPartTest, nodes_sit_a_contact_part_inside_the_corners_or_at_them)
{
	const Nodes     corners = cuboidCorners(Vector3r::Constant(.2));
	const InnerPart inset(cube()), full(cube(Inner::FullSize));
	for (int a = 0; a < nodeCount; ++a) {
		EXPECT_LT((inset.nodes[a] - .95 * corners[a]).norm(), 1e-15);
		EXPECT_EQ(full.nodes[a], corners[a]);
	}
}

TEST(InnerPartTest, level_decides_the_number_of_modes)
{
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Rigid)).modes.count, 0);
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Uniform)).modes.count, 6);
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Trilinear)).modes.count, 18);
}

TEST(InnerPartTest, nodes_carry_the_whole_bricks_mass)
{
	// Spectrum of a cube's K is E L times fixed numbers, the largest 1 / (1 - 2 nu) / 2 = 1; nodes weigh an eighth of the brick each, whatever their hexahedron.
	for (Real r : { .001, .005, .02 }) {
		const Real node = 1800 * .2 * .2 * .2 / 8;
		EXPECT_NEAR(InnerPart(cube(Inner::Inset, Deformation::Trilinear, r)).modes.omegaSquared[17] * node / (9.8e6 * (.2 - 2 * r)), 1, roundOff);
		EXPECT_NEAR(InnerPart(cube(Inner::FullSize, Deformation::Trilinear, r)).modes.omegaSquared[17] * node / (9.8e6 * .2), 1, roundOff);
	}
}

TEST(InnerPartTest, inset_softens_a_brick_as_its_smaller_section_says)
{
	// pulled by two opposite faces: the nodes' spread is N l / (E l^2), with l = L - 2 r
	const InnerPart part(cube());
	Vector24        f, u = Vector24::Zero();
	for (int a = 0; a < nodeCount; ++a)
		f.segment<3>(3 * a) = Vector3r(nodeSigns[a][0] * 25, 0, 0);
	for (int k = 0; k < part.modes.count; ++k)
		u += part.modes.shapes.col(k) * part.modes.shapes.col(k).dot(f) / part.modes.omegaSquared[k];
	const Real spread = u[3] - u[0]; // nodes 1 and 0
	EXPECT_NEAR(spread, 100 / (9.8e6 * .19), roundOff * spread);
}

TEST(InnerPartTest, contact_part_too_thick_for_the_brick_is_refused)
{
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	for (Real r : { .1, .2, 0., -.01, nan })
		EXPECT_THROW(InnerPart(cube(Inner::Inset, Deformation::Trilinear, r)), std::invalid_argument) << r;
	auto poisson    = cube();
	poisson.poisson = .5;
	EXPECT_THROW(InnerPart { poisson }, std::invalid_argument);
}
