// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"

#include <gtest/gtest.h>

using namespace brick;

namespace {

using S = JointSegments;

/// One segment's answer, written down as the law is, with branches.
struct Segment {
	Real         p, q, area;
	SegmentState state;
	Vector2r     slip;
	Real         normal;
	Vector2r     tangent;
};

Real length(const Vector2r& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1]); }

SegmentState failure(const SegmentSweep& s, Real sigma, Real shear)
{
	const SegmentState mode = failureMode(s.strength, sigma, shear);
	if (mode != SegmentState::Intact) return mode;
	return s.bending > s.hingeTension + s.hingeShare * std::abs(sigma) - s.hingeSign * sigma ? SegmentState::Tension : SegmentState::Intact;
}

void step(Segment& g, const SegmentSweep& s)
{
	const Real     un = at(s.opening.normal, g.p, g.q), sigma = s.springs.normal * un;
	const Vector2r ut(at(s.opening.tangent1, g.p, g.q), at(s.opening.tangent2, g.p, g.q)), elastic = s.springs.shear * (ut - g.slip);
	const bool     moving = g.state != SegmentState::Intact;
	if (!moving) g.state = failure(s, sigma, length(elastic));
	if (g.state == SegmentState::Intact) {
		g.normal  = sigma;
		g.tangent = elastic;
		return;
	}
	const Real     rn = moving ? at(s.rate.normal, g.p, g.q) : 0;
	const Vector2r rt = moving ? Vector2r(at(s.rate.tangent1, g.p, g.q), at(s.rate.tangent2, g.p, g.q)) : Vector2r(0, 0);
	const Real     pressure = un < 0 ? std::max(0., -(sigma + s.springs.normalDashpot * rn)) : 0, limit = pressure * s.tanFriction;
	const auto     kept = [limit](const Vector2r& t) { return length(t) > limit ? Vector2r(t * (limit / length(t))) : t; };
	const Vector2r held = kept(elastic);
	g.slip              = ut - held * (1 / s.springs.shear);
	g.normal            = -pressure;
	g.tangent           = kept(held + s.springs.shearDashpot * rt);
}

SegmentField randomField(pairs::Random& random, Real size)
{
	SegmentField f;
	for (auto* row : { &f.normal, &f.tangent1, &f.tangent2 })
		for (Real& c : *row)
			c = random.between(-size, size);
	return f;
}

/// A sweep in which about half of the segments that hold fail, and contact opens, sticks and slides.
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

std::vector<Segment> randomSegments(pairs::Random& random, int count)
{
	std::vector<Segment> out;
	for (int i = 0; i < count; ++i) {
		const bool failed = random.between(0, 1) < .5;
		out.push_back({ random.between(0, 1), random.between(0, 1), random.between(.5, 1) * 1e-3, failed ? SegmentState::Shear : SegmentState::Intact,
		                failed ? Vector2r(random.vector(1e-6).head<2>()) : Vector2r(0, 0), 0, { 0, 0 } });
	}
	return out;
}

JointSegments arrays(const std::vector<Segment>& segments)
{
	JointSegments out(int(segments.size()));
	for (int i = 0; i < out.count(); ++i) {
		out.row(S::P)[i] = segments[i].p, out.row(S::Q)[i] = segments[i].q, out.row(S::Area)[i] = segments[i].area;
		out.row(S::State)[i] = int(segments[i].state);
		out.row(S::Slip1)[i] = segments[i].slip[0], out.row(S::Slip2)[i] = segments[i].slip[1];
	}
	return out;
}

} // namespace

TEST(JointSegmentsTest, sweep_is_bitwise_the_law_segment_by_segment_whatever_the_instruction_set)
{
	pairs::Random random(11);
	int           failed = 0, modes[4] {};
	for (int trial = 0; trial < 400; ++trial) {
		const SegmentSweep sweep    = randomSweep(random);
		auto               expected = randomSegments(random, 1 + trial % 37);
		JointSegments      segments = arrays(expected);
		const SegmentSums  sums     = sweepSegments(segments, sweep);
		// sums of the eight lanes, each in the order of segments, then in halves
		Real force[3][4][S::lanes] {}, deepest = -1;
		bool any = false;
		for (int i = 0; i < segments.count(); ++i) {
			Segment&           g   = expected[i];
			const SegmentState was = g.state;
			step(g, sweep);
			any |= g.state != was;
			failed += g.state != was;
			++modes[int(g.state)];
			ASSERT_EQ(segments.row(S::State)[i], int(g.state));
			ASSERT_EQ(segments.row(S::Slip1)[i], g.state == SegmentState::Intact ? 0 : g.slip[0]);
			ASSERT_EQ(segments.row(S::Slip2)[i], g.state == SegmentState::Intact ? 0 : g.slip[1]);
			const Real f[3] = { g.area * g.normal, g.area * g.tangent[0], g.area * g.tangent[1] }, with[4] = { 1, g.p, g.q, g.p * g.q };
			for (int c = 0; c < 3; ++c)
				for (int m = 0; m < 4; ++m)
					force[c][m][i % S::lanes] += with[m] * f[c];
			deepest = std::max(deepest, -at(sweep.opening.normal, g.p, g.q));
		}
		const Real* found[3] = { sums.force.normal, sums.force.tangent1, sums.force.tangent2 };
		for (int c = 0; c < 3; ++c)
			for (int m = 0; m < 4; ++m) {
				const auto& lane = force[c][m];
				ASSERT_EQ(found[c][m], ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7])));
			}
		ASSERT_EQ(sums.penetration, deepest);
		ASSERT_EQ(sums.anyFailed, any);
	}
	EXPECT_GT(failed, 500); // the trials reach every branch
	for (int mode : modes)
		EXPECT_GT(mode, 100);
}

TEST(JointSegmentsTest, padding_does_nothing)
{
	for (int count : { 1, 7, 8, 9, 16 }) {
		JointSegments segments(count);
		EXPECT_EQ(segments.padded() % S::lanes, 0);
		SegmentSweep sweep {};
		sweep.opening.normal[0] = 1, sweep.springs = { 1, 1, 0, 0 };
		const SegmentSums sums = sweepSegments(segments, sweep); // no segment has an area, and all strengths are zero
		EXPECT_EQ(sums.force.normal[0], 0);
		EXPECT_FALSE(sums.anyFailed);
		EXPECT_EQ(segments.row(S::State)[segments.padded() - 1], 0);
	}
}
