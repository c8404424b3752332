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

namespace {

/// Where a pressure acts that grows from nothing at x = level, from the part of a polygon beyond.
Vector2r pressed(Polygon p)
{
	Vertex centre;
	p.areaAndCentroid(centre);
	p.pressedCentroid(3, centre);
	return centre.head<2>();
}

} // namespace

TEST(ClippedPolygonTest, wedge_of_pressure_acts_at_two_thirds)
{
	// depth 1 - x over the square: a wedge along x
	EXPECT_LT((pressed(square(1)) - Vector2r(1. / 3, .5)).norm(), roundOff);
	// depth 3 - x: a block of 2 and a wedge of 1
	EXPECT_LT((pressed(square(3)) - Vector2r((2 * .5 + .5 / 3) / 2.5, .5)).norm(), roundOff);
	// cut where it ends: a wedge over the part
	Polygon part = square(.4);
	part.keepNegative(3);
	EXPECT_LT((pressed(part) - Vector2r(.4 / 3, .5)).norm(), roundOff);
}

TEST(ClippedPolygonTest, pressure_on_a_triangle_acts_where_its_closed_form_says)
{
	// depths a, b, c at the corners (0,0), (1,0), (0,1): place = sum of the corners weighted with (their depth + all) / 4 all
	for (const auto& depth : { Vector3r(1, 1, 1), Vector3r(1, 0, 0), Vector3r(0, 1, 0), Vector3r(2, 1, 5) }) {
		const auto in = [&](Real x, Real y) {
			Vertex v = at(x, y, 0);
			v[3]     = -(depth[0] + x * (depth[1] - depth[0]) + y * (depth[2] - depth[0]));
			v[4]     = x + y - 1;
			return v;
		};
		Polygon triangle(in(0, 0), in(1, 0), in(1, 1), in(0, 1));
		triangle.keepNegative(4);
		const Real all = depth.sum();
		EXPECT_LT((pressed(triangle) - Vector2r(depth[1] + all, depth[2] + all) / (4 * all)).norm(), roundOff) << depth.transpose();
	}
	// on an uncut square the same by halves: depth 1 - x + y / 2
	const auto in = [](Real x, Real y) {
		Vertex v = at(x, y, 0);
		v[3]     = -(1 - x + y / 2);
		return v;
	};
	// integrals over the square: 3/4, x: 1/6 + 1/8, y: 1/4 + 1/6
	EXPECT_LT((pressed(Polygon(in(0, 0), in(1, 0), in(1, 1), in(0, 1))) - Vector2r((1. / 6 + 1. / 8) / .75, (1. / 4 + 1. / 6) / .75)).norm(), roundOff);
}

TEST(ClippedPolygonTest, without_pressure_the_centroid_stays)
{
	EXPECT_EQ(pressed(square(-.5)), Vector2r(.5, .5)); // nothing is beyond
	EXPECT_EQ(pressed(square(.5)), Vector2r(.5, .5));  // as much pulls as presses
}
