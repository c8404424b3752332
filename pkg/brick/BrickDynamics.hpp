// SPDX-License-Identifier: GPL-2.0-or-later
// Adds up what joints and contacts do to each body, and moves the deformation parts.                     [Furukawa2014, eqs. (10), (17)-(18)]
// Stands between InteractionLoop and NewtonIntegrator.
#pragma once

#include "EnergyGuard.hpp"
#include "EnergyLedger.hpp"
#include "StepWatch.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class BrickDynamics : public GlobalEngine {
public:
	void action() override;
	void postLoad(BrickDynamics&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BrickDynamics, GlobalEngine, R"(Forces and torques of all joints and contacts of bricks, summed for each body over its interactions in the order of ids (so that results do not depend on the number of threads), and one step of every brick's deformation modes, eqs. (17), (18). Must stand after :yref:`InteractionLoop` and before :yref:`NewtonIntegrator`, which moves the bricks as rigid bodies.

Looks after the run: warns, once, when :yref:`O.dt<Omega.dt>` was set by hand above the stable limit, and stops a run whose joints and contacts make energy from nothing (see :yref:`guard<BrickDynamics.guard>`). Raises an error, naming the body, when a brick lacks what it needs, a force is not finite, or the guard has found something; in the last two cases the scene is saved first.

While :yref:`O.trackEnergy<Omega.trackEnergy>`, ``O.energy`` gets, besides what YADE books itself (``kinetic``, ``gravWork``, ``nonviscDamp``) [J]: ``elastPotential`` of joints and contacts, ``deformElastic`` and ``deformKinetic`` of the bricks' deformation, and what was taken up to now: ``fracture``, ``plastDissip`` (friction), ``dashpots`` (of joints and contacts), ``deformDamping``, ``contactArea`` (shear of contacts whose area changes: an amount that may also fall, energy from nothing), ``levelChange`` (by springs and elements whose stiffness a change of level changed; may fall likewise); less what came in: ``supportWork`` through bodies that forces do not move, ``groundWork`` of :yref:`GroundMotion`. ``kinetic`` is moved on to the present step. ``O.energy.total()`` then stays constant but for the errors of a step; forces that other engines or scripts apply are not in it, and it is not exact over a change of :yref:`O.dt<Omega.dt>`, nor over saving and loading (work of dashpots in half a step).)",
		((Real, damping, 0, Attr::triggerPostLoad, "Local non-viscous damping of the modes [-], 0 to 1 exclusive, as :yref:`NewtonIntegrator.damping` for the rigid motion; 0 for dynamics."))
		((Real, levelTime, NaN, Attr::triggerPostLoad, "Time that a brick takes to change its level of deformation in a run [s]; NaN: four periods of the slowest mode of all bricks that change at the time; 0: at once, by which forces jump. See :yref:`Brick.share`."))
		((bool, guard, true, , "Whether to stop when, within at most 1000 steps, joints and contacts have done more work on the bodies than their springs and the bricks held, by ten times all energy there is to be had: the sign of an unstable time step, or of bricks that were put into each other."))
		((string, stopFile, "stopped.yade.gz", , "File that the scene is saved to when a run is stopped; empty: it is not saved."))
	);
	// clang-format on

private:
	std::vector<BodyStep> steps;         // by id
	long                  lastStep = -2; // that `steps` is of
	Real                  lastDt   = 0;

	EnergyGuard                       energyGuard;
	string                            alarm; // of the last step: the run stops before the next one changes anything
	EnergyLedger                      energyLedger;
	StepWatch                         stepWatch;

	// Who acts on each body, in the order of the others' ids, one body after the other: the maps of interactions are spread over the memory, and reading them in
	// every step would cost more than all sums. Found anew when there may be new interactions, or when one was not computed in this step.
	std::vector<shared_ptr<IPhys>> acting; // BrickPhys; shared, so that one that was erased meanwhile can be told by its step
	std::vector<int>               firstActing; // by id, and the end
	long                           physMade = -1;

	std::size_t interactionsKept = 0; // when those between bricks that are held apart were last dropped

	void prepare();
	bool isCurrent() const;
	void findActing();
	void prefetchFollowing(int id) const;
	void begin();
	void moveOn(Body&, BodyStep&);
	void moveBrickOn(Body&, Brick&, const brick::NodalVectors&, BodyStep&, int holding);
	void give(int id);
	void checkFree(Body::id_t);
	void book();
	void changeLevels();
	void countAnew(const Body&);
	void forgetStepLimit();
	void askForNewBounds(const Body&, const Brick&) const;
	void dropHeldApart();
	void takeUpReleased(const Body&);
	[[noreturn]] void stop(const string& why) const;
	string            textOf(const EnergyGuard::Gain&);
};
REGISTER_SERIALIZABLE(BrickDynamics);

} // namespace yade
