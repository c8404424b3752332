// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable time step of a scene of bricks, from what is joined and touches at present: kernel/StableStep.
#pragma once

#include "BrickContact.hpp"

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

private:
	/// Stiffest partners that one brick has joints or contact with: compliance per area beyond the brick's own [m/Pa], of bodies that move and of bodies that are held.
	struct Partners {
		std::array<Real, 2>                normal, shear; // moving, held
		Real                               dashpotTime;
		std::array<Real, brick::faceCount> coverage; // how often each face is covered at present: 0 where bare, otherwise 1, or more where partners overlap
		bool                               operator==(const Partners& o) const
		{
			return normal == o.normal && shear == o.shear && dashpotTime == o.dashpotTime && coverage == o.coverage;
		}
	};
	struct Step {
		Real seconds = std::numeric_limits<Real>::infinity();
		int  face    = -1;
	};
	/// What a brick was counted with.
	struct Known {
		Real     young = 0, poisson = 0, mass = 0;
		Partners partners {};
		bool     isOf(const BrickMat& m, const State& s) const { return young == m.young && poisson == m.poisson && mass == s.mass; }
	};
	std::vector<Known>                known;  // by id
	std::map<std::vector<Real>, Step> shared; // steps of bricks alike

	std::optional<bool> dashpots; // see lawHasDashpots; found once in an update, if it is asked for

	bool     lawHasDashpots(const Scene&);
	Partners partnersOf(const Body&, const Brick&, const BrickMat&, Scene*);
	Step     stepOf(const Body&, Brick&, const BrickMat&, const Partners&);
	void     count(const Body&, Brick&, const BrickMat&, Scene*);
};

} // namespace yade
