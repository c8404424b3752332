// SPDX-License-Identifier: GPL-2.0-or-later
// One step of a deformation mode:  q'' + 2 zeta omega q' + omega^2 q = f.                [Furukawa2014, eq. (18), mode by mode]
//
// Leap-frog for the load, midpoint rule for the mode's own stiffness and damping; in both this is leap-frog with the inertia 1 + dt^2 omega^2 / 4 in place
// of 1. With contact springs K_c attached, dt^2/4 (omega^2 + K_c) <= 1 + dt^2 omega^2 / 4  holds exactly when  dt^2/4 K_c <= 1: the hexahedron does not
// limit dt, whatever Poisson's ratio; only springs on masses do. (An exact step for a load held over the step would also free dt from omega, but
// lowers the limit that the springs set, and near dt omega = 2 pi does not answer to the load at all.) Statics is untouched.
#pragma once

#include "Modes.hpp"

#include <cmath>
#include <vector>

namespace brick {

struct ModeState {
	Real amplitude = 0; ///< q_n [sqrt(kg) m]
	Real rate      = 0; ///< q' at n - 1/2 [sqrt(kg) m/s]
};

/// @param load phi^T f at step n   @param zeta fraction of critical damping   @return q at n + 1, q' at n + 1/2
/// @param localDamping of the net force against the motion, as NewtonIntegrator.damping; 0 for dynamics
inline ModeState advanced(const ModeState& mode, Real load, Real omegaSquared, Real zeta, Real localDamping, Real dt)
{
	const Real inertia = 1 + dt * dt * omegaSquared / 4;
	const Real damping = zeta == 0 ? 0 : zeta * std::sqrt(omegaSquared) * dt;
	Real       force   = load - omegaSquared * mode.amplitude;
	if (localDamping != 0) force *= 1 - std::copysign(localDamping, force * (mode.rate + dt / 2 * force));
	ModeState next;
	next.rate      = ((inertia - damping) * mode.rate + dt * force) / (inertia + damping);
	next.amplitude = mode.amplitude + dt * next.rate;
	return next;
}

/// Energy of modes at step n, where they have both rates, those of n - 1/2 and n + 1/2: with the inertia I of advanced(), I q'- q'+ / 2 and omega^2 q^2 / 2
/// change from step to step by the work of loads and damping alone, each the mean of its values at both ends times the change of q.
struct ModeEnergy {
	Real kinetic = 0, elastic = 0;           ///< [J]
	Real dampedBefore = 0, dampedAfter = 0; ///< what the damping of this step takes from the half step before it and from the one after it [J]
	Real stiffened = 0;                     ///< what a change of their stiffness since the step before has put in [J]
};
/// @param load, amplitude, rateBefore, rateAfter of each mode; amplitudes at step n
ModeEnergy modeEnergy(
        const std::vector<Real>& omegaSquared, const Real* load, const Real* amplitude, const Real* rateBefore, const Real* rateAfter, Real zeta, Real localDamping, Real dt);

/// What a change of the modes' stiffness puts in, at step n [J]: with the energies above, half the change of omega^2 times the squared mean of the amplitudes at
/// n - 1 and n.
/// @param change of the factor on omega^2   @param dt of the step to n
Real stiffeningEnergy(const std::vector<Real>& omegaSquared, Real change, const Real* amplitude, const Real* rateBefore, Real dt);

/// All modes of a brick, the same.
/// @param amplitudes, rates of each; replaced
void advanceModes(const std::vector<Real>& omegaSquared, const Real* loads, Real zeta, Real localDamping, Real dt, Real* amplitudes, Real* rates);

/// Mode shapes laid out for a step: columns padded to whole groups of lanes, by modes for the displacements and by nodes for the loads.
class ModeColumns {
public:
	ModeColumns() = default; ///< no modes of no nodes
	ModeColumns(const Real* shapes, int dofs, int modes);
	int  modes() const { return modeTotal; }
	int  dofs() const { return dofTotal; }
	int  paddedModes() const { return padded(modeTotal); }
	int  paddedDofs() const { return padded(dofTotal); }
	void loads(const Real* nodal, Real* modal) const { sum(byNode, paddedModes(), dofTotal, nodal, modal); } ///< phi^T f; writes paddedModes() entries
	void displacements(const Real* modal, Real* nodal) const { sum(byMode, paddedDofs(), modeTotal, modal, nodal); } ///< phi q; writes paddedDofs() entries

	static constexpr int lanes = 8;

private:
	static int  padded(int n) { return (n + lanes - 1) / lanes * lanes; }
	static void sum(const std::vector<Real>& columns, int rows, int count, const Real* x, Real* y);

	int               dofTotal = 0, modeTotal = 0;
	std::vector<Real> byNode, byMode;
};

} // namespace brick
