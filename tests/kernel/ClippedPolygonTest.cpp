// SPDX-License-Identifier: GPL-2.0-or-later
#include <pkg/brick/kernel/ClippedPolygon.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace brick;

namespace {

constexpr Real roundOff = 1e-14; ///< numbers of order 1, a few roundings

using Polygon = ClippedPolygon<6, 4>; // place and three values
using Vertex  = Polygon::Vertex;

/// The unit square in the plane z = 0, with the values x - level, y - level and 2 x + y.
Vertex at(Real x, Real y, Real level)
{
	Vertex v;
	v << x, y, 0, x - level, y - level, 2 * x + y;
	return v;
}
Polygon square(Real level) { return Polygon(at(0, 0, level), at(1, 0, level), at(1, 1, level), at(0, 1, level)); }

Real area(const Polygon& p)
{
	Vertex centre;
	return p.areaAndCentroid(centre);
}

} // namespace

TEST(ClippedPolygonTest, uncut_square_has_its_area_and_centre)
{
	Vertex centre;
	EXPECT_NEAR(square(.5).areaAndCentroid(centre), 1, roundOff);
	EXPECT_LT((centre - at(.5, .5, .5)).norm(), roundOff);
}

TEST(ClippedPolygonTest, trapezoid_in_space_has_its_area_and_centroid)
{
	// parallel sides 3 and 1, height 2, in a plane turned about x
	const auto in = [](Real p, Real q) {
		Vertex v;
		v << p, .6 * q, .8 * q, p, q, 1;
		return v;
	};
	Vertex centre;
	EXPECT_NEAR(Polygon(in(0, 0), in(3, 0), in(2, 2), in(1, 2)).areaAndCentroid(centre), 4, roundOff);
	EXPECT_LT((centre - in(1.5, 2. / 3 * (3 + 2 * 1) / (3 + 1))).norm(), roundOff);
}

TEST(ClippedPolygonTest, cut_keeps_the_negative_part_and_its_values)
{
	Polygon p = square(.25);
	p.keepNegative(3); // x < 1/4
	Vertex centre;
	EXPECT_NEAR(p.areaAndCentroid(centre), .25, roundOff);
	EXPECT_LT((centre - at(.125, .5, .25)).norm(), roundOff);
	p.keepNegative(4); // y < 1/4
	EXPECT_NEAR(p.areaAndCentroid(centre), .0625, roundOff);
	EXPECT_LT((centre - at(.125, .125, .25)).norm(), roundOff);
}

TEST(ClippedPolygonTest, cut_across_a_corner_leaves_a_pentagon)
{
	const auto in = [](Real x, Real y) {
		Vertex v = at(x, y, 0);
		v[3]     = x + y - 1.5;
		return v;
	};
	Polygon p(in(0, 0), in(1, 0), in(1, 1), in(0, 1));
	p.keepNegative(3);
	Vertex centre;
	EXPECT_NEAR(p.areaAndCentroid(centre), 1 - .125, roundOff);
	const Real c = (.5 - .125 * 5 / 6) / .875; // the square less the triangle at the corner, whose centroid is at 5/6
	EXPECT_LT((centre.head<2>() - Vector2r(c, c)).norm(), roundOff);
}

TEST(ClippedPolygonTest, comparing_two_values_parts_the_square_along_its_diagonal)
{
	Polygon upper = square(.5), lower = square(.5);
	upper.keepAbove(4, 3), lower.keepAbove(3, 4); // y > x, x > y
	Vertex centre;
	EXPECT_NEAR(upper.areaAndCentroid(centre), .5, roundOff);
	EXPECT_LT((centre.head<2>() - Vector2r(1. / 3, 2. / 3)).norm(), roundOff);
	EXPECT_NEAR(lower.areaAndCentroid(centre), .5, roundOff);
	EXPECT_LT((centre.head<2>() - Vector2r(2. / 3, 1. / 3)).norm(), roundOff);
}

TEST(ClippedPolygonTest, square_beyond_the_cut_is_gone_and_before_it_is_whole)
{
	Polygon gone = square(-.1), whole = square(1.1);
	gone.keepNegative(3), whole.keepNegative(3);
	EXPECT_TRUE(gone.empty());
	EXPECT_EQ(area(gone), 0);
	EXPECT_FALSE(whole.empty());
	EXPECT_NEAR(area(whole), 1, roundOff);
	gone.keepNegative(4); // cutting nothing leaves nothing
	EXPECT_TRUE(gone.empty());
}

TEST(ClippedPolygonTest, touching_the_cut_counts_as_beyond_it)
{
	Polygon outside = square(0), inside = square(1), sliver = square(1e-12);
	outside.keepNegative(3), inside.keepNegative(3), sliver.keepNegative(3);
	EXPECT_EQ(area(outside), 0);
	EXPECT_NEAR(area(inside), 1, roundOff);
	EXPECT_NEAR(area(sliver), 1e-12, 1e-16); // its place rounds like any other, to 1e-16 of the unit square
}

TEST(ClippedPolygonTest, parts_on_both_sides_of_any_cuts_sum_to_the_whole)
{
	for (Real slope : { -3., -.7, 0., .2, 1., 11. })
		for (Real level : { -.4, .1, .5, .93 }) {
			Real   sum     = 0;
			Vertex moments = Vertex::Zero();
			for (Real first : { -1., 1. })
				for (Real second : { -1., 1. }) {
					const auto in = [&](Real x, Real y) {
						Vertex v = at(x, y, 0);
						v[3] = first * (y - slope * x - level), v[4] = second * (x + slope * y - level);
						return v;
					};
					Polygon p(in(0, 0), in(1, 0), in(1, 1), in(0, 1));
					p.keepNegative(3), p.keepNegative(4);
					Vertex     centre;
					const Real part = p.areaAndCentroid(centre);
					sum += part, moments += part * centre;
				}
			EXPECT_NEAR(sum, 1, roundOff);
			EXPECT_LT((moments.head<2>() - Vector2r(.5, .5)).norm(), roundOff);
			EXPECT_NEAR(moments[5], 1.5, roundOff); // 2 x + y
		}
}
