// SPDX-License-Identifier: GPL-2.0-or-later
//
// Time spent in an engine, measured by the scene if O.timingEnabled.
#pragma once

namespace yade {

class TimingDeltas;

struct TimingInfo {
	long               nExec = 0;
	unsigned long long nsec  = 0;
	static bool        enabled;
};

} // namespace yade
