// SPDX-License-Identifier: GPL-2.0-or-later
// Fills O.energy with what joints, contacts and deformation hold and take, so that O.energy.total() stays constant: see BrickDynamics.
//
// YADE's integrator books the kinetic energy of half a step before; this is what the ledger moves on to the present step, where positions, and so all springs,
// are known. The sum then changes only by the errors of a nonlinear step (kernel/PairLedger.hpp).
#pragma once

#include "BodyStep.hpp"
#include "BrickContact.hpp"

namespace yade {

class EnergyLedger {
public:
	/// Room for the modes of each body in this step.
	std::vector<brick::ModeEnergy> modes;

	/// Books a step.
	/// @param before, now what acted on each body in the step before and in this one   @param acting interactions that act in this step, each once
	void book(Scene&, const std::vector<BodyStep>& before, const std::vector<BodyStep>& now, const std::vector<const BrickPhys*>& acting);

private:
	struct Motion {
		Vector3r velocity;
	};
	std::vector<Motion> last; // of each body in the step before
	long                lastStep   = -2;
	Real                lastDt     = 0;
	Real                dampedLate = 0; // by the modes' damping in the half step after the last one [J]

	struct Sums;
	void addFree(const Body&, const BodyStep& before, const BodyStep& now, Sums&) const;
	void addHeld(const Body&, const BodyStep& before, const BodyStep& now, Sums&) const;
	void addModes(Sums&);
};

} // namespace yade
