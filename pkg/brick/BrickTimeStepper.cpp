// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickTimeStepper.hpp"

#include <core/Omega.hpp>

namespace yade {

YADE_PLUGIN((BrickTimeStepper));

void BrickTimeStepper::postLoad(BrickTimeStepper&)
{
	if (!(safety > 0 && safety <= 1)) throw std::invalid_argument("BrickTimeStepper.safety: " + std::to_string(safety) + "; must be in (0, 1]");
}

void BrickTimeStepper::computeTimeStep(Scene* scene)
{
	if (!scene->engineByName("BrickDynamics"))
		throw std::runtime_error("BrickTimeStepper: there is no BrickDynamics in O.engines, so no force of joints and contacts would reach the bricks; "
		                         "put it before NewtonIntegrator");
	present.seconds = limit, present.brickId = limitingBrick, present.face = limitingFace; // as loaded
	present.update(*scene);
	limit = present.seconds, limitingBrick = present.brickId, limitingFace = present.face;
	if (limit < std::numeric_limits<Real>::infinity()) scene->dt = safety * limit;
}

Real BrickTimeStepper::stableStep(int id)
{
	Scene& now = *Omega::instance().getScene();
	if (id < 0 || !now.bodies->exists(id)) throw std::out_of_range("BrickTimeStepper.stableStep: there is no body #" + std::to_string(id));
	return present.ofBrick(*Body::byId(id, &now), now);
}

} // namespace yade
