// SPDX-License-Identifier: GPL-2.0-or-later
// The segments of a joint as plain arrays, and the sweep over them: springs, failure, friction, dashpots.    [Furukawa2014, eqs. (5)-(9)]
//
// A segment lies at (p, q) in the unit square over the joint's overlap, where relative displacement and its rate are bilinear: a field is given by its four
// coefficients of 1, p, q, pq, and the forces go out as their moments with the same four. With un the normal and ut the tangential part (two components along the
// joint's own axes):
//     intact   sigma = kn un,  tau = ks ut
//     failed   sigma = min(0, kn un + cn un') where un < 0,  tau = ks (ut - slip) + cs ut',  |tau| <= |sigma| tan(phi)
// slip is the plastic part of ut: it follows ut while the segment is open or slides.
//
// Without friction tau = 0 and slip = ut in a failed segment; without dashpots cn = cs = 0; without failure a segment stays as it is. (LawTerms.hpp)
//
// The sweep takes `lanes` segments at a time and sums each lane on its own, so the compiler may use any vector instructions and the result is bitwise the same
// with all of them.
#pragma once

#include "LawTerms.hpp"
#include "MortarLaw.hpp"

#include <vector>

namespace brick {

class JointSegments {
public:
	static constexpr int lanes = 8;
	enum Row { P, Q, Area, State, Slip1, Slip2, rowCount }; ///< State holds numbers of SegmentState, intact and without slip at first

	JointSegments() = default;
	explicit JointSegments(int count)
	        : used(count)
	        , values(std::size_t(rowCount) * padded(), 0)
	{
	}
	int         count() const { return used; }
	int         padded() const { return (used + lanes - 1) / lanes * lanes; } ///< entries beyond count() have no area
	Real*       row(Row r) { return values.data() + std::size_t(r) * padded(); }
	const Real* row(Row r) const { return values.data() + std::size_t(r) * padded(); }

	template <class Archive> void archive(Archive&& with) { with(used), with(values); }

private:
	int               used = 0;
	std::vector<Real> values;
};

/// Coefficients of 1, p, q, pq of a vector field over the overlap: its normal and its two tangential components.
struct SegmentField {
	Real normal[4], tangent1[4], tangent2[4];
};

/// A component of a field at a place.
inline Real at(const Real (&c)[4], Real p, Real q) { return c[0] + p * c[1] + (q * c[2] + p * q * c[3]); }

/// What a sweep needs to know besides the segments.
struct SegmentSweep {
	SegmentField   opening; ///< relative displacement of side 1, the rest gap taken off [m]
	SegmentField   rate;    ///< its rate [m/s]; for dashpots only
	SpotSprings    springs;
	MortarStrength strength;
	Real           tanFriction = 0; ///< of failed segments
	LawTerms       terms;
	/// An intact segment also fails in tension when  bending > hingeTension + hingeShare |sigma| - hingeSign sigma  (see Joint.hpp) [Pa]
	Real bending = 0, hingeTension = 0, hingeShare = 0, hingeSign = 0;
};

struct SegmentSums {
	SegmentField force;           ///< on side 0: moments with 1, p, q, pq [N]
	Real         penetration = 0; ///< largest -un [m]; of a joint that is open everywhere, negative
	bool         anyFailed   = false; ///< a segment failed in this sweep
};

/// One step of all segments: forces, failure, slip, as far as `terms` asks for them.
SegmentSums sweepSegments(JointSegments&, const SegmentSweep&);

} // namespace brick
