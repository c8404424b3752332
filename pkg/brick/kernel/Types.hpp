// SPDX-License-Identifier: GPL-2.0-or-later
// Vocabulary of the kernel: numbers, vectors, and how the nodes and faces of a hexahedron are numbered.
//
//        7 ------- 6            face 0: -x   face 1: +x
//       /|        /|            face 2: -y   face 3: +y
//      / |       / |            face 4: -z   face 5: +z
//     4 ------- 5  |
//     |  3 -----|- 2     z      Faces list their nodes counter-clockwise as seen from outside,
//     | /       | /      | y    so that (x1-x0) x (x3-x0) points outward. On a face the bilinear
//     |/        |/       |/     coordinates (xi, eta) in [-1,1]^2 belong to its nodes in that order:
//     0 ------- 1        +--x   (-1,-1), (1,-1), (1,1), (-1,1).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>

namespace brick {

using Real        = double;
using Vector2r    = Eigen::Matrix<Real, 2, 1>;
using Vector3r    = Eigen::Matrix<Real, 3, 1>;
using Vector4r    = Eigen::Matrix<Real, 4, 1>;
using Vector6r    = Eigen::Matrix<Real, 6, 1>;
using Matrix3r    = Eigen::Matrix<Real, 3, 3>;
using Matrix6r    = Eigen::Matrix<Real, 6, 6>;
using Quaternionr = Eigen::Quaternion<Real>;
using VectorX     = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using MatrixX     = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

constexpr int nodeCount = 8;
constexpr int faceCount = 6;
constexpr int dofCount  = 3 * nodeCount; ///< nodal degrees of freedom, ordered x0 y0 z0 x1 ...

using Nodes    = std::array<Vector3r, nodeCount>;
using Vector24 = Eigen::Matrix<Real, dofCount, 1>;
using Matrix24 = Eigen::Matrix<Real, dofCount, dofCount>;

/// Nodes of each face, counter-clockwise from outside.
constexpr int faceNodes[faceCount][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };

/// Signs of a node's natural coordinates (xi, eta, zeta).
constexpr int nodeSigns[nodeCount][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 }, { -1, -1, 1 }, { 1, -1, 1 }, { 1, 1, 1 }, { -1, 1, 1 } };

/// How much of a brick's deformation is followed: none; six uniform strains; all eighteen of one hexahedron; all that the surface of n x n x n can have.
enum class Deformation { Rigid, Uniform, Trilinear, Refined };

/// How the stiffness of the inner hexahedron is integrated.
enum class Element { Full, Incompatible, Bbar };

/// Where the inner hexahedron ends: a contact part's thickness inside the brick's corners (the paper), or at the corners.
enum class Inner { Inset, FullSize };

} // namespace brick
