// SPDX-License-Identifier: GPL-2.0-or-later
// What counts as equal, and as nothing, among squared frequencies and mode shapes: for all that finds modes (Modes.cpp, CondensedPart.cpp).
#pragma once

#include "Message.hpp"
#include "Types.hpp"

#include <stdexcept>

namespace brick {

/// Neighbouring squared frequencies closer than this, relatively, are one frequency. The solver leaves 1e-15 of the largest, 1e-13 of the softest unless
/// nu is close to 0.5; there equal frequencies may count as two, which costs the rule for their shapes and nothing else.
constexpr Real sameFrequency = 1e-10;

/// Difference of entries across the diagonal, of the largest entry, that counts as round-off.
constexpr Real symmetryTolerance = 1e-10;

/// Components (or their squares) this close to the largest, relatively, are equal to it: symmetric shapes have such ties, and round-off must not decide them.
constexpr Real sameComponent = 1e-6;

/// @param frequencies squared, ascending [1/s2]   @param noFrequency those below this, of the largest, are none
/// @throws std::invalid_argument when the first is none
inline void requireStiffness(const VectorX& frequencies, Real noFrequency)
{
	const Real largest = frequencies[frequencies.size() - 1];
	if (frequencies[0] > noFrequency * largest) return;
	throw std::invalid_argument(
	        message("a deformation meets no stiffness: omega^2 is ",
	                frequencies[0],
	                " 1/s2; it must be above ",
	                noFrequency,
	                " of the largest, ",
	                largest));
}

/// How many squared frequencies from `first` on are one.
inline int countOfSame(const VectorX& frequencies, int first)
{
	int size = 1;
	while (first + size < frequencies.size() && frequencies[first + size] - frequencies[first + size - 1] <= sameFrequency * frequencies[first + size])
		++size;
	return size;
}

} // namespace brick
