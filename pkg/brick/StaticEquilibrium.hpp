// SPDX-License-Identifier: GPL-2.0-or-later
// Brings a jointed structure to rest under its weight at once.
#pragma once

#include "IntactAssembly.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class StaticEquilibrium : public GlobalEngine {
public:
	void action() override;
	void postLoad(StaticEquilibrium&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(StaticEquilibrium, GlobalEngine, R"(Moves all bricks to where mortar joints and deformation carry their weight and the permanent forces and torques (``O.forces.setPermF``), and takes velocities away: self weight in one call, after :yref:`MortarJoints` and before the first step: ``StaticEquilibrium()()``. As one of ``O.engines`` it works once and is then :yref:`dead<Engine.dead>`.

The joints are taken to hold, whatever their strength: those that are beyond it are counted in :yref:`overloaded<StaticEquilibrium.overloaded>` and crack in the first step. Newton's method with a sparse factorisation; the state is an equilibrium of the engine loop to round-off. It is meant for structures that deform little, as masonry does: one that sags by a good part of its size is refused. Dry contacts are not part of it: settle those in the loop, with damping.

Raises ValueError when bricks touch without mortar or a joint has failed in part, RuntimeError naming the brick when the structure can move freely, or finds no equilibrium; the scene is then as it was.)",
		((Vector3r, gravity, Vector3r::Constant(NaN), Attr::triggerPostLoad, "Gravity [m/s2]; NaN: that of the scene's :yref:`NewtonIntegrator`."))
		((Real, tolerance, 1e-6, Attr::triggerPostLoad, "Largest allowed :yref:`imbalance<StaticEquilibrium.imbalance>` [-], in (0, 1). Iterations go on below it as long as they help: round-off ends them."))
		((int, mostIterations, 30, Attr::triggerPostLoad, "Iterations after which it gives up, > 0."))
		((int, iterations, 0, Attr::readonly, "Iterations of the last call."))
		((Real, imbalance, NaN, Attr::readonly, "What is left of the loads after the last call [-], in the energy norm: :math:`\\sqrt{r K^{-1} r / f K^{-1} f}` with residual r and loads f."))
		((int, overloaded, 0, Attr::readonly, "Segments of mortar beyond their strength in this state."))
		((Real, elasticEnergy, NaN, Attr::readonly, "Of joints and deformation in this state [J]."))
	);
	// clang-format on

private:
	Vector3r           presentGravity() const;
	brick::VectorX     loads(const SceneAssembly&) const;
	brick::Equilibrium settled(SceneAssembly&) const;
	void               takeOver(const SceneAssembly&);
};
REGISTER_SERIALIZABLE(StaticEquilibrium);

} // namespace yade
