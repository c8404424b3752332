// SPDX-License-Identifier: GPL-2.0-or-later
#include "StaticEquilibrium.hpp"

#include "Gravity.hpp"

#include <core/Body.hpp>
#include <core/Scene.hpp>

#include "kernel/Message.hpp"

namespace yade {

YADE_PLUGIN((StaticEquilibrium));

void StaticEquilibrium::postLoad(StaticEquilibrium&)
{
	if (!(tolerance > 0 && tolerance < 1)) throw std::invalid_argument(brick::message("StaticEquilibrium.tolerance: ", tolerance, "; must be in (0, 1)"));
	if (mostIterations < 1) throw std::invalid_argument(brick::message("StaticEquilibrium.mostIterations: ", mostIterations, "; must be > 0"));
	if (!gravity.allFinite() && !gravity.array().isNaN().all())
		throw std::invalid_argument(brick::message("StaticEquilibrium.gravity: (", gravity.transpose(), "); must be finite"));
}

Vector3r StaticEquilibrium::presentGravity() const
{
	if (gravity.allFinite()) return gravity;
	if (const auto found = gravityOf(*scene)) return *found;
	throw std::invalid_argument("StaticEquilibrium.gravity is not given, and O.engines has no NewtonIntegrator to take it from");
}

brick::VectorX StaticEquilibrium::loads(const SceneAssembly& assembly) const
{
	const Vector3r g   = presentGravity();
	brick::VectorX out = brick::VectorX::Zero(assembly.structure.size());
	for (std::size_t i = 0; i < assembly.ids.size(); ++i)
		out.segment<3>(assembly.structure.place(int(i))) = assembly.structure.bricks()[i].mass * g;
	if (scene->forces.getPermForceUsed()) scene->forces.sync(); // sizes the arrays of forces given since the last step
	for (std::size_t i = 0; i < assembly.ids.size(); ++i) {
		const int at = assembly.structure.place(int(i));
		if (scene->forces.getPermForceUsed()) {
			out.segment<3>(at) += scene->forces.getPermForce(assembly.ids[i]);
			out.segment<3>(at + 3) += scene->forces.getPermTorque(assembly.ids[i]);
		}
		if (!out.segment<6>(at).allFinite())
			throw std::invalid_argument(brick::message("StaticEquilibrium: weight and permanent force of brick #", assembly.ids[i], " are not finite"));
	}
	return out;
}

void StaticEquilibrium::takeOver(const SceneAssembly& assembly)
{
	for (std::size_t i = 0; i < assembly.ids.size(); ++i) {
		const auto& part  = assembly.structure.bricks()[i];
		const auto& body  = Body::byId(assembly.ids[i], scene);
		State&      state = *body->state;
		state.pos         = part.position;
		state.ori         = part.orientation;
		state.vel = state.angVel = state.angMom = Vector3r::Zero();
		auto& shape = static_cast<Brick&>(*body->shape);
		shape.moved = true;
		if (part.modes) shape.setAmplitudes(part.amplitudes);
	}
	scene->doSort = true;
}

brick::Equilibrium StaticEquilibrium::settled(SceneAssembly& assembly) const
{
	try {
		return brick::settle(assembly.structure, loads(assembly), tolerance, mostIterations);
	} catch (const brick::Mechanism& mechanism) {
		throw std::runtime_error(brick::message(
		        "StaticEquilibrium: nothing resists a motion of brick #",
		        assembly.ids[mechanism.brick],
		        "; a joint with a single row of segments is a hinge (more Brick.segments make more rows)"));
	}
}

void StaticEquilibrium::action()
{
	SceneAssembly assembly = SceneAssembly::of(*scene);
	const int     loose    = assembly.structure.freeBrick();
	if (loose >= 0)
		throw std::runtime_error(
		        brick::message("StaticEquilibrium: brick #", assembly.ids[loose], " is not held: no chain of joints leads from it to a support"));
	const auto reached = settled(assembly);
	takeOver(assembly);
	iterations    = reached.iterations;
	imbalance     = reached.imbalance;
	overloaded    = assembly.structure.overloaded().total();
	elasticEnergy = assembly.structure.elasticEnergy();
	dead          = true;
}

} // namespace yade
