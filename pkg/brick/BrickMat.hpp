// SPDX-License-Identifier: GPL-2.0-or-later
//
// Material of bricks, and of the mortar between them.
#pragma once

#include <pkg/common/ElastMat.hpp>

namespace yade {

/// Joint between two bricks: thickness, elasticity, and the yield surface of eqs. (6)-(8).
class Mortar : public Serializable {
public:
	void postLoad(Mortar&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Mortar, Serializable, "Mortar of a joint. The strengths have no default: a joint that can fail needs them all.",
		((Real, young, NaN, Attr::triggerPostLoad, "Young's modulus [Pa]; NaN for that of the bricks."))
		((Real, poisson, NaN, Attr::triggerPostLoad, "Poisson's ratio [-]; NaN for that of the bricks."))
		((Real, thickness, 0, Attr::triggerPostLoad, "Thickness :math:`t_M` [m] in eq. (2); zero for a joint without thickness, eq. (3)."))
		((Real, tensileStrength, NaN, Attr::triggerPostLoad, "Tensile strength [Pa], eq. (6)."))
		((Real, cohesion, NaN, Attr::triggerPostLoad, "Cohesion [Pa], eq. (7)."))
		((Real, frictionAngle, NaN, Attr::triggerPostLoad, "Angle of friction [rad] of the intact joint, eq. (7)."))
		((Real, compressiveStrength, NaN, Attr::triggerPostLoad, "Compressive strength [Pa], eq. (8)."))
		((Real, Cs, 9, Attr::triggerPostLoad, "Weight of the shear traction in the compression cap [-], eq. (8). The paper gives no value; 9 is Lourenco's usual one."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(Mortar)

/// Brick: elasticity, friction of open joints, damping.
class BrickMat : public FrictMat {
public:
	void postLoad(BrickMat&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(BrickMat, FrictMat, "Elastic brick; with :yref:`mortar<BrickMat.mortar>`, faces that touch at the start are joined.",
		((shared_ptr<Mortar>, mortar, , Attr::triggerPostLoad, "Mortar of the joints of this brick; None for dry joints."))
		((Real, hn, .1, Attr::triggerPostLoad, "Damping ratio of the normal contact dashpots [-], eq. (4). Our value."))
		((Real, hs, .1, Attr::triggerPostLoad, "Damping ratio of the tangential contact dashpots [-], eq. (4). Our value."))
		((Real, dampingRatio, 0, Attr::triggerPostLoad, "Fraction of critical damping of the modes of deformation [-]."))
		, createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BrickMat, FrictMat);
};
REGISTER_SERIALIZABLE(BrickMat)

/// A body's material as a brick's; null for any other.
inline const BrickMat* asBrickMat(const shared_ptr<Material>& material)
{
	return material && material->getClassIndex() == BrickMat::getClassIndexStatic() ? static_cast<const BrickMat*>(material.get()) : nullptr;
}

} // namespace yade
