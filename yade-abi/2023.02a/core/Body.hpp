// SPDX-License-Identifier: GPL-2.0-or-later
//
// A particle: what it is made of, where it is, what it looks like, what it touches.
#pragma once

#include <core/Bound.hpp>
#include <core/Material.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

class Interaction;

class Body : public Serializable {
public:
	using id_t        = int;
	using MapId2IntrT = std::map<id_t, shared_ptr<Interaction>>;
	enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2 };

	id_t                 id;
	int                  groupMask;
	int                  flags;
	int                  subdomain;
	shared_ptr<Material> material;
	shared_ptr<State>    state;
	shared_ptr<Shape>    shape;
	shared_ptr<Bound>    bound;
	MapId2IntrT          intrs; // all, real and potential, by the id of the other body
	id_t                 clumpId;
	long                 iterBorn;
	Real                 timeBorn;

	Body();
	YADE_HOST_CLASS(Body)
	virtual void userForcedDisplacementRedrawHook();

	id_t getId() const { return id; }
	bool isDynamic() const { return state->blockedDOFs != State::DOF_ALL; }
	bool isBounded() const { return flags & FLAG_BOUNDED; }
	bool isAspherical() const { return flags & FLAG_ASPHERICAL; }
	bool isStandalone() const { return clumpId == -1; }
	bool isClump() const { return clumpId != -1 && clumpId == id; }
	bool isClumpMember() const { return clumpId != -1 && clumpId != id; }

	static const shared_ptr<Body>& byId(id_t, Scene* = nullptr); // no range check; null for an erased id
};
YADE_ABI_SIZE(Body, 176)
YADE_ABI_OFFSET(Body, id, 24)
YADE_ABI_OFFSET(Body, material, 40)
YADE_ABI_OFFSET(Body, state, 56)
YADE_ABI_OFFSET(Body, shape, 72)
YADE_ABI_OFFSET(Body, bound, 88)
YADE_ABI_OFFSET(Body, intrs, 104)
YADE_ABI_OFFSET(Body, clumpId, 152)
YADE_ABI_OFFSET(Body, timeBorn, 168)

} // namespace yade
