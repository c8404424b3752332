// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elastic and frictional materials.
#pragma once

#include <core/Material.hpp>

namespace yade {

class ElastMat : public Material {
public:
	Real young = 1e9, poisson = .25;

	ElastMat() { createIndex(); }
	YADE_HOST_CLASS(ElastMat)
	YADE_HOST_ARCHIVE(Material, (young)(poisson))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(ElastMat, 96)
YADE_ABI_OFFSET(ElastMat, young, 80)
YADE_ABI_OFFSET(ElastMat, poisson, 88)
REGISTER_SERIALIZABLE(ElastMat)

class FrictMat : public ElastMat {
public:
	Real frictionAngle = .5; // [rad]

	FrictMat() { createIndex(); }
	YADE_HOST_CLASS(FrictMat)
	YADE_HOST_ARCHIVE(ElastMat, (frictionAngle))
	YADE_HOST_INDEX
};
YADE_ABI_SIZE(FrictMat, 104)
YADE_ABI_OFFSET(FrictMat, frictionAngle, 96)
REGISTER_SERIALIZABLE(FrictMat)

} // namespace yade
