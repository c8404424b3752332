// SPDX-License-Identifier: GPL-2.0-or-later
// Copies of bricks and joints for the 3-D view, taken while a step cannot move the memory that they are in (DrawingLock.hpp). Places are computed anew from them
// and from where the bodies are, so that they are known in the first step and after loading, too.
#pragma once

#include "BrickContact.hpp"

namespace yade {

/// The surface of a brick.
struct DrawnSurface {
	shared_ptr<const brick::Hexahedron> solid;        // null as long as no corners are given
	int                                 cells = 1;    // along each edge of a face
	std::vector<Vector3r>               displacement; // of its nodes, body axes [m]; empty when rigid

	std::vector<Vector3r> nodes() const; ///< in the order of brick::surfaceGrid(cells), body axes [m]
};

/// @param magnified factor of the displacements
DrawnSurface drawnSurface(const Brick&, Real magnified);

/// A mortar joint.
struct DrawnJoint {
	brick::Joint     joint;  // without segments while all hold, and when none does
	std::vector<int> states; // of the segments when they are not all 0, as BrickPhys.segmentState

	bool holds() const { return states.empty(); }
	Real failedShare() const; ///< of its segments
};

/// Nothing for an ordinary contact.
std::optional<DrawnJoint> drawnJoint(const BrickPhys&);

/// The joints that a brick has had, each with the body at its side 0.
std::vector<std::pair<DrawnJoint, Body::id_t>> drawnLostJoints(const Brick&);

/// Where a joint is now.
struct DrawnMotion {
	brick::JointMotion motion;
	Vector3r           origin; ///< position of side 0, world axes [m]
};

/// @param first, second of the interaction, in the order of its ids   @param magnified as drawnSurface
DrawnMotion drawnMotion(const DrawnJoint&, const Body& first, const Body& second, const Vector3r& shift2, Real magnified);

/// Shift of an interaction's second body [m].
Vector3r shiftOf(const Interaction&, const Scene&);

} // namespace yade
