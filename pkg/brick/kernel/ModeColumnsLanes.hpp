// SPDX-License-Identifier: GPL-2.0-or-later
// Sums of columns, and the modes' own step: included by InnerMotion.cpp once for each instruction set (InstructionSets.hpp).

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

/// advanced() without local damping, of whole groups of modes; the number of modes moved.
inline int advanceGroups(const Real* omegaSquared, int count, const Real* loads, Real zeta, Real dt, Real* amplitudes, Real* rates)
{
	int first = 0;
	for (; first + lanes <= count; first += lanes) {
		const Lanes square = loadLanes(omegaSquared + first), q = loadLanes(amplitudes + first);
		const Lanes inertia = 1 + dt * dt * square / 4, damping = zeta == 0 ? Lanes {} : zeta * root(square) * dt;
		const Lanes rate    = ((inertia - damping) * loadLanes(rates + first) + dt * (loadLanes(loads + first) - square * q)) / (inertia + damping);
		storeLanes(rates + first, rate);
		storeLanes(amplitudes + first, q + dt * rate);
	}
	return first;
}
