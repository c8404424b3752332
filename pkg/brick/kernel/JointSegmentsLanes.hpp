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

BRICK_INLINE void sweepGroup(JointSegments& segments, int first, const SegmentSweep& s, LaneSums& sums)
{
	using S         = JointSegments;
	const Lanes p = loadLanes(segments.row(S::P) + first), q = loadLanes(segments.row(S::Q) + first), area = loadLanes(segments.row(S::Area) + first), pq = p * q;
	const Lanes un = at(s.opening.normal, p, q, pq), u1 = at(s.opening.tangent1, p, q, pq), u2 = at(s.opening.tangent2, p, q, pq);

	// springs, elastic from the slip on
	const Lanes sigma = s.springs.normal * un;
	const Lanes v1 = s.springs.shear * (u1 - loadLanes(segments.row(S::Slip1) + first)), v2 = s.springs.shear * (u2 - loadLanes(segments.row(S::Slip2) + first));
	const Lanes shear = root(v1 * v1 + v2 * v2);

	const Lanes was = loadLanes(segments.row(S::State) + first), mode = area > 0 ? modeOf(s, was, sigma, shear) : was;
	const Mask  failed = mode != 0;
	sums.changed |= mode != was;
	storeLanes(segments.row(S::State) + first, mode);

	// contact of the failed; of those that fail in this step the rate does not count
	const Lanes moving   = was != 0 ? allLanes(Real(1)) : allLanes(Real(0));
	const Lanes rn       = moving * at(s.rate.normal, p, q, pq);
	const Lanes r1       = moving * at(s.rate.tangent1, p, q, pq), r2 = moving * at(s.rate.tangent2, p, q, pq);
	const Lanes pushing  = -(sigma + s.springs.normalDashpot * rn);
	const Lanes pressure = (un < 0) & (pushing > 0) ? pushing : allLanes(Real(0));
	const Lanes limit    = pressure * s.tanFriction;
	const Lanes held     = shortening(shear, limit);
	const Lanes e1 = v1 * held, e2 = v2 * held;
	const Lanes w1 = e1 + s.springs.shearDashpot * r1, w2 = e2 + s.springs.shearDashpot * r2;
	const Lanes kept = shortening(root(w1 * w1 + w2 * w2), limit);
	const Real  flexibility = 1 / s.springs.shear;
	storeLanes(segments.row(S::Slip1) + first, failed ? u1 - e1 * flexibility : allLanes(Real(0)));
	storeLanes(segments.row(S::Slip2) + first, failed ? u2 - e2 * flexibility : allLanes(Real(0)));

	addMoments(sums.force[0], area * (failed ? -pressure : sigma), p, q, pq);
	addMoments(sums.force[1], area * (failed ? w1 * kept : v1), p, q, pq);
	addMoments(sums.force[2], area * (failed ? w2 * kept : v2), p, q, pq);
	sums.deepest = (area > 0) & (-un > sums.deepest) ? -un : sums.deepest;
}

inline void sweep(JointSegments& segments, const SegmentSweep& input, EightSums& out)
{
	constexpr int parts = JointSegments::lanes / lanes;
	LaneSums      sums[parts];
	__builtin_memset(sums, 0, sizeof sums);
	for (LaneSums& s : sums)
		s.deepest = allLanes(-std::numeric_limits<Real>::infinity());
	for (int first = 0; first < segments.padded(); first += JointSegments::lanes)
		for (int part = 0; part < parts; ++part)
			sweepGroup(segments, first + part * lanes, input, sums[part]);
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
