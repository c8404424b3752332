// SPDX-License-Identifier: GPL-2.0-or-later
// What the law leaves out (LawTerms): each variant beside the full one with parameters that make the same term vanish, bit for bit.
#include "Pairs.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

using S = JointSegments;

constexpr int  below = 4, above = 5; // faces -z and +z
constexpr Real infinite = std::numeric_limits<Real>::infinity();

std::vector<LawTerms> variants()
{
	std::vector<LawTerms> out;
	for (int i = 0; i < 8; ++i)
		out.push_back({ bool(i & 1), bool(i & 2), bool(i & 4) });
	return out;
}
std::string named(const LawTerms& t) { return std::string(t.failure ? "failure " : "") + (t.friction ? "friction " : "") + (t.dashpots ? "dashpots" : ""); }

const MortarStrength unbreakable { infinite, infinite, pairs::friction, infinite, 9 };

// Bits

bool same(const Real* a, const Real* b, std::size_t count) { return std::memcmp(a, b, count * sizeof(Real)) == 0; }
bool same(const Vector3r& a, const Vector3r& b) { return same(a.data(), b.data(), 3); }
bool same(const SegmentSums& a, const SegmentSums& b)
{
	return same(&a.force.normal[0], &b.force.normal[0], sizeof(SegmentField) / sizeof(Real)) && same(&a.penetration, &b.penetration, 1)
	        && a.anyFailed == b.anyFailed;
}
bool same(const JointSegments& a, const JointSegments& b)
{
	return a.count() == b.count() && same(a.row(S::P), b.row(S::P), std::size_t(S::rowCount) * a.padded());
}
bool same(const Loads& a, const Loads& b)
{
	bool equal = same(a.force, b.force) && same(a.torque, b.torque) && a.nodal.size() == b.nodal.size();
	for (std::size_t n = 0; n < a.nodal.size(); ++n)
		equal = equal && same(a.nodal[n], b.nodal[n]);
	return equal;
}
bool same(const PairSummary& a, const PairSummary& b)
{
	return same(a.normalForce, b.normalForce) && same(a.shearForce, b.shearForce) && same(a.point, b.point) && same(a.normal, b.normal)
	        && same(&a.kn, &b.kn, 4);
}

// Sweeps

SegmentField randomField(pairs::Random& random, Real size)
{
	SegmentField f;
	for (auto* row : { &f.normal, &f.tangent1, &f.tangent2 })
		for (Real& c : *row)
			c = random.between(-size, size);
	return f;
}

/// About half of the segments that hold fail; contact opens, sticks and slides.
SegmentSweep randomSweep(pairs::Random& random)
{
	SegmentSweep s {};
	s.opening     = randomField(random, 1e-6);
	s.rate        = randomField(random, 1e-3);
	s.springs     = { pairs::knThin, pairs::ksThin, 1e6, 1e6 };
	s.strength    = { pairs::tensile, pairs::cohesive, pairs::friction, 5e3, 9 };
	s.tanFriction = .5;
	s.bending = random.between(0, 4e3), s.hingeTension = pairs::tensile, s.hingeShare = random.between(0, 1), s.hingeSign = random.between(0, 1);
	return s;
}

/// With everything computed, and nothing that comes of what the variant leaves out.
SegmentSweep vanishing(SegmentSweep s, const LawTerms& variant)
{
	if (!variant.failure) s.strength = unbreakable, s.hingeTension = infinite;
	if (!variant.friction) s.tanFriction = 0;
	if (!variant.dashpots) s.springs.normalDashpot = s.springs.shearDashpot = 0;
	return s;
}

JointSegments randomSegments(pairs::Random& random, int count)
{
	JointSegments out(count);
	for (int i = 0; i < count; ++i) {
		out.row(S::P)[i] = random.between(0, 1), out.row(S::Q)[i] = random.between(0, 1), out.row(S::Area)[i] = random.between(.5, 1) * 1e-3;
		if (random.between(0, 1) < .5) continue;
		out.row(S::State)[i] = int(SegmentState::Shear);
		out.row(S::Slip1)[i] = random.between(-1e-6, 1e-6), out.row(S::Slip2)[i] = random.between(-1e-6, 1e-6);
	}
	return out;
}

} // namespace

TEST(JointTermsTest, sweep_without_a_term_is_bitwise_the_full_one_where_the_term_vanishes)
{
	for (const LawTerms& variant : variants()) {
		pairs::Random random(7);
		for (int trial = 0; trial < 100; ++trial) {
			JointSegments lean = randomSegments(random, 1 + trial % 37), full = lean;
			for (int step = 0; step < 4; ++step) {
				SegmentSweep sweep = randomSweep(random), reference = vanishing(sweep, variant);
				sweep.terms             = variant;
				const SegmentSums found = sweepSegments(lean, sweep), expected = sweepSegments(full, reference);
				ASSERT_TRUE(same(found, expected)) << named(variant) << ", trial " << trial << ", step " << step;
				ASSERT_TRUE(same(lean, full)) << named(variant) << ", trial " << trial << ", step " << step;
			}
		}
	}
}

TEST(JointTermsTest, full_sweep_differs_from_each_variant)
{
	for (const LawTerms& variant : variants()) {
		if (variant.failure && variant.friction && variant.dashpots) continue;
		pairs::Random random(7);
		JointSegments lean = randomSegments(random, 37), full = lean;
		SegmentSweep  sweep    = randomSweep(random);
		const auto    expected = sweepSegments(full, sweep);
		sweep.terms            = variant;
		EXPECT_FALSE(same(sweepSegments(lean, sweep), expected)) << named(variant);
	}
}

// Joints

namespace {

struct JointPair {
	Body        first, second;
	PairSprings springs;
	Joint       joint;

	JointPair(const Body& first, const Body& second, const MortarStrength& strength, const PairSprings& springs)
	        : first(first)
	        , second(second)
	        , springs(springs)
	        , joint(*joinFaces(first.side(), above, second.side(), below, 3e-7))
	{
		joint.setMortar(springs.at(first.contactLength[above], second.contactLength[below]), strength);
	}
	struct Answer {
		std::array<Loads, 2> loads;
		PairSummary          sum;
		Failures             failures;
	};
	/// Without dashpots nobody says how the bodies move.
	Answer step(const LawTerms& terms = {})
	{
		Answer                a;
		const JointPlacements moving { first.side().placement, second.side().placement };
		JointLoads            found;
		a.failures = jointLoads(
		        joint, pairs::motionOf(joint, first, second), terms.dashpots ? &moving : nullptr, springs.tanFriction, found, a.sum, nullptr, terms);
		for (int s = 0; s < 2; ++s) {
			const Body& b    = s ? second : first;
			a.loads[s]       = Loads(b.cells);
			a.loads[s].force = found.forceOn(s), a.loads[s].torque = found.torque[s];
			addNodalForces(joint, found, s, b.placement.rotation, a.loads[s].nodal.data());
		}
		return a;
	}
};

/// Half over half, deformable, askew.
std::array<Body, 2> halfOverHalf(int cells)
{
	std::array<Body, 2> bodies { Body::cube({ 0, 0, 0 }, 4), Body::cube({ edge / 2, 0, edge }, 4) };
	for (Body& b : bodies) {
		b.deformable = true;
		b.move({ .3, -1.1, .7 }, { 1, -2, .5 });
		if (cells > 1) b.refine(cells);
	}
	return bodies;
}

/// Puts a body, deformed, near where it was, and has it move.
void shake(Body& b, const Body& from, Real size, pairs::Random& random)
{
	b              = from;
	b.displacement = random.nodes(size), b.rate = random.nodes(1e3 * size);
	if (b.cells > 1) b.refine(b.cells);
	b.move(random.vector(4 * size), random.vector(size), from.placement.position);
	b.placement.velocity = random.vector(1e3 * size), b.placement.angularVelocity = random.vector(1e4 * size);
}

PairSprings damped()
{
	PairSprings s   = pairs::springs();
	s.normalDamping = s.shearDamping = .3;
	return s;
}

PairSprings vanishing(PairSprings s, const LawTerms& variant)
{
	if (!variant.friction) s.tanFriction = 0;
	if (!variant.dashpots) s.normalDamping = s.shearDamping = 0;
	return s;
}

} // namespace

TEST(JointTermsTest, joint_without_a_term_is_bitwise_the_full_one_where_the_term_vanishes)
{
	const MortarStrength weak { pairs::tensile, pairs::cohesive, pairs::friction, 5e4, 9 };
	for (int cells : { 1, 2 })
		for (const LawTerms& variant : variants()) {
			pairs::Random random(3);
			const auto    bodies = halfOverHalf(cells);
			JointPair     lean(bodies[0], bodies[1], weak, damped()),
			        full(bodies[0], bodies[1], variant.failure ? weak : unbreakable, vanishing(damped(), variant));
			int failed = 0;
			for (int step = 0; step < 40; ++step) {
				if (step == 10) pairs::fail(lean.joint, 3, SegmentState::Shear), pairs::fail(full.joint, 3, SegmentState::Shear);
				shake(lean.first, bodies[0], step < 10 ? 2e-8 : 5e-7, random), shake(lean.second, bodies[1], step < 10 ? 2e-8 : 5e-7, random);
				full.first = lean.first, full.second = lean.second;
				const auto a = lean.step(variant), b = full.step();
				ASSERT_TRUE(same(a.loads[0], b.loads[0]) && same(a.loads[1], b.loads[1]) && same(a.sum, b.sum))
				        << named(variant) << ", step " << step;
				ASSERT_EQ(a.failures.total(), b.failures.total());
				for (std::size_t i = 0; i < lean.joint.segments.size(); ++i)
					ASSERT_TRUE(same(lean.joint.segments[i], full.joint.segments[i]));
				failed += a.failures.total();
			}
			if (variant.failure) EXPECT_GT(failed, 0);
			else
				EXPECT_EQ(failed, 0);
		}
}

TEST(JointTermsTest, joint_that_cannot_fail_is_linear_far_beyond_its_strength)
{
	const LawTerms elastic { false, true, true };
	for (int segments : { 1, 4 }) // one segment wide is a hinge, which bending alone would tear
		for (const Vector3r& moved : { Vector3r(0, 0, 1e-4), Vector3r(3e-4, -2e-4, -1e-4) }) {
			const MortarStrength weak { pairs::tensile, pairs::cohesive, pairs::friction, pairs::crush, 9 };
			JointPair            pair(Body::cube({ 0, 0, 0 }, segments), Body::cube({ 0, 0, edge }, segments), weak, damped());
			pair.second.placement.position += moved;
			pair.second.move({ 1e-4, 0, 0 }, { 0, 0, 0 }, moved + Vector3r(0, 0, edge / 2)); // about the middle of its bed
			EXPECT_GT(overloaded(pair.joint, pairs::motionOf(pair.joint, pair.first, pair.second)).total(), 0);
			const auto once = pair.step(elastic);
			EXPECT_TRUE(pair.joint.holds());
			EXPECT_TRUE(pair.joint.segments.empty());
			const SpotSprings& k = pair.joint.springs;
			const Vector3r     f = -pair.joint.area() * Vector3r(k.shear * moved[0], k.shear * moved[1], k.normal * moved[2]);
			EXPECT_LT((once.loads[1].force - f).norm(), 1e-3 * f.norm()); // the joint's axes turn by 5e-5
			const Real rows = segments, deepest = -moved[2] + 1e-4 * edge / 2 * (rows - 1) / rows;
			EXPECT_NEAR(once.sum.penetration, deepest, 1e-3 * std::abs(deepest)); // of an outermost segment's middle; likewise
			EXPECT_GT(pair.step().failures.total(), 0);                           // as soon as it can
		}
}

TEST(JointTermsTest, friction_that_is_switched_on_begins_without_shear)
{
	constexpr Real pressed = 1e-5, slid = 1e-6;
	JointPair      pair(Body::cube({ 0, 0, 0 }), Body::cube({ 0, 0, edge }), unbreakable, pairs::springs());
	pairs::failAll(pair.joint, SegmentState::Tension);
	pair.second.placement.position += Vector3r(slid, 0, -pressed);
	const Real k = pair.joint.springs.shear * pair.joint.area();
	EXPECT_NEAR(pair.step().sum.shearForce.norm(), k * slid, 1e-6 * k * slid);
	EXPECT_EQ(pair.step({ true, false, true }).sum.shearForce.norm(), 0);
	pair.second.placement.position[1] += 3 * slid;
	EXPECT_EQ(pair.step({ true, false, true }).sum.shearForce.norm(), 0);
	EXPECT_EQ(pair.step().sum.shearForce.norm(), 0);
	pair.second.placement.position[1] -= slid;
	EXPECT_NEAR(pair.step().sum.shearForce[1], k * slid, 1e-6 * k * slid);
}

// Contact

namespace {

struct Touch {
	Body                     first, second;
	PairSprings              springs;
	ContactMemory            memory, scratch;
	std::vector<ContactSpot> spots;
	std::array<Loads, 2>     loads;
	PairSummary              sum;

	Touch(const Body& one, const Body& other, const PairSprings& between)
	        : first(one)
	        , second(other)
	        , springs(between)
	{
	}

	void step(const LawTerms& terms = {})
	{
		const Side side0 = first.side(), side1 = second.side();
		sum = PairSummary();
		findContact(side0, side1, spots);
		contactLoads(side0, side1, spots, springs, 1e-5, memory, scratch, loads, sum, terms);
	}
	/// Traction of a spot; zero where the memory has none.
	Vector3r traction(int key) const
	{
		const auto at = std::find(memory.keys.begin(), memory.keys.end(), key);
		return at == memory.keys.end() ? Vector3r(Vector3r::Zero()) : memory.tractions[at - memory.keys.begin()];
	}
};

/// Pairs that touch face to face, edge to face and on a support, of one cell and of several.
std::vector<std::array<Body, 2>> touching()
{
	std::vector<std::array<Body, 2>> out;
	for (int cells : { 1, 2 })
		for (int tilted : { 0, 1 })
			for (bool support : { false, true }) {
				Body lower = support ? Body::slab({ 3, 3, edge }, { 0, 0, 0 }) : Body::cube({ 0, 0, 0 }, 5),
				     upper = Body::cube({ .01, .03, edge - 2e-5 }, 4);
				if (tilted) upper.move({ .01, 5e-3, .4 }, { 0, 0, 5e-4 }, upper.placement.position);
				lower.deformable = !support, upper.deformable = true;
				if (cells > 1) upper.refine(cells);
				lower.move({ .3, -1.1, .7 }, { 1, -2, .5 }), upper.move({ .3, -1.1, .7 }, { 1, -2, .5 });
				out.push_back({ lower, upper });
			}
	return out;
}

} // namespace

TEST(ContactTermsTest, contact_without_a_term_is_bitwise_the_full_one_where_the_term_vanishes)
{
	for (const auto& bodies : touching())
		for (const LawTerms& variant : variants()) {
			pairs::Random random(5);
			Touch         lean(bodies[0], bodies[1], damped());
			if (bodies[0].support) lean.springs = pairs::onSupport(lean.springs, 0);
			Touch full   = lean;
			full.springs = vanishing(lean.springs, variant);
			int spots    = 0;
			for (int step = 0; step < 20; ++step) {
				shake(lean.first, bodies[0], 1e-6, random), shake(lean.second, bodies[1], 1e-6, random);
				full.first = lean.first, full.second = lean.second;
				lean.step(variant), full.step();
				ASSERT_TRUE(same(lean.loads[0], full.loads[0]) && same(lean.loads[1], full.loads[1])) << named(variant) << ", step " << step;
				ASSERT_TRUE(same(lean.sum, full.sum)) << named(variant) << ", step " << step;
				for (const int key : full.memory.keys)
					ASSERT_EQ(lean.traction(key), full.traction(key)); // equal, but for signs of zeros
				spots += int(lean.spots.size());
			}
			EXPECT_GT(spots, 20);
		}
}

TEST(ContactTermsTest, friction_that_is_switched_on_begins_without_shear)
{
	constexpr Real slid = 1e-8;
	Touch          touch(Body::cube(), Body::cube({ 0, 0, edge - 1e-5 }), pairs::springs());
	const auto     slide = [&](Real by, const LawTerms& terms) {
                touch.second.placement.position[0] += by;
                touch.second.placement.velocity[0] = by / 1e-5;
                touch.step(terms);
                return touch.sum.shearForce[0];
	};
	const Real resists = slide(slid, {});
	EXPECT_LT(resists, 0);
	EXPECT_EQ(slide(slid, { true, false, true }), 0);
	EXPECT_EQ(touch.memory.size(), 0u);
	EXPECT_EQ(slide(0, {}), 0);
	EXPECT_NEAR(slide(slid, {}), resists, 1e-6 * std::abs(resists)); // its share of the bed has changed by 1e-7
}

TEST(LawTermsTest, pair_without_friction_or_damping_needs_neither)
{
	const auto needed = [](Real tanFriction, Real hn, Real hs) {
		PairSprings s;
		s.tanFriction = tanFriction, s.normalDamping = hn, s.shearDamping = hs;
		return LawTerms().neededBy(s);
	};
	EXPECT_TRUE(needed(.5, .1, .1).friction && needed(.5, .1, .1).dashpots && needed(.5, .1, .1).failure);
	EXPECT_FALSE(needed(0, .1, .1).friction);
	EXPECT_TRUE(needed(0, 0, .1).dashpots && needed(0, .1, 0).dashpots);
	EXPECT_FALSE(needed(.5, 0, 0).dashpots);
	EXPECT_FALSE((LawTerms { false, false, false }).neededBy(damped()).friction);
}
