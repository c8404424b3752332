// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contact geometry that YADE's recorders and time steppers expect every contact to have.
#pragma once

#include <core/IGeom.hpp>

namespace yade {

class GenericSpheresContact : public IGeom {
public:
	Vector3r normal, contactPoint; // normal from body 1 to body 2
	Real     refR1, refR2;         // [m]

	GenericSpheresContact()
	        : normal(Vector3r::Zero())
	        , contactPoint(Vector3r::Zero())
	        , refR1(0)
	        , refR2(0)
	{
		createIndex();
	}
	YADE_HOST_CLASS(GenericSpheresContact)
	YADE_HOST_ARCHIVE(IGeom, (normal)(contactPoint)(refR1)(refR2))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(GenericSpheresContact, 96)
YADE_ABI_OFFSET(GenericSpheresContact, normal, 32)
YADE_ABI_OFFSET(GenericSpheresContact, contactPoint, 56)
YADE_ABI_OFFSET(GenericSpheresContact, refR1, 80)
REGISTER_SERIALIZABLE(GenericSpheresContact)

} // namespace yade
