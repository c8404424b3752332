// SPDX-License-Identifier: GPL-2.0-or-later
#include "StepLimit.hpp"

#include "RigidMotion.hpp"

#include "kernel/Contact.hpp"
#include "kernel/StableStep.hpp"

namespace yade {

namespace {

	constexpr std::size_t mostShared = 10000; // known steps kept: in a heap that never rests, new ones keep coming

	brick::Elasticity elasticityOf(const BrickMat& m) { return { m.young, m.poisson }; }

	/// Contact length of a face when no change of level goes on: while one does, springs are softer. A support has none.
	Real contactLength(const Brick* shape, int face) { return shape ? shape->settledContactLength(face) : 0; }

	Real shortestContactLength(const Brick& shape)
	{
		Real shortest = contactLength(&shape, 0);
		for (int f = 1; f < brick::faceCount; ++f)
			shortest = std::min(shortest, contactLength(&shape, f));
		return shortest;
	}

	/// Largest c/k [s] of the dashpots of a spot, normal or shear.
	Real dashpotTime(const brick::SpotSprings& k) { return std::max(k.normalDashpot / k.normal, k.shearDashpot / k.shear); }

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

/// Two bodies that touch, as one of them sees the other.
struct StepLimit::Touching {
	const Brick &   shape;
	const Brick*    other;         // null: a support
	Real            normal, shear; // compliances of the other's material [1/Pa]
	bool            held;
	const BrickPhys& phys;
	int              side;         // of the brick in the interaction

	void add(int face, int its, Real area, FacePartners& p) const
	{
		const brick::PairSprings& pair = phys.springs();
		p.normal[held] = std::min(p.normal[held], pair.mortarNormal + contactLength(other, its) * normal);
		p.shear[held]  = std::min(p.shear[held], pair.mortarShear + contactLength(other, its) * shear);
		p.coverage += area / shape.solid->faces[face].area;
		if (!phys.damped) return;
		const Real mine = contactLength(&shape, face), others = contactLength(other, its);
		p.dashpotTime = std::max(p.dashpotTime, dashpotTime(side == 0 ? pair.at(mine, others) : pair.at(others, mine)));
	}
};

/// What a brick that nothing touches may meet any time with any face: its like.
StepLimit::FacePartners StepLimit::likeOf(const Brick& shape, const BrickMat& material, bool damped) const
{
	const Real   l = shortestContactLength(shape);
	FacePartners like;
	like.normal[0] = l * elasticityOf(material).normalCompliance();
	like.shear[0]  = l * elasticityOf(material).shearCompliance();
	like.coverage  = 1;
	const auto pair = pairSprings(material, false, material);
	for (int f = 0; damped && f < brick::faceCount; ++f)
		like.dashpotTime = std::max(like.dashpotTime, dashpotTime(pair.at(contactLength(&shape, f), contactLength(&shape, f))));
	return like;
}

StepLimit::Partners StepLimit::partnersOf(const Body& b, const Brick& shape, const BrickMat& material, Scene* scene)
{
	Partners p;
	bool     alone = true, damped = false;
	for (const auto& item : b.intrs) {
		const auto* phys = asBrickPhys(item.second->phys);
		if (!phys || !item.second->geom) continue;
		const auto&    other    = Body::byId(item.first, scene);
		const auto*    otherMat = asBrickMat(other->material);
		const Brick*   otherShape = otherMat ? asBrick(other->shape) : nullptr;
		const auto     elastic  = otherShape ? elasticityOf(*otherMat) : brick::Elasticity { 1, 0 };
		const Touching touching { shape, otherShape, elastic.normalCompliance(), elastic.shearCompliance(), !other->isDynamic(), *phys, phys->ids[0] == b.getId() ? 0 : 1 };
		forEachTouch(static_cast<const BrickGeom&>(*item.second->geom), *phys, [&](int face0, int face1, Real area) {
			const int mine = touching.side == 0 ? face0 : face1;
			touching.add(mine, touching.side == 0 ? face1 : face0, area, p[mine]);
		});
		alone = false, damped = damped || phys->damped;
	}
	// what touches a bare face is seen in the step that it does so
	if (std::all_of(p.begin(), p.end(), [](const FacePartners& face) { return face.coverage == 0; }))
		p.fill(likeOf(shape, material, alone ? lawHasDashpots(*scene) : damped));
	for (auto& face : p)
		if (face.coverage > 0) face.coverage = atLeastOnce(face.coverage);
	return p;
}

brick::LargestStep StepLimit::stepOf(const Body& b, Brick& shape, const BrickMat& material, const Partners& partners)
{
	const State&                                     state = *b.state;
	const brick::InnerPart*                          inner = shape.innerPart(material);
	std::array<brick::FaceSprings, brick::faceCount> springs;
	for (int f = 0; f < brick::faceCount; ++f) {
		const FacePartners& its = partners[f];
		const Real          l = contactLength(&shape, f), n = l * elasticityOf(material).normalCompliance(), s = l * elasticityOf(material).shearCompliance();
		springs[f] = { its.coverage * std::max(2 / (n + its.normal[0]), 1 / (n + its.normal[1])),
			       its.coverage * std::max(2 / (s + its.shear[0]), 1 / (s + its.shear[1])),
			       its.dashpotTime };
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

} // namespace yade
