// SPDX-License-Identifier: GPL-2.0-or-later
// What a brick's deformation is made of, by level: see InnerPart.hpp.
#include "InnerPart.hpp"
#include "CondensedPart.hpp"

namespace brick {

InnerPart::InnerPart(const InnerPartType& type)
        : type(type)
        , cells(type.deformation == Deformation::Refined ? type.cells : 1)
{
	const Nodes corners = type.inner == Inner::Inset ? insetCorners(Hexahedron(type.corners), type.thickness) : type.corners;
	const Real  mass    = type.density * solidProperties(type.corners).volume;
	if (type.deformation == Deformation::Refined) makeRefined(type, corners, mass);
	else
		makeHexahedron(type, corners, mass);
	columns = ModeColumns(modes.shapes.data(), 3 * int(nodes.size()), modes.count());
}

void InnerPart::makeHexahedron(const InnerPartType& type, const Nodes& corners, Real mass)
{
	nodes.assign(corners.begin(), corners.end());
	modes = deformationModes(stiffness(corners, type.young, type.poisson, type.element), corners, lumpedMasses(corners, mass), type.deformation);
	stressOf.resize(6, dofCount);
	for (int i = 0; i < dofCount; ++i)
		stressOf.col(i) = centreStress(corners, type.young, type.poisson, Vector24::Unit(i));
}

void InnerPart::makeRefined(const InnerPartType& type, const Nodes& corners, Real mass)
{
	CondensedPart part(corners, cells, type.young, type.poisson, type.element, mass);
	nodes         = std::move(part.nodes);
	modes         = std::move(part.modes);
	stressOf      = std::move(part.stressOf);
	surfaceMasses = std::move(part.surfaceMasses);
	rigidMass     = part.rigidMass;
}

} // namespace brick
