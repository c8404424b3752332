// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rigid motion of a body, inertia, and which degrees of freedom are blocked.
#pragma once

#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class State : public Serializable, public Indexable {
public:
	enum : unsigned { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32, DOF_XYZ = 7, DOF_RXRYRZ = 56, DOF_ALL = 63 };

	Vector3r&    pos; // is se3.position
	Quaternionr& ori; // is se3.orientation
	std::mutex   updateMutex;
	Se3r         se3;
	Vector3r     vel; // [m/s], world
	Real         mass;
	Vector3r     angVel;  // [rad/s], world
	Vector3r     angMom;  // [kg m^2/s], world
	Vector3r     inertia; // [kg m^2], about the axes of the body, which are principal
	Vector3r     refPos;
	Quaternionr  refOri;
	unsigned     blockedDOFs; // DOF_*
	bool         isDamped;
	Real         densityScaling;

	State();
	YADE_HOST_CLASS(State)
	YADE_HOST_ARCHIVE(
	        Serializable, (se3)(vel)(mass)(angVel)(angMom)(inertia)(refPos)(refOri)(blockedDOFs)(isDamped)(densityScaling))
	YADE_HOST_INDEX_TOP
};
YADE_ABI_SIZE(State, 320)
YADE_ABI_OFFSET(State, se3, 88)
YADE_ABI_OFFSET(State, vel, 144)
YADE_ABI_OFFSET(State, mass, 168)
YADE_ABI_OFFSET(State, inertia, 224)
YADE_ABI_OFFSET(State, refOri, 272)
YADE_ABI_OFFSET(State, blockedDOFs, 304)
YADE_ABI_OFFSET(State, densityScaling, 312)
REGISTER_SERIALIZABLE(State)

} // namespace yade
