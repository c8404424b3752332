// SPDX-License-Identifier: GPL-2.0-or-later
// The deformation part of one type of brick: the inner hexahedron with its modes.        [Furukawa2014, section 3]
#pragma once

#include "Hexahedron.hpp"
#include "InnerMotion.hpp"
#include "Modes.hpp"
#include "Stiffness.hpp"

namespace brick {

/// What the deformation of a brick depends on.
struct InnerPartType {
	Nodes       corners; ///< of the brick, body axes [m]
	Deformation deformation = Deformation::Trilinear;
	Element     element     = Element::Full;
	Inner       inner       = Inner::Inset;
	Real        thickness   = 0; ///< r of the contact part [m]
	Real        young = 0, poisson = 0, density = 0;
};

struct InnerPart {
	Nodes nodes; ///< of the inner hexahedron at rest, body axes [m]
	Real  young, poisson;
	Modes modes;

	ModeColumns columns; ///< of the modes' shapes

	/// The nodes carry the whole brick's mass, as in the paper.
	/// @throws std::invalid_argument as insetCorners and stiffness do
	explicit InnerPart(const InnerPartType& type)
	        : nodes(type.inner == Inner::Inset ? insetCorners(Hexahedron(type.corners), type.thickness) : type.corners)
	        , young(type.young)
	        , poisson(type.poisson)
	        , modes(deformationModes(
	                  stiffness(nodes, young, poisson, type.element),
	                  nodes,
	                  lumpedMasses(nodes, type.density * solidProperties(type.corners).volume),
	                  type.deformation))
	        , columns(modes.shapes.data(), dofCount, modes.count)
	{
	}
};

} // namespace brick
