// SPDX-License-Identifier: GPL-2.0-or-later
#include "JointSegments.hpp"

#include <algorithm>
#include <limits>

namespace brick {

namespace {

	/// Sums of a sweep over every eighth segment each: the same for vectors of any width.
	struct EightSums {
		Real force[3][4][JointSegments::lanes]; ///< normal and tangential components: moments with 1, p, q, pq
		Real deepest[JointSegments::lanes];
		bool changed = false;
	};

	Real sumOf(const Real (&x)[JointSegments::lanes]) { return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7])); }

} // namespace

} // namespace brick

#define BRICK_LANES_FILE "JointSegmentsLanes.hpp"
#include "ForEachInstructionSet.hpp"

namespace brick {

SegmentSums sweepSegments(JointSegments& segments, const SegmentSweep& input)
{
	EightSums eight;
	BRICK_BEST_INSTRUCTION_SET(sweep)(segments, input, eight);
	SegmentSums out;
	out.anyFailed   = eight.changed;
	out.penetration = *std::max_element(eight.deepest, eight.deepest + JointSegments::lanes);
	Real* const force[3] { out.force.normal, out.force.tangent1, out.force.tangent2 };
	for (int c = 0; c < 3; ++c)
		for (int m = 0; m < 4; ++m)
			force[c][m] = sumOf(eight.force[c][m]);
	return out;
}

} // namespace brick
