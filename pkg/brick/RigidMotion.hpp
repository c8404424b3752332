// SPDX-License-Identifier: GPL-2.0-or-later
// A body as NewtonIntegrator moves it.
#pragma once

#include <core/Body.hpp>
#include <core/State.hpp>

namespace yade {

/// Whether forces move a body.
inline bool movesFreely(const Body& b) { return b.isDynamic() && b.state->mass > 0; }

/// Kinetic energy of the rigid motion with the present velocities, those of half a step before [J].
inline Real rigidKineticEnergy(const State& s)
{
	const Vector3r w = s.ori.conjugate() * s.angVel;
	return (s.mass * s.vel.squaredNorm() + w.dot(s.inertia.cwiseProduct(w))) / 2;
}

} // namespace yade
