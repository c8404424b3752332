// SPDX-License-Identifier: GPL-2.0-or-later
// Time step from a proven bound on the frequencies of the present assembly: StepLimit.
#pragma once

#include "StepLimit.hpp"

#include <core/TimeStepper.hpp>

namespace yade {

class BrickTimeStepper : public TimeStepper {
public:
	void computeTimeStep(Scene*) override;
	void postLoad(BrickTimeStepper&);
	Real stableStep(int id);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BrickTimeStepper, TimeStepper, R"(Sets :yref:`O.dt<Omega.dt>` to :yref:`safety<BrickTimeStepper.safety>` times a proven lower bound of the largest stable step: each brick alone, every face that something touches standing on the stiffest springs that the bodies near it give (twice the springs to bodies that can move; all faces when nothing touches it), with its exact mass and inertia, its modes, and dashpots that lag by half a step. The stiffness of the inner hexahedra does not limit the step.

The step never grows during a run, so that a run continued from a file takes the same steps; for the same reason, stand it after :yref:`InteractionLoop`, where the present contacts are known. Raises an error when :yref:`O.engines<Omega.engines>` has no :yref:`BrickDynamics`.)",
		((Real, safety, .9, Attr::triggerPostLoad, "Fraction of the bound, in (0, 1]."))
		((Real, limit, std::numeric_limits<Real>::infinity(), Attr::readonly, "The bound [s]; infinite before the first step."))
		((int, limitingBrick, -1, Attr::readonly, "Id of the brick that sets it."))
		((int, limitingFace, -1, Attr::readonly, "The face of that brick (0 to 5: -x, +x, -y, +y, -z, +z) whose springs store most of the motion that sets it.")),
		/*ctor*/,
		/*py*/
		.def("stableStep", &BrickTimeStepper::stableStep, (boost::python::arg("id")), "The bound of one brick alone, as it is joined and touched at present [s]; infinite for a body that is no brick or does not move freely. Raises IndexError when there is no such body.")
	);
	// clang-format on

private:
	StepLimit present;
};
REGISTER_SERIALIZABLE(BrickTimeStepper);

} // namespace yade
