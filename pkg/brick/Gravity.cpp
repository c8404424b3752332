// SPDX-License-Identifier: GPL-2.0-or-later
#include "Gravity.hpp"

#include <core/Engine.hpp>

#include <boost/python/dict.hpp>
#include <boost/python/extract.hpp>

namespace yade {

namespace {

	/// NewtonIntegrator's class is the host's: its attribute is read as Python does, for which an engine in the loop needs Python's lock.
	Vector3r attributeOf(const Engine& newton)
	{
		const PyGILState_STATE state = PyGILState_Ensure();
		const Vector3r         found = boost::python::extract<Vector3r>(newton.pyDict()["gravity"])();
		PyGILState_Release(state);
		return found;
	}

} // namespace

std::optional<Vector3r> gravityOf(Scene& scene)
{
	const auto newton = scene.engineByName("NewtonIntegrator");
	return newton ? std::make_optional(attributeOf(*newton)) : std::nullopt;
}

} // namespace yade
