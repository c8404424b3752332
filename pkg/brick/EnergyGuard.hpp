// SPDX-License-Identifier: GPL-2.0-or-later
// Notices that joints and contacts make energy.
//
// Whatever they do - hold, crack, rub, damp - joints and contacts can only give back what their springs and the bricks' deformation hold. Within any time their
// work on all bodies is therefore at most the elastic energy at its beginning. The guard sums the work in windows of steps, which needs the elastic energy once a
// window only. The work is that which made the present velocities, of half a step before: leap-frog shows more of it than there is, by 1 / (1 - (omega dt / 2)^2),
// so the guard leaves room for ten times all that there is to be had, kinetic and elastic energy at the beginning and work from outside. An unstable time step
// passes any such mark within some tens of steps. (The energy of whole steps, EnergyLedger.hpp, is conserved even then: its kinetic part becomes negative.)
#pragma once

#include "BodyStep.hpp"
#include "BrickContact.hpp"

#include <optional>

namespace yade {

class EnergyGuard {
public:
	/// Energy that came from nothing.
	struct Gain {
		Real work;    // of joints and contacts on all bodies [J]
		Real held;    // elastic energy at the beginning [J]
		long steps;   // that it took
		int  body;    // that gained most
	};

	/// Whether a window ends with this step; if so, and before the deformation moves on, begin one.
	bool isDue(const Scene&) const;
	void begin(Scene&);
	/// Adds a step's work. Bodies' gains are added up in `steps`.
	std::optional<Gain> add(const Scene&, std::vector<BodyStep>& steps);

private:
	long first = -1, last = -2; // steps of the window
	Real held = 0, moving = 0;  // elastic and kinetic energy at its beginning [J]
	Real least = 0;             // not worth an alarm [J]
	Real work  = 0;             // since then [J]
	Real given = 0, coming = 0; // by bodies that forces do not move, since then and in this step: deformation feels it before it is counted [J]

	bool isTooMuch(const Scene&) const;
};

} // namespace yade
