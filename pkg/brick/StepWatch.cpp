// SPDX-License-Identifier: GPL-2.0-or-later
#include "StepWatch.hpp"

#include "kernel/Message.hpp"

#include <core/TimeStepper.hpp>

#include <iostream>

namespace yade {

namespace {

	constexpr long looksApart = 1000; // steps: contacts come and go
	constexpr Real roundOff   = 1e-12;

	bool isSetByStepper(const Scene& scene)
	{
		for (const auto& engine : scene.engines)
			if (engine->getClassName() == "BrickTimeStepper" && !engine->dead) return static_cast<const TimeStepper&>(*engine).active;
		return false;
	}

	const char* nameOfFace(int face)
	{
		static const char* const names[] { "-x", "+x", "-y", "+y", "-z", "+z" };
		return names[face];
	}

} // namespace

string StepWatch::problem(Scene& scene)
{
	limit.update(scene);
	if (!(scene.dt > limit.seconds * (1 + roundOff))) return "";
	return brick::message(
	        "O.dt = ",
	        scene.dt,
	        " s is above ",
	        limit.seconds,
	        " s, up to which this scene is proven to be stable (brick #",
	        limit.brickId,
	        ", springs on its face ",
	        nameOfFace(limit.face),
	        ")");
}

void StepWatch::look(Scene& scene)
{
	if (scene.dt == seen && scene.iter < next) return;
	warned = warned && scene.dt == seen;
	seen   = scene.dt;
	next   = scene.iter + looksApart;
	if (warned || isSetByStepper(scene)) return;
	const string found = problem(scene);
	if (found.empty()) return;
	warned = true;
	std::cerr << "<WARNING> BrickDynamics: " << found << ". Springs may swing up and make energy: set a smaller O.dt, or leave it to BrickTimeStepper." << std::endl;
}

} // namespace yade
