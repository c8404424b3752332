// SPDX-License-Identifier: GPL-2.0-or-later
// What joints and contacts do to a body in a step, as BrickDynamics sums it up.
#pragma once

#include <core/State.hpp>

namespace yade {

struct BodyStep {
	Vector3r force { Vector3r::Zero() }, torque { Vector3r::Zero() };
	bool     any        = false; // some joint or contact acts on the body
	bool     released   = false; // a brick that its joints hold apart from others no more
	bool     changing   = false; // a brick whose level of deformation changes

	// While the guard is on or energy is tracked
	Real power     = 0; // of force and torque with the present velocities, those of half a step before [W]
	Real lastPower = 0; // of those of the step before with the present velocities [W]

	// While the guard is on
	Real work   = 0; // what the present velocities came from: of the step before, on the deformation of this one [J]
	Real gained = 0; // work since the guard's window has begun [J]

	Real powerWith(const State& s) const { return force.dot(s.vel) + torque.dot(s.angVel); }
};

} // namespace yade
