// SPDX-License-Identifier: GPL-2.0-or-later
#include "DeformationOnDemand.hpp"

#include "kernel/Message.hpp"
#include "kernel/Utilisation.hpp"

#include <core/Body.hpp>
#include <core/Scene.hpp>

namespace yade {

YADE_PLUGIN((DeformationOnDemand));

void DeformationOnDemand::postLoad(DeformationOnDemand&)
{
	const auto refuse = [](const char* what, const auto& value, const char* allowed) {
		throw std::invalid_argument(brick::message("DeformationOnDemand.", what, ": ", value, "; allowed is ", allowed));
	};
	if (level != "uniform" && level != "trilinear") refuse("level", level, "'uniform' or 'trilinear'");
	if (!(utilisation > 0)) refuse("utilisation", utilisation, "a number above 0");
	if (!std::isnan(stress) && !(stress > 0)) refuse("stress", stress, "a number of Pa above 0, or NaN");
	if (!(release >= 0 && release <= 1)) refuse("release", release, "0 to 1");
	if (!(patience >= 0)) refuse("patience", patience, "a number of s, 0 or more");
	if (interval < 1) refuse("interval", interval, "1 or more");
}

/// Bricks that may change.
std::vector<Body::id_t> DeformationOnDemand::candidates() const
{
	std::vector<Body::id_t> found;
	const auto              add = [&](const shared_ptr<Body>& b) {
                const Brick* const shape = b && b->isDynamic() ? asBrick(b->shape) : nullptr;
                if (shape && shape->solid && asBrickMat(b->material) && shape->isSettled() && (shape->deformation == "rigid" || shape->deformation == level)) found.push_back(b->getId());
	};
	for (const int id : ids) {
		if (!scene->bodies->exists(id) || !asBrick((*scene->bodies)[id]->shape))
			throw std::invalid_argument(brick::message("DeformationOnDemand.ids: there is no brick #", id));
		add((*scene->bodies)[id]);
	}
	if (ids.empty())
		for (const auto& b : *scene->bodies)
			add(b);
	return found;
}

/// How much deformation is asked for: from 1 on it matters.
Real DeformationOnDemand::demand(const Body& b) const
{
	Real     most    = 0;
	Matrix3r moments = Matrix3r::Zero();
	for (const auto& item : b.intrs) {
		const Interaction& I    = *item.second;
		const BrickPhys*   phys = asBrickPhys(I.phys);
		if (!phys || !I.geom || phys->step != scene->iter) continue;
		const BrickGeom& geom = static_cast<const BrickGeom&>(*I.geom);
		if (phys->isJoint()) most = std::max(most, brick::utilisation(phys->joint, geom.motion) / utilisation);
		const Vector3r force = phys->normalForce + phys->shearForce; // on id2
		moments += (geom.contactPoint - b.state->pos) * (I.getId2() == b.getId() ? force : Vector3r(-force)).transpose();
	}
	if (std::isnan(stress)) return most;
	return std::max(most, brick::largestPrincipalStress(moments, b.state->mass / b.material->density) / stress);
}

void DeformationOnDemand::decide(Body& b, Real demand)
{
	Brick&     shape = static_cast<Brick&>(*b.shape);
	Real&      since = lowSince[b.getId()];
	const auto take  = [&](const string& other, long& count) {
                shape.deformation = other;
                shape.postLoad(shape);
                since = NaN;
                ++count;
	};
	if (shape.deformation == "rigid") {
		if (demand >= 1) take(level, promoted);
		return;
	}
	if (!(demand < release)) since = NaN;
	else if (std::isnan(since))
		since = scene->time;
	if (scene->time - since >= patience) take("rigid", demoted);
}

void DeformationOnDemand::action()
{
	if (scene->iter % interval != 0) return;
	lowSince.resize(scene->bodies->size(), NaN);
	const auto        among = candidates();
	const int         count = int(among.size());
	std::vector<Real> demands(count);
#pragma omp parallel for schedule(static)
	for (int i = 0; i < count; ++i)
		demands[i] = demand(*(*scene->bodies)[among[i]]);
	for (int i = 0; i < count; ++i)
		decide(*(*scene->bodies)[among[i]], demands[i]);
}

} // namespace yade
