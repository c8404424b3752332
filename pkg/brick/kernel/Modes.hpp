// SPDX-License-Identifier: GPL-2.0-or-later
// Deformation modes of one brick type, found once and shared by equal bricks: eq. (18) of Furukawa et al. 2014 less its rigid part,
// taken apart into independent oscillators. K is constant in the co-rotated frame, so the modes are too.
#pragma once

#include "Types.hpp"

#include <vector>

namespace brick {

constexpr int modeCount = dofCount - 6; ///< deformations of eight nodes without rigid motion

/// Shapes phi that are orthogonal to each other and to every rigid motion in the mass M of the nodes, with phi^T M phi = 1. With u = sum phi q each
/// mode obeys  q'' + omega^2 q = phi^T f ,  f the nodal loads: a load's rigid part, M times a rigid acceleration, drops out by itself.
/// Rigid displacements u have q = phi^T M u = 0. M is the lumped mass of a hexahedron, or that of a condensed part (CondensedPart.hpp).
struct Modes {
	MatrixX           shapes;       ///< one column a mode [1/sqrt(kg)], body frame; rows x0 y0 z0 x1 ... of the nodes
	std::vector<Real> omegaSquared; ///< ascending [1/s2], > 0

	int count() const { return int(omegaSquared.size()); }
};

/// Rigid: none. Uniform: the six fields of constant strain (Rayleigh-Ritz in them). Trilinear: all eighteen. (Refined has more nodes than these eight:
/// CondensedPart.hpp.)
/// The same input gives the same modes whatever the eigenvalue solver: a simple mode has its largest (first of equals) component positive, in mass-weighted
/// coordinates; modes of one frequency are the projections of single nodal directions onto their common space, the best aligned first.
/// @param K stiffness of the hexahedron [N/m], symmetric   @param nodes where its nodes are at rest [m], body frame
/// @param masses of the nodes [kg], each finite and > 0
/// @throws std::invalid_argument when an entry is not finite, a mass not positive, K not symmetric, or a deformation meets no stiffness; when the level is Refined
Modes deformationModes(const Matrix24& K, const Nodes& nodes, const std::array<Real, nodeCount>& masses, Deformation level);

} // namespace brick
