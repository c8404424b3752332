// SPDX-License-Identifier: GPL-2.0-or-later
// How fast cracked joints are beside what the same core can do: updated segments a second, and the peak rate of double-precision multiply-adds.
// All that touches the kernel's joints is in CrackedJoints. Then the same without what the law can leave out, and contact likewise.
#include <pkg/brick/kernel/Contact.hpp>

#include <benchmark/benchmark.h>

#include <immintrin.h>

namespace {

// Floating point operations of one update of a failed segment that is pressed and slides: a multiply-add is two; a root, a division, a comparison one each.

/// As the method states it, each point placed by the four nodes of its face. The yardstick: a kernel that needs fewer operations is the better for it.
constexpr int flopsPerSegment = 2 * 3 * 7 + 3 // places of the two points, and d
        + 2 * 3 * 7 + 3                       // velocities, likewise
        + 6 + 6 + 5                           // un, ut, un'
        + 4                                   // pressure: kn un + cn un', not below zero
        + 11                                  // slip turned into the joint's plane
        + 6 + 12 + 6                          // ks (ut - slip), Coulomb's limit, the new slip
        + 6 + 6 + 11                          // ut', what the dashpot adds, the limit again
        + 6 + 3 + 6                           // traction, force, the point where it acts
        + 2 * 4 * 3 * 2                       // forces on the nodes of both faces
        + 3 + 12 + 6 + 6 + 2;                 // sums of force, torque, places, normal force, area; the largest penetration

/// In the leanest form that we know: displacement and rate bilinear over the joint in its own axes, forces summed as their moments with 1, p, q, pq.
constexpr int leanFlopsPerSegment = 1 // pq
        + 2 * 3 * 6                   // opening and rate
        + 4                           // pressure
        + 4 + 9 + 4                   // ks (ut - slip), Coulomb's limit, the new slip
        + 4 + 8                       // what the dashpot adds, the limit again
        + 3 + 3 * 7 + 1;              // force, its moments; the largest penetration

/// A column of cubes with as many joints as a wall of 24 x 24 has. All segments of each joint have failed but one, so that it is a joint still; the faces press
/// on each other and slide to and fro, which asks for every term of the law.
class CrackedJoints {
public:
	static constexpr int jointCount = 1128;

	explicit CrackedJoints(int segmentsAlongEdge)
	        : segments(segmentsAlongEdge)
	        , cubes(jointCount + 1)
	{
		contactLength.fill(thickness);
		springs.normalCompliance = { .9375 / young, .9375 / young }; // nu = 0.25
		springs.shearCompliance  = { 2.5 / young, 2.5 / young };
		springs.density          = { 1800, 1800 };
		springs.normalDamping = springs.shearDamping = .1;
		springs.tanFriction                          = tanFriction;
		for (int i = 0; i <= jointCount; ++i)
			cubes[i].placeAt(edge * i);
		for (int i = 0; i < jointCount; ++i)
			joins.push_back(join(i));
		for (int i = 0; i <= jointCount; ++i)
			cubes[i].placeAt((edge - pressedBy) * i);
	}

	/// The loads of all joints after a step of sliding; the number of segments.
	long update()
	{
		forth = !forth;
		for (int i = 0; i <= jointCount; ++i)
			cubes[i].slide(forth == bool(i % 2));
		for (int i = 0; i < jointCount; ++i)
			loadsOf(joins[i], cubes[i].placement, cubes[i + 1].placement);
		return long(jointCount) * segments * segments;
	}

	/// From now on.
	void compute(const brick::LawTerms& wanted) { terms = wanted; }

	/// What `update` does for the faces alone, whatever the number of segments.
	void moveFaces()
	{
		for (int i = 0; i < jointCount; ++i)
			jointMotion(joins[i].joint, cubes[i].placement, cubes[i + 1].placement, joins[i].motion), benchmark::ClobberMemory();
	}

	/// Every joint has one segment left, and the others slide at Coulomb's limit.
	bool cracked()
	{
		const double failed = segments * segments - 1;
		update();
		for (const auto& join : joins)
			if (join.failed != failed || join.sum.shearForce.norm() < .99 * tanFriction * join.sum.normalForce.norm() * failed / (failed + 1))
				return false;
		return true;
	}

private:
	static constexpr double edge = .2, thickness = 5e-3, young = 9.8e6, tanFriction = .625, pressedBy = 1e-6;
	static constexpr int    above = 5, below = 4; // faces

	struct Cube {
		brick::Placement placement;
		brick::Nodes     displacement, rate;

		void placeAt(double height)
		{
			displacement.fill(brick::Vector3r::Zero()), rate.fill(brick::Vector3r::Zero());
			placement.position         = { 0, 0, height };
			placement.displacement     = displacement.data();
			placement.displacementRate = rate.data();
		}
		/// Ten times as far as friction sticks.
		void slide(bool forth)
		{
			placement.position[0] = forth ? 8e-6 : -8e-6;
			placement.velocity[0] = forth ? .1 : -.1;
		}
	};

	/// A joint and what a step makes of it.
	struct Join {
		brick::Joint       joint;
		brick::JointMotion motion;
		brick::JointLoads  loads;
		brick::PairSummary sum;
		int                failed = 0;
	};

	void loadsOf(Join& join, const brick::Placement& lower, const brick::Placement& upper) const
	{
		jointMotion(join.joint, lower, upper, join.motion);
		const brick::JointPlacements moving { lower, upper };
		join.sum        = brick::PairSummary();
		join.failed += jointLoads(join.joint, join.motion, &moving, tanFriction, join.loads, join.sum, nullptr, terms).total();
	}

	/// The joint above a cube, cracked by turning the upper cube about a diagonal: the segment in one corner stays pressed, by one and a half times what the joint
	/// opens from one segment to the next; its neighbours open at their edges. The mortar resists nothing but shear and compression.
	Join join(int lower) const
	{
		const auto side = [&](int i) { return brick::Side { &solid, &contactLength, segments, false, cubes[i].placement }; };
		Join       made { *brick::joinFaces(side(lower), above, side(lower + 1), below, 1e-9), {}, {}, {} };
		made.joint.setMortar(springs.at(thickness, thickness), { 1e-3, 1e12, tanFriction, 1e12, 9 });

		constexpr double slope = 1e-4;
		const double     size = edge / segments, opening = slope * size, middle = slope * (edge - size) - 1.5 * opening;
		brick::Placement tilted = cubes[lower + 1].placement;
		tilted.rotation         = Eigen::AngleAxisd(std::sqrt(2) * slope, brick::Vector3r(1, -1, 0).normalized());
		tilted.position += brick::Vector3r(0, 0, middle - edge / 2) + tilted.rotation * brick::Vector3r(0, 0, edge / 2);
		for (int pass = 0; pass < 2 * segments; ++pass)
			loadsOf(made, cubes[lower].placement, tilted);
		return made;
	}

	int                        segments;
	brick::LawTerms            terms;
	bool                       forth = false;
	brick::Hexahedron          solid { brick::cuboidCorners(brick::Vector3r::Constant(edge)) };
	std::array<brick::Real, 6> contactLength;
	brick::PairSprings         springs;
	std::vector<Cube>          cubes;
	std::vector<Join>          joins;
};

benchmark::Counter perJoint() { return { 1e-9 * CrackedJoints::jointCount, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert }; }

void segmentUpdates(benchmark::State& state)
{
	CrackedJoints joints(int(state.range(0)));
	if (!joints.cracked()) return state.SkipWithError("joints are not cracked as they should be");
	long updated = 0;
	for (auto _ : state)
		updated += joints.update();
	state.SetItemsProcessed(updated);
	state.counters["nanosecondsPerJoint"] = perJoint();
	state.counters["flopsPerSegment"]     = flopsPerSegment;
	state.counters["leanFlopsPerSegment"] = leanFlopsPerSegment;
}
BENCHMARK(segmentUpdates)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);

/// The same joints without their segments: subtracted from segmentUpdates, it leaves the segments alone.
void facesOfTheSameJoints(benchmark::State& state)
{
	CrackedJoints joints(4);
	for (auto _ : state)
		joints.moveFaces();
	state.counters["nanosecondsPerJoint"] = perJoint();
}
BENCHMARK(facesOfTheSameJoints)->Unit(benchmark::kMicrosecond);

// What the law leaves out

constexpr brick::LawTerms everything, noFailure { false, true, true }, noFriction { true, false, true }, noDashpots { true, true, false },
        nothing { false, false, false };

void jointsWith(benchmark::State& state, const brick::LawTerms& terms)
{
	CrackedJoints joints(4);
	if (!joints.cracked()) return state.SkipWithError("joints are not cracked as they should be");
	joints.compute(terms);
	long updated = 0;
	for (auto _ : state)
		updated += joints.update();
	state.SetItemsProcessed(updated);
	state.counters["nanosecondsPerJoint"] = perJoint();
}
BENCHMARK_CAPTURE(jointsWith, everything, everything)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(jointsWith, noFailure, noFailure)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(jointsWith, noFriction, noFriction)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(jointsWith, noDashpots, noDashpots)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(jointsWith, nothing, nothing)->Unit(benchmark::kMicrosecond);

/// A cube on a cube, pressed and sliding: the loads of spots that have been found.
void contactWith(benchmark::State& state, const brick::LawTerms& terms)
{
	constexpr double           edge = .2, pressed = 1e-6, dt = 1e-5;
	const brick::Hexahedron    solid(brick::cuboidCorners(brick::Vector3r::Constant(edge)));
	std::array<brick::Real, 6> contactLength;
	contactLength.fill(5e-3);
	brick::PairSprings springs;
	springs.normalCompliance = { 1e-7, 1e-7 }, springs.shearCompliance = { 2.5e-7, 2.5e-7 }, springs.density = { 1800, 1800 };
	springs.normalDamping = springs.shearDamping = .1, springs.tanFriction = .625;
	const brick::Nodes still = [] {
		brick::Nodes n;
		n.fill(brick::Vector3r::Zero());
		return n;
	}();
	brick::Placement places[2];
	for (auto& place : places)
		place.displacement = place.displacementRate = still.data();
	places[1].position = { 0, 0, edge - pressed }, places[1].velocity = { .1, 0, 0 };
	const int         segments = int(state.range(0));
	const brick::Side lower { &solid, &contactLength, segments, false, places[0] }, upper { &solid, &contactLength, segments, false, places[1] };
	std::vector<brick::ContactSpot> spots;
	brick::findContact(lower, upper, spots);
	brick::ContactMemory        memory, scratch;
	std::array<brick::Loads, 2> loads;
	for (auto _ : state) {
		brick::PairSummary sum;
		brick::contactLoads(lower, upper, spots, springs, dt, memory, scratch, loads, sum, terms);
		benchmark::DoNotOptimize(sum);
	}
	state.SetItemsProcessed(long(spots.size()) * state.iterations());
}
BENCHMARK_CAPTURE(contactWith, everything, everything)->Arg(4)->Arg(10);
BENCHMARK_CAPTURE(contactWith, noFriction, noFriction)->Arg(4)->Arg(10);
BENCHMARK_CAPTURE(contactWith, noDashpots, noDashpots)->Arg(4)->Arg(10);
BENCHMARK_CAPTURE(contactWith, nothing, nothing)->Arg(4)->Arg(10);

// Peak: independent chains of multiply-adds, more than the latency of one needs

constexpr int chains = 12, links = 1000;

__attribute__((target("avx2,fma"))) void multiplyAdd256(double* values)
{
	const __m256d factor = _mm256_set1_pd(1 - 1e-9), term = _mm256_set1_pd(1e-9);
	__m256d       r[chains];
#pragma GCC unroll 12
	for (int c = 0; c < chains; ++c)
		r[c] = _mm256_loadu_pd(values + 4 * c);
	for (int link = 0; link < links; ++link)
#pragma GCC unroll 12
		for (int c = 0; c < chains; ++c)
			r[c] = _mm256_fmadd_pd(r[c], factor, term);
#pragma GCC unroll 12
	for (int c = 0; c < chains; ++c)
		_mm256_storeu_pd(values + 4 * c, r[c]);
}

__attribute__((target("avx512f"))) void multiplyAdd512(double* values)
{
	const __m512d factor = _mm512_set1_pd(1 - 1e-9), term = _mm512_set1_pd(1e-9);
	__m512d       r[chains];
#pragma GCC unroll 12
	for (int c = 0; c < chains; ++c)
		r[c] = _mm512_loadu_pd(values + 8 * c);
	for (int link = 0; link < links; ++link)
#pragma GCC unroll 12
		for (int c = 0; c < chains; ++c)
			r[c] = _mm512_fmadd_pd(r[c], factor, term);
#pragma GCC unroll 12
	for (int c = 0; c < chains; ++c)
		_mm512_storeu_pd(values + 8 * c, r[c]);
}

void peak(benchmark::State& state, void (*multiplyAdd)(double*), int width, bool supported)
{
	if (!supported) return state.SkipWithError("not on this machine");
	std::vector<double> values(chains * width, 1.);
	for (auto _ : state) {
		multiplyAdd(values.data());
		benchmark::DoNotOptimize(values.data());
		benchmark::ClobberMemory();
	}
	state.SetItemsProcessed(2l * width * chains * links * state.iterations()); // flops
}
BENCHMARK_CAPTURE(peak, avx2, multiplyAdd256, 4, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
BENCHMARK_CAPTURE(peak, avx512, multiplyAdd512, 8, __builtin_cpu_supports("avx512f"));

} // namespace

BENCHMARK_MAIN();
