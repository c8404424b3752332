// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include <optional>

namespace yade {

/// Gravity of the scene's NewtonIntegrator [m/s2]; none if it has no such engine. Takes Python's lock.
std::optional<Vector3r> gravityOf(Scene&);

} // namespace yade
