// SPDX-License-Identifier: GPL-2.0-or-later
//
// One item of the simulation loop.
#pragma once

#include <core/Omega.hpp>
#include <core/Timing.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Engine : public Serializable {
public:
	Scene*                   scene; // set before isActivated and action are called
	TimingInfo               timingInfo;
	shared_ptr<TimingDeltas> timingDeltas;
	bool                     dead;
	int                      ompThreads;
	std::string              label;

	Engine();
	YADE_HOST_CLASS(Engine)
	YADE_HOST_ARCHIVE(Serializable, (dead)(ompThreads)(label))
	virtual bool isActivated();
	virtual void action();
};
YADE_ABI_SIZE(Engine, 104)
YADE_ABI_OFFSET(Engine, scene, 24)
YADE_ABI_OFFSET(Engine, timingInfo, 32)
YADE_ABI_OFFSET(Engine, dead, 64)
YADE_ABI_OFFSET(Engine, label, 72)
REGISTER_SERIALIZABLE(Engine)

} // namespace yade
