// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr Real printed = 2e-8; ///< relative: pairs::knThin and ksThin have eight digits
constexpr Real depth   = 1e-5; ///< of penetration [m], a hundredth of the contact part
const Real     kn = pairs::springs().at(.001, .001).normal, ks = pairs::springs().at(.001, .001).shear;

/// Two bodies in contact.
struct Pair {
	Body                     first, second;
	PairSprings              springs;
	ContactMemory            memory, scratch;
	std::vector<ContactSpot> spots;

	Pair(const Body& first, const Body& second)
	        : first(first)
	        , second(second)
	        , springs(pairs::springs())
	{
		if (first.support) springs = pairs::onSupport(springs, 0);
		if (second.support) springs = pairs::onSupport(springs, 1);
	}
	/// A cube on a cube, pressed in.
	static Pair stacked(int segments = 4, Real pressed = depth)
	{
		return Pair(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, edge - pressed }, segments));
	}

	struct Answer {
		std::array<Loads, 2> loads;
		PairSummary          sum;
		Vector3r             force() const { return loads[1].force; } ///< on the second
	};
	Answer step(Real dt = 0)
	{
		Answer     a;
		const Side side0 = first.side(), side1 = second.side();
		findContact(side0, side1, spots);
		contactLoads(side0, side1, spots, springs, dt, memory, scratch, a.loads, a.sum);
		return a;
	}
	void turnAll(const Vector3r& turn, const Vector3r& shift) { first.move(turn, shift), second.move(turn, shift); }
};

void expectBalance(const Pair& p, const Pair::Answer& a, Real scale)
{
	EXPECT_LE((a.loads[0].force + a.loads[1].force).norm(), 1e-14 * scale); // both sides add the same numbers in the same order
	for (const Vector3r& about : { Vector3r(0, 0, 0), Vector3r(3, -3, 2) })
		EXPECT_LE(pairs::totalMoment(p.first, p.second, a.loads, about).norm(), 1e-13 * scale); // arms of up to 6 m
}

/// A voussoir about the y axis, in its body frame.
Body voussoir(Real from, Real to)
{
	Nodes corners;
	for (int a = 0; a < nodeCount; ++a) {
		const int* s      = nodeSigns[a];
		const Real radius = s[2] > 0 ? 1.2 : 1, angle = s[0] > 0 ? to : from;
		corners[a] = { radius * std::sin(angle), s[1] * .125, radius * std::cos(angle) };
	}
	const Vector3r centre = solidProperties(corners).centroid;
	for (auto& x : corners)
		x -= centre;
	Body b(corners);
	b.placement.position = centre;
	return b;
}

/// Smallest overlap of two bodies along any axis that could part them (15 of two boxes); negative when a plane passes between.
Real overlapOf(const Body& a, const Body& b)
{
	std::vector<Vector3r> axes;
	for (int i = 0; i < 3; ++i) {
		axes.push_back(a.placement.rotation.col(i)), axes.push_back(b.placement.rotation.col(i));
		for (int j = 0; j < 3; ++j) {
			const Vector3r c = a.placement.rotation.col(i).cross(b.placement.rotation.col(j));
			if (c.norm() > 1e-6) axes.push_back(c.normalized());
		}
	}
	Real least = std::numeric_limits<Real>::infinity();
	for (const auto& axis : axes) {
		Real lower[2], upper[2];
		for (int s = 0; s < 2; ++s) {
			const Body& body = s ? b : a;
			lower[s] = std::numeric_limits<Real>::infinity(), upper[s] = -lower[s];
			for (const auto& x : body.solid.corners) {
				const Real h = axis.dot(body.world(x));
				lower[s] = std::min(lower[s], h), upper[s] = std::max(upper[s], h);
			}
		}
		least = std::min(least, std::min(upper[0] - lower[1], upper[1] - lower[0]));
	}
	return least;
}

} // namespace

// Face on face

TEST(ContactTest, normal_force_of_flat_faces_is_kn_times_the_integral_of_penetration)
{
	for (int n : { 1, 4, 7, 16 })
		for (const Vector2r& offset : { Vector2r(0, 0), Vector2r(.05, -.03), Vector2r(.1, 0), Vector2r(-.19, .19) }) {
			Pair p                                = Pair::stacked(n);
			p.second.placement.position.head<2>() = offset;
			const Real area = (edge - std::abs(offset[0])) * (edge - std::abs(offset[1])), N = kn * area * depth;
			const auto a = p.step();
			// depths of 1e-5 m are differences of numbers of 0.1 m: 1e-11
			EXPECT_LT((a.force() - Vector3r(0, 0, N)).norm(), 1e-10 * N) << n;
			EXPECT_NEAR(a.sum.area, area, 1e-12);
			EXPECT_NEAR(a.sum.penetration, depth, 1e-15);
			EXPECT_LT((a.sum.normal - Vector3r::UnitZ()).norm(), 1e-14);
			EXPECT_LT((a.sum.point - Vector3r(offset[0] / 2, offset[1] / 2, edge / 2 - depth / 2)).norm(), 1e-12);
			EXPECT_LT((a.sum.normalForce - a.force()).norm(), 1e-12 * N);
		}
}

TEST(ContactTest, force_of_tilted_faces_does_not_depend_on_the_number_of_segments)
{
	for (const Vector3r& tilt : { Vector3r(1e-4, 0, 0), Vector3r(3e-5, -8e-5, .3), Vector3r(1e-3, 0, 0), Vector3r(-2e-3, 1.5e-3, .01) }) {
		Vector3r first = Vector3r::Zero();
		for (int n : { 1, 4, 7, 16 }) {
			Pair p = Pair::stacked(n);
			p.second.move(tilt, { 0, 0, 0 }, { 0, 0, edge / 2 });
			const Vector3r f = p.step().force();
			if (n == 1) first = f;
			// at the rims a strip as wide as the depth may be taken for nearest to a side: the square of depth / edge, depths of up to 1e-4 m
			EXPECT_LT((f - first).norm(), 1e-6 * first.norm()) << n << ": " << tilt.transpose();
		}
	}
	// all of the face pressed in: the mean depth counts, to the square of the tilt
	Pair whole = Pair::stacked(4);
	whole.second.move({ 9e-5, 0, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
	EXPECT_NEAR(whole.step().force()[2], kn * edge * edge * depth, 1e-6 * kn * edge * edge * depth);
	// half of it: a wedge, whose sharp end begins in the middle
	Pair half = Pair::stacked(7, 0);
	half.second.move({ 1e-3, 0, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
	const Real wedge = kn * edge * (edge / 2) * (edge / 2) / 2 * 1e-3;
	EXPECT_NEAR(half.step().force()[2], wedge, 2e-3 * wedge); // the lower face presses along the tilted normal: first order in the tilt at the edges
}

TEST(ContactTest, brick_on_a_support_carries_its_springs_alone)
{
	const Body slab = Body::slab({ 10, 10, 1 }, { 0, 0, -.5 }), brick = Body::cube({ 1.1, -.3, edge / 2 - depth });
	const Real N = edge * edge * depth / (.001 * (1 - .0625) / pairs::young);
	EXPECT_LT((Pair(slab, brick).step().force() - Vector3r(0, 0, N)).norm(), 1e-9 * N);
	EXPECT_LT((Pair(brick, slab).step().force() + Vector3r(0, 0, N)).norm(), 1e-9 * N);
	for (const auto& spot : Pair(slab, brick).spots)
		EXPECT_EQ(spot.owner, 1);
}

TEST(ContactTest, small_brick_on_a_fixed_brick_of_three_metres_has_its_whole_area)
{
	for (const Vector2r& at : { Vector2r(0, 0), Vector2r(.73, -1.1), Vector2r(1.4, 1.4), Vector2r(1.5, 0) }) {
		const Pair big(Body::cuboid({ 3, 3, .5 }, { 0, 0, -.25 }), Body::cube({ at[0], at[1], edge / 2 - depth }));
		const Real over = std::min(edge, 1.6 - at[0]) * edge, N = kn * over * depth;
		EXPECT_LT((Pair(big).step().force() - Vector3r(0, 0, N)).norm(), 1e-9 * N) << at.transpose();
	}
}

TEST(ContactTest, stacked_bricks_press_with_their_beds_only)
{
	for (int n : { 1, 4 })
		for (const Vector3r& turn : { Vector3r(0, 0, 0), Vector3r(.3, -1.2, .8) }) {
			Pair p = Pair::stacked(n); // sides flush
			p.turnAll(turn, { .3, .1, -.2 });
			p.step();
			Real across = 0;
			for (const auto& spot : p.spots)
				if (spot.otherFace != (spot.owner == 0 ? 4 : 5) || spot.ownerFace != (spot.owner == 0 ? 5 : 4))
					across += spot.area * spot.penetration;
			EXPECT_LT(across, edge * edge * 1e-15); // round-off of places may press sides together by 1e-16 m
		}
}

TEST(ContactTest, neighbours_with_coincident_faces_do_not_feel_each_other)
{
	const Real small = kn * edge * edge * 1e-15; // as above, under kn
	for (const Vector3r& away : { Vector3r(edge, 0, 0), Vector3r(edge, edge, 0), Vector3r(edge, edge, edge), Vector3r(0, 0, edge) })
		for (const Vector3r& turn : { Vector3r(0, 0, 0), Vector3r(.3, -1.2, .8) }) {
			Pair p(Body::cube(), Body::cube(away));
			p.turnAll(turn, { .3, .1, -.2 });
			EXPECT_LE(p.step().force().norm(), turn.norm() > 0 ? small : 0);
		}
	// a gap and a penetration of one part in a thousand million
	EXPECT_EQ(Pair(Body::cube(), Body::cube({ 0, 0, edge + 1e-10 })).step().force().norm(), 0);
	EXPECT_NEAR(Pair(Body::cube(), Body::cube({ 0, 0, edge - 1e-10 })).step().force()[2], kn * edge * edge * 1e-10, kn * edge * edge * 1e-15);
}

TEST(ContactTest, area_shrinks_continuously_as_a_brick_slides_off_its_support)
{
	// Within two depths of the end the nearest face of the strip becomes the side, which is not pressed: what is lost there is kn x depth x (2 depth) x edge.
	const Real lost = kn * depth * 2 * depth * edge;
	for (Real x = 0; x < 1.2 * edge; x += .00137) {
		Pair p                         = Pair::stacked();
		p.second.placement.position[0] = x;
		EXPECT_NEAR(p.step().force()[2], kn * depth * edge * std::max(0., edge - x), lost + 1e-9) << x;
	}
	for (Real strip : { 3 * depth, 2.1 * depth, depth, depth / 10, 0., -depth }) {
		Pair p                         = Pair::stacked();
		p.second.placement.position[0] = edge - strip;
		const Vector3r f               = p.step().force();
		EXPECT_NEAR(f[2], kn * depth * edge * std::max(0., strip), lost) << strip;
		EXPECT_LT(f.head<2>().norm(), lost); // a strip narrower than the depth is nearer to the sides
	}
}

TEST(ContactTest, brick_sliding_over_two_neighbours_feels_one_floor)
{
	const Real N = kn * edge * edge * depth, lost = kn * depth * 2 * depth * edge; // as above
	for (Real x = -.01; x < 1.05 * edge; x += .00333) {
		Real sum = 0;
		for (const Vector3r& at : { Vector3r(-edge, 0, 0), Vector3r(0, 0, 0), Vector3r(edge, 0, 0), Vector3r(2 * edge, 0, 0) })
			sum += Pair(Body::cube(at), Body::cube({ x, 0, edge - depth })).step().force()[2];
		EXPECT_NEAR(sum, N, 2 * lost) << x;
	}
}

TEST(ContactTest, bulged_faces_touch_where_they_stand)
{
	const auto press = [](Body& b, int face, const std::array<Real, 4>& out) {
		b.deformable = true;
		for (int a = 0; a < 4; ++a)
			b.displacement[faceNodes[face][a]] += out[a] * b.solid.faces[face].normal;
	};
	for (int n : { 1, 4, 7 }) {
		const Real b = depth / 3;
		Pair       p = Pair::stacked(n), q = Pair::stacked(n), far = Pair::stacked(n, -depth / 2);
		press(p.first, 5, { b, b, b, b });    // raised all over
		press(q.second, 4, { b, -b, b, -b }); // warped: the mean depth stays
		press(far.first, 5, { b, b, b, b }), press(far.second, 4, { b, b, b, b });
		const Real area = kn * edge * edge;
		EXPECT_NEAR(p.step().force()[2], area * (depth + b), 1e-9 * area * depth);
		// a warped cell is taken as two triangles: b / 3 off its mean with one cell a face, less with the square of their number
		EXPECT_NEAR(q.step().force()[2], area * depth, area * b / 3 / (n * n) + 1e-9 * area * depth);
		EXPECT_NEAR(far.step().force()[2], area * (2 * b - depth / 2), 1e-9 * area * depth);
		EXPECT_NEAR(far.step().sum.penetration, 2 * b - depth / 2, 1e-13);
	}
}

TEST(ContactTest, part_of_a_bulged_face_counts_with_its_own_height)
{
	for (int n : { 1, 4, 7 })
		for (int side : { -1, 1 }) {
			const Real b       = depth / 3; // the lower face rises along x, by b at its edges; the upper brick stands on one half
			Pair       p       = Pair::stacked(n);
			p.first.deformable = true;
			for (int a : faceNodes[5])
				p.first.displacement[a] = Vector3r(0, 0, nodeSigns[a][0] * b);
			p.second.placement.position[0] = side * edge / 2;
			const Real N                   = kn * edge * edge / 2 * (depth + side * b / 2);
			// Linear, so exact where cells end with the face; a cell of the upper face that reaches beyond the lower one takes the height at the edge for what
			// lies outside, and between: b / 8 of the mean with one cell, less with the square of their number.
			EXPECT_NEAR(p.step().force()[2], N, (n == 4 ? 1e-9 : 1.001 * b / 8 / depth / (n * n)) * kn * edge * edge / 2 * depth) << n;
		}
}

TEST(ContactTest, bulging_sides_of_neighbours_meet)
{
	for (int n : { 1, 4 }) {
		Pair p(Body::cube({ 0, 0, 0 }, n), Body::cube({ edge, 0, 0 }, n));
		p.first.deformable = p.second.deformable = true;
		for (int a = 0; a < nodeCount; ++a) // each a third of a depth wider
			p.first.displacement[a] = p.second.displacement[a] = depth / 6 * Vector3r(nodeSigns[a][0], nodeSigns[a][1], 0);
		const Real N = kn * (edge + depth / 3) * edge * depth / 3; // of the deformed faces
		EXPECT_NEAR(p.step().force()[0], N, 1e-4 * N);             // footprint on the rest face: depth / edge
	}
}

TEST(ContactTest, voussoirs_press_on_their_radial_faces)
{
	for (const Vector3r& turn : { Vector3r(0, 0, 0), Vector3r(.3, -1.2, .8) }) {
		Pair           p(voussoir(-.3, 0), voussoir(0, .25));
		const Vector3r n = p.first.solid.faces[1].normal;
		EXPECT_LT(p.step().force().norm(), kn * .05 * 1e-14);
		p.second.placement.position -= depth * n;
		const Real N = kn * .2 * .25 * depth;
		p.turnAll(turn, { 1, 2, 3 });
		const Vector3r f = p.step().force();
		EXPECT_LT((p.first.placement.rotation.transpose() * f - N * n).norm(), 1e-4 * N); // at the rims: depth / edge
	}
}

// Edges and corners

namespace {

/// A cube above a cube, turned about its own centre so that its lowest corner is `pressed` into the lower one's upper face.
Pair dropped(const Vector3r& turn, Real pressed, int segments = 4)
{
	Pair p(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, 0 }, segments));
	p.second.move(turn);
	Vector3r lowest(0, 0, 1); // middle of the lowest corners
	int      count = 0;
	for (const auto& corner : p.second.solid.corners) {
		const Vector3r x = p.second.world(corner);
		if (x[2] < lowest[2] - 1e-9) lowest = x, count = 1;
		else if (x[2] < lowest[2] + 1e-9)
			lowest = (count * lowest + x) / (count + 1), ++count;
	}
	p.second.placement.position += Vector3r(.0123, -.0071, edge / 2 - pressed) - lowest;
	return p;
}

const Vector3r onEdge(M_PI / 4, 0, 0);
/// Turn that stands a cube on its corner.
const Vector3r onCorner = std::acos(1 / std::sqrt(3.)) * Vector3r(1, -1, 0).normalized();

Pair crossedEdges(Real pressed)
{
	Pair p(Body::cube(), Body::cube({ .011, .007, 0 }));
	p.first.move({ 0, M_PI / 4, 0 }), p.second.move(onEdge, Vector3r::Zero(), p.second.placement.position);
	p.second.placement.position[2] = std::sqrt(2.) * edge - pressed;
	return p;
}

} // namespace

TEST(ContactTest, edge_on_a_face_is_pushed_straight_back)
{
	for (int n : { 1, 3, 4, 16 })
		for (Real pressed : { 1e-6, 1e-5, 1e-4 }) {
			const Vector3r f = dropped(onEdge, pressed, n).step().force();
			EXPECT_GT(f[2], 0) << n;
			EXPECT_LT(f.head<2>().norm(), 1e-6 * f[2]) << n << " " << pressed; // both flanks alike; depths of 1e-6 m keep nine digits
		}
}

TEST(ContactTest, direction_of_the_force_on_an_edge_turns_continuously)
{
	Vector3r last = dropped({ .70, 0, 0 }, 1e-4).step().force();
	for (Real angle = .702; angle < .88; angle += .002) { // through 45 degrees
		const Vector3r f = dropped({ angle, 0, 0 }, 1e-4).step().force();
		EXPECT_LT((f - last).norm(), .02 * last.norm()) << angle;
		last = f;
	}
}

TEST(ContactTest, corner_on_a_face_is_pushed_straight_back)
{
	for (int n : { 1, 3, 4, 16 })
		for (Real pressed : { 1e-5, 1e-4, 1e-3 }) {
			const Vector3r f = dropped(onCorner, pressed, n).step().force();
			EXPECT_GT(f[2], 0) << n;
			EXPECT_LT(f.head<2>().norm(), 1e-6 * f[2]) << n << " " << pressed;
		}
}

TEST(ContactTest, crossed_edges_push_each_other_straight_apart)
{
	for (Real pressed : { 1e-5, 1e-4, 1e-3 }) {
		const Vector3r f = crossedEdges(pressed).step().force();
		EXPECT_GT(f[2], 0);
		EXPECT_LT(f.head<2>().norm(), 1e-6 * f[2]) << pressed;
	}
}

TEST(ContactTest, force_grows_continuously_from_zero_in_every_way_of_touching)
{
	for (const Vector3r& turn :
	     { Vector3r(0, 0, 0), Vector3r(0, 0, .4), Vector3r(.01, 0, 0), onEdge, onCorner, Vector3r(.3, .5, .2), Vector3r(1.2, .1, -.4) }) {
		EXPECT_EQ(dropped(turn, -1e-9).step().force().norm(), 0);
		Real last = 0;
		for (int i = 1; i <= 200; ++i) {
			const Vector3r f = dropped(turn, i * 1e-6).step().force();
			EXPECT_GT(f[2], last) << i << ": " << turn.transpose();
			EXPECT_LT(f[2] - last, 1.01 * kn * edge * edge * 1e-6) << i << ": " << turn.transpose(); // no faster than a whole face
			last = f[2];
		}
	}
	Real last = 0;
	for (int i = 1; i <= 200; ++i) {
		const Real f = crossedEdges(i * 1e-6).step().force()[2];
		EXPECT_GT(f, last);
		last = f;
	}
}

// Symmetries

namespace {

/// Two deformed boxes in a random position, more or less touching.
Pair randomPair(pairs::Random& random, bool deformed = true)
{
	const auto size = [&] { return Vector3r(random.between(.1, .3), random.between(.1, .3), random.between(.1, .3)); };
	Pair p(Body::cuboid(size(), { 0, 0, 0 }, 1 + int(random.between(0, 5.99))), Body::cuboid(size(), random.vector(.2), 1 + int(random.between(0, 5.99))));
	for (Body* b : { &p.first, &p.second }) {
		b->move(random.turn(), Vector3r::Zero(), b->placement.position);
		b->deformable   = deformed;
		b->displacement = random.nodes(1e-4), b->rate = random.nodes(.1);
		b->placement.velocity = random.vector(1), b->placement.angularVelocity = random.vector(5);
	}
	p.springs.normalDamping = p.springs.shearDamping = .2;
	return p;
}

} // namespace

TEST(ContactTest, swapping_the_bodies_swaps_the_loads)
{
	pairs::Random random(11);
	for (int trial = 0; trial < 300; ++trial) {
		Pair p = randomPair(random), q = p;
		std::swap(q.first, q.second);
		Pair::Answer a, b;
		for (int i = 0; i < 3; ++i) // with memory
			a = p.step(1e-5), b = q.step(1e-5);
		const Real small = 1e-13 * a.force().norm();
		for (int s = 0; s < 2; ++s) {
			EXPECT_LE((a.loads[s].force - b.loads[1 - s].force).norm(), small);
			EXPECT_LE((a.loads[s].torque - b.loads[1 - s].torque).norm(), small);
			for (int n = 0; n < nodeCount; ++n)
				EXPECT_LE((a.loads[s].nodal[n] - b.loads[1 - s].nodal[n]).norm(), small);
		}
		EXPECT_LE((a.sum.normalForce + b.sum.normalForce).norm(), small);
		EXPECT_LE((a.sum.normal + b.sum.normal).norm(), 1e-12);
	}
}

TEST(ContactTest, momentum_is_conserved_and_nodes_share_the_force)
{
	pairs::Random random(12);
	for (int trial = 0; trial < 300; ++trial) {
		Pair       p     = randomPair(random);
		const auto a     = p.step(1e-5);
		Real       scale = 0; // parts may cancel
		for (const auto& spot : p.spots)
			scale += spot.area * kn * spot.penetration * 100;
		expectBalance(p, a, scale + a.force().norm());
		for (int s = 0; s < 2; ++s)
			EXPECT_LE((pairs::nodalForce(s ? p.second : p.first, a.loads[s]) - a.loads[s].force).norm(), 1e-13 * (scale + a.force().norm()));
	}
}

TEST(ContactTest, moment_of_the_nodal_loads_is_that_of_the_force)
{
	for (const Vector3r& tilt : { Vector3r(0, 0, 0), Vector3r(4e-5, -2e-5, .3) }) {
		Pair p = Pair::stacked();
		p.second.move(tilt, { .04, .07, 0 }, { 0, 0, edge / 2 });
		p.turnAll({ .3, -1.2, .8 }, { 0, 0, 0 });
		const auto a = p.step();
		for (int s = 0; s < 2; ++s) {
			const Body& b = s ? p.second : p.first;
			// the force acts on the owner's surface, at most a depth from where the other's nodes feel it
			EXPECT_LT((pairs::nodalMoment(b, a.loads[s]) - a.loads[s].torque).norm(), 2 * depth * a.force().norm());
		}
	}
}

TEST(ContactTest, rigid_rotation_of_both_bodies_turns_the_forces_and_changes_nothing_else)
{
	pairs::Random random(13);
	for (int trial = 0; trial < 100; ++trial) {
		const bool     deformed = trial % 2;
		Pair           p = randomPair(random, deformed), q = p;
		const Vector3r turn = random.turn();
		q.turnAll(turn, { .3, .1, -.2 });
		const auto     a = p.step(1e-5), b = q.step(1e-5);
		const Matrix3r R = Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()).toRotationMatrix();
		EXPECT_EQ(p.spots.size(), q.spots.size());
		for (int s = 0; s < 2; ++s)
			// Depths may be 1e-6 of the size. A cut through a corner of the other body may leave the corner on either side by round-off, and a part of a warped
			// face, which is not plane, is then divided into other triangles: 1e-4 m of warping, to the second order.
			EXPECT_LE((R * a.loads[s].force - b.loads[s].force).norm(), (deformed ? 1e-5 : 1e-9) * a.force().norm());
	}
}

TEST(ContactTest, bodies_in_random_positions_touch_exactly_when_no_plane_parts_them)
{
	pairs::Random random(14);
	int           touching = 0, apart = 0;
	for (int trial = 0; trial < 3000; ++trial) {
		Pair       p       = randomPair(random, false);
		const Real overlap = overlapOf(p.first, p.second);
		const auto a       = p.step(1e-5);
		EXPECT_TRUE(a.force().allFinite() && a.loads[0].torque.allFinite() && a.loads[1].torque.allFinite());
		EXPECT_TRUE(a.sum.normal.allFinite() && a.sum.point.allFinite());
		for (const auto& spot : p.spots) {
			EXPECT_GT(spot.area, 0);
			EXPECT_GT(spot.penetration, 0);
		}
		if (overlap <= 0) {
			++apart;
			EXPECT_TRUE(p.spots.empty()) << overlap;
		} else if (
		        overlap > 1e-12
		        && overlap < .05) { // when all of a face is nearest to the far side, there is nothing to press on: fifty contact parts deep
			++touching;
			EXPECT_FALSE(p.spots.empty()) << overlap;
		}
	}
	EXPECT_GT(touching, 100);
	EXPECT_GT(apart, 100);
}

TEST(ContactTest, shallow_contact_pushes_bodies_apart)
{
	pairs::Random random(15);
	for (int trial = 0; trial < 500; ++trial) {
		Pair p                  = randomPair(random, false);
		p.springs.normalDamping = p.springs.shearDamping = 0, p.springs.tanFriction = 0;
		// moved along the line of the centres until they overlap by a given depth
		const Real     wanted = random.between(1e-6, 1e-3);
		const Vector3r apart  = p.second.placement.position.normalized();
		Real           near = 0, far = 1;
		for (int i = 0; i < 60; ++i) {
			p.second.placement.position                          = (near + far) / 2 * apart;
			(overlapOf(p.first, p.second) > wanted ? near : far) = (near + far) / 2;
		}
		const Vector3r f = p.step().force();
		Pair           q = p; // yielding to the force, they overlap less
		q.second.placement.position += wanted / 10 * f.normalized();
		EXPECT_LT(overlapOf(q.first, q.second), wanted) << wanted;
	}
}

TEST(ContactTest, spots_come_in_the_order_of_their_keys)
{
	pairs::Random random(16);
	for (int trial = 0; trial < 500; ++trial) {
		Pair p = randomPair(random);
		p.step();
		for (std::size_t i = 1; i < p.spots.size(); ++i)
			EXPECT_LT(p.spots[i - 1].key, p.spots[i].key);
	}
}

// Friction and dashpot

namespace {

const Real     weight = kn * edge * edge * depth, stiffness = ks * edge * edge, limit = pairs::friction * weight;
constexpr Real dt = 1e-5;

/// Moves the upper brick along x by a distance within one step and returns the friction on it.
Real slide(Pair& p, Real distance)
{
	p.second.placement.velocity[0] = distance / dt;
	p.second.placement.position[0] += distance;
	return p.step(dt).force()[0];
}

} // namespace

TEST(ContactTest, friction_sticks_slides_and_turns_back)
{
	Pair       p     = Pair::stacked();
	const Real stick = limit / stiffness, small = 3e-4 * limit; // the overlap shrinks with the slide of 12e-5 m
	p.step(dt);
	EXPECT_NEAR(slide(p, stick / 2), -limit / 2, small);
	EXPECT_NEAR(slide(p, stick), -limit, small);
	EXPECT_NEAR(slide(p, stick), -limit, small);
	EXPECT_NEAR(slide(p, -stick / 2), -limit / 2, small);
	EXPECT_NEAR(slide(p, -stick), limit / 2, small);
	EXPECT_NEAR(slide(p, -stick * 3), limit, small);
	EXPECT_NEAR(p.step(dt).sum.shearForce.norm(), limit, small);
}

TEST(ContactTest, friction_opposes_sliding_in_any_direction_on_turned_bricks)
{
	Pair p = Pair::stacked();
	p.turnAll({ .3, -1.2, .8 }, { 0, 0, 0 });
	const Vector3r along        = p.first.placement.rotation * Vector3r(.6, -.8, 0);
	p.second.placement.velocity = 10 * along; // 1e-4 m in a step: slides
	const Vector3r f            = p.step(dt).force() - p.step(dt).sum.normalForce;
	EXPECT_LT((f + limit * along).norm(), 1e-9 * limit);
}

TEST(ContactTest, energy_is_that_of_the_springs)
{
	Pair p                      = Pair::stacked();
	p.second.placement.velocity = { .01, 0, 0 };
	const Real slip = 1e-8, dt = slip / .01; // small, so that it sticks
	p.step(dt);
	const Real energy = contactEnergy(p.first.side(), p.second.side(), p.spots, p.springs, p.memory);
	EXPECT_NEAR(energy, edge * edge / 2 * (kn * depth * depth + ks * slip * slip), 1e-10 * energy);
	EXPECT_GT(ks * slip * slip, 1e-8 * kn * depth * depth); // shear is seen
}

TEST(ContactTest, friction_turns_with_the_bricks)
{
	Pair p = Pair::stacked();
	slide(p, limit / stiffness / 2);
	p.second.placement.velocity.setZero();
	const Vector3r before = p.step(0).force();
	const Vector3r turn(.5, -.2, 1);
	p.turnAll(turn, { 0, 0, 0 });
	const Matrix3r R = Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()).toRotationMatrix();
	EXPECT_LT((p.step(0).force() - R * before).norm(), 1e-9 * before.norm());
}

TEST(ContactTest, segments_that_part_forget_their_friction)
{
	Pair p = Pair::stacked();
	slide(p, limit / stiffness / 2);
	EXPECT_EQ(p.memory.size(), p.spots.size());
	for (std::size_t i = 0; i < p.spots.size(); ++i)
		EXPECT_EQ(p.memory.keys[i], p.spots[i].key);
	p.second.placement.position[2] += 1e-3;
	p.step(dt);
	EXPECT_EQ(p.memory.size(), 0u);
	p.second.placement.velocity.setZero();
	p.second.placement.position[2] -= 1e-3;
	EXPECT_LT(p.step(dt).force().head<2>().norm(), 1e-12 * weight);
}

TEST(ContactTest, friction_of_one_half_of_a_bed_is_not_inherited_by_the_other)
{
	for (Real tilt : { -1e-3, 1e-3 }) {
		Pair p = Pair::stacked(4, 0);
		p.second.move({ 0, tilt, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
		EXPECT_LT(slide(p, 1e-7), -1); // N, on the half that is pressed
		p.second.placement.velocity.setZero();
		p.second.placement.position[0] -= 1e-7;
		p.second.move({ 0, -2 * tilt, 0 }, { 0, 0, 0 }, { 0, 0, edge / 2 });
		EXPECT_GT(p.step(dt).sum.normalForce[2], 1);
		EXPECT_LT(p.step(dt).sum.shearForce.norm(), .01); // N: a sliver as wide as the slide, 1e-7 m, is pressed both times
	}
}

TEST(ContactTest, dashpot_brakes_and_never_attracts)
{
	for (Real speed : { -1e-2, 1e-3, 1e-2, 10. }) {
		Pair p                         = Pair::stacked();
		p.springs.normalDamping        = .2;
		p.second.placement.velocity[2] = speed;
		const Real expected            = std::max(0., weight - p.springs.at(.001, .001).normalDashpot * edge * edge * speed);
		EXPECT_NEAR(p.step(dt).force()[2], expected, 1e-9 * (weight + expected)) << speed;
	}
}

TEST(ContactTest, shear_dashpot_brakes_within_the_friction_limit)
{
	for (Real speed : { 1e-4, 1e-2, 10. }) {
		Pair p                         = Pair::stacked();
		p.springs.shearDamping         = .2;
		p.second.placement.velocity[0] = speed;
		EXPECT_NEAR(-p.step(0).force()[0], std::min(limit, p.springs.at(.001, .001).shearDashpot * edge * edge * speed), 1e-9 * limit) << speed;
	}
}

TEST(ContactTest, rates_of_the_nodes_and_of_the_rotation_count_as_motion)
{
	Pair p = Pair::stacked(), q = p, r = p;
	for (Pair* each : { &p, &q, &r })
		each->springs.normalDamping = each->springs.shearDamping = .2, each->second.deformable = true;
	const Vector3r v(1e-4, 2e-4, -3e-4);
	p.second.placement.velocity = v;
	q.second.rate.fill(v);
	EXPECT_LT((p.step(dt).force() - q.step(dt).force()).norm(), 1e-12 * weight);
	// turning about the middle of the bed: no motion in the mean
	r.second.placement.angularVelocity = { 1e-4, 0, 0 };
	r.second.placement.velocity        = -Vector3r(1e-4, 0, 0).cross(Vector3r(0, 0, -edge / 2));
	EXPECT_LT((r.step(dt).force() - Vector3r(0, 0, weight)).norm(), 1e-6 * weight); // the bed is a depth thick
}

// End of a joint

namespace {

/// Largest jump of normal and shear force, as fractions of each, when contact takes over from a joint that has failed all over.
Vector2r jumpAtHandOver(const Body& lower, Body upper, const Vector3r& shift, const Vector3r& turn)
{
	auto joint = joinFaces(lower.side(), 5, upper.side(), 4, 3e-7);
	Pair p(lower, upper);
	p.second.placement.position += shift;
	p.turnAll(turn, { .3, .1, -.2 });
	joint->setMortar(p.springs.at(.001, .001), {});
	pairs::failAll(*joint, SegmentState::Shear);
	std::array<Loads, 2> loads;
	PairSummary          sum;
	const JointMotion    motion = pairs::motionOf(*joint, p.first, p.second);
	pairs::stepJoint(*joint, p.springs, p.first, p.second, loads, sum);
	p.memory       = tractionsOfJoint(*joint, motion, p.springs.tanFriction, p.first.side(), p.second.side());
	const auto now = p.step(0);
	return { (now.sum.normalForce - sum.normalForce).norm() / sum.normalForce.norm(),
		 (now.sum.shearForce - sum.shearForce).norm() / sum.shearForce.norm() };
}

} // namespace

TEST(ContactTest, force_is_continuous_when_contact_takes_over_from_a_joint)
{
	const Vector3r sticking(2e-6, -1e-6, -depth), sliding(2e-5, -3e-5, -depth);
	for (const Vector3r& shift : { sticking, sliding })
		for (const Vector3r& turn : { Vector3r(0, 0, 0), Vector3r(.3, -1.2, .8) })
			for (int n : { 1, 2, 4, 7 }) {
				// What is new is the overlap that the slide has left: slide / edge on either side, and as much of the shear.
				const Real lost = 2 * shift.head<2>().lpNorm<1>() / edge + 1e-9;
				for (const Vector3r& over : { Vector3r(0, 0, edge), Vector3r(edge / 2, 0, edge) }) {
					if (over[0] > 0 && n % 2) continue; // cells match when half a face is a whole number of them
					const Vector2r jump = jumpAtHandOver(Body::cube({ 0, 0, 0 }, n), Body::cube(over, n), shift, turn);
					EXPECT_LT(jump[0], over[0] > 0 ? 2 * lost : lost) << n << ", " << over.transpose();
					EXPECT_LT(jump[1], over[0] > 0 ? 2 * lost : lost) << n << ", " << over.transpose();
				}
			}
}

TEST(ContactTest, force_is_continuous_when_cells_of_joint_and_contact_do_not_match)
{
	// normal forces as above; a uniform shear is uniform whatever the cells
	Body diamond = Body::cube({ 0, 0, edge }, 5);
	diamond.move({ 0, 0, .6 }, { .03, .02, 0 });
	const std::vector<std::pair<Body, Body>> cases {
		{ Body::cube({ 0, 0, 0 }, 3), Body::cube({ edge / 2, 0, edge }, 3) },
		{ Body::cube({ 0, 0, 0 }, 5), diamond },
		{ Body::cube({ 0, 0, 0 }, 4), Body::cuboid({ .1, .2, .2 }, { .05, 0, edge }, 4) },
		{ Body::slab({ 3, 3, .2 }, { 0, 0, 0 }), Body::cube({ .3, .3, edge }, 4) },
	};
	const Vector3r shift(2e-6, -1e-6, -depth);
	for (const auto& c : cases) {
		const Vector2r jump = jumpAtHandOver(c.first, c.second, shift, { .3, -1.2, .8 });
		EXPECT_LT(jump[0], 8 * 3e-6 / edge);
		EXPECT_LT(jump[1], 8 * 3e-6 / edge);
	}
}

// Refined bodies

namespace {

constexpr Real gentle = 1e-6; ///< displacements of the nodes [m]

/// Two cubes a little tilted on each other, or two boxes that dig into each other by an edge or a corner; with rates, dashpots and friction.
Pair rubbing(pairs::Random& random, bool flat)
{
	Pair p = flat ? Pair::stacked() : randomPair(random);
	if (flat) p.second.move(1e-4 * random.vector(1), { random.between(-.1, .1), random.between(-.1, .1), 0 }, p.second.placement.position);
	for (Body* b : { &p.first, &p.second }) {
		b->segments = 6, b->deformable = true, b->displacement = random.nodes(gentle), b->rate = random.nodes(.1);
		b->placement.velocity = random.vector(.1), b->placement.angularVelocity = random.vector(.5);
	}
	p.springs.normalDamping = p.springs.shearDamping = .01;
	p.turnAll({ .3, -1.2, .8 }, { .3, .1, -.2 });
	return p;
}

/// Parts of the force may cancel.
Real sizeOfForces(const Pair& p, const Pair::Answer& a)
{
	Real sum = a.force().norm();
	for (const auto& spot : p.spots)
		sum += spot.area * kn * spot.penetration;
	return sum;
}

/// What nodal forces on the surface do on the trilinear field of each of eight nodes.
Nodes onEightNodes(const Loads& loads, int cells)
{
	Nodes sum;
	sum.fill(Vector3r::Zero());
	for (std::size_t node = 0; node < loads.nodal.size(); ++node) {
		const auto N = shapeFunctions(surfaceGrid(cells).naturalCoordinates(int(node)));
		for (int a = 0; a < nodeCount; ++a)
			sum[a] += N[a] * loads.nodal[node];
	}
	return sum;
}

Vector3r moment(const Body& b, const Loads& loads)
{
	const auto rest = surfaceGrid(b.cells).positions(b.solid.corners);
	Vector3r   sum  = Vector3r::Zero();
	for (std::size_t node = 0; node < rest.size(); ++node)
		sum += b.placement.rotation * (rest[node] + b.side().placement.displacement[node]).cross(loads.nodal[node]);
	return sum;
}

/// Gives both bodies cells, and their nodes displacements and rates as they please.
void refineAtRandom(Pair& p, int cells0, int cells1, pairs::Random& random)
{
	p.first.refine(cells0), p.second.refine(cells1);
	for (Body* b : { &p.first, &p.second })
		for (std::size_t node = 0; node < b->surface.size(); ++node)
			b->surface[node] = random.vector(gentle), b->surfaceRate[node] = random.vector(.1);
}

} // namespace

TEST(ContactTest, loads_of_refined_bodies_with_a_trilinear_field_are_those_of_eight_nodes)
{
	pairs::Random random(17);
	int           pressed = 0;
	for (int trial = 0; trial < 100; ++trial)
		for (const auto& cells : { std::array<int, 2> { 2, 1 }, { 1, 3 }, { 3, 2 }, { 6, 6 } }) {
			Pair p = rubbing(random, trial % 2), q = p;
			q.first.refine(cells[0]), q.second.refine(cells[1]);
			Pair::Answer a, b;
			for (int i = 0; i < 3; ++i) // with memory
				a = p.step(1e-5), b = q.step(1e-5);
			pressed += !p.spots.empty();
			// Where an edge of the other body ends a part, round-off may have it divided into other triangles: displacements of 1e-6 m are not linear over it, as in
			// ContactSearchTest, which are 1e-8 of the edge.
			const Real small = (trial % 2 ? 1e-9 : 1e-7) * sizeOfForces(p, a);
			for (int s = 0; s < 2; ++s) {
				EXPECT_LE((a.loads[s].force - b.loads[s].force).norm(), small);
				EXPECT_LE((a.loads[s].torque - b.loads[s].torque).norm(), small * edge);
				ASSERT_EQ(int(b.loads[s].nodal.size()), surfaceGrid(cells[s]).size());
				const Nodes work = onEightNodes(b.loads[s], cells[s]);
				for (int node = 0; node < nodeCount; ++node)
					EXPECT_LE((a.loads[s].nodal[node] - work[node]).norm(), small);
			}
			EXPECT_LE((a.sum.normalForce - b.sum.normalForce).norm() + (a.sum.shearForce - b.sum.shearForce).norm(), small);
			EXPECT_NEAR(a.sum.area, b.sum.area, 1e-8 * edge * edge);
		}
	EXPECT_GT(pressed, 200);
}

TEST(ContactTest, nodes_of_refined_bodies_share_the_force_and_its_moment)
{
	pairs::Random random(18);
	int           pressed = 0;
	for (int trial = 0; trial < 100; ++trial)
		for (const auto& cells : { std::array<int, 2> { 2, 1 }, { 1, 3 }, { 3, 2 }, { 6, 6 } }) {
			const bool flat = trial % 2;
			Pair       p    = rubbing(random, flat);
			refineAtRandom(p, cells[0], cells[1], random);
			p.step(1e-5);
			const auto a     = p.step(1e-5);
			const Real scale = sizeOfForces(p, a);
			pressed += !p.spots.empty();
			expectBalance(p, a, scale);
			for (int s = 0; s < 2; ++s) {
				const Body& b = s ? p.second : p.first;
				EXPECT_LE((pairs::nodalForce(b, a.loads[s]) - a.loads[s].force).norm(), 1e-13 * scale);
				Real deepest = 0; // the force acts on the owner's surface, at most that far from where the other's nodes feel it
				for (const auto& spot : p.spots)
					deepest = std::max(deepest, spot.penetration);
				EXPECT_LE((moment(b, a.loads[s]) - a.loads[s].torque).norm(), (deepest + 4 * gentle) * scale);
			}
		}
	EXPECT_GT(pressed, 200);
}

TEST(ContactTest, forces_on_a_refined_body_reach_the_cell_where_it_is_pressed_alone)
{
	for (int n : { 2, 4, 8 }) {
		Pair p(Body::cube({ 0, 0, 0 }, 8),
		       Body::cuboid({ edge / n, edge / n, edge }, { edge / 2 - edge / n / 2, edge / n / 2 - edge / 2, edge - depth }));
		p.first.deformable = true, p.first.refine(n);
		p.turnAll({ .3, -1.2, .8 }, { .3, .1, -.2 });
		const auto a    = p.step();
		const auto cell = surfaceGrid(n).cellNodes(5, n - 1, 0);
		const Real N    = kn * edge / n * edge / n * depth;
		EXPECT_LT((a.loads[0].force + a.force()).norm(), 1e-12 * N);
		for (int node = 0; node < surfaceGrid(n).size(); ++node) {
			const bool     here = std::find(cell.begin(), cell.end(), node) != cell.end();
			const Vector3r f    = a.loads[0].nodal[node];
			// strips as wide as the depth, along the sides, are nearer to these
			EXPECT_LT((f - Vector3r(0, 0, here ? -N / 4 : 0)).norm(), 8 * depth / (edge / n) * N) << n << ", " << node;
			EXPECT_TRUE(here || f.norm() == 0) << n << ", " << node;
		}
	}
}

TEST(ContactTest, rates_of_single_nodes_count_where_their_cells_are_pressed)
{
	// the middle node of the bed moves: its hat has a quarter of the area, so dashpots brake by a quarter of what a moving bed would be braked by
	for (bool upper : { false, true })
		for (int n : { 2, 4 }) {
			Pair p                                                      = Pair::stacked(8);
			p.springs.normalDamping                                     = .01;
			Body& b                                                     = upper ? p.second : p.first;
			b.deformable                                                = true, b.refine(n);
			const Real     speed                                        = .01 * (upper ? -1 : 1);
			const Vector3r moving                                       = speed * Vector3r::UnitZ();
			b.surfaceRate[surfaceGrid(n).faceNode(upper ? 4 : 5, 1, 1)] = moving;
			const Real braking = p.springs.at(.001, .001).normalDashpot * std::abs(speed) * (edge / n) * (edge / n);
			EXPECT_NEAR(
			        p.step().force()[2],
			        weight + braking,
			        1e-9 * weight); // spots at the middles of segments have the hat's mean; depths keep 1e-11
		}
}

TEST(ContactTest, loads_of_refined_bodies_are_made_anew_in_the_same_memory)
{
	Pair p             = Pair::stacked(4);
	p.first.deformable = p.second.deformable = true;
	p.first.refine(4), p.second.refine(2);
	Pair::Answer a;
	const auto   step = [&] {
                const Side side0 = p.first.side(), side1 = p.second.side();
                a.sum = PairSummary();
                findContact(side0, side1, p.spots);
                contactLoads(side0, side1, p.spots, p.springs, 1e-5, p.memory, p.scratch, a.loads, a.sum);
	};
	step();
	const Vector3r *before0 = a.loads[0].nodal.data(), *before1 = a.loads[1].nodal.data();
	const auto      first = a.loads;
	step();
	for (int s = 0; s < 2; ++s)
		for (std::size_t node = 0; node < first[s].nodal.size(); ++node)
			EXPECT_EQ(first[s].nodal[node], a.loads[s].nodal[node]);
	EXPECT_EQ(a.loads[0].nodal.data(), before0);
	EXPECT_EQ(a.loads[1].nodal.data(), before1);
}

// Work and energy

namespace {

/// A rigid cube that stands on its corner, 1 mm deep in a slab; no friction.
struct Loop {
	Pair pair;
	int  corner = 0; ///< that digs in

	Loop(const Body& lower, const Vector3r& turn, int segments)
	        : pair(lower, Body::cube({ 0, 0, 0 }, segments))
	        , turn(turn)
	{
		pair.springs.tanFriction = 0;
		pair.second.move(turn);
		for (int a = 0; a < nodeCount; ++a)
			if (pair.second.world(pair.second.solid.corners[a])[2] < pair.second.world(pair.second.solid.corners[corner])[2]) corner = a;
	}
	/// Its corner goes in a circle and up and down while it tilts and turns; time from 0 to 1, both ends alike.
	void place(Real time)
	{
		const Real t = 2 * M_PI * time;
		Body&      b = pair.second;
		b.placement  = Placement();
		b.move(turn), b.move({ .1 * std::sin(t), .07 * std::cos(2 * t), .2 * std::sin(t) });
		b.placement.position
		        += Vector3r(.01 * std::cos(t), .02 * std::sin(t), edge / 2 - 1e-3 * (1 + .5 * std::sin(t + .3))) - b.world(b.solid.corners[corner]);
	}
	/// Work of the contact's forces on the upper body all around, as a share of the sum of its absolute values.
	Real work(int steps)
	{
		Real sum = 0, turned = 0;
		place(0);
		for (int i = 1; i <= steps; ++i) {
			const Placement before = pair.second.placement;
			const auto      a      = pair.step();
			place(Real(i) / steps);
			const auto                   b   = pair.step();
			const Placement&             now = pair.second.placement;
			const Eigen::AngleAxis<Real> by(Matrix3r(now.rotation * before.rotation.transpose()));
			const Real                   done = (a.loads[1].force + b.loads[1].force).dot(now.position - before.position) / 2
			        + (a.loads[1].torque + b.loads[1].torque).dot(by.angle() * by.axis()) / 2;
			sum += done, turned += std::abs(done);
		}
		return sum / turned;
	}

private:
	Vector3r turn;
};

Real energyOf(const Pair& p)
{
	std::vector<ContactSpot> spots;
	findContact(p.first.side(), p.second.side(), spots);
	return contactEnergy(p.first.side(), p.second.side(), spots, p.springs, {});
}

/// Force and torque on the upper body as the slope of the energy, by finite differences.
std::array<Vector3r, 2> slopeOf(const Pair& p)
{
	constexpr Real          h = 1e-7, angle = 1e-6;
	std::array<Vector3r, 2> out;
	for (int i = 0; i < 3; ++i) {
		const auto moved = [&](Real shift, Real turn) {
			Pair q = p;
			q.second.move(turn * Vector3r::Unit(i), shift * Vector3r::Unit(i), p.second.placement.position);
			return energyOf(q);
		};
		out[0][i] = -(moved(h, 0) - moved(-h, 0)) / (2 * h);
		out[1][i] = -(moved(0, angle) - moved(0, -angle)) / (2 * angle);
	}
	return out;
}

/// On a corner, and on corners so low that an edge is in as well.
const std::array<Vector3r, 3> standing { onCorner, Vector3r(.5, .3, .2), Vector3r(.35, .25, 0) };

Body ground() { return Body::slab({ 3, 3, edge }, { 0, 0, 0 }); }

} // namespace

TEST(ContactTest, rigid_cube_led_around_in_a_loop_has_no_work_done_on_it)
{
	for (const Vector3r& turn : standing) {
		Real last = 0;
		for (int n : { 1, 4, 16 }) {
			Loop       loop(ground(), turn, n);
			const Real coarse = loop.work(100), fine = loop.work(200);
			EXPECT_NEAR(coarse / fine, 4, .3) << turn.transpose(); // all there is, is the trapezoidal rule's error
			EXPECT_LT(std::abs(fine), 5e-4) << turn.transpose();   // of 200 steps around: (2 pi / 200)^2 / 2
			EXPECT_NEAR(fine, n > 1 ? last : fine, 1e-9) << n;     // depths of 1e-3 m keep thirteen digits, slivers some less
			last = fine;
		}
	}
}

TEST(ContactTest, force_and_torque_on_a_rigid_cube_are_the_slope_of_its_energy)
{
	for (const Vector3r& turn : standing)
		for (int n : { 1, 4, 16 })
			for (Real time : { .1, .4, .8 }) {
				Loop loop(ground(), turn, n);
				loop.place(time);
				const auto a     = loop.pair.step();
				const auto slope = slopeOf(loop.pair);
				// differences of 1e-7 of 1 mm of depth: third derivatives to 1e-8; of 1e-6 rad at an arm of 0.2 m to (2e-7 / 1e-3)^2
				const Real close = 1e-6 * a.force().norm();
				EXPECT_LT((a.force() - slope[0]).norm(), close) << turn.transpose();
				EXPECT_LT((a.loads[1].torque - slope[1]).norm(), close * edge) << turn.transpose();
			}
}

namespace {

constexpr Real small = .12; ///< edge of the upper body's bed [m]

std::vector<Vector3r*> nodesOf(Body& b)
{
	std::vector<Vector3r*> out;
	if (b.cells > 1)
		for (auto& u : b.surface)
			out.push_back(&u);
	else
		for (auto& u : b.displacement)
			out.push_back(&u);
	return out;
}

/// A smaller box on a cube or on a slab, a little turned, with nodes displaced at random.
Pair pressedTogether(bool slab, int cells, int segments, Real pressed, Real displaced)
{
	pairs::Random random(19);
	Pair          p(slab ? Body::slab({ 3, 3, edge }, { 0, 0, 0 }) : Body::cube({ 0, 0, 0 }, segments),
	       Body::cuboid({ small, small, edge }, { .01, -.015, edge - pressed }, segments));
	p.springs.tanFriction = 0;
	p.second.move({ 0, 0, .1 }, { 0, 0, 0 }, p.second.placement.position);
	for (Body* b : { &p.first, &p.second }) {
		if (b->support) continue;
		b->deformable = true;
		if (cells > 1) b->refine(cells);
		for (Vector3r* u : nodesOf(*b))
			*u = random.vector(displaced);
	}
	return p;
}

/// One component of a node's displacement.
struct Freedom {
	int   body, node, axis;
	Real& of(Pair& p) const { return (*nodesOf(body ? p.second : p.first)[node])[axis]; }
	Real  force(const Pair::Answer& a) const { return a.loads[body].nodal[node][axis]; }
};

std::vector<Freedom> freedomsOf(Pair& p)
{
	std::vector<Freedom> out;
	for (int body = 0; body < 2; ++body)
		if (Body& b = body ? p.second : p.first; !b.support)
			for (int node = 0; node < int(nodesOf(b).size()); ++node)
				for (int axis = 0; axis < 3; ++axis)
					out.push_back({ body, node, axis });
	return out;
}

/// Largest difference between nodal forces and the slope of the energy, as a share of the largest nodal force.
Real worstSlope(Pair p)
{
	constexpr Real h     = 1e-8;
	Real           worst = 0, largest = 0;
	const auto     a = p.step();
	for (const Freedom& freedom : freedomsOf(p)) {
		Pair up = p, down = p;
		freedom.of(up) += h, freedom.of(down) -= h;
		worst   = std::max(worst, std::abs(freedom.force(a) + (energyOf(up) - energyOf(down)) / (2 * h)));
		largest = std::max(largest, std::abs(freedom.force(a)));
	}
	return worst / largest;
}

/// Largest difference between the stiffness of the contact, by finite differences, and its transpose, as a share of its largest entry.
Real asymmetry(Pair p)
{
	constexpr Real  h        = 1e-8;
	const auto      freedoms = freedomsOf(p);
	Eigen::MatrixXd K(freedoms.size(), freedoms.size());
	for (std::size_t j = 0; j < freedoms.size(); ++j) {
		Pair up = p, down = p;
		freedoms[j].of(up) += h, freedoms[j].of(down) -= h;
		const auto a = up.step(), b = down.step();
		for (std::size_t i = 0; i < freedoms.size(); ++i)
			K(i, j) = (freedoms[i].force(a) - freedoms[i].force(b)) / (2 * h);
	}
	return (K - K.transpose()).cwiseAbs().maxCoeff() / K.cwiseAbs().maxCoeff();
}

} // namespace

TEST(ContactTest, nodal_forces_are_the_slope_of_the_energy_to_the_depth_over_the_size_of_a_cell)
{
	// Left are: the area, which counts in the energy as it is deformed, without a force that would do its work: for a corner of the owner's face exactly depth
	// over size; and, where the other's face is warped within a segment, the square of the segment's size.
	for (bool slab : { true, false })
		for (int cells : { 1, 2, 4 })
			for (int each : { 1, 2, 4 }) // segments in a cell
				for (Real pressed : { 2e-4, 5e-5 })
					for (Real share : { 0., .25 }) {
						if (cells * each > 8) continue;
						const Real error = worstSlope(pressedTogether(slab, cells, cells * each, pressed, share * pressed)),
						           area  = pressed * cells / small;
						EXPECT_LT(error, 1.1 * area + .04 * share / (each * each))
						        << slab << " " << cells << " " << each << " " << pressed;
						EXPECT_NEAR(error, slab && cells == 1 && share == 0 ? area : error, 1e-3 * area);
					}
}

TEST(ContactTest, stiffness_of_deformed_faces_in_contact_is_symmetric)
{
	// Left are the area, as above, and what a segment cannot tell: where it is warped, or cut to a triangle, the place that presses and the place that is read
	// differ by its third moments. A face that is not cut has none.
	for (int cells : { 1, 2 })
		for (int each : { 1, 2 })
			for (Real pressed : { 2e-4, 5e-5 })
				for (Real share : { 0., .25 }) {
					pairs::Random random(20);
					Pair          p = Pair::stacked(cells * each, pressed);
					for (Body* b : { &p.first, &p.second }) {
						b->deformable = true;
						if (cells > 1) b->refine(cells);
						for (Vector3r* u : nodesOf(*b))
							*u = random.vector(share * pressed);
					}
					const Real area = pressed * cells / edge;
					EXPECT_LT(asymmetry(p), 3 * area + .1 * share / (each * each))
					        << cells << " " << each << " " << pressed << " " << share;
					EXPECT_LT(
					        asymmetry(pressedTogether(false, cells, cells * each, pressed, share * pressed)),
					        3 * area + .06 / (each * each));
					EXPECT_LT(
					        asymmetry(pressedTogether(true, cells, cells * each, pressed, share * pressed)),
					        3 * area + .1 * share / (each * each));
				}
}

namespace {

/// As seen in a mirror across the plane through the origin normal to an axis.
Body mirrored(const Body& b, int axis)
{
	Matrix3r mirror        = Matrix3r::Identity();
	mirror(axis, axis)     = -1;
	Body out               = b; // a box looks the same
	out.placement.position = mirror * b.placement.position;
	out.placement.rotation = mirror * b.placement.rotation * mirror;
	for (int a = 0; a < nodeCount; ++a) {
		int opposite = 0;
		for (int c = 0; c < nodeCount; ++c) {
			bool same = true;
			for (int i = 0; i < 3; ++i)
				same &= nodeSigns[c][i] == (i == axis ? -1 : 1) * nodeSigns[a][i];
			if (same) opposite = c;
		}
		out.displacement[opposite] = mirror * b.displacement[a];
	}
	return out;
}

} // namespace

TEST(ContactTest, mirrored_bodies_have_mirrored_spots)
{
	pairs::Random random(23);
	int           compared = 0;
	for (int trial = 0; trial < 200; ++trial)
		for (int axis = 0; axis < 3; ++axis) {
			const bool deformed = trial % 2, flat = trial % 4 < 2;
			Pair       p = flat ? Pair::stacked(1 + trial % 6) : randomPair(random, deformed);
			if (flat) {
				p.second.move(
				        { 0, 0, random.between(-.5, .5) },
				        { random.between(-.1, .1), random.between(-.1, .1), 0 },
				        p.second.placement.position);
				p.second.move(random.vector(1e-5), { 0, 0, 0 }, p.second.placement.position);
				for (Body* b : { &p.first, &p.second })
					b->deformable = deformed, b->displacement = random.nodes(1e-6);
			}
			Pair q(mirrored(p.first, axis), mirrored(p.second, axis));
			p.step(), q.step();
			Matrix3r mirror    = Matrix3r::Identity();
			mirror(axis, axis) = -1;
			Real volume = 0, missed = 0, volumeThere = 0;
			for (const auto& spot : q.spots)
				volumeThere += spot.area * spot.penetration;
			for (const auto& spot : p.spots) {
				Real least = std::numeric_limits<Real>::infinity();
				for (const auto& other : q.spots)
					if (other.owner == spot.owner)
						least = std::min(
						        least,
						        (other.position - mirror * spot.position).norm() / edge
						                + std::abs(other.penetration - spot.penetration) / edge
						                + std::abs(other.area - spot.area) / (edge * edge));
				volume += spot.area * spot.penetration;
				if (least > 1e-9) missed += spot.area * spot.penetration; // cuts at slopes of 1e-5 place to 3e-12 m
				++compared;
			}
			// Where edges dig in, segments are cut by several faces, in the order of their numbers, which a mirror changes: warped by 1e-4 m over a tenth of a metre,
			// parts differ by the square of that.
			const bool roundOffAlone = flat || !deformed;
			EXPECT_TRUE(missed == 0 || !roundOffAlone) << trial << " " << axis;
			EXPECT_NEAR(volumeThere, volume, (roundOffAlone ? 1e-12 : 1e-5) * volume);
		}
	EXPECT_GT(compared, 2000);
}

TEST(ContactTest, shear_of_a_joint_between_its_segments_is_their_mean)
{
	// Of four by four segments; one row and one column of the upper face's three by three lie between them. Twisted, so that no two have the same shear.
	Body       lower = Body::cube({ 0, 0, 0 }, 4), upper = Body::cube({ 0, 0, edge }, 3);
	auto       joint = *joinFaces(lower.side(), 5, upper.side(), 4, 3e-7);
	const Real twist = 1e-6;
	joint.setMortar(pairs::springs().at(.001, .001), { 1e30, 1e30, pairs::friction, 1e30, 9 });
	upper.move({ 0, 0, twist }, { 0, 0, 0 }, { 0, 0, 0 });
	const auto memory = tractionsOfJoint(joint, pairs::motionOf(joint, lower, upper), pairs::friction, lower.side(), upper.side());
	int        between[2] { 0, 0 };
	for (std::size_t i = 0; i < memory.size(); ++i) {
		const int      owner = memory.keys[i] >= contactKey(1, 0, 0, 0), cell = memory.keys[i] - contactKey(owner, owner ? 4 : 5, owner ? 5 : 4, 0);
		const Body&    b       = owner ? upper : lower;
		const int      n       = b.segments;
		const Vector3r x       = b.world(b.solid.faces[owner ? 4 : 5].at((2. * (cell % n) + 1) / n - 1, (2. * (cell / n) + 1) / n - 1));
		int            count   = 0;
		Real           nearest = std::numeric_limits<Real>::infinity();
		Vector3r       mean    = Vector3r::Zero();
		for (const auto& s : pairs::segmentsOf(joint))
			nearest = std::min(nearest, (lower.world(joint.shape->patches[0].sides[0].corners.transpose() * cornerWeights(s.p, s.q)) - x).norm());
		for (const auto& s : pairs::segmentsOf(joint)) {
			const Vector3r at = lower.world(joint.shape->patches[0].sides[0].corners.transpose() * cornerWeights(s.p, s.q));
			if ((at - x).norm() < nearest + 10 * twist * edge) mean += at, ++count;
		}
		mean /= count;
		++between[count > 1];
		const Vector3r shear = ks * twist * Vector3r(-mean[1], mean[0], 0) * (owner ? -1 : 1); // linear: that of their mean place
		EXPECT_LT((memory.tractions[i] - shear).norm(), 2 * twist * ks * twist * edge) << owner << " " << cell << " " << count;
	}
	EXPECT_EQ(between[0], 16 + 4);
	EXPECT_EQ(between[1], 5);
}
