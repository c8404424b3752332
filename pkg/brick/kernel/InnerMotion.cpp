// SPDX-License-Identifier: GPL-2.0-or-later
#include "InnerMotion.hpp"

#include "InstructionSets.hpp"

namespace brick {

namespace {

	constexpr int lanes = ModeColumns::lanes;
	typedef Real  Lanes __attribute__((vector_size(lanes * sizeof(Real))));

	/// y = sum of the columns times x, for so many groups of rows at a time.
	template <int groups> BRICK_INLINE void sumColumns(const Real* columns, int rows, int count, const Real* x, Real* y)
	{
		Lanes total[groups] {};
		for (int j = 0; j < count; ++j)
			for (int g = 0; g < groups; ++g) {
				Lanes column;
				__builtin_memcpy(&column, columns + std::size_t(j) * rows + g * lanes, sizeof column);
				total[g] += x[j] * column;
			}
		__builtin_memcpy(y, total, sizeof total);
	}

	BRICK_ANY_INSTRUCTION_SET
	void sumAllColumns(const Real* columns, int rows, int count, const Real* x, Real* y)
	{
		int at = 0;
		for (; at + 3 * lanes <= rows; at += 3 * lanes)
			sumColumns<3>(columns + at, rows, count, x, y + at);
		for (; at < rows; at += lanes)
			sumColumns<1>(columns + at, rows, count, x, y + at);
	}

} // namespace

ModeColumns::ModeColumns(const Real* shapes, int dofs, int modes)
        : dofTotal(dofs)
        , modeTotal(modes)
        , byNode(std::size_t(paddedModes()) * dofs, 0)
        , byMode(std::size_t(paddedDofs()) * modes, 0)
{
	for (int k = 0; k < modes; ++k)
		for (int j = 0; j < dofs; ++j)
			byNode[std::size_t(j) * paddedModes() + k] = byMode[std::size_t(k) * paddedDofs() + j] = shapes[std::size_t(k) * dofs + j];
}

void ModeColumns::sum(const std::vector<Real>& columns, int rows, int count, const Real* x, Real* y) { sumAllColumns(columns.data(), rows, count, x, y); }

} // namespace brick
