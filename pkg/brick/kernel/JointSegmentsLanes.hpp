// SPDX-License-Identifier: GPL-2.0-or-later
// The sweep over a joint's segments, some at a time: included by JointSegments.cpp once for each instruction set (InstructionSets.hpp).

constexpr int lanes = BRICK_WIDTH;

#include "LaneVectors.hpp"

/// A field at the places of a group of segments.
BRICK_INLINE Lanes at(const Real (&c)[4], const Lanes& p, const Lanes& q, const Lanes& pq) { return c[0] + p * c[1] + (q * c[2] + pq * c[3]); }

/// Sums of a sweep, lane by lane.
struct LaneSums {
	Lanes force[3][4]; ///< normal and tangential components: moments with 1, p, q, pq
	Lanes deepest;
	Mask  changed;
};

BRICK_INLINE void addMoments(Lanes (&sums)[4], const Lanes& f, const Lanes& p, const Lanes& q, const Lanes& pq)
{
	sums[0] += f;
	sums[1] += p * f;
	sums[2] += q * f;
	sums[3] += pq * f;
}

/// Number of the mode in which each segment has failed: as it was, or eqs. (6)-(8) in this order, then the hinge rule.
BRICK_INLINE Lanes modeOf(const SegmentSweep& s, const Lanes& was, const Lanes& sigma, const Lanes& shear)
{
	const Lanes magnitude = sigma < 0 ? -sigma : sigma;
	Lanes       mode      = s.hingeTension + s.hingeShare * magnitude - s.hingeSign * sigma < s.bending ? allLanes(Real(1)) : allLanes(Real(0));
	mode = (sigma < 0) & (sigma * sigma + s.strength.capShape * shear * shear > s.strength.compression * s.strength.compression) ? allLanes(Real(3)) : mode;
	mode = shear + sigma * s.strength.tanFriction > s.strength.cohesion ? allLanes(Real(2)) : mode;
	mode = sigma > s.strength.tension ? allLanes(Real(1)) : mode;
	return was != 0 ? was : mode;
}

/// A group of segments, what their springs would carry, and what contact and friction make of it in those that have failed.
struct Group {
	Lanes p, q, pq, un, u1, u2;
	Lanes sigma, v1, v2, shear; ///< of the springs, elastic from the slip on; |tau|
	Lanes pressure;
	Lanes slip1, slip2, t1, t2; ///< of the failed: slip and shear traction
};

template <bool friction> BRICK_INLINE void setSprings(const JointSegments& segments, int first, const SegmentSweep& s, Group& g)
{
	using S = JointSegments;
	g.p = loadLanes(segments.row(S::P) + first), g.q = loadLanes(segments.row(S::Q) + first), g.pq = g.p * g.q;
	g.un = at(s.opening.normal, g.p, g.q, g.pq), g.u1 = at(s.opening.tangent1, g.p, g.q, g.pq), g.u2 = at(s.opening.tangent2, g.p, g.q, g.pq);
	g.sigma = s.springs.normal * g.un;
	if constexpr (friction) {
		g.v1 = s.springs.shear * (g.u1 - loadLanes(segments.row(S::Slip1) + first));
		g.v2 = s.springs.shear * (g.u2 - loadLanes(segments.row(S::Slip2) + first));
	} else
		g.v1 = s.springs.shear * g.u1, g.v2 = s.springs.shear * g.u2; // of those that hold, which have no slip
	g.shear = root(g.v1 * g.v1 + g.v2 * g.v2);
}

/// Contact of the failed; of those that fail in this step the rate does not count.
template <bool friction, bool dashpots> BRICK_INLINE void setContact(const Lanes& was, const SegmentSweep& s, Group& g)
{
	const Lanes moving  = was != 0 ? allLanes(Real(1)) : allLanes(Real(0));
	Lanes       pushing = -g.sigma;
	if constexpr (dashpots) pushing = -(g.sigma + s.springs.normalDashpot * (moving * at(s.rate.normal, g.p, g.q, g.pq)));
	g.pressure = (g.un < 0) & (pushing > 0) ? pushing : allLanes(Real(0));
	g.slip1 = g.u1, g.slip2 = g.u2, g.t1 = g.t2 = allLanes(Real(0));
	if constexpr (!friction) return;
	const Lanes limit = g.pressure * s.tanFriction, held = shortening(g.shear, limit);
	const Lanes e1 = g.v1 * held, e2 = g.v2 * held;
	Lanes       w1 = e1, w2 = e2;
	if constexpr (dashpots) {
		w1 += s.springs.shearDashpot * (moving * at(s.rate.tangent1, g.p, g.q, g.pq));
		w2 += s.springs.shearDashpot * (moving * at(s.rate.tangent2, g.p, g.q, g.pq));
	}
	const Lanes kept        = shortening(root(w1 * w1 + w2 * w2), limit); // without dashpots all but 1; as with dashpots of zero, to the last bit
	const Real  flexibility = 1 / s.springs.shear;
	g.slip1 -= e1 * flexibility, g.slip2 -= e2 * flexibility;
	g.t1 = w1 * kept, g.t2 = w2 * kept;
}

/// Where a variant leaves out what is zero, signs of zeros are all that may differ from the one that computes it; sums that begin with +0 do not feel them.
template <bool failure, bool friction, bool dashpots> BRICK_INLINE void sweepGroup(JointSegments& segments, int first, const SegmentSweep& s, LaneSums& sums)
{
	using S = JointSegments;
	Group g;
	setSprings<friction>(segments, first, s, g);
	const Lanes area = loadLanes(segments.row(S::Area) + first), was = loadLanes(segments.row(S::State) + first);
	Lanes       mode = was;
	if constexpr (failure) {
		mode = area > 0 ? modeOf(s, was, g.sigma, g.shear) : was;
		sums.changed |= mode != was;
		storeLanes(segments.row(S::State) + first, mode);
	}
	const Mask failed = mode != 0;
	setContact<friction, dashpots>(was, s, g);
	storeLanes(segments.row(S::Slip1) + first, failed ? g.slip1 : allLanes(Real(0)));
	storeLanes(segments.row(S::Slip2) + first, failed ? g.slip2 : allLanes(Real(0)));

	addMoments(sums.force[0], area * (failed ? -g.pressure : g.sigma), g.p, g.q, g.pq);
	addMoments(sums.force[1], area * (failed ? g.t1 : g.v1), g.p, g.q, g.pq);
	addMoments(sums.force[2], area * (failed ? g.t2 : g.v2), g.p, g.q, g.pq);
	sums.deepest = (area > 0) & (-g.un > sums.deepest) ? -g.un : sums.deepest;
}

template <bool failure, bool friction, bool dashpots> void sweepAll(JointSegments& segments, const SegmentSweep& input, EightSums& out)
{
	constexpr int parts = JointSegments::lanes / lanes;
	LaneSums      sums[parts];
	__builtin_memset(sums, 0, sizeof sums);
	for (LaneSums& s : sums)
		s.deepest = allLanes(-std::numeric_limits<Real>::infinity());
	for (int first = 0; first < segments.padded(); first += JointSegments::lanes)
		for (int part = 0; part < parts; ++part)
			sweepGroup<failure, friction, dashpots>(segments, first + part * lanes, input, sums[part]);
	for (int part = 0; part < parts; ++part)
		for (int i = 0; i < lanes; ++i) {
			const int lane = part * lanes + i;
			for (int c = 0; c < 3; ++c)
				for (int m = 0; m < 4; ++m)
					out.force[c][m][lane] = sums[part].force[c][m][i];
			out.deepest[lane] = sums[part].deepest[i];
			out.changed |= sums[part].changed[i] != 0;
		}
}

inline void sweep(JointSegments& segments, const SegmentSweep& input, EightSums& out)
{
	static constexpr decltype(&sweep) variants[2][2][2] {
		{ { sweepAll<false, false, false>, sweepAll<false, false, true> }, { sweepAll<false, true, false>, sweepAll<false, true, true> } },
		{ { sweepAll<true, false, false>, sweepAll<true, false, true> }, { sweepAll<true, true, false>, sweepAll<true, true, true> } },
	};
	variants[input.terms.failure][input.terms.friction][input.terms.dashpots](segments, input, out);
}
