// SPDX-License-Identifier: GPL-2.0-or-later
//
// Material of a body. A subclass with its own State overrides newAssocState and stateTypeOk together.
#pragma once

#include <core/State.hpp>

namespace yade {

class Scene;

class Material : public Serializable, public Indexable {
public:
	int         id = -1; // position in Scene::materials, -1 if not shared
	std::string label;
	Real        density = 1000; // [kg/m^3]

	Material() { }
	YADE_HOST_CLASS(Material)
	YADE_HOST_ARCHIVE(Serializable, (id)(label)(density))
	virtual shared_ptr<State> newAssocState() const;
	virtual bool              stateTypeOk(State*) const; // checked before the first step
	YADE_HOST_INDEX_TOP

	static const shared_ptr<Material> byId(int, Scene* = nullptr);
};
YADE_ABI_SIZE(Material, 80)
YADE_ABI_OFFSET(Material, id, 32)
YADE_ABI_OFFSET(Material, label, 40)
YADE_ABI_OFFSET(Material, density, 72)
REGISTER_SERIALIZABLE(Material)

} // namespace yade
