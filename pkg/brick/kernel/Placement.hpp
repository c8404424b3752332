// SPDX-License-Identifier: GPL-2.0-or-later
// Where a brick or a support is and how it moves, as joints and contacts see it, and the loads that they return.
//
// A material point of a face is a weighted sum of the four nodes of the face, or of its cell where the surface has several (SurfaceGrid.hpp). Its place is
//     x = position + R (X + sum_a N_a u_a)                                        [Furukawa2014, eqs. (12)-(13)]
// with the rigid motion (position, R) and the nodal displacements u of the deformation part, in body axes.
#pragma once

#include "SurfaceGrid.hpp"

#include <boost/container/small_vector.hpp>

namespace brick {

/// Placement and motion of one body; world axes unless said.
struct Placement {
	Vector3r        position { Vector3r::Zero() };     ///< of the centre of gravity [m]
	Matrix3r        rotation { Matrix3r::Identity() }; ///< body axes to world axes
	Vector3r        velocity { Vector3r::Zero() };     ///< [m/s]
	Vector3r        angularVelocity { Vector3r::Zero() };
	const Vector3r* displacement     = nullptr; ///< of the nodes of the surface, body axes [m]; null for a rigid body
	const Vector3r* displacementRate = nullptr; ///< likewise [m/s]; null: none, or not known
};

/// One of the two bodies of a joint or contact.
struct Side {
	const Hexahedron*          solid         = nullptr; ///< rest geometry
	const std::array<Real, 6>* contactLength = nullptr; ///< l (rigid) or r (deformable) of each face [m], eqs. (1), (16); zero for supports
	int                        segments      = 1;       ///< along each edge of a face
	bool                       support       = false;   ///< a Wall or Box: carries no segments of its own
	Placement                  placement;
	int                        cells = 1; ///< of the surface along each edge of a face; segments is a multiple of it
};

/// A vector for each node of a surface; in one piece when there are eight.
using NodalVectors = boost::container::small_vector<Vector3r, nodeCount>;

/// What a contact does to one of its bodies.
struct Loads {
	Vector3r     force { Vector3r::Zero() };  ///< world axes [N]
	Vector3r     torque { Vector3r::Zero() }; ///< about the body's position, world axes [N m]
	NodalVectors nodal;                       ///< forces on the nodes of the surface, body axes [N]; their sum is the force

	explicit Loads(int cells = 1)
	        : nodal(surfaceGrid(cells).size(), Vector3r::Zero())
	{
	}
};

} // namespace brick
