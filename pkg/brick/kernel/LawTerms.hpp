// SPDX-License-Identifier: GPL-2.0-or-later
// What the law of joints and contacts computes. Each choice is a variant of the sweeps over segments (JointSegmentsLanes.hpp) and spots (ContactLanes.hpp), made
// by the compiler: what is left out costs nothing, and the variant with everything does not pay for the choice.
#pragma once

#include "Springs.hpp"

namespace brick {

struct LawTerms {
	bool failure  = true; ///< of segments of mortar; without it those that hold do so whatever the load, and those that have failed stay failed
	bool friction = true; ///< in contacts and failed segments; without it they carry no shear, and begin without any when they get it
	bool dashpots = true; ///< in contacts and failed segments

	/// Without what a pair has none of: the same forces, bit for bit, for less. (Shear stresses below 1e-162 Pa, whose squares are zero, count as zero.)
	LawTerms neededBy(const PairSprings& pair) const
	{
		return { failure, friction && pair.tanFriction != 0, dashpots && (pair.normalDamping != 0 || pair.shearDamping != 0) };
	}
};

} // namespace brick
