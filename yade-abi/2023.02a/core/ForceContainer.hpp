// SPDX-License-Identifier: GPL-2.0-or-later
//
// Forces and torques on bodies, gathered by thread and summed by sync().
#pragma once

#include <core/Body.hpp>

namespace yade {

class ForceContainer {
	alignas(8) unsigned char opaque[304];

public:
	ForceContainer()                      = delete; // the scene has one
	ForceContainer(const ForceContainer&) = delete;

	// safe inside parallel regions
	void addForce(Body::id_t, const Vector3r&);
	void addTorque(Body::id_t, const Vector3r&);

	void            sync(); // not inside parallel regions; then read
	const Vector3r& getForce(Body::id_t);
	const Vector3r& getTorque(Body::id_t);
	const Vector3r  getForceSingle(Body::id_t); // sum over the threads, without sync
	const Vector3r  getTorqueSingle(Body::id_t);

	// the summed arrays themselves: the caller sees to it that they are synced and that the id exists
	void            addForceUnsynced(Body::id_t, const Vector3r&);
	void            addTorqueUnsynced(Body::id_t, const Vector3r&);
	const Vector3r& getForceUnsynced(Body::id_t);
	const Vector3r& getTorqueUnsynced(Body::id_t);

	bool            getPermForceUsed() const;
	const Vector3r& getPermForce(Body::id_t); // only if used: until then there is no array to read
	const Vector3r& getPermTorque(Body::id_t);
	void            setPermForce(Body::id_t, const Vector3r&);
	void            setPermTorque(Body::id_t, const Vector3r&);
	void            addMaxId(Body::id_t); // announces ids up to this one
};
YADE_ABI_SIZE(ForceContainer, 304)

} // namespace yade
