// SPDX-License-Identifier: GPL-2.0-or-later
#include "EnergyLedger.hpp"

#include "Gravity.hpp"
#include "RigidMotion.hpp"

namespace yade {

namespace {

	void add(Scene& scene, Real value, const char* name, bool present)
	{
		int id = -1; // not kept: O.energy.clear() would leave it behind
		scene.energy->add(value, name, id, present);
	}

	constexpr bool present = true, accumulated = false;

} // namespace

struct EnergyLedger::Sums {
	Real     dt = 0, lastDt = 0; // of this step and of the one before, 0 if that was not booked
	Vector3r gravity { Vector3r::Zero() };
	Real     kinetic = 0, supportWork = 0;
	Vector3r heldMomentum { Vector3r::Zero() }; // of bodies that forces do not move
	Real     modesKinetic = 0, modesElastic = 0, modesDamping = 0, modesStiffened = 0;
};

void EnergyLedger::addFree(Scene& scene, const Body& b, const BodyStep& step, Sums& sums)
{
	const State& s     = *b.state;
	Vector3r     force = step.force + s.mass * sums.gravity;
	if (scene.forces.getPermForceUsed()) force += scene.forces.getPermForce(b.getId());
	sums.kinetic += sums.dt / 2 * (force.dot(s.vel) + step.torque.dot(s.angVel));
}

void EnergyLedger::addHeld(const Body& b, const BodyStep& step, Sums& sums)
{
	const State& s = *b.state;
	sums.supportWork += sums.lastDt / 2 * (step.lastPower + step.power);
	sums.heldMomentum += s.mass * s.vel;
	// YADE counts it, although nothing can be had from it
	sums.kinetic -= rigidKineticEnergy(s);
}

void EnergyLedger::addModes(Sums& sums)
{
	sums.modesDamping = dampedLate, dampedLate = 0;
	for (const auto& m : modes) {
		sums.modesKinetic += m.kinetic, sums.modesElastic += m.elastic, sums.modesDamping += m.dampedBefore;
		sums.modesStiffened += m.stiffened;
		dampedLate += m.dampedAfter;
	}
}

void EnergyLedger::book(Scene& scene, Real lastDt, const std::vector<BodyStep>& steps, const std::vector<const BrickPhys*>& acting)
{
	const bool continues = lastStep == scene.iter - 1;
	if (!continues) dampedLate = 0;
	if (scene.forces.getPermForceUsed()) scene.forces.sync(); // sizes the arrays of forces given since the last step
	Sums sums;
	sums.dt      = scene.dt;
	sums.lastDt  = continues ? lastDt : 0;
	sums.gravity = gravityOf(scene).value_or(Vector3r::Zero());
	for (const auto& b : *scene.bodies) {
		const auto id = b->getId();
		if (movesFreely(*b)) addFree(scene, *b, steps[id], sums);
		else if (!b->isDynamic())
			addHeld(*b, steps[id], sums);
	}
	addModes(sums);
	brick::PairEnergy pairs;
	for (const BrickPhys* phys : acting)
		if (phys->ledger) pairs += phys->isJoint() ? phys->ledger->joint.energy : phys->ledger->contact.energy;
	add(scene, sums.kinetic, "kinetic", present);
	add(scene, sums.modesKinetic, "deformKinetic", present);
	add(scene, sums.modesElastic, "deformElastic", present);
	add(scene, sums.modesDamping, "deformDamping", accumulated);
	add(scene, pairs.elastic, "elastPotential", present);
	add(scene, pairs.fracture, "fracture", accumulated);
	add(scene, pairs.friction, "plastDissip", accumulated);
	add(scene, pairs.dashpot, "dashpots", accumulated);
	add(scene, pairs.area, "contactArea", accumulated);
	add(scene, pairs.level - sums.modesStiffened + std::exchange(dropped, 0), "levelChange", accumulated);
	add(scene, sums.supportWork, "supportWork", accumulated);
	// YADE counts bodies that are held, too
	add(scene, sums.gravity.dot(sums.heldMomentum) * scene.dt, "gravWork", accumulated);
	lastStep = scene.iter;
}

} // namespace yade
