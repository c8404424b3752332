// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr Real roundOff  = 1e-14; ///< lengths and areas of order 0.1, a few roundings
constexpr Real printed   = 2e-8;  ///< relative: references have eight digits, and so do the inputs made of them
constexpr Real tolerance = 3e-7;  ///< within which faces touch [m]: 1e-6 of a brick's diagonal, as in a scene

constexpr int below = 4, above = 5; // faces -z and +z

MortarStrength mortar() { return { pairs::tensile, pairs::cohesive, pairs::friction, pairs::crush, 9 }; }
MortarStrength unbreakable() { return { 1e30, 1e30, pairs::friction, 1e30, 9 }; }

/// Two bodies and their joint.
struct Pair {
	Body        first, second;
	PairSprings springs;
	Joint       joint;

	Pair(const Body& first, const Body& second, int face0 = above, int face1 = below, const MortarStrength& strength = unbreakable())
	        : first(first)
	        , second(second)
	        , springs(pairs::springs())
	{
		if (first.support) springs = pairs::onSupport(springs, 0);
		if (second.support) springs = pairs::onSupport(springs, 1);
		const auto found = joinFaces(first.side(), face0, second.side(), face1, tolerance);
		if (!found) throw std::logic_error("the faces do not touch");
		joint          = *found;
		joint.setMortar(springs.at(first.contactLength[face0], second.contactLength[face1]), strength);
	}
	static Pair stacked(const MortarStrength& strength = unbreakable(), int segments = 4)
	{
		return Pair(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, edge }, segments), above, below, strength);
	}
	/// Half over half, deformable, anywhere.
	static Pair english(const Vector3r& turn = Vector3r(.3, -1.1, .7))
	{
		Body lower = Body::cube(), upper = Body::cube({ edge / 2, 0, edge });
		lower.deformable = upper.deformable = true;
		lower.move(turn, { 1, -2, .5 }), upper.move(turn, { 1, -2, .5 });
		return Pair(lower, upper);
	}

	JointMotion motion() const { return pairs::motionOf(joint, first, second); }

	struct Answer {
		std::array<Loads, 2> loads;
		PairSummary          sum;
		Failures             failures;
	};
	Answer step()
	{
		Answer a;
		a.failures = pairs::stepJoint(joint, springs, first, second, a.loads, a.sum);
		return a;
	}
	/// Of an intact joint, without touching it.
	Answer answer() const { return Pair(*this).step(); }

	void breakAll() { pairs::failAll(joint, SegmentState::Tension); }
	Real area() const
	{
		Real out = 0;
		for (const auto& s : pairs::segmentsOf(joint))
			out += s.area;
		return out;
	}
	/// Place of a segment on one of the bodies, world axes.
	Vector3r place(const JointSegment& s, int side) const
	{
		return (side ? second : first).world(joint.shape->patches[s.patch].sides[side].corners.transpose() * cornerWeights(s.p, s.q));
	}
	/// Largest distance between the two places of a segment.
	Real widest() const
	{
		Real out = 0;
		for (const auto& s : pairs::segmentsOf(joint))
			out = std::max(out, (place(s, 1) - place(s, 0)).norm());
		return out;
	}
};

/// Area of the overlap of two convex polygons, counter-clockwise: by cutting the first by the edges of the second.
Real overlapArea(std::vector<Vector2r> polygon, const std::vector<Vector2r>& other)
{
	const auto cross = [](const Vector2r& a, const Vector2r& b) { return a[0] * b[1] - a[1] * b[0]; };
	for (std::size_t e = 0; e < other.size(); ++e) {
		const Vector2r        from = other[e], along = other[(e + 1) % other.size()] - from;
		std::vector<Vector2r> kept;
		for (std::size_t i = 0; i < polygon.size(); ++i) {
			const Vector2r a = polygon[i], b = polygon[(i + 1) % polygon.size()];
			const Real     ha = cross(along, a - from), hb = cross(along, b - from);
			if (ha >= 0) kept.push_back(a);
			if ((ha >= 0) != (hb >= 0)) kept.push_back(a + ha / (ha - hb) * (b - a));
		}
		polygon = kept;
	}
	Real area = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i)
		area += cross(polygon[i], polygon[(i + 1) % polygon.size()]) / 2;
	return area;
}

/// A voussoir of an arch about the y axis, inner radius 1 m, thickness 0.2 m; in its body frame. `middle` is the angle of its axis from the crown.
Body voussoir(Real from, Real to, const std::array<Real, 2>& width = { .25, .25 })
{
	Nodes corners;
	for (int a = 0; a < nodeCount; ++a) {
		const int* s      = nodeSigns[a];
		const Real radius = s[2] > 0 ? 1.2 : 1, angle = s[0] > 0 ? to : from;
		corners[a] = { radius * std::sin(angle), s[1] * width[s[2] > 0] / 2, radius * std::cos(angle) };
	}
	const Vector3r centre = solidProperties(corners).centroid;
	for (auto& x : corners)
		x -= centre;
	Body b(corners);
	b.placement.position = centre;
	return b;
}

void expectBalance(const Pair& p, const Pair::Answer& a, Real scale)
{
	EXPECT_LT((a.loads[0].force + a.loads[1].force).norm(), 1e-15 * scale); // one is the negative of the other
	for (const Vector3r& about : { Vector3r(0, 0, 0), Vector3r(5, -3, 2) })
		EXPECT_LT(pairs::totalMoment(p.first, p.second, a.loads, about).norm(), 1e-14 * scale); // arms of up to 6 m
}

} // namespace

// Geometry

TEST(JointTest, full_overlap_of_two_cubes_gives_n_by_n_equal_segments)
{
	for (int n : { 1, 2, 4, 7 }) {
		const Pair p = Pair::stacked(unbreakable(), n);
		ASSERT_EQ(p.joint.count(), n * n);
		EXPECT_EQ(p.joint.intact(), n * n);
		for (const auto& s : pairs::segmentsOf(p.joint))
			EXPECT_NEAR(s.area, edge * edge / (n * n), roundOff * edge * edge);
		EXPECT_NEAR(p.area(), edge * edge, roundOff * edge * edge);
		EXPECT_LT(p.widest(), roundOff);
	}
}

TEST(JointTest, half_overlap_of_an_english_bond_gives_half_the_segments_and_half_the_area)
{
	for (int n : { 2, 4, 6 }) {
		const Pair p(Body::cube({ 0, 0, 0 }, n), Body::cube({ edge / 2, 0, edge }, n));
		EXPECT_EQ(p.joint.count(), n * n / 2);
		EXPECT_NEAR(p.area(), edge * edge / 2, roundOff * edge * edge);
		EXPECT_LT(p.widest(), roundOff);
		for (const auto& s : pairs::segmentsOf(p.joint))
			EXPECT_GT(p.place(s, 0)[0], 0);
	}
}

TEST(JointTest, brick_of_half_the_size_takes_the_finer_grid_of_the_two)
{
	const Body whole = Body::cuboid({ .2, .2, .2 }, { 0, 0, 0 }, 2), half = Body::cuboid({ .1, .2, .2 }, { .05, 0, .2 }, 8);
	for (const Pair& p : { Pair(whole, half), Pair(half, whole, below, above) }) {
		EXPECT_EQ(p.joint.count(), 4 * 8); // cells of 0.2 m / 8
		EXPECT_NEAR(p.area(), .02, roundOff * .02);
	}
}

TEST(JointTest, squares_turned_by_45_degrees_overlap_in_a_regular_octagon)
{
	for (int n : { 1, 3, 4, 16 }) {
		Body upper = Body::cube({ 0, 0, edge }, n);
		upper.move({ 0, 0, M_PI / 4 });
		const Pair p(Body::cube({ 0, 0, 0 }, n), upper);
		EXPECT_NEAR(p.area(), 2 * (std::sqrt(2.) - 1) * edge * edge, 10 * roundOff * edge * edge); // cut eight times
		EXPECT_LT(p.widest(), roundOff);
	}
}

TEST(JointTest, areas_sum_to_the_overlap_and_places_coincide_however_the_faces_lie)
{
	pairs::Random random(1);
	for (int trial = 0; trial < 200; ++trial) {
		const Vector3r        size0(random.between(.1, .4), random.between(.1, .4), .2), size1(random.between(.1, .4), random.between(.1, .4), .2);
		const Real            angle = random.between(-M_PI, M_PI);
		const Vector3r        shift(random.between(-.1, .1), random.between(-.1, .1), .2);
		std::vector<Vector2r> flat[2];
		for (int a = 0; a < 4; ++a) {
			const Vector2r corner(a == 0 || a == 3 ? -.5 : .5, a < 2 ? -.5 : .5);
			flat[0].push_back(corner.cwiseProduct(size0.head<2>()));
			flat[1].push_back(shift.head<2>() + Eigen::Rotation2D<Real>(angle) * Vector2r(corner.cwiseProduct(size1.head<2>())));
		}
		Body lower = Body::cuboid(size0, { 0, 0, 0 }, 1 + trial % 5), upper = Body::cuboid(size1, { 0, 0, 0 }, 1 + trial % 3);
		upper.move({ 0, 0, angle }, shift);
		const Vector3r turn = random.turn(), away = random.vector(1);
		lower.move(turn, away), upper.move(turn, away);
		const Pair p(lower, upper), swapped(upper, lower, below, above);
		const Real expected = overlapArea(flat[0], flat[1]);
		EXPECT_NEAR(p.area(), expected, 1e-9 * .16 + roundOff); // slivers below 1e-9 of a cell are left out
		EXPECT_NEAR(swapped.area(), expected, 1e-9 * .16 + roundOff);
		EXPECT_LT(p.widest(), 20 * roundOff); // bricks up to 1.7 m from the origin
	}
}

TEST(JointTest, voussoirs_join_on_their_radial_faces)
{
	for (const std::array<Real, 2>& width : { std::array<Real, 2> { .25, .25 }, std::array<Real, 2> { .2, .3 } }) { // rectangles, trapezia
		const Pair p(voussoir(-.2, 0, width), voussoir(0, .3, width), 1, 0);
		EXPECT_NEAR(p.area(), .2 * (width[0] + width[1]) / 2, 1e-12); // slivers along the slanting edges
		EXPECT_LT(p.widest(), 5 * roundOff);                          // 1 m from the origin
		EXPECT_LT((p.motion().normal - p.first.solid.faces[1].normal).norm(), roundOff);
	}
}

TEST(JointTest, trapezoidal_faces_join_like_any_other)
{
	Body front = voussoir(-.1, .1), back = voussoir(-.1, .1);
	back.placement.position[1] += .25;
	const Pair p(front, back, 3, 2);
	EXPECT_NEAR(p.area(), (1.2 * 1.2 - 1) * std::sin(.2) / 2, 1e-12);
	EXPECT_LT(p.widest(), 5 * roundOff);
}

TEST(JointTest, faces_further_apart_than_the_tolerance_do_not_join)
{
	for (Real gap : { -2 * tolerance, 2 * tolerance, 1., -.2 })
		EXPECT_FALSE(joinFaces(Body::cube().side(), above, Body::cube({ 0, 0, edge + gap }).side(), below, tolerance)) << gap;
	for (Real gap : { -tolerance / 2, 0., tolerance / 2 })
		EXPECT_TRUE(joinFaces(Body::cube().side(), above, Body::cube({ 0, 0, edge + gap }).side(), below, tolerance)) << gap;
}

TEST(JointTest, faces_that_look_the_same_way_or_across_do_not_join)
{
	const Body cube = Body::cube(), same = Body::cube();
	for (int f0 = 0; f0 < faceCount; ++f0)
		for (int f1 = 0; f1 < faceCount; ++f1)
			EXPECT_FALSE(joinFaces(cube.side(), f0, same.side(), f1, tolerance)) << f0 << f1;
	Body tilted = Body::cube({ 0, 0, edge });
	tilted.move({ .002, 0, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
	EXPECT_FALSE(joinFaces(cube.side(), above, tilted.side(), below, tolerance));
}

TEST(JointTest, faces_in_one_plane_that_do_not_overlap_do_not_join)
{
	const Body cube = Body::cube();
	for (const Vector3r& at : { Vector3r(edge, 0, edge), Vector3r(edge, edge, edge), Vector3r(.3, 0, edge), Vector3r(edge - tolerance / 2, 0, edge) })
		EXPECT_FALSE(joinFaces(cube.side(), above, Body::cube(at).side(), below, tolerance)) << at.transpose();
	Body diamond = Body::cube({ .19, .19, edge }); // boxes overlap, faces do not
	diamond.move({ 0, 0, M_PI / 4 }, { 0, 0, 0 }, diamond.placement.position);
	EXPECT_FALSE(joinFaces(cube.side(), above, diamond.side(), below, tolerance));
}

TEST(JointTest, brick_joins_a_support_of_any_size_over_its_whole_face)
{
	for (Real width : { .5, 10., 2e7 }) {
		const Body slab = Body::slab({ width, width, 100 }, { 0, 0, -50 }), brick = Body::cube({ .1, -.05, edge / 2 });
		for (const Pair& p : { Pair(slab, brick, above, below), Pair(brick, slab, below, above) }) {
			EXPECT_EQ(p.joint.count(), 16);
			EXPECT_NEAR(p.area(), edge * edge, 1e-8 * edge * edge); // 1e7 m away, a place has nine digits left of a metre
			EXPECT_LT(p.widest(), 1e-13);                           // the slab's centre is 50 m away
			EXPECT_NEAR(p.joint.springs.normal, pairs::young / (1 - .0625) / .001, 1);
		}
	}
}

TEST(JointTest, joint_is_free_of_stress_when_made)
{
	for (Real gap : { -.9 * tolerance, 0., .9 * tolerance }) {
		std::vector<Pair> joints { Pair(Body::cube(), Body::cube({ 0, 0, edge + gap })),
			                   Pair(Body::cube({ 0, 0, edge + gap }), Body::cube(), below, above) };
		const Body        slab = Body::slab({ 1, 1, 1 }, { 0, 0, -.6 - gap });
		joints.push_back(Pair(slab, Body::cube()));
		joints.push_back(Pair(Body::cube(), slab, below, above));
		Body tilted = Body::cube({ 0, 0, edge + gap });
		tilted.move({ 5e-4, -8e-4, .1 }, { 0, 0, 0 }, { 0, 0, edge / 2 + gap });
		joints.push_back(Pair(Body::cube(), tilted));
		joints.push_back(Pair(tilted, Body::cube(), below, above));
		Body shifted = tilted;
		shifted.placement.position += Vector3r(.1, .02, 0);
		for (const auto& p : joints) {
			const auto answer = p.answer();
			// An error of 1e-14 m under kn. With a tilt of 9.4e-4, the gap runs along one face's normal and not along the mean one: its slanting half is
			// taken for a slide of 2.7e-7 m x 4.7e-4, a quarter of a pascal.
			EXPECT_LT(answer.loads[0].force.norm(), edge * edge * (pairs::knThin * 1e-13 + pairs::ksThin * std::abs(gap) * 4.8e-4)) << gap;
			EXPECT_LT(answer.sum.penetration, 1e-12) << gap;
		}
	}
}

// Forces

TEST(JointTest, uniform_opening_gives_kn_times_area_times_opening)
{
	Pair       p  = Pair::stacked();
	const Real un = 1e-6;
	p.second.placement.position[2] += un;
	const auto a = p.step();
	const Real N = pairs::knThin * edge * edge * un;
	EXPECT_LT((a.loads[0].force - Vector3r(0, 0, N)).norm(), printed * N);
	EXPECT_LT(a.loads[0].torque.norm(), 1e-9 * N * edge);                    // 1e-16 m out of 1e-6 m of opening, and segments in symmetry
	EXPECT_LT((a.sum.normalForce - Vector3r(0, 0, -N)).norm(), printed * N); // on the second, pulled down
	EXPECT_LT(a.sum.shearForce.norm(), 1e-9 * N);
	EXPECT_NEAR(a.sum.kn, pairs::knThin * edge * edge, printed * a.sum.kn);
	EXPECT_NEAR(a.sum.ks, pairs::ksThin * edge * edge, printed * a.sum.ks);
	EXPECT_NEAR(a.sum.area, edge * edge, roundOff);
	EXPECT_LT((a.sum.point - Vector3r(0, 0, edge / 2 + un / 2)).norm(), roundOff);
	EXPECT_LT((a.sum.normal - Vector3r::UnitZ()).norm(), roundOff);
}

TEST(JointTest, sliding_gives_ks_times_area_times_slide_and_its_moment)
{
	Pair       p  = Pair::stacked();
	const Real us = 1e-6;
	p.second.placement.position[0] += us;
	const auto a = p.step();
	const Real V = pairs::ksThin * edge * edge * us;
	EXPECT_LT((a.loads[0].force - Vector3r(V, 0, 0)).norm(), printed * V);
	EXPECT_LT((a.loads[0].torque - Vector3r(0, V * edge / 2, 0)).norm(), printed * V * edge);
	EXPECT_LT((a.loads[1].torque - Vector3r(0, V * edge / 2, 0)).norm(), printed * V * edge);
	EXPECT_LT((a.sum.shearForce - Vector3r(-V, 0, 0)).norm(), printed * V);
}

TEST(JointTest, linear_deformation_of_a_brick_acts_as_the_motion_of_its_face)
{
	// the upper brick stretches downward and shears: its lower face moves as if the brick had
	Pair           p = Pair::stacked();
	const Vector3r move(2e-7, -3e-7, 4e-7);
	p.second.deformable = true;
	for (int a = 0; a < 4; ++a)
		p.second.displacement[faceNodes[below][a]] = move;
	Pair q = Pair::stacked();
	q.second.placement.position += move;
	EXPECT_LT((p.step().loads[0].force - q.step().loads[0].force).norm(), 1e-9 * pairs::knThin * edge * edge * move.norm()); // 1e-16 of 1e-7 m
}

TEST(JointTest, forces_and_torques_balance_to_round_off_in_any_state_of_motion)
{
	pairs::Random random(2);
	for (int trial = 0; trial < 100; ++trial) {
		Pair p                  = Pair::english(random.turn());
		p.springs.normalDamping = p.springs.shearDamping = .3;
		p.joint.setMortar(p.springs.at(.001, .001), p.joint.shape->strength);
		for (Body* b : { &p.first, &p.second }) {
			b->displacement = random.nodes(1e-4), b->rate = random.nodes(.1);
			b->move(random.vector(1e-3), random.vector(1e-4), b->placement.position);
			b->placement.velocity = random.vector(.1), b->placement.angularVelocity = random.vector(1);
		}
		if (trial % 2) p.breakAll();
		const auto a = p.step();
		expectBalance(p, a, std::max(a.loads[0].force.norm(), pairs::knThin * edge * edge * 1e-4));
	}
}

TEST(JointTest, nodal_loads_sum_to_the_force_and_to_its_moment_about_the_segments)
{
	pairs::Random random(3);
	Pair          p = Pair::english();
	for (Body* b : { &p.first, &p.second })
		b->displacement = random.nodes(1e-4), b->move(random.vector(1e-3), random.vector(1e-4), b->placement.position);
	const auto  a         = p.step();
	const Real  F         = a.loads[0].force.norm();
	const Body* bodies[2] = { &p.first, &p.second };
	for (int s = 0; s < 2; ++s) {
		EXPECT_LT((pairs::nodalForce(*bodies[s], a.loads[s]) - a.loads[s].force).norm(), 1e-13 * F);
		// nodes feel the force at their own face, the rigid motion half way between the faces: apart by half the opening, some 1e-4 m
		const Vector3r difference = a.loads[s].torque - pairs::nodalMoment(*bodies[s], a.loads[s]);
		EXPECT_LT(difference.norm(), F * 3e-4);
		const auto& joined = p.joint.shape->patches[0].sides[s].nodes;
		for (int n = 0; n < nodeCount; ++n)
			if (std::find(joined.begin(), joined.end(), n) == joined.end()) {
				EXPECT_EQ(a.loads[s].nodal[n], Vector3r(Vector3r::Zero()));
			}
	}
}

TEST(JointTest, rigid_rotation_of_the_whole_pair_turns_the_forces_and_changes_nothing_else)
{
	pairs::Random random(4);
	for (int trial = 0; trial < 20; ++trial) {
		Pair p = Pair::english();
		for (Body* b : { &p.first, &p.second }) {
			b->displacement = random.nodes(1e-5), b->rate = random.nodes(.01);
			b->move(random.vector(1e-4), random.vector(1e-5), b->placement.position);
		}
		if (trial % 2) p.breakAll();
		Pair           q    = p;
		const Vector3r turn = random.turn();
		const Matrix3r R    = Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()).toRotationMatrix();
		q.first.move(turn, { 3, 1, -2 }), q.second.move(turn, { 3, 1, -2 });
		for (Body* b : { &q.first, &q.second }) { // turning on: the same relative velocities
			b->placement.angularVelocity = Vector3r(2, -1, 3);
			b->placement.velocity        = Vector3r(2, -1, 3).cross(b->placement.position);
		}
		const auto a = p.step(), b = q.step();
		// places 4 m from the origin keep 1e-15 m of them, under kn: 1e-6 N out of 1e3 N
		const Real small = pairs::knThin * edge * edge * 1e-14;
		for (int s = 0; s < 2; ++s) {
			EXPECT_LT((R * a.loads[s].force - b.loads[s].force).norm(), small);
			EXPECT_LT((R * a.loads[s].torque - b.loads[s].torque).norm(), small * edge);
			for (int n = 0; n < nodeCount; ++n)
				EXPECT_LT((a.loads[s].nodal[n] - b.loads[s].nodal[n]).norm(), small);
		}
	}
}

TEST(JointTest, swapping_the_sides_swaps_the_loads)
{
	pairs::Random random(5);
	for (int trial = 0; trial < 40; ++trial) {
		Pair p = Pair::english(random.turn());
		if (trial % 2) p.breakAll();
		for (Body* b : { &p.first, &p.second }) {
			b->displacement = random.nodes(1e-5), b->rate = random.nodes(.01);
			b->move(random.vector(1e-4), random.vector(1e-5), b->placement.position);
			b->placement.velocity = random.vector(.01);
		}
		Pair q = p;
		std::swap(q.first, q.second), q.joint.setMortar(p.joint.springs, p.joint.shape->strength), std::swap(q.joint.shape->faces[0], q.joint.shape->faces[1]);
		std::swap(q.joint.shape->patches[0].sides[0], q.joint.shape->patches[0].sides[1]);
		const auto a = p.step(), b = q.step();
		const Real small = pairs::knThin * edge * edge * 1e-14; // as above
		for (int s = 0; s < 2; ++s) {
			EXPECT_LT((a.loads[s].force - b.loads[1 - s].force).norm(), small);
			EXPECT_LT((a.loads[s].torque - b.loads[1 - s].torque).norm(), small * edge);
			for (int n = 0; n < nodeCount; ++n)
				EXPECT_LT((a.loads[s].nodal[n] - b.loads[1 - s].nodal[n]).norm(), small);
		}
		EXPECT_LT((a.sum.normalForce + b.sum.normalForce).norm(), small);
		EXPECT_LT((a.sum.shearForce + b.sum.shearForce).norm(), small);
	}
}

namespace {

/// Elastic energy of an intact joint [J].
Real energy(const Pair& p)
{
	const auto m   = p.motion();
	Real       sum = 0;
	for (int s = 0; s < p.joint.count(); ++s) {
		const auto t = segmentTraction(p.joint, s, m, 0);
		sum += segmentOf(p.joint, s).area / 2 * (t.normal * t.normal / p.joint.springs.normal + t.shear.squaredNorm() / p.joint.springs.shear);
	}
	return sum;
}

/// Largest difference between the loads and minus the gradient of the energy, over the 24 + 24 nodal displacements and the 6 + 6 rigid motions, as fractions
/// of the force (times the brick's half edge for moments).
struct Defect {
	Real nodal = 0, rigid = 0;
};
Defect conservationDefect(const Pair& at)
{
	const auto a = at.answer();
	const Real F = a.loads[0].force.norm();
	Defect     d;
	const auto slope = [&](const std::function<void(Pair&, Real)>& move, Real h) {
		// five points: exact for the energy's fourth degree
		Real e[5];
		for (int i = 0; i < 5; ++i) {
			Pair p = at;
			move(p, (i - 2) * h);
			e[i] = energy(p);
		}
		return (e[0] - 8 * e[1] + 8 * e[3] - e[4]) / (12 * h);
	};
	for (int s = 0; s < 2; ++s) {
		const auto body = [s](Pair& p) -> Body& { return s ? p.second : p.first; };
		for (int k = 0; k < dofCount; ++k) {
			const Real g = slope([&](Pair& p, Real h) { body(p).displacement[k / 3][k % 3] += h; }, 1e-6);
			d.nodal      = std::max(d.nodal, std::abs(a.loads[s].nodal[k / 3][k % 3] + g) / F);
		}
		for (int k = 0; k < 3; ++k) {
			const Vector3r unit = Vector3r::Unit(k);
			const Real     g    = slope([&](Pair& p, Real h) { body(p).placement.position += h * unit; }, 1e-6);
			d.rigid             = std::max(d.rigid, std::abs(a.loads[s].force[k] + g) / F);
			const Real t        = slope([&](Pair& p, Real h) { body(p).move(h * unit, Vector3r::Zero(), body(p).placement.position); }, 1e-5);
			d.rigid             = std::max(d.rigid, std::abs(a.loads[s].torque[k] + t) / (F * edge / 2));
		}
	}
	return d;
}

} // namespace

TEST(JointTest, force_is_minus_the_gradient_of_the_elastic_energy)
{
	pairs::Random random(6);
	Defect        worst[3];
	const Real    sizes[3] = { 4e-3, 2e-3, 1e-3 };
	for (int trial = 0; trial < 5; ++trial) {
		const Vector3r turn[2] = { random.vector(10), random.vector(10) }, shift[2] = { random.vector(1), random.vector(1) };
		const Nodes    bend[2] = { random.nodes(1), random.nodes(1) };
		for (int i = 0; i < 3; ++i) {
			Pair  p         = Pair::english();
			Body* bodies[2] = { &p.first, &p.second };
			for (int s = 0; s < 2; ++s) {
				bodies[s]->move(sizes[i] * turn[s], sizes[i] * shift[s], bodies[s]->placement.position);
				for (int a = 0; a < nodeCount; ++a)
					bodies[s]->displacement[a] = sizes[i] * bend[s][a];
			}
			const Defect d = conservationDefect(p);
			worst[i]       = { std::max(worst[i].nodal, d.nodal), std::max(worst[i].rigid, d.rigid) };
		}
	}
	for (int i = 0; i < 3; ++i)
		// Nodes, which do not turn the normal: exact; an energy of 1e4 J and steps of 1e-6 m leave 1e-16 x 1e4 / 1e-6 = 1e-6 N out of 1e6 N.
		EXPECT_LT(worst[i].nodal, 1e-10) << sizes[i];
	// Turning: the normal turns with the mean of both rotations only as far as the faces are parallel, so the torque is wrong in the second order of the
	// displacements relative to itself: halving them must quarter the defect (within a third). At rotations of 0.04 rad it is 3e-4 of force times half edge.
	EXPECT_LT(worst[0].rigid, 4e-4);
	EXPECT_NEAR(worst[0].rigid / worst[1].rigid, 4, 1.3);
	EXPECT_NEAR(worst[1].rigid / worst[2].rigid, 4, 1.3);
}

TEST(JointTest, joint_that_holds_gives_the_sum_of_its_segments)
{
	// whole grids and cut ones, deformed in any way
	pairs::Random random(12);
	for (int trial = 0; trial < 60; ++trial) {
		Body lower = Body::cube({ 0, 0, 0 }, 1 + trial % 6), upper = Body::cube({ edge / 2, 0, edge }, 1 + trial % 6);
		if (trial % 3 == 1) upper.move({ 0, 0, random.between(-3, 3) }, { 0, 0, 0 }, { edge / 2, 0, 0 });
		lower.deformable = true, upper.deformable = trial % 2;
		Pair p(lower, upper);
		for (Body* b : { &p.first, &p.second })
			b->displacement = random.nodes(1e-5), b->move(random.vector(1e-4), random.vector(1e-5), b->placement.position);
		const auto whole = p.step();
		EXPECT_TRUE(p.joint.segments.empty()); // no arrays as long as it holds
		const auto m     = p.motion();
		Vector3r   force = Vector3r::Zero(), torque = Vector3r::Zero();
		Real       deepest = -1;
		for (int s = 0; s < p.joint.count(); ++s) {
			const auto     segment  = segmentOf(p.joint, s);
			const auto     traction = segmentTraction(p.joint, s, m, 0);
			const Vector3r f        = segment.area * (traction.normal * m.normal + traction.shear);
			force += f;
			torque += m.middle(segment).cross(f);
			deepest = std::max(deepest, -traction.normal / p.joint.springs.normal);
		}
		const Real size = pairs::knThin * edge * edge * 1e-4; // of what the segments' forces may cancel to
		EXPECT_LT((force - whole.loads[0].force).norm(), 1e-13 * size);
		EXPECT_LT((torque - whole.loads[0].torque).norm(), 1e-13 * size);
		EXPECT_NEAR(whole.sum.penetration, deepest, trial % 3 == 1 ? 1e-4 : 1e-15); // of cut cells the rectangle around them is looked at
	}
}

TEST(JointTest, joint_fails_when_and_only_when_a_segment_does)
{
	pairs::Random random(13);
	int           failed = 0;
	for (int trial = 0; trial < 300; ++trial) {
		Pair p          = Pair::english();
		p.joint.setMortar(p.joint.springs, mortar());
		for (Body* b : { &p.first, &p.second })
			b->displacement = random.nodes(5e-7), b->move(random.vector(2e-6), random.vector(5e-7), b->placement.position);
		const int expected = overloaded(p.joint, p.motion()).total();
		EXPECT_EQ(p.step().failures.total(), expected);
		failed += expected > 0;
	}
	EXPECT_GT(failed, 50);
	EXPECT_LT(failed, 250);
}

// Failure

namespace {

constexpr Real justBelow = 1 - 1e-7, justAbove = 1 + 1e-7; ///< wide of the eight digits of the inputs

/// Contact lengths of dyn.bond: two contact parts of 1 mm, and two rigid cubes.
struct Layer {
	Real length, kn, ks, openingAtFailure; ///< dyn.bond: u_t_r1mm, u_t_rigid
};
const Layer layers[] = { { .001, pairs::knThin, pairs::ksThin, 8.8010204e-7 }, { .1, pairs::knRigid, pairs::ksRigid, 8.8010204e-5 } };

Pair bonded(const Layer& layer, int segments = 4)
{
	Body lower(cuboidCorners(Vector3r::Constant(edge)), layer.length), upper = lower;
	lower.segments = upper.segments = segments;
	upper.placement.position[2]     = edge;
	return Pair(lower, upper, above, below, mortar());
}

/// A stacked pair whose joint has failed, pressed by a depth [m] and slid along x.
Pair cracked(Real depth, Real slide = 0)
{
	Pair p = Pair::stacked(mortar());
	p.breakAll();
	p.second.placement.position += Vector3r(slide, 0, -depth);
	return p;
}

constexpr Real depth  = 1e-6;
const Real     weight = pairs::knThin * edge * edge * depth; ///< normal force at that depth

} // namespace

TEST(JointTest, couplet_pulled_apart_fails_at_184_newtons)
{
	for (const Layer& layer : layers) {
		Pair p                         = bonded(layer);
		p.second.placement.position[2] = edge + layer.openingAtFailure * justBelow;
		auto a                         = p.step();
		EXPECT_EQ(a.failures.total(), 0);
		EXPECT_NEAR(a.loads[0].force[2], 184, 184 * (1e-7 + printed));
		p.second.placement.position[2] = edge + layer.openingAtFailure * justAbove;
		a                              = p.step();
		EXPECT_EQ(a.failures.tension, 16);
		EXPECT_EQ(a.failures.total(), 16);
		EXPECT_EQ(p.joint.intact(), 0);
		EXPECT_EQ(a.loads[0].force, Vector3r(Vector3r::Zero()));
	}
}

TEST(JointTest, couplet_peak_shear_follows_coulomb_and_keeps_its_friction)
{
	const std::pair<Real, Real> shear[] = { { 0, 116. }, { 1e3, 140.99477 }, { 5e3, 240.97387 }, { 2e4, 615.89548 }, { 1e5, 2615.4774 } }; // dyn.bond
	for (const Layer& layer : layers)
		for (const auto& row : shear) {
			Pair       p    = bonded(layer);
			const Real peak = row.second / (edge * edge) / layer.ks;
			p.second.placement.position += Vector3r(peak * justBelow, 0, -row.first / layer.kn);
			auto a = p.step();
			EXPECT_EQ(a.failures.total(), 0) << row.first;
			EXPECT_NEAR(a.loads[0].force[0], row.second, row.second * (1e-7 + printed));
			p.second.placement.position[0] = peak * justAbove;
			a                              = p.step();
			EXPECT_EQ(a.failures.shear, 16) << row.first;
			// the cohesion is lost, the friction stays, and so does the pressure
			EXPECT_NEAR(a.loads[0].force[0], row.second - 116, 116 * 1e-6);
			EXPECT_NEAR(a.loads[0].force[2], -row.first * edge * edge, 1e-6 * std::max(1., row.first * edge * edge));
		}
}

TEST(JointTest, couplet_crushes_at_19600_newtons_and_still_carries_the_pressure)
{
	for (const Layer& layer : layers) {
		Pair p                         = bonded(layer);
		p.second.placement.position[2] = edge - pairs::crush / layer.kn * justBelow;
		auto a                         = p.step();
		EXPECT_EQ(a.failures.total(), 0);
		EXPECT_NEAR(a.loads[0].force[2], -19600, 19600 * (1e-7 + printed));
		p.second.placement.position[2] = edge - pairs::crush / layer.kn * justAbove;
		a                              = p.step();
		EXPECT_EQ(a.failures.compression, 16);
		EXPECT_NEAR(a.loads[0].force[2], -19600, 19600 * (1e-7 + printed));
	}
}

TEST(JointTest, bond_wrench_opens_the_outer_row_at_the_closed_form_moment)
{
	const std::pair<int, Real> wrench[] = { { 2, 9.2 }, { 4, 7.6666667 }, { 8, 6.9 } }; // dyn.bond; ft A L (1 + 1/n) / 6
	for (const Layer& layer : layers)
		for (const auto& row : wrench) {
			const int  n     = row.first;
			const Real angle = pairs::tensile / layer.kn / (edge / 2 * (1 - 1. / n));
			for (Real factor :
			     { 1 - 1e-6, 1 + 1e-6 }) { // rotations of up to 1.8e-3 change the stress by their square, 1.6e-6 of it at most: see below
				Pair       p    = bonded(layer, n);
				const Real turn = angle * factor * (1 + angle * angle * (factor > 1 ? 1 : -1));
				p.second.move({ turn, 0, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
				const auto a = p.step();
				if (factor < 1) {
					EXPECT_EQ(a.failures.total(), 0) << n;
					EXPECT_NEAR(a.loads[0].torque[0], row.second, row.second * (1e-6 + 4 * angle * angle + printed));
				} else {
					EXPECT_EQ(a.failures.tension, n);
					EXPECT_EQ(a.failures.total(), n);
					EXPECT_EQ(p.joint.intact(), n * n - n);
				}
			}
		}
}

TEST(JointTest, last_row_is_no_hinge)
{
	// of a cracked joint: its edge, half a segment from where the bricks turn about it, opens beyond the strength
	for (const Layer& layer : layers)
		for (const int n : { 2, 4, 8 })
			for (const Real pressed : { 0., 3 * pairs::tensile }) {
				const Real half = edge / 2 / n, opens = (pairs::tensile + pressed) / layer.kn / half;
				for (const Real factor : { .99, 1.01 }) { // the mean normal turns by half the angle, up to 0.03 rad: its square is 1e-3
					Pair p = bonded(layer, n);
					for (int s = 0; s < p.joint.count(); ++s)
						if (p.place(segmentOf(p.joint, s), 0)[1] > -edge / 2 + 1.5 * half) pairs::fail(p.joint, s, SegmentState::Tension);
					ASSERT_EQ(p.joint.intact(), n);
					p.second.placement.position[2] -= pressed / layer.kn;
					p.second.move({ opens * factor, 0, 0 }, { 0, 0, 0 }, { 0, -edge / 2 + half, edge / 2 - pressed / layer.kn });
					const auto a = p.step();
					EXPECT_EQ(a.failures.tension, factor > 1 ? n : 0) << n << " " << pressed;
					EXPECT_EQ(a.failures.total(), a.failures.tension);
				}
			}
}

TEST(JointTest, joint_one_segment_wide_is_no_hinge)
{
	// narrow in y only: bending about x is not felt by its middles; bending about y is the rows' matter
	for (const Layer& layer : layers)
		for (const Real factor : { .99, 1.01 }) {
			const Real angle = factor * 10 * pairs::tensile / layer.kn / (edge / 8);
			Body       lower = Body::cuboid({ edge, edge / 4, edge }), upper = Body::cuboid({ edge, edge / 4, edge }, { 0, 0, edge });
			lower.contactLength.fill(layer.length), upper.contactLength.fill(layer.length);
			for (const bool across : { true, false }) {
				Pair p(lower, upper, above, below, mortar());
				ASSERT_EQ(p.joint.count(), 4);
				p.second.move(across ? Vector3r(angle, 0, 0) : Vector3r(0, angle / 80, 0), { 0, 0, 0 }, { 0, 0, edge / 2 });
				EXPECT_EQ(p.step().failures.tension, across && factor > 1 ? 4 : 0);
			}
		}
}

TEST(JointTest, joint_that_holds_is_judged_at_the_middles_of_its_segments)
{
	Pair p = bonded(layers[0], 4);
	p.second.move({ 1e-5, 0, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
	EXPECT_EQ(edgeOpening(p.joint, p.motion(), 0), 0);
	pairs::fail(p.joint, 0, SegmentState::Tension);
	EXPECT_NEAR(edgeOpening(p.joint, p.motion(), 0), 1e-5 * edge / 8, 1e-9 * edge);
}

TEST(JointTest, failed_segment_carries_pressure_and_no_tension)
{
	EXPECT_NEAR(cracked(depth).step().loads[0].force[2], -weight, printed * weight);
	EXPECT_LT(cracked(0).step().loads[0].force.norm(), pairs::knThin * edge * edge * 1e-16); // the face's place rounds to 1e-17 m
	EXPECT_EQ(cracked(-1e-12).step().loads[0].force.norm(), 0);
	EXPECT_EQ(cracked(-1e-3, 1e-3).step().loads[0].force.norm(), 0);
}

TEST(JointTest, friction_of_failed_segments_sticks_slides_and_turns_back)
{
	Pair       p     = cracked(depth);
	const Real limit = pairs::friction * weight, stiffness = pairs::ksThin * edge * edge, stick = limit / stiffness;
	const auto at = [&](Real slide) {
		p.second.placement.position[0] = slide;
		return p.step().loads[0].force[0];
	};
	const Real small = 1e-7 * limit; // 1e-16 m of 0.2 m in a slide of 1e-6 m, and eight digits
	EXPECT_NEAR(at(stick / 2), limit / 2, small);
	EXPECT_NEAR(at(stick * 3), limit, small);
	EXPECT_NEAR(at(stick * 10), limit, small);
	EXPECT_NEAR(at(stick * 9.5), limit / 2, small);
	EXPECT_NEAR(at(stick * 8.5), -limit / 2, small);
	EXPECT_NEAR(at(stick * 2), -limit, small);
	EXPECT_NEAR(p.joint.segments[0].row(JointSegments::Slip1)[5], stick * 3, 1e-6 * stick);
}

TEST(JointTest, friction_acts_against_the_slide_in_any_direction)
{
	for (Real angle : { .3, 2.1, -1.4 }) {
		Pair p = cracked(depth);
		p.second.placement.position += 1e-3 * Vector3r(std::cos(angle), std::sin(angle), 0);
		const Vector3r f = p.step().loads[1].force;
		EXPECT_LT((f.head<2>() + pairs::friction * weight * Vector2r(std::cos(angle), std::sin(angle))).norm(), 1e-7 * weight);
	}
}

TEST(JointTest, slip_follows_while_open_so_that_recontact_begins_without_shear)
{
	Pair p = cracked(depth, 1e-7);
	p.step();
	p.second.placement.position = Vector3r(1e-3, -2e-3, edge + 1e-4); // opens and moves on
	EXPECT_EQ(p.step().loads[0].force.norm(), 0);
	p.second.placement.position[2] = edge - depth;
	const Vector3r f               = p.step().loads[0].force;
	EXPECT_NEAR(f[2], -weight, 1e-7 * weight);
	EXPECT_LT(f.head<2>().norm(), 1e-7 * weight);
	p.second.placement.position[0] += 1e-8;
	EXPECT_NEAR(p.step().loads[0].force[0], pairs::ksThin * edge * edge * 1e-8, 1e-6 * weight);
}

TEST(JointTest, dashpot_brakes_and_never_attracts)
{
	for (Real speed : { -1e-3, 1e-4, 1e-2, 1. }) {
		Pair p                  = cracked(depth);
		p.springs.normalDamping = .2, p.springs.shearDamping = .1;
		p.joint.setMortar(p.springs.at(.001, .001), p.joint.shape->strength);
		p.second.placement.velocity[2] = speed;
		const Real expected            = std::max(0., weight - p.joint.springs.normalDashpot * edge * edge * speed);
		EXPECT_NEAR(-p.step().loads[0].force[2], expected, 1e-7 * (weight + expected)) << speed;
	}
	Pair open                         = cracked(-depth);
	open.springs.normalDamping        = .2;
	open.joint.setMortar(open.springs.at(.001, .001), open.joint.shape->strength);
	open.second.placement.velocity[2] = -1; // closing, but not yet closed
	EXPECT_EQ(open.step().loads[0].force.norm(), 0);
}

TEST(JointTest, shear_dashpot_brakes_within_the_friction_limit)
{
	for (Real speed : { 1e-6, 1e-3, 1. }) {
		Pair p                         = cracked(depth);
		p.springs.shearDamping         = .1;
		p.joint.setMortar(p.springs.at(.001, .001), p.joint.shape->strength);
		p.second.placement.velocity[0] = speed;
		const Real expected            = std::min(pairs::friction * weight, p.joint.springs.shearDashpot * edge * edge * speed);
		EXPECT_NEAR(p.step().loads[0].force[0], expected, 1e-7 * weight) << speed;
	}
	Pair moving                        = Pair::stacked(); // the intact joint has no dashpot
	moving.joint.setMortar({ pairs::knThin, pairs::ksThin, 1e9, 0 }, unbreakable());
	moving.second.placement.velocity   = { 1, 1, 1 };
	EXPECT_LT(moving.step().loads[0].force.norm(), 1e-6);
}

TEST(JointTest, joint_cracked_in_part_pulls_where_it_holds_and_slips_where_it_does_not)
{
	Pair p = Pair::stacked(mortar());
	for (int i = 0; i < 4; ++i)
		pairs::fail(p.joint, i, SegmentState::Shear);
	p.second.placement.position[2] += 1e-7;
	EXPECT_NEAR(p.step().loads[0].force[2], pairs::knThin * 12 / 16 * edge * edge * 1e-7, 1e-7 * weight);
	p.second.placement.position = { 0, 0, edge - 1e-7 };
	EXPECT_NEAR(p.step().loads[0].force[2], -pairs::knThin * edge * edge * 1e-7, 1e-7 * weight);
	EXPECT_EQ(p.joint.intact(), 12);
}

TEST(JointTest, tractions_shown_are_those_that_act)
{
	pairs::Random random(8);
	for (bool failed : { false, true }) {
		Pair p = Pair::english();
		if (failed) p.breakAll();
		for (int i = 0; i < 3; ++i) {
			for (Body* b : { &p.first, &p.second })
				b->displacement = random.nodes(1e-5), b->move(random.vector(1e-5), random.vector(1e-5), b->placement.position);
			const auto a   = p.step();
			const auto m   = p.motion();
			Vector3r   sum = Vector3r::Zero();
			for (int s = 0; s < p.joint.count(); ++s) {
				const auto t = segmentTraction(p.joint, s, m, pairs::friction);
				sum += segmentOf(p.joint, s).area * (t.normal * m.normal + t.shear);
			}
			EXPECT_LT((sum - a.loads[0].force).norm(), 1e-12 * (1 + a.loads[0].force.norm()));
		}
	}
}

TEST(JointTest, outlines_of_segments_have_their_areas_and_middles_cut_or_not)
{
	for (Real angle : { 0., M_PI / 4 }) {
		Body upper = Body::cube({ 0, 0, edge }, 3);
		upper.move({ 0, 0, angle });
		Pair           p(Body::cube({ 0, 0, 0 }, 3), upper);
		const Vector3r turn(.3, -1.1, .7);
		for (Body* b : { &p.first, &p.second })
			b->move(turn, { 1, -2, .5 }, { 0, 0, 0 });
		const auto m = p.motion();
		for (int s = 0; s < p.joint.count(); ++s) {
			const auto     o = segmentOutline(p.joint, s, m);
			const Vector3r area = (o[2] - o[0]).cross(o[3] - o[1]) / 2;
			EXPECT_NEAR(area.norm(), segmentOf(p.joint, s).area, roundOff);
			EXPECT_NEAR(std::abs(area.normalized().dot(m.normal)), 1, roundOff);
			EXPECT_LT(((o[0] + o[1] + o[2] + o[3]) / 4 - m.middle(segmentOf(p.joint, s))).norm(), roundOff);
		}
	}
}

TEST(JointTest, opening_of_a_segment_is_the_motion_of_one_side_from_the_other)
{
	Pair           p = Pair::stacked();
	const Vector3r by(1e-4, -2e-4, 3e-4);
	p.second.placement.position += by;
	for (int s = 0; s < p.joint.count(); ++s)
		EXPECT_LT((segmentOpening(p.joint, s, p.motion()) - by).norm(), roundOff);
}
