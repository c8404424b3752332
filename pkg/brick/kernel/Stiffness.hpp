// SPDX-License-Identifier: GPL-2.0-or-later
// Linear elasticity of the 8-node hexahedron: eq. (17) of Furukawa et al. 2014, f_react = K u, and its lumped masses.
// Isotropic, small strain in the co-rotated frame. Set-up code: computed once a brick type, may throw std::invalid_argument.
// Stress and strain are Voigt vectors in the order  xx yy zz xy yz zx,  shear strain as the engineering angle 2 eps_ij.
#pragma once

#include "Types.hpp"

namespace brick {

/// Isotropic stiffness D of  sigma = D eps  [Pa], Voigt order above.
/// @param young E [Pa], finite and > 0   @param poisson nu, in (-1, 0.5)
Matrix6r elasticity(Real young, Real poisson);

/// Stiffness K of the hexahedron [N/m]: nodal forces that hold the displacements u are K u; the element answers with -K u, eq. (17).
/// Symmetric to the last bit, six zero modes, exact for any linear displacement field (patch test) in any shape.
///   Full          2 x 2 x 2 Gauss points: the paper's. A cube is 50 % (nu = 0.25) too stiff in bending; locks for nu -> 0.5.
///   Incompatible  nine internal bending modes (Wilson) 1 - xi_i^2, condensed; their gradient uses the Jacobian of the centre times
///                 det J0 / det J (Taylor), so that they do no work on constant stress. Bends exactly when rectangular.
///   Bbar          volumetric strain replaced by its volume average; does not lock for nu -> 0.5.
/// @param nodes admissible to nodesProblem: det J > 0 at the Gauss points; faces need not be planar
/// @throws std::invalid_argument with what is wrong with nodes, young or poisson
Matrix24 stiffness(const Nodes& nodes, Real young, Real poisson, Element element);

/// Mean stress of the hexahedron [Pa]: the volume average, which in a parallelepiped is the value at the centre. The same for all three elements,
/// and in equilibrium with the nodal forces: V sigma = sum_a sym(f_a x_a^T).
/// @param u nodal displacements [m], order x0 y0 z0 x1 ..., in the frame of the nodes
Vector6r centreStress(const Nodes& nodes, Real young, Real poisson, const Vector24& u);

/// Row sums of the consistent mass matrix [kg]: all positive, their sum is `mass` and their centre is that of the solid hexahedron.
/// Their rotary inertia is not the solid's (three times that of a cuboid): only the deformation is to be moved by them.
/// @param mass of the whole hexahedron, of uniform density [kg], finite and > 0
std::array<Real, nodeCount> lumpedMasses(const Nodes& nodes, Real mass);

} // namespace brick
