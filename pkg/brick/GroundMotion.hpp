// SPDX-License-Identifier: GPL-2.0-or-later
// Earthquake: a given ground acceleration as inertia forces, or as imposed motion of the base.          [Furukawa2014, eqs. (10), (18)]
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Scene.hpp>

#include "kernel/Accelerogram.hpp"

namespace yade {

class GroundMotion : public GlobalEngine {
public:
	void     action() override;
	void     postLoad(GroundMotion&);
	Vector3r groundAcceleration(Real time) const { return motion.acceleration(time); }
	Vector3r groundVelocity(Real time) const { return motion.velocity(time); }
	Vector3r groundDisplacement(Real time) const { return motion.displacement(time); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GroundMotion, GlobalEngine, R"(Ground acceleration z''(t), linear between samples and zero before and after.

Without ``ids`` the scene is seen from the ground: every body that is free to move gets the force -m z'' of eq. (10), and supports stand still. With ``ids`` these bodies (the base) move with the ground in space. Must come before :yref:`NewtonIntegrator`. The nodes' own -m z'' of eq. (18) is part of the rigid acceleration that the deformation is relative to, and drops out.)",
		((Real, dt, NaN, Attr::triggerPostLoad, "Time between samples [s]."))
		((vector<Vector3r>, acceleration, , Attr::triggerPostLoad, "Samples of the ground acceleration [m/s2]."))
		((Real, startTime, 0, Attr::triggerPostLoad, "Time of the first sample [s]."))
		((vector<int>, ids, , , "Bodies that are moved with the ground; none: inertia forces on all free bodies.")),
		/*ctor*/,
		/*py*/
		.def("groundAcceleration", &GroundMotion::groundAcceleration, (boost::python::arg("time")), "Ground acceleration at a time [m/s2].")
		.def("groundVelocity", &GroundMotion::groundVelocity, (boost::python::arg("time")), "Ground velocity at a time [m/s], from rest.")
		.def("groundDisplacement", &GroundMotion::groundDisplacement, (boost::python::arg("time")), "Ground displacement at a time [m], from rest.")
	);
	// clang-format on

private:
	brick::Accelerogram motion;

	// of the step before, while energy is tracked
	long     lastStep = -2;
	Real     lastDt   = 0;
	Vector3r lastAcceleration { Vector3r::Zero() };

	void push();
	void bookWork(const Vector3r& acceleration);
	void moveBase();
};
REGISTER_SERIALIZABLE(GroundMotion);

} // namespace yade
