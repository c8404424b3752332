// SPDX-License-Identifier: GPL-2.0-or-later
#include "InnerMotion.hpp"

#define BRICK_LANES_FILE "ModeColumnsLanes.hpp"
#include "ForEachInstructionSet.hpp"

namespace brick {

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

void advanceModes(const std::vector<Real>& omegaSquared, const Real* loads, Real zeta, Real localDamping, Real dt, Real* amplitudes, Real* rates)
{
	const int count = int(omegaSquared.size());
	int       k     = localDamping == 0 ? BRICK_BEST_INSTRUCTION_SET(advanceGroups)(omegaSquared.data(), count, loads, zeta, dt, amplitudes, rates) : 0;
	for (; k < count; ++k) {
		const ModeState next = advanced({ amplitudes[k], rates[k] }, loads[k], omegaSquared[k], zeta, localDamping, dt);
		amplitudes[k]        = next.amplitude;
		rates[k]             = next.rate;
	}
}

ModeEnergy modeEnergy(
        const std::vector<Real>& omegaSquared, const Real* load, const Real* amplitude, const Real* rateBefore, const Real* rateAfter, Real zeta, Real localDamping, Real dt)
{
	ModeEnergy out;
	for (std::size_t k = 0; k < omegaSquared.size(); ++k) {
		const Real force = load[k] - omegaSquared[k] * amplitude[k], mean = (rateBefore[k] + rateAfter[k]) / 2;
		const Real damping = 2 * zeta * std::sqrt(omegaSquared[k]) * mean
		        + std::copysign(localDamping, force * (rateBefore[k] + dt / 2 * force)) * force; // against the motion
		out.kinetic += (1 + dt * dt * omegaSquared[k] / 4) * rateBefore[k] * rateAfter[k] / 2;
		out.elastic += omegaSquared[k] * amplitude[k] * amplitude[k] / 2;
		out.dampedBefore += damping * dt / 2 * rateBefore[k];
		out.dampedAfter += damping * dt / 2 * rateAfter[k];
	}
	return out;
}

Real stiffeningEnergy(const std::vector<Real>& omegaSquared, Real change, const Real* amplitude, const Real* rateBefore, Real dt)
{
	Real sum = 0;
	for (std::size_t k = 0; k < omegaSquared.size(); ++k) {
		const Real mean = amplitude[k] - dt / 2 * rateBefore[k];
		sum += omegaSquared[k] * mean * mean;
	}
	return change / 2 * sum;
}

void ModeColumns::sum(const std::vector<Real>& columns, int rows, int count, const Real* x, Real* y)
{
	BRICK_BEST_INSTRUCTION_SET(sumAllColumns)(columns.data(), rows, count, x, y);
}

} // namespace brick
