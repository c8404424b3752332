// SPDX-License-Identifier: GPL-2.0-or-later
// Drawing and computing go on at the same time, in two threads. The 3-D view holds YADE's own locks while it paints (BodyContainer::drawloopmutex, for
// interactions also theirs), so no body and no interaction comes or goes meanwhile. What they do not cover is memory that a body or an interaction
// replaces in a step: a brick's nodes when its level of deformation changes, a joint when its last segment fails. This lock does.
//
// Held by drawing while it copies one brick or joint (Drawn.hpp), never while it draws, and by a step while it replaces such memory, which is rare: a step that
// only moves bricks and loads joints writes numbers in place and takes no lock. Numbers that are read in the middle of a step are as old or as new as may be, as
// YADE's own are.
#pragma once

#include <mutex>

namespace yade {

/// Locked as long as the object lives.
class DrawingLock {
public:
	DrawingLock()
	        : lock(mutex())
	{
	}

private:
	std::lock_guard<std::mutex> lock;
	static std::mutex&          mutex()
	{
		static std::mutex one;
		return one;
	}
};

} // namespace yade
