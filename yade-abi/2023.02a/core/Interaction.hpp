// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two bodies whose bounds overlap (potential) or that touch (real: it has geometry and physics).
#pragma once

#include <core/Body.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>

namespace yade {

class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;

class Interaction : public Serializable {
public:
	bool isActive;
	struct {
		bool                     geomExists;
		shared_ptr<IGeomFunctor> geom;
		shared_ptr<IPhysFunctor> phys;
		shared_ptr<LawFunctor>   constLaw;
	} functorCache; // filled by YADE at the first use and kept from then on
	Body::id_t        id1, id2;
	long              iterMadeReal, iterLastSeen;
	shared_ptr<IGeom> geom;
	shared_ptr<IPhys> phys;
	Vector3i          cellDist; // periods by which body 2 is shifted
	int               linIx;
	long              iterBorn;

	Interaction(Body::id_t, Body::id_t);
	YADE_HOST_CLASS(Interaction)

	const Body::id_t& getId1() const { return id1; }
	const Body::id_t& getId2() const { return id2; }
	bool              isReal() const { return geom && phys; }
	bool              isFresh(Scene*); // made real in this step
	void              reset();         // drops geometry and physics
	void              swapOrder();
};
YADE_ABI_SIZE(Interaction, 168)
YADE_ABI_OFFSET(Interaction, functorCache, 32)
YADE_ABI_OFFSET(Interaction, id1, 88)
YADE_ABI_OFFSET(Interaction, iterMadeReal, 96)
YADE_ABI_OFFSET(Interaction, geom, 112)
YADE_ABI_OFFSET(Interaction, phys, 128)
YADE_ABI_OFFSET(Interaction, cellDist, 144)
YADE_ABI_OFFSET(Interaction, iterBorn, 160)

} // namespace yade
