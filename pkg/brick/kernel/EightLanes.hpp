// SPDX-License-Identifier: GPL-2.0-or-later
// Eight numbers at once, and what can be asked of them, for files that are included once for each instruction set (InstructionSets.hpp) and include this one.

constexpr int lanes = 8;

#include "LaneVectors.hpp"

constexpr Mask laneNumbers { 0, 1, 2, 3, 4, 5, 6, 7 };

/// In halves: the same order whatever the instruction set.
BRICK_INLINE Real sumOf(const Lanes& x)
{
	Lanes y = x + __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3);
	y += __builtin_shufflevector(y, y, 2, 3, 0, 1, 6, 7, 4, 5);
	return y[0] + y[1];
}
BRICK_INLINE Real leastOf(const Lanes& x)
{
	Lanes y = lesser(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
	y       = lesser(y, __builtin_shufflevector(y, y, 2, 3, 0, 1, 6, 7, 4, 5));
	return y[0] < y[1] ? y[0] : y[1];
}
BRICK_INLINE Real mostOf(const Lanes& x) { return -leastOf(-x); }

/// Bit i is lane i.
BRICK_INLINE unsigned bitsOf(const Mask& m)
{
	Mask bits = m & Mask { 1, 2, 4, 8, 16, 32, 64, 128 };
	bits |= __builtin_shufflevector(bits, bits, 4, 5, 6, 7, 0, 1, 2, 3);
	bits |= __builtin_shufflevector(bits, bits, 2, 3, 0, 1, 6, 7, 4, 5);
	return unsigned(bits[0] | bits[1]);
}

/// Coefficients of a field that is bilinear over a face, from its values at the four nodes: c0 + c1 xi + (c2 + c3 xi) eta.
struct BilinearField {
	Real                 c[4];
	static BilinearField of(Real v0, Real v1, Real v2, Real v3)
	{
		return { { ((v0 + v1) + (v2 + v3)) / 4, ((v1 - v0) + (v2 - v3)) / 4, ((v3 - v0) + (v2 - v1)) / 4, ((v0 - v1) + (v2 - v3)) / 4 } };
	}
	BRICK_INLINE Lanes at(const Lanes& xi, const Lanes& eta) const { return (c[0] + c[1] * xi) + (c[2] + c[3] * xi) * eta; }
};
