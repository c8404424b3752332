// SPDX-License-Identifier: GPL-2.0-or-later
#include "Accelerogram.hpp"

#include "Message.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace brick {

Accelerogram::Accelerogram(Real interval, std::vector<Vector3r> given, Real start)
        : interval(interval)
        , start(start)
        , samples(std::move(given))
{
	if (!(interval > 0) || !std::isfinite(interval))
		throw std::invalid_argument(message("interval between samples: ", interval, " s; must be finite and > 0"));
	if (!std::isfinite(start)) throw std::invalid_argument(message("time of the first sample: ", start, " s; must be finite"));
	if (samples.size() < 2) throw std::invalid_argument(message(samples.size(), " samples of acceleration; at least 2 are needed"));
	for (std::size_t i = 0; i < samples.size(); ++i)
		if (!samples[i].allFinite())
			throw std::invalid_argument(message("acceleration sample ", i, " is (", samples[i].transpose(), ") m/s2; must be finite"));
	velocities.assign(1, Vector3r::Zero());
	displacements.assign(1, Vector3r::Zero());
	for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
		velocities.push_back(velocities[i] + interval / 2 * (samples[i] + samples[i + 1]));
		displacements.push_back(displacements[i] + interval * velocities[i] + interval * interval / 6 * (2 * samples[i] + samples[i + 1]));
	}
}

std::size_t Accelerogram::at(Real time, Real& since) const
{
	const Real        elapsed = time - start;
	const std::size_t i       = std::min(std::size_t(elapsed / interval), samples.size() - 2);
	since                     = elapsed - Real(i) * interval;
	return i;
}

Vector3r Accelerogram::acceleration(Real time) const
{
	if (time < start || time > end()) return Vector3r::Zero();
	Real              since;
	const std::size_t i = at(time, since);
	return samples[i] + since / interval * (samples[i + 1] - samples[i]);
}

Vector3r Accelerogram::velocity(Real time) const
{
	if (time < start) return Vector3r::Zero();
	if (time > end()) return velocities.back();
	Real              since;
	const std::size_t i = at(time, since);
	return velocities[i] + since * samples[i] + since * since / (2 * interval) * (samples[i + 1] - samples[i]);
}

Vector3r Accelerogram::displacement(Real time) const
{
	if (time < start) return Vector3r::Zero();
	if (time > end()) return displacements.back() + (time - end()) * velocities.back();
	Real              since;
	const std::size_t i = at(time, since);
	return displacements[i] + since * velocities[i] + since * since / 2 * samples[i]
	        + since * since * since / (6 * interval) * (samples[i + 1] - samples[i]);
}

} // namespace brick
