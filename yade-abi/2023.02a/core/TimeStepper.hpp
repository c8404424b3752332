// SPDX-License-Identifier: GPL-2.0-or-later
//
// Engine that sets the time step; a simulation has at most one.
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

class TimeStepper : public GlobalEngine {
public:
	bool         active                 = true;
	unsigned int timeStepUpdateInterval = 1;

	TimeStepper() { }
	YADE_HOST_CLASS(TimeStepper)
	YADE_HOST_ARCHIVE(GlobalEngine, (active)(timeStepUpdateInterval))
	bool         isActivated() override;
	void         action() override;
	virtual void computeTimeStep(Scene*);
};
YADE_ABI_SIZE(TimeStepper, 112)
YADE_ABI_OFFSET(TimeStepper, active, 104)
YADE_ABI_OFFSET(TimeStepper, timeStepUpdateInterval, 108)
REGISTER_SERIALIZABLE(TimeStepper)

} // namespace yade
