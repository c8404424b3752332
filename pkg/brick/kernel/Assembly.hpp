// SPDX-License-Identifier: GPL-2.0-or-later
// Bricks joined by mortar that holds everywhere, as one structure: equilibrium, and stiffness and mass for small motion about the present state.
// Set-up and study, not for a step: allocates and throws.
//
// Coordinates of a brick: translation of its centre (3) and rotation vector (3) in world axes, then the amplitudes of its modes. A point of face node a moves by
//     dx + dtheta x (x_a - position) + R phi_a dq
// and a joint adds  sum over segments A w w^T (kn n n^T + ks (1 - n n^T))  on the nodes of its two faces, w their weights. The stiffness that the stresses themselves
// have when bricks turn (geometric) is left out: it is of the order of stress over E.
#pragma once

#include "Joint.hpp"
#include "Modes.hpp"

#include <Eigen/Sparse>

#include <stdexcept>
#include <string>

namespace brick {

using SparseMatrix = Eigen::SparseMatrix<Real>;

struct AssembledBrick {
	Vector3r            position { Vector3r::Zero() };           ///< [m]
	Quaternionr         orientation { Quaternionr::Identity() }; ///< body axes to world axes
	Real                mass = 0;                                ///< [kg]
	Vector3r            inertia { Vector3r::Zero() };            ///< principal, body axes [kg m2]
	const Modes*        modes = nullptr;                         ///< null for a rigid brick
	std::vector<Real>   amplitudes;                              ///< one a mode [sqrt(kg) m]
	std::array<bool, 6> held { false, false, false, false, false, false };

	int coordinates() const { return 6 + (modes ? modes->count() : 0); }
	int nodes() const { return modes ? int(modes->shapes.rows()) / 3 : nodeCount; } ///< of the surface
	/// Displacement of the nodes, body axes [m].
	NodalVectors displacement() const;
};

struct AssembledJoint {
	std::array<int, 2> bricks { -1, -1 }; ///< index of each side's brick; -1: a support
	Placement          support;           ///< where the support is, if there is one
	Joint              joint;
};

class Assembly {
public:
	/// @throws std::invalid_argument when a joint has a failed segment, or a brick has too few amplitudes
	Assembly(std::vector<AssembledBrick>, std::vector<AssembledJoint>);

	int                                size() const { return coordinateCount; }
	int                                place(int brick) const { return places[brick]; } ///< of its first coordinate
	const std::vector<AssembledBrick>& bricks() const { return parts; }
	bool                               isHeld(int coordinate) const { return held[coordinate]; }

	/// Of joints and inner parts [N/m and, for rotations and amplitudes, accordingly]; held coordinates included.
	SparseMatrix stiffness() const;
	SparseMatrix mass() const;
	/// Generalised forces of joints and inner parts in the present state.
	VectorX internalForces() const;
	/// Displacement of a brick's nodes in world axes (three rows a node) for each of its coordinates: nodal forces go back through the transpose.
	/// @param nodes of the surface of the brick or of its inner part at rest, body axes [m]
	MatrixX nodalMap(int brick, const std::vector<Vector3r>& nodes) const;
	/// A first brick that can move freely, since no chain of joints leads from it to a support or a held brick; -1: none.
	int freeBrick() const;

	/// Moves all bricks.
	void move(const VectorX& increment);
	/// Segments beyond their strength in the present state, by mode.
	Failures overloaded() const;
	/// Of joints and inner parts [J].
	Real elasticEnergy() const;

private:
	std::vector<AssembledBrick> parts;
	std::vector<AssembledJoint> joints;
	std::vector<int>            places;
	std::vector<bool>           held;
	int                         coordinateCount = 0;

	Placement   placement(const AssembledJoint&, int side, NodalVectors& displacement) const;
	JointMotion motionOf(const AssembledJoint&) const;
	void        addJoint(const AssembledJoint&, std::vector<Eigen::Triplet<Real>>&) const;
	/// Adds a patch's stiffness to the blocks of the joint's two bricks; blocks of a support are empty.
	void addPatch(
	        const AssembledJoint&,
	        int                             number,
	        const std::array<Placement, 2>& at,
	        const PatchMotion&,
	        const Matrix3r&                        springs,
	        std::array<std::array<MatrixX, 2>, 2>& blocks) const;
};

/// Nothing resists a motion of a brick of a structure.
struct Mechanism : std::runtime_error {
	int brick; ///< its index
	Mechanism(const std::string& what, int index)
	        : std::runtime_error(what)
	        , brick(index)
	{
	}
};

/// What settle() reached.
struct Equilibrium {
	int  iterations = 0;
	Real imbalance  = 0; ///< sqrt(r.K^-1 r / f.K^-1 f) with the remaining forces r and the loads f
};

/// Moves the assembly to where internal forces balance the loads, by Newton's method; the stiffness is found anew when an iteration helps little.
/// @param loads on all coordinates   @param tolerance of the imbalance; it goes on below as long as iterations help
/// @throws Mechanism when the structure has one; std::runtime_error when the imbalance does not fall
Equilibrium settle(Assembly&, const VectorX& loads, Real tolerance, int mostIterations);

} // namespace brick
