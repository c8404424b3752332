// SPDX-License-Identifier: GPL-2.0-or-later
// Looks at a time step that no BrickTimeStepper sets.
#pragma once

#include "StepLimit.hpp"

namespace yade {

class StepWatch {
public:
	/// Warns, once for each O.dt set by hand, when it is above the limit.
	void look(Scene&);
	/// What is wrong with O.dt, with numbers; empty if nothing is.
	string problem(Scene&);

private:
	StepLimit limit;
	Real      seen   = NaN; // O.dt
	long      next   = 0;   // step to look at
	bool      warned = false;
};

} // namespace yade
