// SPDX-License-Identifier: GPL-2.0-or-later
//
// The 3-D view. It collects its drawing functors once, at the first painting.
#pragma once

namespace yade {

class OpenGLRenderer {
public:
	static bool initDone;
};

} // namespace yade
