// SPDX-License-Identifier: GPL-2.0-or-later
// Text of a refusal: what is wrong, the value, what is allowed. Set-up code only.
#pragma once

#include <sstream>
#include <string>

namespace brick {

/// The parts one after the other, numbers with ten digits: enough to find a value again in the input.
template <class... Parts> std::string message(const Parts&... parts)
{
	std::ostringstream text;
	text.precision(10);
	(text << ... << parts);
	return text.str();
}

} // namespace brick
