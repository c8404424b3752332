// SPDX-License-Identifier: GPL-2.0-or-later
//
// Energies by name, one row of values for each thread. To be used only if Scene::trackEnergy.
#pragma once

#include <lib/serialization/Serializable.hpp>

#include <omp.h>

namespace yade {

class EnergyTracker : public Serializable {
public:
	struct {
		int                  cacheLine;
		std::size_t          threads;
		int                  perLine;
		std::vector<double*> chunk; // by thread
		std::size_t          count;
		std::size_t          lines;
	} energies;
	std::map<std::string, int> names;
	std::vector<bool>          resetStep;

	EnergyTracker() = delete; // the scene has one
	~EnergyTracker() override;
	void findId(const std::string& name, int& id, bool reset = false, bool newIfNotFound = true);

	/// Adds to a named energy; safe in parallel regions.
	/// @param id    the caller keeps it, -1 at first (hidden, not saved)
	/// @param reset true for amounts that describe the present state, which start at zero in each step; false for accumulated work
	void add(const Real& value, const std::string& name, int& id, bool reset = false)
	{
		if (id < 0) findId(name, id, reset);
		energies.chunk[omp_get_thread_num()][id] += value;
	}
};
YADE_ABI_SIZE(EnergyTracker, 176)
YADE_ABI_OFFSET(EnergyTracker, energies, 24)
YADE_ABI_OFFSET(EnergyTracker, names, 88)
YADE_ABI_OFFSET(EnergyTracker, resetStep, 136)

} // namespace yade
