// SPDX-License-Identifier: GPL-2.0-or-later
// What the 3-D view colours bricks by: one number a brick, and the colours that stand for numbers.
#pragma once

#include "Brick.hpp"

#include <core/Scene.hpp>

#include <chrono>

namespace yade {

enum class BrickField { color, displacement, speed, meanStress, verticalStress, principalStress, vonMisesStress, level, utilisation, failed };

/// Values of all bricks in one painting. The view asks for one brick after the other, in the order of their ids.
class BrickValues {
public:
	/// Of the body that has this shape; NaN: it has none. The caller holds BodyContainer::drawloopmutex, as the view does while it draws shapes.
	Real of(const Shape&, Scene&, BrickField);
	/// Least and largest of all that are finite; NaN when none is.
	const Vector2r& range() const { return ends; }

private:
	using Clock = std::chrono::steady_clock;
	std::vector<Real> values; ///< by id
	Vector2r          ends { NaN, NaN };
	BrickField        field = BrickField::color;
	int               last  = -1; ///< id that was asked for last
	Clock::time_point begin;

	int  idOf(const Shape&, Scene&) const;
	bool beginsPainting(int id, BrickField) const;
	void read(Scene&, BrickField);
};

/// Of one brick [m, m/s, Pa, or without unit]; NaN when it is not known. The caller holds InteractionContainer::drawloopmutex where joints count.
Real valueOf(const Body&, const Brick&, BrickField, Scene&);

/// Whether a field is read from the interactions of a brick.
inline bool isOfJoints(BrickField field) { return field == BrickField::utilisation || field == BrickField::failed; }

/// Colour of a value, from dark blue over grey to yellow: it gets lighter all the way, and blue and yellow are told apart by all kinds of colour-blindness.
/// @param share of the range, 0 to 1, clamped; NaN gives a light grey
Vector3r fieldColor(Real share);

} // namespace yade
