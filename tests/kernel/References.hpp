// SPDX-License-Identifier: GPL-2.0-or-later
// Independent reference numbers of the hexahedron's tests, under the ids of the verification references (references.json). They are
// printed with eight significant digits: comparing them tighter than that means nothing.
#pragma once

#include <pkg/brick/kernel/Types.hpp>

#include <utility>
#include <vector>

namespace brick::references {

constexpr Real printedDigits = 1e-8; ///< relative or, of numbers near 1, absolute: rounding and the inputs' own rounding stay below

/// Paper's Table 2: cube 0.1 m, E = 9.8e7 Pa, base fixed, W = 200 N, a quarter on each top node; u_A is the change of the full width.
struct Table2 {
	Real poisson;
	Real width;      ///< t2.fem.nu25, t2.fem.nu40: one full hexahedron; W/(3EL), 0.448 W/(EL) [m]
	Real settlement; ///< t2.fem.uz.nu25, t2.fem.uz.nu40: u_z of the top nodes [m]
	Real paper;      ///< t2.paper.fem: the FEM column, four digits, which were cut and not rounded [m]
};
constexpr Table2 table2[]        = { { 0.25, 6.8027211e-06, -1.9274376e-05, 6.802e-6 }, { 0.40, 9.1428571e-06, -1.5619048e-05, 9.142e-6 } };
constexpr Real   table2Tolerance = 1e-12, table2PaperDigit = 1e-9; // [m]

/// hex.distorted.*: one hexahedron with warped faces, E = 9.8e6 Pa, nu = 0.25, in a uniform displacement gradient. Own computation, exact for any consistent
/// element.
inline Nodes distortedNodes()
{
	return { { { -0.099290703, -0.072972178, -0.12135042 },
		   { 0.12691897, -0.11129011, -0.10460041 },
		   { 0.11966216, 0.094551948, -0.097024379 },
		   { -0.12834645, 0.11521079, -0.097711401 },
		   { -0.1102161, -0.082694278, 0.08819169 },
		   { 0.097209873, -0.1219575, 0.094186779 },
		   { 0.082207314, 0.0857388, 0.11502188 },
		   { -0.11317547, 0.099111458, 0.12884423 } } };
}
inline Matrix3r distortedGradient() { return 1e-3 * (Matrix3r() << 1, .3, -.2, .1, -.5, .4, .6, -.7, .25).finished(); }
inline Nodes    distortedForces()
{
	return { { { -159.01269, 7.4546062, -63.435412 },
		   { 67.558748, 36.878886, -25.916436 },
		   { 137.54282, 16.642964, -43.009835 },
		   { -92.855039, -14.137046, -80.474541 },
		   { -138.85317, -16.372858, 39.660106 },
		   { 89.679264, 11.864949, 80.766302 },
		   { 164.14946, -6.3689816, 66.730872 },
		   { -68.209397, -35.962519, 25.678945 } } };
}
constexpr Real distortedVolume = 0.0090885655;

/// hex.eig_*_0.25: eigenvalues of a cube's stiffness over E L, and how often each occurs. Own computation.
using Spectrum = std::vector<std::pair<Real, int>>;
inline Spectrum cubeSpectrum(Element element)
{
	switch (element) {
		case Element::Full: return { { 0, 6 }, { 1. / 15, 2 }, { 1. / 9, 3 }, { 1. / 5, 3 }, { 4. / 15, 1 }, { 1. / 3, 3 }, { 2. / 5, 5 }, { 1, 1 } };
		case Element::Bbar: return { { 0, 6 }, { 1. / 15, 2 }, { 2. / 27, 3 }, { 1. / 9, 3 }, { 1. / 5, 3 }, { 4. / 15, 1 }, { 2. / 5, 5 }, { 1, 1 } };
		default: return { { 0, 6 }, { 1. / 15, 2 }, { 1. / 9, 3 }, { 2. / 15, 3 }, { 2. / 9, 3 }, { 4. / 15, 1 }, { 2. / 5, 5 }, { 1, 1 } };
	}
}

/// dt.free.*: 2 / omega_max of a free cuboid, E = 9.8e6 Pa, nu = 0.25, rho = 1800 kg/m3 [s]. Exact eigenvalues, own computation.
struct FreeStep {
	Vector3r size;
	Element  element;
	Real     lumped, consistent;
};
inline std::vector<FreeStep> freeSteps()
{
	const Vector3r cube(.2, .2, .2), half(.1, .2, .2), small(.1, .1, .1);
	return { { cube, Element::Full, 0.0019166297, 0.0011065667 },           { cube, Element::Bbar, 0.0019166297, 0.0011065667 },
		 { cube, Element::Incompatible, 0.0019166297, 0.0011065667 },   { half, Element::Full, 0.0011932887, 0.00066130007 },
		 { half, Element::Bbar, 0.0011932887, 0.00068894557 },          { half, Element::Incompatible, 0.0011932887, 0.00066130007 },
		 { small, Element::Full, 0.00095831485, 0.00055328334 },        { small, Element::Bbar, 0.00095831485, 0.00055328334 },
		 { small, Element::Incompatible, 0.00095831485, 0.00055328334 } };
}
constexpr Real freeStepTolerance = 1e-9;

/// lock.B.h1.*: base bonded, uniform traction on top of one cube: mean settlement times E / (sigma h). Truth 0.97997, 0.91166 and 0.90769. Own computation.
struct Locking {
	Real poisson, full, bbar, incompatible;
};
constexpr Locking locking[]
        = { { 0.25, 0.94444444, 0.97619048, 0.95833333 }, { 0.49, 0.19768073, 0.91824991, 0.76460784 }, { 0.499, 0.023496798, 0.91555567, 0.75149601 } };

} // namespace brick::references
