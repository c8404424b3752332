// SPDX-License-Identifier: GPL-2.0-or-later
// Geometry of a brick: a convex hexahedron with planar faces. Trilinear interpolation inside, bilinear on the faces,
// volume, centre and inertia of the solid, its principal frame, and the inner hexahedron that a contact part leaves.
// Node and face numbering: Types.hpp. Set-up code may throw std::invalid_argument; what a step calls never throws or allocates.
#pragma once

#include "Types.hpp"

#include <algorithm>
#include <string>

namespace brick {

/// Largest distance of a corner from its face's mean plane, as a fraction of the longest edge. Corners typed with seven digits pass;
/// a looser value would let the planes that contact works with part visibly from the bilinear surfaces that joints work with.
constexpr Real planarityTolerance = 1e-6;

/// Smallest volume that the three edges at a corner may span, as a fraction of the product of their lengths, and shortest edge as a fraction of the
/// longest. Below it the corner is flat for all purposes: strains would be divided by it.
constexpr Real cornerTolerance = 1e-6;

/// Off-diagonal inertia, as a fraction of the largest moment, that counts as round-off, and difference of two moments that counts as
/// none. Corners of a 0.2 m brick placed 100 m from the origin carry about 1e-13.
constexpr Real inertiaTolerance = 1e-10;

/// Trilinear weights N_a of the eight nodes at natural coordinates (xi, eta, zeta) in [-1,1]^3; they sum to 1.
Eigen::Matrix<Real, nodeCount, 1> shapeFunctions(const Vector3r& natural);

/// Their derivatives, one row a node: dN_a/dxi, dN_a/deta, dN_a/dzeta.
Eigen::Matrix<Real, nodeCount, 3> shapeDerivatives(const Vector3r& natural);

/// Jacobian J_ij = dx_i / dxi_j of the trilinear map [m]; its determinant is positive inside an admissible brick.
Matrix3r jacobian(const Nodes& corners, const Vector3r& natural);

/// Volume, centre and inertia of a solid hexahedron of unit density.
struct SolidProperties {
	Real     volume;   ///< [m3]
	Vector3r centroid; ///< in the frame of the corners [m]
	Matrix3r inertia;  ///< about the centroid, in the axes of the corners [m5]: times the density, [kg m2]
};

/// Exact (to round-off) for the trilinear solid, so also for a hexahedron with planar faces: 3 x 3 x 3 Gauss points integrate x x^T det J,
/// of degree 4 in each natural coordinate. The corners are not checked: see cornersProblem.
SolidProperties solidProperties(const Nodes& corners);

/// Principal moments of inertia and the axes that they belong to.
struct PrincipalFrame {
	Vector3r    inertia;     ///< principal moments, in the order of the axes
	Quaternionr orientation; ///< unit; the columns of its matrix are the principal axes, in the frame of the given inertia, right-handed
};

/// The principal frame closest to the given axes. A diagonal inertia (cube, cuboid along its axes) gives the identity exactly; otherwise
/// the axes are permuted and signed, and turned within a plane of equal moments, so that the rotation is as small as it can be.
/// @throws std::invalid_argument when the inertia is not finite, not symmetric or not positive definite
PrincipalFrame principalFrame(const Matrix3r& inertia);

/// Why no element can be made of these nodes: empty when one can, otherwise what is wrong, the value, and what is allowed. Checked in this order:
/// finite, no edge of (nearly) zero length, det J > 0 at the 2 x 2 x 2 Gauss points and the centre. Faces need not be planar.
std::string nodesProblem(const Nodes& nodes);

/// Why these corners are not an admissible brick, likewise: nodesProblem, then det J > 0 at the corners, planar faces (planarityTolerance), and convex
/// (every corner strictly behind every face that it is not on).
std::string cornersProblem(const Nodes& corners);

/// Weights of a face's four nodes at its natural coordinates, in the order of faceNodes; they sum to 1.
inline Vector4r bilinear(Real xi, Real eta)
{
	return { (1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4, (1 - xi) * (1 + eta) / 4 };
}

/// One face of a brick at rest, body frame:  x(xi, eta) = centre + xi e1 + eta e2 + xi eta e12,  (xi, eta) in [-1,1]^2.
struct Face {
	Vector3r normal; ///< unit, outward
	Real     offset; ///< normal . x of the points of the face [m]
	Real     area;   ///< [m2]
	Vector3r centre; ///< mean of the four nodes; the centroid too when the face is a parallelogram
	Vector3r e1, e2; ///< half sides at the centre [m]
	Vector3r e12;    ///< zero when the face is a parallelogram [m]
	Vector3r dual1;  ///< dual basis in the face's plane [1/m]: dual1.e1 = dual2.e2 = 1, dual1.e2 = dual2.e1 = 0;
	Vector3r dual2;  ///< dual1.(x - centre) = xi and dual2.(x - centre) = eta when e12 = 0

	/// @param x0 .. x3 corners, counter-clockwise from outside [m]. Without area the normal is NaN.
	static Face of(const Vector3r& x0, const Vector3r& x1, const Vector3r& x2, const Vector3r& x3);

	/// Natural coordinates of the projection of x along the normal, each clamped to [-1,1]. Closed form, exact on any convex face; of a point beside the
	/// face, first eta is clamped, then xi (the nearest point only if the face is a rectangle). Never throws or allocates.
	Vector2r coordinates(const Vector3r& x) const
	{
		if (!parallelogram) return coordinatesOnQuadrilateral(x);
		const Vector3r d = x - centre;
		return { std::max(Real(-1), std::min(dual1.dot(d), Real(1))), std::max(Real(-1), std::min(dual2.dot(d), Real(1))) };
	}

	/// Point of the face at (xi, eta), body frame [m].
	Vector3r at(Real xi, Real eta) const;

	bool parallelogram; ///< e12 is round-off (its squared length below 1e-24 of the sides')

private:
	Vector2r coordinatesOnQuadrilateral(const Vector3r& x) const;
};

/// Rest geometry of a brick, shared by equal bricks. Body frame: the origin is the centre of gravity.
struct Hexahedron {
	Nodes                       corners;
	std::array<Face, faceCount> faces;
	Vector3r                    reach; ///< largest distance of a corner from the origin along each axis [m]

	/// @throws std::invalid_argument with cornersProblem(restCorners), or when the origin is not inside the brick
	explicit Hexahedron(const Nodes& restCorners);

	/// Distance from the centre of gravity to the plane of a face, l of eq. (1) [m]; positive.
	Real distance(int face) const { return faces[face].offset; }
};

/// Largest thickness that a contact part can have: at it the first edge of the inner hexahedron vanishes [m].
Real insetLimit(const Hexahedron& brick);

/// Corners of the inner hexahedron: each one is where the three planes that meet at the corner intersect after moving inward by r.
/// Its faces are parallel to the brick's.
/// @param r thickness of the contact part [m], 0 < r < insetLimit
/// @throws std::invalid_argument with r and the largest admissible value
Nodes insetCorners(const Hexahedron& brick, Real r);

/// Corners of a cuboid centred at the origin, sides along the axes.
/// @param size full lengths along x, y, z [m], each finite and > 0, otherwise std::invalid_argument
Nodes cuboidCorners(const Vector3r& size);

} // namespace brick
