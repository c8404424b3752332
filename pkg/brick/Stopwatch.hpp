// SPDX-License-Identifier: GPL-2.0-or-later
// Time spent in a piece of the parallel loop, summed over threads, while O.timingEnabled.
#pragma once

#include <core/Timing.hpp>

#include <chrono>

namespace yade {

class Stopwatch {
	using Clock = std::chrono::steady_clock;

public:
	/// @param total where the time between now and the end of this object is added [s]
	explicit Stopwatch(double& total)
	        : total(total)
	        , running(TimingInfo::enabled)
	{
		if (running) start = Clock::now();
	}
	~Stopwatch()
	{
		if (!running) return;
		const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
#pragma omp atomic
		total += elapsed;
	}
	Stopwatch(const Stopwatch&) = delete;

private:
	double&           total;
	bool              running;
	Clock::time_point start;
};

} // namespace yade
