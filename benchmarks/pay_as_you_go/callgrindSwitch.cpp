// SPDX-License-Identifier: GPL-2.0-or-later
// Starts and ends callgrind's counting from Python (ctypes), so that neither YADE's start nor the making of a scene is instrumented, and one process counts many
// scenes. Without valgrind these do nothing.
#include <valgrind/callgrind.h>

extern "C" {

void startCounting()
{
	CALLGRIND_START_INSTRUMENTATION;
	CALLGRIND_ZERO_STATS;
}

/// Writes what was counted since to a file of callgrind's, with this name as its trigger.
void endCounting(const char* name)
{
	CALLGRIND_DUMP_STATS_AT(name);
	CALLGRIND_STOP_INSTRUMENTATION;
}
}
