// SPDX-License-Identifier: GPL-2.0-or-later
//
// The program: current scene, classes known to it.
#pragma once

#include <lib/base/Singleton.hpp>
#include <lib/factory/ClassFactory.hpp>

namespace yade {

class Scene;

struct DynlibDescriptor {
	std::set<std::string> baseClasses;
	bool                  isSerializable;
};

class Omega : public Singleton<Omega> {
	Omega() = delete;

public:
	const shared_ptr<Scene>&                       getScene() const;
	const std::map<std::string, DynlibDescriptor>& getDynlibsDescriptor() const;
	void                                           pause();
	void                                           saveSimulation(const std::string& file, bool quiet = false);
};

} // namespace yade
