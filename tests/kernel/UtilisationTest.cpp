// SPDX-License-Identifier: GPL-2.0-or-later
// How near joints are to failure, beside the rule by which they fail, segment by segment; the mean stress of a body beside stresses that are uniform.
#include "Pairs.hpp"

#include <pkg/brick/kernel/Utilisation.hpp>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr Real roundOff = 1e-12; ///< relative: a few operations
constexpr int  below = 4, above = 5; // faces -z and +z

/// Zero now and then, otherwise up to a size.
Real orZero(pairs::Random& random, Real size, Real low = 0) { return random.between(0, 1) < .2 ? 0 : random.between(low, 1) * size; }

MortarStrength randomStrength(pairs::Random& random)
{
	return { orZero(random, 5e3), orZero(random, 5e3), orZero(random, 1), orZero(random, 2e4), orZero(random, 9) };
}

/// Two bodies, the second on the first, and a joint that holds.
struct Pair {
	Body  lower, upper;
	Joint joint;

	Pair(const Body& first, const Body& second)
	        : lower(first)
	        , upper(second)
	        , joint(joinFaces(lower.side(), above, upper.side(), below, 3e-7).value())
	{
		lower.deformable = upper.deformable = true;
	}
	/// Cubes of four segments an edge, with so many cells, moved and turned against each other within their plane.
	static Pair cubes(const std::array<int, 2>& cells, const Vector2r& shift, Real turn = 0, Real gap = 0)
	{
		Body first = Body::cube(), second = Body::cube();
		second.move({ 0, 0, turn });
		second.placement.position = { shift[0], shift[1], edge + gap };
		first.deformable = second.deformable = true;
		for (Body* b : { &first, &second })
			if (cells[b == &second] > 1) b->refine(cells[b == &second]);
		return Pair(first, second);
	}
	bool isCut() const
	{
		bool cut = false;
		for (const JointPatch& patch : joint.shape->patches)
			cut |= !patch.cut.empty();
		return cut;
	}
	/// Gives the mortar a strength and moves both bodies: stresses of some kPa.
	void load(const MortarStrength& strength, pairs::Random& random)
	{
		joint.setMortar(pairs::springs().at(.001, .001), strength);
		for (Body* b : { &lower, &upper }) {
			b->displacement = random.nodes(5e-7);
			if (b->cells > 1) b->refine(b->cells);
			b->move(random.vector(5e-6), random.vector(5e-7), b->placement.position);
		}
	}
	JointMotion motion() const { return pairs::motionOf(joint, lower, upper); }
	Real        found() const { return utilisation(joint, motion()); }
	/// Of the segments that hold, one by one.
	Real bySegment() const
	{
		const JointMotion m       = motion();
		Real              largest = 0;
		for (int s = 0; s < joint.count(); ++s) {
			const SegmentTraction t = segmentTraction(joint, s, m, pairs::friction);
			if (segmentOf(joint, s).state == SegmentState::Intact) largest = std::max(largest, utilisation(joint.shape->strength, t.normal, t.shear.norm()));
		}
		return largest;
	}
};

/// With faces of one cell or more, whole overlaps and parts.
std::vector<Pair> grids()
{
	std::vector<Pair> out;
	for (const std::array<int, 2>& cells : { std::array<int, 2> { 1, 1 }, { 2, 2 }, { 4, 2 }, { 1, 4 } })
		for (Real shift : { 0., edge / 2 })
			for (Real gap : { -2e-7, 0., 2e-7 })
				out.push_back(Pair::cubes(cells, { shift, 0 }, 0, gap));
	return out;
}

/// Whose border cuts segments.
std::vector<Pair> cutOnes(int cells)
{
	return { Pair::cubes({ cells, cells }, { 0, 0 }, M_PI / 4), Pair::cubes({ cells, cells }, { .03, -.05 }, .3), Pair::cubes({ cells, cells }, { .08, .08 }, 1) };
}

void expectEqual(Real found, Real expected)
{
	// places of 0.1 m keep 1e-17 m of openings of 1e-6 m, and what friction leaves of the cohesion may be a thousandth of it
	EXPECT_TRUE(found == expected || std::abs(found - expected) <= 1e-7 * expected) << found << ", expected " << expected;
}

Matrix3r symmetric(pairs::Random& random, Real size)
{
	const Matrix3r m = Matrix3r::NullaryExpr([&] { return random.between(-size, size); });
	return m + m.transpose();
}

/// Sum of x f^T over the faces of a solid that turns by R, under a uniform stress: the traction is uniform on a face, so it acts at its centroid.
Matrix3r momentsOf(const Hexahedron& solid, const Matrix3r& stress, const Matrix3r& R)
{
	Matrix3r moments = Matrix3r::Zero();
	for (const Face& face : solid.faces) {
		Vector3r      first = Vector3r::Zero(), area = Vector3r::Zero();
		constexpr Real g    = .57735026918962576; // 2 x 2 Gauss points: exact
		for (Real xi : { -g, g })
			for (Real eta : { -g, g }) {
				const Vector3r part = (face.e1 + eta * face.e12).cross(face.e2 + xi * face.e12);
				area += part, first += part.norm() * face.at(xi, eta);
			}
		const Vector3r centroid = first / area.norm();
		moments += (R * centroid) * (R * (stress * area)).transpose();
	}
	return moments;
}

Real largestMagnitude(const Matrix3r& stress) { return Eigen::SelfAdjointEigenSolver<Matrix3r>(stress).eigenvalues().cwiseAbs().maxCoeff(); }

Nodes leaning()
{
	Nodes corners = cuboidCorners({ .25, .12, .06 });
	for (auto& x : corners)
		x[0] += .4 * x[2] + .5 * x[0] * x[2];
	const Vector3r centroid = solidProperties(corners).centroid;
	for (auto& x : corners)
		x -= centroid;
	return corners;
}

} // namespace

TEST(UtilisationTest, is_above_one_exactly_when_a_segment_fails)
{
	pairs::Random random(41);
	int           modes[4] {};
	for (int trial = 0; trial < 200000; ++trial) {
		const MortarStrength strength = randomStrength(random);
		const Real           sigma = orZero(random, random.between(0, 1) < .5 ? 1e4 : -3e4), tau = orZero(random, 1e4);
		const Real           u    = utilisation(strength, sigma, tau);
		const SegmentState   mode = failureMode(strength, sigma, tau);
		ASSERT_GE(u, 0);
		ASSERT_TRUE((u > 1) == (mode != SegmentState::Intact) || std::abs(u - 1) < roundOff) << u << ": " << sigma << ", " << tau;
		++modes[int(mode)];
	}
	for (int count : modes)
		EXPECT_GT(count, 1000); // the trials reach every mode
}

TEST(UtilisationTest, is_the_share_of_the_strength_in_each_mode)
{
	const MortarStrength strength { 4e3, 3e3, .5, 5e5, 9 };
	EXPECT_DOUBLE_EQ(utilisation(strength, 1e3, 0), .25); // tension
	EXPECT_DOUBLE_EQ(utilisation(strength, 0, 600), .2); // shear
	EXPECT_DOUBLE_EQ(utilisation(strength, -2e3, 1e3), .25); // with friction
	EXPECT_DOUBLE_EQ(utilisation(strength, 2e3, 1e3), .5); // both: 1000 of 3000 - 0.5 * 2000, and 2000 of 4000
	EXPECT_DOUBLE_EQ(utilisation(strength, -1e5, 0), .2); // compression
	EXPECT_DOUBLE_EQ(utilisation(strength, -3e5, 1e5 / 3), std::sqrt(.4)); // with shear: the square root of 3e5^2 + 9 (1e5/3)^2, over 5e5
	EXPECT_EQ(utilisation(strength, 0, 0), 0);
}

TEST(UtilisationTest, mortar_without_strength_is_used_up_by_any_stress_and_not_used_by_none)
{
	const MortarStrength none;
	EXPECT_EQ(utilisation(none, 0, 0), 0);
	for (const auto& [sigma, tau] : { std::pair(1., 0.), std::pair(0., 1.), std::pair(-1., 0.), std::pair(-1., 1.) })
		EXPECT_TRUE(std::isinf(utilisation(none, sigma, tau)));
	const Real infinite = std::numeric_limits<Real>::infinity();
	for (Real sigma : { -1e9, 0., 1e9 })
		EXPECT_EQ(utilisation({ infinite, infinite, .6, infinite, 9 }, sigma, 1e9), 0);
}

TEST(UtilisationTest, joint_that_holds_has_that_of_its_worst_segment)
{
	pairs::Random random(42);
	for (Pair pair : grids())
		for (int trial = 0; trial < 20; ++trial) {
			Pair loaded = pair;
			loaded.load(randomStrength(random), random);
			expectEqual(loaded.found(), loaded.bySegment());
		}
}

TEST(UtilisationTest, joint_of_cut_segments_that_holds_has_that_of_its_worst_segment)
{
	pairs::Random random(43);
	for (int cells : { 1, 2 })
		for (const Pair& pair : cutOnes(cells)) {
			EXPECT_TRUE(pair.isCut());
			for (int trial = 0; trial < 20; ++trial) {
				Pair loaded = pair;
				loaded.load(randomStrength(random), random);
				expectEqual(loaded.found(), loaded.bySegment());
			}
		}
}

TEST(UtilisationTest, cracked_joint_has_that_of_its_worst_segment_that_holds)
{
	pairs::Random     random(44);
	std::vector<Pair> all = grids();
	for (int cells : { 1, 2 })
		for (const Pair& pair : cutOnes(cells))
			all.push_back(pair);
	for (Pair& pair : all) {
		pair.load(randomStrength(random), random);
		for (int s = 0; s < pair.joint.count(); ++s) {
			if (s == 0 || random.between(0, 1) < .5) pairs::fail(pair.joint, s, SegmentState::Tension);
			expectEqual(pair.found(), pair.bySegment());
		}
	}
}

TEST(UtilisationTest, joint_without_segments_that_hold_has_none)
{
	pairs::Random random(45);
	for (Pair& pair : grids()) {
		pair.load({ 1, 1, .5, 1, 9 }, random);
		EXPECT_GT(pair.found(), 1);
		pairs::failAll(pair.joint, SegmentState::Shear);
		EXPECT_EQ(pair.found(), 0);
	}
}

TEST(UtilisationTest, joint_fails_exactly_above_one)
{
	pairs::Random random(46);
	int           failed = 0, held = 0;
	for (const Pair& pair : grids())
		for (int trial = 0; trial < 40; ++trial) {
			Pair       loaded = pair;
			const Real size   = random.between(.3, 4);
			loaded.load({ size * 8e3, size * 5e3, .6, size * 1e4, 9 }, random);
			const bool fails = overloaded(loaded.joint, loaded.motion()).total() > 0;
			EXPECT_TRUE((loaded.found() > 1) == fails || std::abs(loaded.found() - 1) < 1e-7) << loaded.found(); // as said at expectEqual
			++(fails ? failed : held);
		}
	EXPECT_GT(failed, 100);
	EXPECT_GT(held, 100); // the trials are near the border
}

TEST(UtilisationTest, uniform_stress_is_found_from_the_forces_on_the_surface_in_any_frame)
{
	pairs::Random random(47);
	for (const Nodes& corners : { cuboidCorners(Vector3r::Constant(edge)), leaning() }) {
		const Hexahedron solid(corners);
		const Real       volume = solidProperties(corners).volume;
		const Matrix3r   one = Matrix3r::Identity(), uniaxial = Vector3r(0, 0, 1) * Vector3r(0, 0, 1).transpose();
		std::vector<Matrix3r> stresses { 3e4 * one, -3e4 * one, 2e3 * uniaxial, -2e3 * uniaxial, 1e-3 * uniaxial, 1e5 * (one - 3 * uniaxial), Matrix3r::Zero() };
		for (int i = 0; i < 200; ++i)
			stresses.push_back(symmetric(random, std::pow(10, random.between(0, 7))));
		for (const Matrix3r& stress : stresses) {
			const Vector3r turn = random.turn();
			const Matrix3r R(Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()));
			EXPECT_NEAR(largestPrincipalStress(momentsOf(solid, stress, R), volume), largestMagnitude(stress), roundOff * stress.norm());
		}
	}
}

TEST(UtilisationTest, torque_alone_is_no_stress)
{
	pairs::Random  random(48);
	const Matrix3r stress = symmetric(random, 1e4), other = Matrix3r::NullaryExpr([&] { return random.between(-1e4, 1e4); });
	EXPECT_NEAR(largestPrincipalStress(stress + (other - other.transpose()), 1), largestMagnitude(stress), roundOff * stress.norm());
}

TEST(UtilisationTest, brick_that_stands_has_half_of_the_stress_at_its_base)
{
	// gravity has no moment about the centroid, the ground's pressure acts half a height below
	const Vector3r down(0, 0, -edge / 2), force(0, 0, pairs::density * 9.81 * edge * edge * edge);
	EXPECT_NEAR(largestPrincipalStress(down * force.transpose(), edge * edge * edge), pairs::density * 9.81 * edge / 2, roundOff * 1e3);
}
