// SPDX-License-Identifier: GPL-2.0-or-later
// How near a joint is to failure, and how much a brick is stressed: what tells whether its deformation matters.
#pragma once

#include "Joint.hpp"

namespace brick {

/// Stress of a segment as a share of the mortar's strength, in the mode that is nearest to failure: above 1 exactly when the segment fails [-]. Infinite where
/// there is no strength at all.
Real utilisation(const MortarStrength&, Real sigma, Real tau);

/// The same of a segment of a joint; zero when it has failed.
Real segmentUtilisation(const Joint&, const JointMotion&, int segment);

/// The same, the largest of all segments of a joint that hold.
Real utilisation(const Joint&, const JointMotion&);

/// Magnitude of the largest principal stress of a body under surface forces [Pa].
/// @param moments sum of  x f^T  over the forces f at x from the body's position, world axes [N m]
Real largestPrincipalStress(const Matrix3r& moments, Real volume);

} // namespace brick
