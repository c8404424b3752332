// SPDX-License-Identifier: GPL-2.0-or-later
#include "GroundMotion.hpp"

#include <core/Body.hpp>
#include <core/State.hpp>

namespace yade {

YADE_PLUGIN((GroundMotion));

void GroundMotion::postLoad(GroundMotion&)
{
	if (acceleration.empty()) return; // attributes come one by one; action() refuses to run without samples
	try {
		motion = brick::Accelerogram(dt, acceleration, startTime);
	} catch (const std::invalid_argument& problem) {
		throw std::invalid_argument(string("GroundMotion: ") + problem.what());
	}
}

void GroundMotion::action()
{
	if (acceleration.empty()) throw std::invalid_argument("GroundMotion.acceleration: no samples given; at least 2 are needed");
	if (ids.empty()) {
		const Vector3r z = motion.acceleration(scene->time);
		if (z == Vector3r::Zero()) return;
		for (const auto& b : *scene->bodies)
			if (b && b->isDynamic() && b->state->mass > 0) scene->forces.addForce(b->getId(), -b->state->mass * z);
		return;
	}
	const Vector3r velocity = (motion.displacement(scene->time + scene->dt) - motion.displacement(scene->time)) / scene->dt;
	for (const int id : ids) {
		if (!scene->bodies->exists(id)) throw std::invalid_argument("GroundMotion.ids: there is no body #" + std::to_string(id));
		Body::byId(id, scene)->state->vel = velocity;
	}
}

} // namespace yade
