// SPDX-License-Identifier: GPL-2.0-or-later
#include "StepLimit.hpp"

#include "RigidMotion.hpp"

#include "kernel/Contact.hpp"
#include "kernel/StableStep.hpp"

namespace yade {

namespace {

	constexpr Real        infinity   = std::numeric_limits<Real>::infinity();
	constexpr std::size_t mostShared = 10000; // known steps kept: in a heap that never rests, new ones keep coming

	Real longest(const std::array<Real, brick::faceCount>& l) { return *std::max_element(l.begin(), l.end()); }
	Real shortest(const std::array<Real, brick::faceCount>& l) { return *std::min_element(l.begin(), l.end()); }

	brick::Elasticity elasticityOf(const BrickMat& m) { return { m.young, m.poisson }; }

	/// Largest c/k [s] of the dashpots of a spot, normal or shear.
	Real dashpotTime(const brick::SpotSprings& k) { return std::max(k.normalDashpot / k.normal, k.shearDashpot / k.shear); }

	/// The same for what is in touch at present. Faces that come into touch later are counted from the step after.
	Real dashpotTime(const BrickGeom& geom, const BrickPhys& phys)
	{
		if (phys.isJoint()) return dashpotTime(phys.joint.shape->springs);
		Real longest = 0;
		if (!geom.contact) return longest;
		const brick::ContactSpot* last = nullptr; // spots of the same faces stand together
		for (const auto& spot : geom.contact->spots) {
			if (last && brick::sameFaces(*last, spot)) continue;
			longest = std::max(longest, dashpotTime(brick::springsOf(spot, geom.contact->sides[0], geom.contact->sides[1], phys.springs())));
			last    = &spot;
		}
		return longest;
	}

	/// Adds the area that an interaction takes of each face of one of its bodies, as a fraction of the face.
	void addCoverage(const Brick& shape, const BrickGeom& geom, const BrickPhys& phys, int side, std::array<Real, brick::faceCount>& coverage)
	{
		const auto& faces = shape.solid->faces;
		if (phys.isJoint()) {
			const int face = phys.joint.shape->faces[side].face;
			coverage[face] += phys.joint.area() / faces[face].area;
		} else if (geom.contact)
			for (const auto& spot : geom.contact->spots) {
				const int face = spot.owner == side ? spot.ownerFace : spot.otherFace;
				coverage[face] += spot.area / faces[face].area;
			}
	}

	/// 1 for a face covered once at most (to round-off); beyond that up in steps, so that the bound is not found anew for every small change.
	Real atLeastOnce(Real coverage)
	{
		constexpr Real stepsOfOne = 32, roundOff = 1e-9;
		return std::max(1., std::ceil(stepsOfOne * (coverage - roundOff)) / stepsOfOne);
	}

} // namespace

StepLimit::Partners StepLimit::partnersOf(const Body& b, const Brick& shape, const BrickMat& material, Scene* scene)
{
	// at the least its like, which it may meet any time
	const Real l = shortest(shape.contactLength), l1 = longest(shape.contactLength);
	Partners   p;
	p.normal = { l * elasticityOf(material).normalCompliance(), infinity };
	p.shear  = { l * elasticityOf(material).shearCompliance(), infinity };
	p.coverage.fill(0);
	p.dashpotTime = dashpotTime(pairSprings(material, false, material).at(l1, l1));
	for (const auto& item : b.intrs) {
		const auto* phys = asBrickPhys(item.second->phys);
		if (!phys || !item.second->geom) continue;
		const auto* geom       = static_cast<const BrickGeom*>(item.second->geom.get());
		const auto& other      = Body::byId(item.first, scene);
		const bool  held       = !other->isDynamic();
		Real        normal     = phys->springs().mortarNormal, shear = phys->springs().mortarShear;
		const auto* otherMat   = asBrickMat(other->material);
		const Brick* otherShape = asBrick(other->shape);
		if (otherShape && otherMat) {
			normal += shortest(otherShape->contactLength) * elasticityOf(*otherMat).normalCompliance();
			shear += shortest(otherShape->contactLength) * elasticityOf(*otherMat).shearCompliance();
		}
		p.normal[held] = std::min(p.normal[held], normal);
		p.shear[held]  = std::min(p.shear[held], shear);
		p.dashpotTime  = std::max(p.dashpotTime, dashpotTime(*geom, *phys));
		addCoverage(shape, *geom, *phys, phys->ids[0] == b.getId() ? 0 : 1, p.coverage);
	}
	// what touches a bare face is seen in the step that it does so; a brick that nothing touches may meet its like with any face
	const bool alone = std::all_of(p.coverage.begin(), p.coverage.end(), [](Real c) { return c == 0; });
	for (auto& c : p.coverage)
		if (alone || c > 0) c = atLeastOnce(c);
	return p;
}

StepLimit::Step StepLimit::stepOf(const Body& b, Brick& shape, const BrickMat& material, const Partners& partners)
{
	const State&                                     state = *b.state;
	const brick::InnerPart*                          inner = shape.innerPart(material);
	std::array<brick::FaceSprings, brick::faceCount> springs;
	for (int f = 0; f < brick::faceCount; ++f) {
		const Real l = shape.contactLength[f], n = l * elasticityOf(material).normalCompliance(), s = l * elasticityOf(material).shearCompliance();
		springs[f] = { partners.coverage[f] * std::max(2 / (n + partners.normal[0]), 1 / (n + partners.normal[1])),
			       partners.coverage[f] * std::max(2 / (s + partners.shear[0]), 1 / (s + partners.shear[1])) };
	}
	std::vector<Real> key { state.mass, state.inertia[0], state.inertia[1], state.inertia[2], partners.dashpotTime };
	for (const auto& f : springs)
		key.push_back(f.normal), key.push_back(f.shear);
	for (const auto& c : shape.solid->corners)
		key.insert(key.end(), c.data(), c.data() + 3);
	if (inner) {
		// the lowest modes tell refined parts apart
		const auto& modes = inner->modes.omegaSquared;
		key.push_back(inner->cells);
		key.insert(key.end(), modes.begin(), modes.begin() + std::min<std::size_t>(modes.size(), brick::modeCount));
	}
	if (shared.size() > mostShared) shared.clear();
	auto found = shared.find(key);
	if (found == shared.end()) {
		const auto fastest = brick::fastestMotion(*shape.solid, springs, state.mass, state.inertia, inner);
		found              = shared.emplace(key, Step { brick::stableStep(fastest.omegaSquared, partners.dashpotTime), fastest.face }).first;
	}
	return found->second;
}

/// Takes a brick into the limit as it is joined and touched now.
void StepLimit::count(const Body& b, Brick& shape, const BrickMat& material, Scene* scene)
{
	Known&         last     = known[b.getId()];
	const Partners partners = partnersOf(b, shape, material, scene);
	if (shape.counted && last.isOf(material, *b.state) && last.partners == partners) return;
	const Step step = stepOf(b, shape, material, partners);
	if (step.seconds < seconds) seconds = step.seconds, brickId = b.getId(), face = step.face;
	last          = { material.young, material.poisson, b.state->mass, partners };
	shape.counted = true;
}

void StepLimit::update(Scene& scene)
{
	known.resize(scene.bodies->size());
	for (const auto& b : *scene.bodies) {
		Brick*      shape    = asBrick(b->shape);
		const auto* material = asBrickMat(b->material);
		if (!shape || !shape->solid || !material || !movesFreely(*b)) continue;
		// without contact nothing has changed but joints that have failed, which only makes the brick softer
		const bool unchanged = shape->counted && shape->contactStep != scene.iter && known[b->getId()].isOf(*material, *b->state);
		if (!unchanged) count(*b, *shape, *material, &scene);
	}
}

} // namespace yade
