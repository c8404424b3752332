// SPDX-License-Identifier: GPL-2.0-or-later
// The deformation part of one type of brick: the inner hexahedron, alone or meshed, with its modes.        [Furukawa2014, section 3]
// Set-up code: computed once a brick type and shared by equal bricks.
#pragma once

#include "Hexahedron.hpp"
#include "InnerMotion.hpp"
#include "Modes.hpp"

namespace brick {

/// What the deformation of a brick depends on.
struct InnerPartType {
	Nodes       corners; ///< of the brick, body axes [m]
	Deformation deformation = Deformation::Trilinear;
	Element     element     = Element::Full;
	Inner       inner       = Inner::Inset;
	Real        thickness   = 0; ///< r of the contact part [m]
	Real        young = 0, poisson = 0, density = 0;
	int         cells = 1; ///< elements along each edge, 1 to largestCells; used by Refined only
};

/// Memory of a refined part, once for all bricks of the type: three times its shapes (in `modes` and twice in `columns`), each 3 S (3 S - 6) numbers with
/// S = 6 n^2 + 2: 0.13 MB for n = 2, 2 MB for n = 4, 32 MB for n = 8. A step reads `columns` alone; `modes.shapes` serves StableStep.hpp and Assembly.hpp.
struct InnerPart {
	InnerPartType                          type;  ///< that it was made for
	int                                    cells; ///< n along each edge of the surface: surfaceGrid(cells) numbers the nodes; 1 unless refined
	std::vector<Vector3r>                  nodes; ///< of the surface at rest, body axes [m]; first the eight corners
	Modes                                  modes;
	ModeColumns                            columns;                      ///< of the modes' shapes
	Eigen::Matrix<Real, 6, Eigen::Dynamic> stressOf;                     ///< mean stress of displacements, see meanStress [Pa/m]
	std::vector<Real>                      surfaceMasses;                ///< M_s of CondensedPart.hpp, one a node [kg]; empty unless refined
	Matrix6r                               rigidMass = Matrix6r::Zero(); ///< of CondensedPart.hpp, about the brick's centre of gravity; zero unless refined

	/// The nodes carry the whole brick's mass, as in the paper.
	/// @throws std::invalid_argument as insetCorners, stiffness and, if refined, condense do
	explicit InnerPart(const InnerPartType&);

	/// Volume average of the stress [Pa], order xx yy zz xy yz zx: centreStress, or the average over a refined part's elements. Never throws or allocates.
	/// @param u displacements of the nodes [m], x0 y0 z0 x1 ...
	Vector6r meanStress(const Eigen::Ref<const VectorX>& u) const { return stressOf.lazyProduct(u); }

private:
	void makeHexahedron(const InnerPartType&, const Nodes& corners, Real mass);
	void makeRefined(const InnerPartType&, const Nodes& corners, Real mass);
};

} // namespace brick
