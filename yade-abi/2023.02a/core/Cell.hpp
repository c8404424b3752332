// SPDX-License-Identifier: GPL-2.0-or-later
//
// Periodic cell. hSize has the base vectors as columns.
#pragma once

#include <lib/serialization/Serializable.hpp>

namespace yade {

class Cell : public Serializable {
	Matrix3r _invTrsf, _trsfInc, _vGradTimesPrevH;
	Vector3r _size, _cos, _refSize;
	bool     _hasShear;
	Matrix3r _shearTrsf, _unshearTrsf;
	double   _glShearTrsfMatrix[16];

public:
	Matrix3r trsf, refHSize, hSize, prevHSize, velGrad, nextVelGrad, prevVelGrad;
	int      homoDeform;
	bool     velGradChanged, flipFlippable;

	Cell() = delete; // the scene has one
	~Cell() override;

	const Vector3r& getSize() const { return _size; }
	bool            hasShear() const { return _hasShear; }
	Vector3r        shearPt(const Vector3r& p) const { return _shearTrsf * p; }
	Vector3r        unshearPt(const Vector3r& p) const { return _unshearTrsf * p; }
	Vector3r        intrShiftPos(const Vector3i& cellDist) const { return hSize * cellDist.cast<Real>(); }
	Vector3r        intrShiftVel(const Vector3i& cellDist) const { return _vGradTimesPrevH * cellDist.cast<Real>(); }

	friend struct CellLayout;
};
struct CellLayout {
	YADE_ABI_SIZE(Cell, 1104)
	YADE_ABI_OFFSET(Cell, _size, 240)
	YADE_ABI_OFFSET(Cell, _hasShear, 312)
	YADE_ABI_OFFSET(Cell, _shearTrsf, 320)
	YADE_ABI_OFFSET(Cell, trsf, 592)
	YADE_ABI_OFFSET(Cell, hSize, 736)
	YADE_ABI_OFFSET(Cell, homoDeform, 1096)
};

} // namespace yade
