// SPDX-License-Identifier: GPL-2.0-or-later
// Adds up what joints and contacts do to each body, and moves the deformation parts.                     [Furukawa2014, eqs. (10), (17)-(18)]
// Stands between InteractionLoop and NewtonIntegrator.
#pragma once

#include "BrickContact.hpp"

#include <core/GlobalEngine.hpp>

namespace yade {

class BrickDynamics : public GlobalEngine {
public:
	void action() override;
	void postLoad(BrickDynamics&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BrickDynamics, GlobalEngine, R"(Forces and torques of all joints and contacts of bricks, summed for each body over its interactions in the order of ids (so that results do not depend on the number of threads), and one step of every brick's deformation modes, eqs. (17), (18). Must stand after :yref:`InteractionLoop` and before :yref:`NewtonIntegrator`, which moves the bricks as rigid bodies.

Raises an error, naming the body, when a brick lacks what it needs or a force is not finite.)",
		((Real, damping, 0, Attr::triggerPostLoad, "Local non-viscous damping of the modes [-], 0 to 1 exclusive, as :yref:`NewtonIntegrator.damping` for the rigid motion; 0 for dynamics."))
	);
	// clang-format on

private:
	struct Sum {
		Vector3r force, torque;
		bool     any;      // some joint or contact acts on the body
		bool     released; // a brick that its joints hold apart from others no more
	};
	std::vector<Sum> sums; // by id

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
	void moveOn(Body&, Sum&);
	void askForNewBounds(const Body&, const Brick&) const;
	void dropHeldApart();
	void takeUpReleased(const Body&);
};
REGISTER_SERIALIZABLE(BrickDynamics);

} // namespace yade
