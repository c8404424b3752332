// SPDX-License-Identifier: GPL-2.0-or-later
// Lays mortar where faces of bricks touch. Set-up: run once, before the first step.
#pragma once

#include "BrickContact.hpp"

#include <core/GlobalEngine.hpp>

#include <map>

namespace yade {

class MortarJoints : public GlobalEngine {
public:
	void action() override;
	void postLoad(MortarJoints&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(MortarJoints, GlobalEngine, R"(Joins bricks to bricks and supports (:yref:`Wall`, :yref:`Box`) wherever two faces touch, fully or in part, by mortar. Call it once when all bodies are there, before the first step: ``MortarJoints()()``; as one of ``O.engines`` it works in the first step and is then :yref:`dead<Engine.dead>`.

The mortar is the materials' (:yref:`BrickMat.mortar`), or the one given here for bed and head joints or some bodies to differ: call with the special ones first, since a pair that is joined stays as it is. Bricks without mortar are left to ordinary contact. The mortar takes half its thickness from each brick: eq. (2), see the documentation of the springs.)",
		((vector<int>, ids, , , "Only joints between these bodies; empty: all."))
		((shared_ptr<Mortar>, mortar, , , "Mortar of these joints; none: that of the bricks' materials."))
		((Vector3r, normal, Vector3r::Zero(), Attr::triggerPostLoad, "Only faces within 45 degrees of this direction, either way: (0,0,1) for bed joints. Zero: all."))
		((Real, tolerance, NaN, Attr::triggerPostLoad, "Largest gap or overlap of faces that touch [m]; NaN: 1e-6 of the smaller brick's diagonal. Such a gap counts as closed."))
		((int, made, 0, Attr::readonly, "Joints made by the last call."))
	);
	// clang-format on

private:
	std::multimap<long, std::shared_ptr<brick::JointShape>> shapes; // of joints laid in this call, by size

	class FunctorsNeeded;

	void shareShape(brick::Joint&, const brick::Side&, const brick::Side&);
	void join(const shared_ptr<Body>&, const shared_ptr<Body>&, FunctorsNeeded&);
	void noteBeside(const shared_ptr<Body>&, const shared_ptr<Body>&) const;
	bool areJoined(Body::id_t, Body::id_t) const;
	Real gapOf(const Body&) const;
	Real gapBetween(const Body&, const Body&) const;
};
REGISTER_SERIALIZABLE(MortarJoints);

} // namespace yade
