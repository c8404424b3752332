// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a scene of bricks, from what is joined and touches at present: kernel/StableStep.
#pragma once

#include "BrickContact.hpp"

#include "kernel/StableStep.hpp"

#include <map>
#include <optional>
#include <vector>

namespace yade {

class StepLimit {
public:
	Real seconds = std::numeric_limits<Real>::infinity(); // never grows: see BrickTimeStepper
	int  brickId = -1;                                    // that sets it
	int  face    = -1;                                    // of that brick, whose springs store most of the motion that sets it

	/// Takes in what has changed. Costs little for bricks that nothing was changed at.
	void update(Scene&);

	/// Of one brick, as it is joined and touched at present [s]. Infinite for a body that is no brick or does not move freely.
	Real ofBrick(const Body&, Scene&);

private:
	/// The stiffest springs and dashpots that one face of a brick has, by area; twice those to bodies that can move (kernel/StableStep).
	struct FacePartners {
		brick::SpotSprings most;
		Real               coverage = 0; // how often it is covered at present: 0 where bare, otherwise 1, or more where partners overlap
		void               add(const brick::SpotSprings&, bool held);
		bool               operator==(const FacePartners& o) const { return most == o.most && coverage == o.coverage; }
	};
	using Partners = std::array<FacePartners, brick::faceCount>;
	/// What a brick was counted with.
	struct Known {
		Real     young = 0, poisson = 0, mass = 0;
		Partners partners {};
		bool     isOf(const BrickMat& m, const State& s) const { return young == m.young && poisson == m.poisson && mass == s.mass; }
	};
	std::vector<Known>                              known;  // by id
	std::map<std::vector<Real>, brick::LargestStep> shared; // of bricks alike

	std::optional<bool> dashpots; // see lawHasDashpots; found once in an update, if it is asked for

	bool               lawHasDashpots(const Scene&);
	Partners           likesOf(const Brick&, const BrickMat&, bool damped) const;
	Partners           partnersOf(const Body&, const Brick&, const BrickMat&, Scene*);
	brick::LargestStep stepOf(const Body&, Brick&, const BrickMat&, const Partners&);
	void               count(const Body&, Brick&, const BrickMat&, Scene*);
};

} // namespace yade
