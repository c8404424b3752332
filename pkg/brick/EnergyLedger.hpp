// SPDX-License-Identifier: GPL-2.0-or-later
// Fills O.energy with what joints, contacts and deformation hold and take, so that O.energy.total() stays constant: see BrickDynamics.
//
// YADE's integrator books the kinetic energy of half a step before; the ledger moves it on to the present step, where positions, and so all springs, are known: by
// half a step of joints, contacts, gravity and permanent forces here, of the ground's acceleration in GroundMotion. The sum then changes only by the errors of a nonlinear step (kernel/PairLedger.hpp).
#pragma once

#include "BodyStep.hpp"
#include "BrickContact.hpp"

namespace yade {

class EnergyLedger {
public:
	/// Room for the modes of each body in this step.
	std::vector<brick::ModeEnergy> modes;

	/// What bricks took that have become rigid, to be booked with the next step [J].
	Real dropped = 0;

	/// Books a step.
	/// @param lastDt time step of the step before [s]   @param steps what joints and contacts do to each body
	/// @param acting interactions that act in this step, each once
	void book(Scene&, Real lastDt, const std::vector<BodyStep>& steps, const std::vector<const BrickPhys*>& acting);

private:
	long lastStep   = -2;
	Real dampedLate = 0; // by the modes' damping in the half step after the last one [J]

	struct Sums;
	static void addFree(Scene&, const Body&, const BodyStep&, Sums&);
	static void addHeld(const Body&, const BodyStep&, Sums&);
	void        addModes(Sums&);
};

} // namespace yade
