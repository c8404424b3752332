// SPDX-License-Identifier: GPL-2.0-or-later
// A ground acceleration z''(t) given at equal intervals, linear in between, zero before and after; its velocity and displacement are its exact integrals.
#pragma once

#include "Types.hpp"

#include <vector>

namespace brick {

class Accelerogram {
public:
	/// Ground at rest.
	Accelerogram() = default;
	/// @param interval between samples [s], > 0   @param samples [m/s2], at least two   @param start time of the first sample [s]
	/// @throws std::invalid_argument with the value and what is allowed
	Accelerogram(Real interval, std::vector<Vector3r> samples, Real start);

	Vector3r acceleration(Real time) const;                                        ///< [m/s2]
	Vector3r velocity(Real time) const;                                            ///< [m/s]; keeps its last value after the end
	Vector3r displacement(Real time) const;                                        ///< [m]; goes on at the last velocity after the end
	Real     end() const { return start + interval * (Real(samples.size()) - 1); } ///< time of the last sample [s]

private:
	/// Interval that a time lies in, and the time since its beginning.
	std::size_t at(Real time, Real& since) const;

	Real                  interval = 1, start = 0;
	std::vector<Vector3r> samples { 2, Vector3r::Zero() }, velocities { 2, Vector3r::Zero() }, displacements { 2, Vector3r::Zero() }; // at the samples
};

} // namespace brick
