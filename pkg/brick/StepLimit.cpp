// SPDX-License-Identifier: GPL-2.0-or-later
#include "StepLimit.hpp"

#include "RigidMotion.hpp"

#include "kernel/Contact.hpp"
#include "kernel/StableStep.hpp"

namespace yade {

namespace {

	constexpr std::size_t mostShared = 10000; // known steps kept: in a heap that never rests, new ones keep coming

	/// Contact length of a face when no change of level goes on: while one does, springs are softer. A support has none.
	Real contactLength(const Brick* shape, int face) { return shape ? shape->settledContactLength(face) : 0; }

	Real shortestContactLength(const Brick& shape)
	{
		Real shortest = contactLength(&shape, 0);
		for (int f = 1; f < brick::faceCount; ++f)
			shortest = std::min(shortest, contactLength(&shape, f));
		return shortest;
	}

	/// Calls  touch(face of side 0, face of side 1, area)  for all pairs of faces of an interaction that touch at present. Those that come into touch later are
	/// counted from the step after.
	template <class Touch> void forEachTouch(const BrickGeom& geom, const BrickPhys& phys, Touch touch)
	{
		if (phys.isJoint()) return touch(phys.joint.shape->faces[0].face, phys.joint.shape->faces[1].face, phys.joint.area());
		if (!geom.contact) return;
		for (const auto& spot : geom.contact->spots)
			if (spot.owner == 0) touch(spot.ownerFace, spot.otherFace, spot.area);
			else
				touch(spot.otherFace, spot.ownerFace, spot.area);
	}

	/// 1 for a face covered once at most (to round-off); beyond that up in steps, so that the bound is not found anew for every small change.
	Real atLeastOnce(Real coverage)
	{
		constexpr Real stepsOfOne = 32, roundOff = 1e-9;
		return std::max(1., std::ceil(stepsOfOne * (coverage - roundOff)) / stepsOfOne);
	}

} // namespace

/// Whether a brick that nothing touches is to be counted with dashpots: not in a scene whose law has none, as its joints and contacts show.
bool StepLimit::lawHasDashpots(const Scene& scene)
{
	if (!dashpots) {
		bool any = false, none = true;
		for (const auto& I : *scene.interactions)
			if (const auto* phys = asBrickPhys(I->phys)) none = false, any |= phys->damped;
		dashpots = any || none;
	}
	return *dashpots;
}

void StepLimit::FacePartners::add(const brick::SpotSprings& k, bool held)
{
	const Real times   = held ? 1 : 2;
	most.normal        = std::max(most.normal, times * k.normal);
	most.shear         = std::max(most.shear, times * k.shear);
	most.normalDashpot = std::max(most.normalDashpot, times * k.normalDashpot);
	most.shearDashpot  = std::max(most.shearDashpot, times * k.shearDashpot);
}

/// What a brick may meet any time with any face: its like, which counts at the least. (That leaves room for local damping, too, which adds to forces that brake.)
StepLimit::Partners StepLimit::likesOf(const Brick& shape, const BrickMat& material, bool damped) const
{
	const Real         l = shortestContactLength(shape);
	brick::PairSprings pair = pairSprings(material, false, material);
	if (!damped) pair.normalDamping = pair.shearDamping = 0;
	Partners likes;
	for (int f = 0; f < brick::faceCount; ++f)
		likes[f].add(pair.at(contactLength(&shape, f), l), false), likes[f].coverage = 1;
	return likes;
}

StepLimit::Partners StepLimit::partnersOf(const Body& b, const Brick& shape, const BrickMat& material, Scene* scene)
{
	Partners p;
	bool     alone = true, damped = false;
	for (const auto& item : b.intrs) {
		const auto* phys = asBrickPhys(item.second->phys);
		if (!phys || !item.second->geom) continue;
		const Body&                       other = *Body::byId(item.first, scene);
		const int                         side  = phys->ids[0] == b.getId() ? 0 : 1;
		const std::array<const Brick*, 2> bricks { side == 0 ? &shape : asBrick(other.shape), side == 1 ? &shape : asBrick(other.shape) };
		brick::PairSprings                pair = phys->springs();
		if (!phys->damped) pair.normalDamping = pair.shearDamping = 0;
		forEachTouch(static_cast<const BrickGeom&>(*item.second->geom), *phys, [&](int face0, int face1, Real area) {
			const int face = side == 0 ? face0 : face1;
			p[face].add(pair.at(contactLength(bricks[0], face0), contactLength(bricks[1], face1)), !other.isDynamic());
			p[face].coverage += area / shape.solid->faces[face].area;
		});
		alone = false, damped = damped || phys->damped;
	}
	const Partners likes = likesOf(shape, material, alone ? lawHasDashpots(*scene) : damped);
	// what touches a bare face is seen in the step that it does so
	if (std::all_of(p.begin(), p.end(), [](const FacePartners& face) { return face.coverage == 0; })) return likes;
	for (int f = 0; f < brick::faceCount; ++f)
		if (p[f].coverage > 0) p[f].add(likes[f].most, true), p[f].coverage = atLeastOnce(p[f].coverage);
	return p;
}

brick::LargestStep StepLimit::stepOf(const Body& b, Brick& shape, const BrickMat& material, const Partners& partners)
{
	const State&                                     state = *b.state;
	const brick::InnerPart*                          inner = shape.innerPart(material);
	std::array<brick::FaceSprings, brick::faceCount> springs;
	for (int f = 0; f < brick::faceCount; ++f) {
		const brick::SpotSprings& most = partners[f].most;
		if (partners[f].coverage == 0) continue;
		springs[f] = { partners[f].coverage * most.normal, partners[f].coverage * most.shear, std::max(most.normalDashpot / most.normal, most.shearDashpot / most.shear) };
	}
	std::vector<Real> key { state.mass, state.inertia[0], state.inertia[1], state.inertia[2] };
	for (const auto& f : springs)
		key.push_back(f.normal), key.push_back(f.shear), key.push_back(f.dashpotTime);
	for (const auto& c : shape.solid->corners)
		key.insert(key.end(), c.data(), c.data() + 3);
	if (inner) {
		// the lowest modes tell refined parts apart
		const auto& modes = inner->modes.omegaSquared;
		key.push_back(inner->cells);
		key.insert(key.end(), modes.begin(), modes.begin() + std::min<std::size_t>(modes.size(), brick::modeCount));
	}
	if (shared.size() > mostShared) shared.clear();
	const auto found = shared.find(key);
	return found != shared.end() ? found->second : shared.emplace(key, brick::largestStep(*shape.solid, springs, state.mass, state.inertia, inner)).first->second;
}

/// Takes a brick into the limit as it is joined and touched now.
void StepLimit::count(const Body& b, Brick& shape, const BrickMat& material, Scene* scene)
{
	Known&         last     = known[b.getId()];
	const Partners partners = partnersOf(b, shape, material, scene);
	if (shape.counted && last.isOf(material, *b.state) && last.partners == partners) return;
	const auto step = stepOf(b, shape, material, partners);
	if (step.seconds < seconds) seconds = step.seconds, brickId = b.getId(), face = step.face;
	last          = { material.young, material.poisson, b.state->mass, partners };
	shape.counted = true;
}

void StepLimit::update(Scene& scene)
{
	known.resize(scene.bodies->size());
	dashpots.reset();
	for (const auto& b : *scene.bodies) {
		Brick*      shape    = asBrick(b->shape);
		const auto* material = asBrickMat(b->material);
		if (!shape || !shape->solid || !material || !movesFreely(*b)) continue;
		// without contact nothing has changed but joints that have failed, which only makes the brick softer
		const bool unchanged = shape->counted && shape->contactStep != scene.iter && known[b->getId()].isOf(*material, *b->state);
		if (!unchanged) count(*b, *shape, *material, &scene);
	}
}

Real StepLimit::ofBrick(const Body& b, Scene& scene)
{
	Brick*      shape    = asBrick(b.shape);
	const auto* material = asBrickMat(b.material);
	if (!shape || !shape->solid || !material || !movesFreely(b)) return std::numeric_limits<Real>::infinity();
	dashpots.reset();
	return stepOf(b, *shape, *material, partnersOf(b, *shape, *material, &scene)).seconds;
}

} // namespace yade
