// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickDynamics.hpp"

#include <core/Body.hpp>

namespace yade {

YADE_PLUGIN((BrickDynamics));

namespace {

	[[noreturn]] void refuse(const Body& b, const string& problem)
	{
		throw std::invalid_argument("Body #" + std::to_string(b.getId()) + " (Brick): " + problem);
	}

	const BrickMat& checkedMaterial(const Body& b, const Brick& shape)
	{
		const auto* material = dynamic_cast<const BrickMat*>(b.material.get());
		if (!material) refuse(b, "its material must be a BrickMat");
		if (!shape.solid) refuse(b, "it has no corners");
		const State& s = *b.state;
		if (b.isDynamic() && !(s.mass > 0 && s.inertia.minCoeff() > 0))
			refuse(b, "mass " + std::to_string(s.mass) + " kg and inertia must be positive (use yade_brick.brick to make bodies)");
		return *material;
	}

} // namespace

void BrickDynamics::postLoad(BrickDynamics&)
{
	if (!(damping >= 0 && damping < 1)) throw std::invalid_argument("BrickDynamics.damping: " + std::to_string(damping) + "; must be in [0, 1)");
}

/// Bodies that take part: bricks, and whatever they touch. Serial, since it may find out the modes of a new type of brick.
void BrickDynamics::gather()
{
	members.clear();
	for (const auto& b : *scene->bodies) {
		if (!b || !b->shape) continue;
		Brick* shape = dynamic_cast<Brick*>(b->shape.get());
		if (!shape && b->intrs.empty()) continue;
		Member m { b.get(), shape, 0, {} };
		if (shape) {
			const BrickMat& material = checkedMaterial(*b, *shape);
			shape->innerPart(material);
			m.dampingRatio = material.dampingRatio;
		}
		members.push_back(m);
	}
}

void BrickDynamics::sum(Member& m) const
{
	const Body::id_t id = m.body->getId();
	for (const auto& item : m.body->intrs) {
		const auto* phys = dynamic_cast<const BrickPhys*>(item.second->phys.get());
		if (!phys || !item.second->geom) continue;
		const brick::Loads& loads = phys->loads[phys->ids[0] == id ? 0 : 1];
		m.total.force += loads.force;
		m.total.torque += loads.torque;
		if (m.brick && m.brick->isDeformable())
			for (int a = 0; a < brick::nodeCount; ++a)
				m.total.nodal[a] += loads.nodal[a];
	}
}

/// The collider's strides watch centres only; a brick that turns or bulges out of its box asks for a new run.
void BrickDynamics::askForNewBounds(const Member& m) const
{
	const auto& bound = m.body->bound;
	if (!m.brick || !bound || bound->lastUpdateIter == scene->iter) return;
	for (const Vector3r& x : m.brick->worldCorners(m.body->state))
		if ((x.array() < bound->min.array()).any() || (x.array() > bound->max.array()).any()) {
			scene->doSort = true;
			return;
		}
}

void BrickDynamics::action()
{
	gather();
	const int count = int(members.size());
#pragma omp parallel for schedule(static) if (count > 200)
	for (int i = 0; i < count; ++i) {
		Member& m = members[i];
		sum(m);
		if (m.brick && m.brick->isDeformable()) m.brick->advance(m.total.nodal, m.dampingRatio, damping, scene->dt);
	}
	// one thread writes all forces, so that sums with other engines' forces have one order too
	for (const Member& m : members) {
		if (!m.total.force.allFinite() || !m.total.torque.allFinite())
			throw std::runtime_error(
			        "BrickDynamics: the force on body #" + std::to_string(m.body->getId()) + " is not finite in step " + std::to_string(scene->iter)
			        + "; is the time step above the limit (BrickTimeStepper.limit)?");
		scene->forces.addForce(m.body->getId(), m.total.force);
		scene->forces.addTorque(m.body->getId(), m.total.torque);
		if (!scene->doSort && !scene->isPeriodic) askForNewBounds(m);
	}
}

} // namespace yade
