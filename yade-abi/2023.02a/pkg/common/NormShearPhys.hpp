// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contacts with normal and shear stiffness. YADE's recorders and time steppers cast to these without asking.
#pragma once

#include <core/IPhys.hpp>

namespace yade {

class NormPhys : public IPhys {
public:
	Real     kn          = 0; // [N/m]
	Vector3r normalForce = Vector3r::Zero(); // [N], on body 2

	NormPhys() { createIndex(); }
	YADE_HOST_CLASS(NormPhys)
	YADE_HOST_ARCHIVE(IPhys, (kn)(normalForce))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(NormPhys, 64)
YADE_ABI_OFFSET(NormPhys, kn, 32)
YADE_ABI_OFFSET(NormPhys, normalForce, 40)
REGISTER_SERIALIZABLE(NormPhys)

class NormShearPhys : public NormPhys {
public:
	Real     ks         = 0; // [N/m]
	Vector3r shearForce = Vector3r::Zero(); // [N], on body 2

	NormShearPhys() { createIndex(); }
	YADE_HOST_CLASS(NormShearPhys)
	YADE_HOST_ARCHIVE(NormPhys, (ks)(shearForce))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(NormShearPhys, 96)
YADE_ABI_OFFSET(NormShearPhys, ks, 64)
YADE_ABI_OFFSET(NormShearPhys, shearForce, 72)
REGISTER_SERIALIZABLE(NormShearPhys)

} // namespace yade
