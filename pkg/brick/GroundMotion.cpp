// SPDX-License-Identifier: GPL-2.0-or-later
#include "GroundMotion.hpp"

#include "RigidMotion.hpp"

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
	if (ids.empty()) push();
	else
		moveBase();
}

void GroundMotion::push()
{
	const Vector3r z = motion.acceleration(scene->time);
	if (scene->trackEnergy) bookWork(z);
	if (z == Vector3r::Zero()) return;
	for (const auto& b : *scene->bodies)
		if (movesFreely(*b)) scene->forces.addForce(b->getId(), -b->state->mass * z);
}

/// Work since the step before: mean of the accelerations at both ends times the displacement between. And what it adds to the kinetic energy in the half step
/// from the present velocities to the present, see EnergyLedger.
void GroundMotion::bookWork(const Vector3r& z)
{
	Vector3r momentum = Vector3r::Zero();
	for (const auto& b : *scene->bodies)
		if (movesFreely(*b)) momentum += b->state->mass * b->state->vel;
	int work = -1, kinetic = -1;
	if (lastStep == scene->iter - 1) scene->energy->add(lastDt / 2 * (lastAcceleration + z).dot(momentum), "groundWork", work);
	scene->energy->add(-scene->dt / 2 * z.dot(momentum), "kinetic", kinetic, true);
	lastStep         = scene->iter;
	lastDt           = scene->dt;
	lastAcceleration = z;
}

void GroundMotion::moveBase()
{
	const Vector3r velocity = (motion.displacement(scene->time + scene->dt) - motion.displacement(scene->time)) / scene->dt;
	for (const int id : ids) {
		if (!scene->bodies->exists(id)) throw std::invalid_argument("GroundMotion.ids: there is no body #" + std::to_string(id));
		State& s = *Body::byId(id, scene)->state;
		if (scene->trackEnergy) {
			// YADE counts the kinetic energy of bodies that forces do not move; BrickDynamics has taken it out, with the velocity that they had
			int entry = -1;
			scene->energy->add(s.mass / 2 * (s.vel.squaredNorm() - velocity.squaredNorm()), "kinetic", entry, true);
		}
		s.vel = velocity;
	}
}

} // namespace yade
