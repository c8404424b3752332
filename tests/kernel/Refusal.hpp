// SPDX-License-Identifier: GPL-2.0-or-later
// What a call refuses its input with.
#pragma once

#include <stdexcept>
#include <string>

namespace brick {

/// Message of the std::invalid_argument that the call throws; empty when it throws none.
template <class Call> std::string refusal(Call call)
{
	try {
		call();
	} catch (const std::invalid_argument& error) {
		return error.what();
	}
	return "";
}

} // namespace brick
