// SPDX-License-Identifier: GPL-2.0-or-later
// An upper bound on the frequencies of an assembly, brick by brick, and the time step that follows.       [compare Furukawa2014, eqs. (14)-(15)]
//
// A spring between bodies A and B stores  k |uA - uB|^2 / 2 <= k |uA|^2 + k |uB|^2 : no more than springs of twice the stiffness from each body to the ground
// (once the stiffness, if the other body is held). So the largest omega^2 of the assembly is at most the largest among single bricks on such springs. A brick's
// springs are bounded by covering each of its faces once (more often where its partners overlap each other) with the stiffest springs that its partners give:
// a segment rule never stores more than the integral over its face does. The brick moves by its rigid motion (exact mass and inertia) and its modes; see
// InnerMotion.hpp for why their own stiffness does not count.
// The paper's eq. (15) is unsafe by up to 1.32 for rigid walls, and far off for the deformable model.
#pragma once

#include "Hexahedron.hpp"
#include "Modes.hpp"

namespace brick {

/// Springs on one face of a brick [Pa/m].
struct FaceSprings {
	Real normal = 0, shear = 0;
};

/// The motion of a brick that limits the step.
struct FastestMotion {
	Real omegaSquared = 0; ///< [1/s2]
	int  face         = 0; ///< whose springs store the largest share of its energy
};

/// The motion of largest omega^2 of a brick whose faces stand on these springs all over. Allocates nothing.
/// @param inertia principal moments [kg m2]   @param modes null for a rigid brick
FastestMotion fastestMotion(const Hexahedron&, const std::array<FaceSprings, faceCount>&, Real mass, const Vector3r& inertia, const Modes* modes);

/// Largest stable step of leap-frog with springs of frequency omega and dashpots that lag by half a step:
///     dt = 2/omega (sqrt(1 + xi^2) - xi),   xi = omega c / (2 k)
/// @param dashpotTime largest c/k of dashpot and spring [s]
Real stableStep(Real omegaSquared, Real dashpotTime);

} // namespace brick
