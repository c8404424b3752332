// SPDX-License-Identifier: GPL-2.0-or-later
// Springs and dashpots between two bodies, per unit area.                           [Furukawa2014, eqs. (1)-(4), (16)]
//
// Two contact lengths l (the distance from face to centre of gravity of a rigid brick, the thickness r of the contact part of a
// deformable one) and a mortar of thickness tM act in series:
//     1/kn = lA (1-nuA^2)/EA + lB (1-nuB^2)/EB + mortar,    mortar = tM (1-nuM^2)/EM - tM/2 [(1-nuA^2)/EA + (1-nuB^2)/EB]
//     1/ks = likewise with 2(1+nu)/E
// The mortar's half thickness is taken from each brick's length, since the paper's unit is brick plus mortar: our reading of eq. (2),
// whose formula is lost in the source. tM = 0 gives eq. (3); a rigid support has no length of its own.
#pragma once

#include "Types.hpp"

namespace brick {

struct Elasticity {
	Real young   = 0;                                                         ///< E [Pa]
	Real poisson = 0;                                                         ///< nu [-]
	Real normalCompliance() const { return (1 - poisson * poisson) / young; } ///< (1-nu^2)/E [1/Pa]
	Real shearCompliance() const { return 2 * (1 + poisson) / young; }        ///< 2(1+nu)/E [1/Pa]
};

/// Stiffness and damping of a spot of contact.
struct SpotSprings {
	Real normal        = 0; ///< kn [Pa/m]
	Real shear         = 0; ///< ks [Pa/m]
	Real normalDashpot = 0; ///< cn [Pa s/m]
	Real shearDashpot  = 0; ///< cs [Pa s/m]

	bool operator==(const SpotSprings& o) const
	{
		return normal == o.normal && shear == o.shear && normalDashpot == o.normalDashpot && shearDashpot == o.shearDashpot;
	}
};

/// A tangential vector, shortened to a largest length: Coulomb's limit, eq. (9).
inline Vector3r limited(const Vector3r& t, Real largest)
{
	const Real length = t.norm();
	return length > largest ? Vector3r(t * (largest / length)) : t;
}

/// Everything about a pair of materials from which the springs of any spot between them follow.
struct PairSprings {
	std::array<Real, 2> normalCompliance { 0, 0 }; ///< (1-nu^2)/E of both sides [1/Pa]; zero for a support
	std::array<Real, 2> shearCompliance { 0, 0 };  ///< 2(1+nu)/E of both sides [1/Pa]
	std::array<Real, 2> density { 0, 0 };          ///< [kg/m3]; zero for a support
	Real                mortarNormal    = 0;       ///< what the mortar adds to 1/kn [m/Pa], eq. (2)
	Real                mortarShear     = 0;       ///< what the mortar adds to 1/ks [m/Pa]
	Real                mortarThickness = 0;       ///< of which a half is taken from the contact length of each side [m]
	Real                normalDamping   = 0;       ///< hn of eq. (4)
	Real                shearDamping    = 0;       ///< hs of eq. (4)
	Real                tanFriction     = 0;       ///< tan(phi) of contact, eq. (9)

	/// Adds mortar of thickness tM [m] between the two sides, eq. (2).
	void setMortar(const Elasticity& mortar, Real thickness);
	/// Springs between spots with contact lengths l0 and l1 [m], at least one of which is on a deformable or rigid brick.
	SpotSprings at(Real l0, Real l1) const;
};

} // namespace brick
