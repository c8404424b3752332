// SPDX-License-Identifier: GPL-2.0-or-later
// An upper bound on the frequencies of an assembly, brick by brick, and the time step that follows.       [compare Furukawa2014, eqs. (14)-(15)]
//
// A spring between bodies A and B stores  k |uA - uB|^2 / 2 <= k |uA|^2 + k |uB|^2 : no more than springs of twice the stiffness from each body to the ground
// (once the stiffness, if the other body is held). So the largest omega^2 of the assembly is at most the largest among single bricks on such springs. A brick's
// springs are bounded by covering each of its faces once (more often where its partners overlap each other) with the stiffest springs that its partners give:
// a segment rule never stores more than the integral over its face does. The brick moves by its rigid motion (exact mass and inertia) and its modes; see
// InnerMotion.hpp for why their own stiffness does not count.
// The paper's eq. (15) is unsafe by up to 1.32 for rigid walls, and far off for the deformable model.
//
// A refined brick of n cells along an edge has 3 S = 18 n^2 + 6 degrees of freedom, which move its surface nodes by Y = (R J^-1/2, phi): R rigid motions of the
// brick's outer surface, J its mass and inertia, phi the modes. omega^2 = lambda(Y^T K Y), the largest eigenvalue, with K the springs on the nodes:
//     sum over faces and cells of  D A ,   D = ks 1 + (kn - ks) n n^T ,   A = integral of N N^T dA .
// Up to n = 4 it is solved for as it stands (in 0.4, 2 and 20 ms with n = 2, 3, 4); n = 8 would take a second or more. Beyond, it is bounded, in 1 to 3 ms:
//   - Y Y^T = M_c^-1 + E,  E = R J^-1 R^T - R_i J_i^-1 R_i^T : the brick's own inertia in place of J_i, which the condensed part has, R_i rigid motions of its
//     nodes; and M_c^-1 <= M_s^-1 (CondensedPart.hpp). So  omega^2 <= lambda(M_s^-1 K) + lambda(E K) . The latter, of rank 12, is solved for.
//   - lambda(M_s^-1 K): D stores no more than the diagonal matrix of its rows' sums of magnitudes, and the same if the faces are along the axes. That takes K
//     apart into a nonnegative matrix for each axis, and for any positive x  lambda <= max (K x)_a / (m_a x_a) .                     [Collatz, Wielandt]
//   - Or D as it is: since  2 u.D v <= t u.D u + v.D v / t ,  lambda <= max over the nodes of  lambda(sum over faces of D (A x)_a) / (m_a x_a) .
//     The smaller one is taken. Iterating, as for an eigenvector, brings x close to the best.
// Bound over truth for n = 5, 6, 8, all faces on equal springs, kn/ks = 8/3 (the step is too short by its root):
//     cube 1.10, 1.09, 1.07      brick 0.25 x 0.12 x 0.06 m 1.38, 1.41, 1.43      voussoir 1.22, 1.21, 1.20
// springs on one face or two opposite ones: up to 1.42, 1.78, 1.51. What is lost is the mass of the inside that follows the surface, M_c - M_s.
#pragma once

#include "Hexahedron.hpp"
#include "InnerPart.hpp"

#include <limits>

namespace brick {

/// Springs on one face of a brick [Pa/m].
struct FaceSprings {
	Real normal = 0, shear = 0;
	Real dashpotTime = 0; ///< largest c/k of the dashpots beside them [s]
};

/// The motion of a brick that limits the step.
struct FastestMotion {
	Real omegaSquared = 0; ///< [1/s2]
	int  face         = 0; ///< whose springs store the largest share of its energy
};

/// The motion of largest omega^2 of a brick whose faces stand on these springs all over; with more than four cells, an upper bound of omega^2. The face of a
/// refined brick is that of the bound. Bitwise the same for the same input, with any number of threads. Allocates nothing unless refined.
/// @param inertia principal moments [kg m2]   @param inner null for a rigid brick
FastestMotion fastestMotion(const Hexahedron&, const std::array<FaceSprings, faceCount>&, Real mass, const Vector3r& inertia, const InnerPart* inner);

/// Largest stable step of leap-frog with springs of frequency omega and dashpots that lag by half a step:
///     dt = 2/omega (sqrt(1 + xi^2) - xi),   xi = omega c / (2 k)
/// @param dashpotTime largest c/k of dashpot and spring [s]
Real stableStep(Real omegaSquared, Real dashpotTime);

struct LargestStep {
	Real seconds = std::numeric_limits<Real>::infinity();
	int  face    = -1; ///< whose springs store most of the motion that limits it
};

/// The same for a brick: the step at which  lambda(M^-1 (dt^2/4 K + dt/2 C)) = 1, C the dashpots, from below, to a thousandth. With one ratio of dashpots to
/// springs on all faces this is stableStep of its fastest motion; also where a refined brick has several, when the largest is taken.
LargestStep largestStep(const Hexahedron&, const std::array<FaceSprings, faceCount>&, Real mass, const Vector3r& inertia, const InnerPart* inner);

} // namespace brick
