// SPDX-License-Identifier: GPL-2.0-or-later
// Sums of columns: included by InnerMotion.cpp once for each instruction set (InstructionSets.hpp).

constexpr int lanes = ModeColumns::lanes;

#include "LaneVectors.hpp"

/// y = sum of the columns times x, for so many groups of rows at a time.
template <int groups> BRICK_INLINE void sumColumns(const Real* columns, int rows, int count, const Real* x, Real* y)
{
	Lanes total[groups] {};
	for (int j = 0; j < count; ++j)
		for (int g = 0; g < groups; ++g)
			total[g] += x[j] * loadLanes(columns + std::size_t(j) * rows + g * lanes);
	for (int g = 0; g < groups; ++g)
		storeLanes(y + g * lanes, total[g]);
}

inline void sumAllColumns(const Real* columns, int rows, int count, const Real* x, Real* y)
{
	int at = 0;
	for (; at + 3 * lanes <= rows; at += 3 * lanes)
		sumColumns<3>(columns + at, rows, count, x, y + at);
	for (; at < rows; at += lanes)
		sumColumns<1>(columns + at, rows, count, x, y + at);
}
