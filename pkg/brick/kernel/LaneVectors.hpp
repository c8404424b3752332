// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors of `lanes` numbers, a constant of the file that includes this one, once for each instruction set (InstructionSets.hpp). Operations are lane by lane,
// so every set gives the same.

typedef Real      Lanes __attribute__((vector_size(lanes * sizeof(Real))));
typedef long long Mask __attribute__((vector_size(lanes * sizeof(Real)))); ///< of comparisons: -1 where true

BRICK_INLINE Lanes allLanes(Real x) { return x - Lanes {}; }
BRICK_INLINE Mask  allLanes(long long x) { return x - Mask {}; }

BRICK_INLINE Lanes loadLanes(const Real* from)
{
	Lanes x;
	__builtin_memcpy(&x, from, sizeof x);
	return x;
}

BRICK_INLINE void storeLanes(Real* to, const Lanes& x) { __builtin_memcpy(to, &x, sizeof x); }

BRICK_INLINE Lanes root(const Lanes& x)
{
	Lanes y;
	for (int i = 0; i < lanes; ++i)
		y[i] = __builtin_sqrt(x[i]);
	return y;
}

BRICK_INLINE Lanes lesser(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
BRICK_INLINE Lanes greater(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

/// Factor that shortens a vector of this length to a largest length: Coulomb's limit.
BRICK_INLINE Lanes shortening(const Lanes& length, const Lanes& largest) { return length > largest ? largest / length : allLanes(Real(1)); }
