// SPDX-License-Identifier: GPL-2.0-or-later
// The inner part of a refined brick: a hexahedron meshed with n x n x n elements, seen from the nodes on its surface (SurfaceGrid.hpp), to which alone
// joints and contacts apply forces. Set-up code: computed once a brick type and shared; may throw std::invalid_argument.   [Guyan 1965]
//
// With s the surface and i the inside, and T the inside that follows the surface in static equilibrium,
//     u_i = T_i u_s,   T_i = -K_ii^-1 K_is,   T = (1, T_i),   K_c = T^T K T = K_ss - K_si K_ii^-1 K_is,   M_c = T^T M T,   M lumped.
//
// What is exact, compared with the mesh itself:
//   - displacements of the surface at rest under any loads on the surface and loads in proportion to mass (weight, uniform acceleration, angular
//     acceleration): T carries rigid motions over unchanged, so M_c times a rigid motion is all that the surface feels of them, and no mode takes part;
//   - total mass, centre and rotary inertia of the lumped mesh; of a cuboid the latter is the solid's times 1 + 2/n^2;
//   - the mean stress: it depends on the surface alone.
// What is not: the inside has no motion of its own. Frequencies omega are never below the mesh's (Rayleigh-Ritz in T), and above them by less than a
// sixth of (omega/omega_i)^2, where omega_i is the lowest frequency of the inside with the surface held (measured on cubes, n to 8, nu from 0 to 0.4, below
// omega_i). With c_S the speed of shear waves, a cube with nu = 0.25 has omega_i = 6.5 c_S/L at n = 8: its lowest deformation, at 2.8 c_S/L, comes 1.5 % too
// high (lumping makes the mesh's own 1.5 % too low), those near 4 c_S/L 2 to 6 %. Above omega_i, waves inside the brick are not followed.
//
// Why not the lowest modes of the whole mesh instead: a cut leaves out flexibility. What a joint's edge or a contact point presses in is made of all modes,
// so statics would be too stiff however fine the mesh. The condensed part keeps each degree of freedom that a joint or contact can push, and its statics
// converges with n to elasticity. For the same reason all of its modes are kept.
#pragma once

#include "Modes.hpp"
#include "Stiffness.hpp"
#include "SurfaceGrid.hpp"

namespace brick {

/// A mesh seen from its surface. Degrees of freedom x0 y0 z0 x1 ... of the nodes of a SurfaceGrid. M_c is full: the inside couples the surface nodes. M_s,
/// what the lumped mesh has at these nodes themselves, is diagonal and bounds it from below, M_c - M_s being positive semidefinite: springs on the nodes
/// have at most the frequencies that they would have with M_s.
struct CondensedMatrices {
	MatrixX           stiffness;     ///< K_c [N/m], symmetric to the last bit, six zero modes
	MatrixX           mass;          ///< M_c [kg], symmetric to the last bit, positive definite
	std::vector<Real> surfaceMasses; ///< M_s, one a node [kg]
};

/// @param corners of the part at rest [m]; each cell must be admissible to nodesProblem   @param cells n along each edge, 1 to largestCells
/// @param mass of all, in proportion to volume [kg]: the whole brick's, as in the paper
/// @throws std::invalid_argument as surfaceGrid, stiffness and lumpedMasses do
CondensedMatrices condense(const Nodes& corners, int cells, Real young, Real poisson, Element element, Real mass);

/// All modes but the six rigid ones. A simple mode has its largest component positive; modes of one frequency are replaced by what their group answers to
/// forces on single degrees of freedom, that of the largest component first. Components are compared after multiplying with the root of M's diagonal; the
/// first of equals counts. Bitwise the same for the same input, with any number of threads.
/// @param K, M symmetric, of size 3 S; K annihilates rigid motions, M is positive definite   @param nodes S of them, at rest [m]
/// @throws std::invalid_argument when K or M has another size or is not finite or not symmetric, M is not positive definite, or a deformation meets no
/// stiffness
Modes deformationModes(const MatrixX& K, const MatrixX& M, const std::vector<Vector3r>& nodes);

/// What a refined brick type needs in a run.
struct CondensedPart {
	int                                    cells;         ///< n along each edge: surfaceGrid(cells) numbers the nodes
	std::vector<Vector3r>                  nodes;         ///< on the surface at rest [m]
	std::vector<Real>                      surfaceMasses; ///< as in CondensedMatrices
	Matrix6r                               rigidMass;     ///< of all in three translations and three rotations about the origin [kg, kg m, kg m2]
	Modes                                  modes;
	Eigen::Matrix<Real, 6, Eigen::Dynamic> stressOf; ///< mean stress of displacements, see meanStress [Pa/m]

	/// @param as those of condense
	CondensedPart(const Nodes& corners, int cells, Real young, Real poisson, Element element, Real mass);

	/// Volume average of the stress [Pa], order xx yy zz xy yz zx as centreStress: elasticity times the mean strain, which by the divergence theorem is
	///     1/V  integral over the surface of  sym(u n^T) dA,
	/// integrated exactly over the bilinear cells. It is the average over the elements, whatever the inside does.
	/// @param u displacements of the surface nodes [m]
	Vector6r meanStress(const VectorX& u) const { return stressOf * u; }
};

} // namespace brick
