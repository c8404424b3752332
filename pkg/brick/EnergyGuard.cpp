// SPDX-License-Identifier: GPL-2.0-or-later
#include "EnergyGuard.hpp"

#include "RigidMotion.hpp"

namespace yade {

namespace {

	constexpr long windowSteps    = 1000;
	constexpr Real room           = 10;
	constexpr Real smallestStrain = 1e-7; // hundredth of what cracks mortar: energy below that of all bricks under this strain is no alarm

	Real kineticEnergy(const Scene& scene)
	{
		Real sum = 0;
		for (const auto& b : *scene.bodies) {
			if (!b->isDynamic()) continue;
			sum += rigidKineticEnergy(*b->state);
			if (const Brick* shape = asBrick(b->shape)) sum += shape->kineticEnergy();
		}
		return sum;
	}

	Real elasticEnergy(const Scene& scene)
	{
		Real sum = 0;
		for (const auto& b : *scene.bodies)
			if (const Brick* shape = asBrick(b->shape)) sum += shape->elasticEnergy();
		for (const auto& I : *scene.interactions) {
			const BrickPhys* phys = asBrickPhys(I->phys);
			if (!phys || !I->geom || phys->step != scene.iter) continue;
			const auto geom = boost::static_pointer_cast<BrickGeom>(I->geom);
			if (geom->isKnown()) sum += phys->elasticEnergy(geom); // not with bodies that are nowhere
		}
		return sum;
	}

	Real energyOfSmallestStrain(const Scene& scene)
	{
		Real sum = 0;
		for (const auto& b : *scene.bodies)
			if (const auto* material = asBrickMat(b->material); material && b->isDynamic())
				sum += material->young * b->state->mass / material->density * smallestStrain * smallestStrain / 2;
		return sum;
	}

} // namespace

bool EnergyGuard::isDue(const Scene& scene) const { return last != scene.iter - 1 || scene.iter - first >= windowSteps; }

void EnergyGuard::begin(Scene& scene)
{
	first  = scene.iter;
	held   = elasticEnergy(scene);
	moving = kineticEnergy(scene);
	least  = energyOfSmallestStrain(scene);
	work = given = 0;
}

bool EnergyGuard::isTooMuch(const Scene& scene) const
{
	if (!(work > held + room * (held + moving) + least)) return false;
	const Real outside = given + coming + std::abs(kineticEnergy(scene) - moving - work); // supports that move; gravity, ground
	return work > held + room * (held + moving + outside) + least;
}

std::optional<EnergyGuard::Gain> EnergyGuard::add(const Scene& scene, std::vector<BodyStep>& steps)
{
	const bool begins = first == scene.iter; // the work done up to now was before the window
	last              = scene.iter;
	coming            = 0;
	for (std::size_t id = 0; id < steps.size(); ++id) {
		BodyStep& s = steps[id];
		s.gained    = begins ? 0 : s.gained + s.work;
		if (begins) continue;
		work += s.work;
		if (const auto& b = (*scene.bodies)[id]; b && !b->isDynamic()) given += std::abs(s.work), coming += std::abs(s.power) * scene.dt;
	}
	if (!isTooMuch(scene)) return {};
	const auto most = std::max_element(steps.begin(), steps.end(), [](const BodyStep& a, const BodyStep& b) { return a.gained < b.gained; });
	return Gain { work, held, scene.iter - first, int(most - steps.begin()) };
}

} // namespace yade
