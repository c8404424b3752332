// SPDX-License-Identifier: GPL-2.0-or-later
#include "BrickField.hpp"

#include "DrawingLock.hpp"
#include "Drawn.hpp"

#include "kernel/Utilisation.hpp"

#include <lib/serialization/EnumSupport.hpp>

#include <Eigen/Eigenvalues>

namespace yade {

YADE_ENUM(yade, BrickField, (color)(displacement)(speed)(meanStress)(verticalStress)(principalStress)(vonMisesStress)(level)(utilisation)(failed));

Vector3r fieldColor(Real share)
{
	static const Vector3r shades[] = { { .07, .10, .36 }, { .25, .33, .56 }, { .50, .54, .58 }, { .77, .73, .44 }, { 1, .93, .36 } };
	constexpr int         steps    = 4;
	if (std::isnan(share)) return { .85, .85, .85 };
	const Real place = std::min(std::max(share, Real(0)), Real(1)) * steps;
	const int  i     = std::min(int(place), steps - 1);
	return shades[i] + (place - i) * (shades[i + 1] - shades[i]);
}

namespace {

	/// Mean stress of a brick, body axes [Pa].
	Matrix3r stressOf(const Brick& b)
	{
		Vector6r s;
		{
			const DrawingLock lock;
			s = b.stress();
		}
		Matrix3r tensor;
		tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
		return tensor;
	}

	Real vonMises(const Matrix3r& stress)
	{
		const Matrix3r deviator = stress - stress.trace() / 3 * Matrix3r::Identity();
		return std::sqrt(1.5 * deviator.squaredNorm());
	}

	Real largestPrincipal(const Matrix3r& stress)
	{
		return stress.allFinite() ? Eigen::SelfAdjointEigenSolver<Matrix3r>(stress, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff() : NaN;
	}

	/// Calls with each joint of a body, the interaction, and its two bodies.
	template <class Use> void forEachJoint(const Body& b, Scene& scene, Use use)
	{
		for (const auto& item : b.intrs) {
			const shared_ptr<IPhys> phys = item.second->phys; // kept, should the interaction end meanwhile
			const BrickPhys* const  p    = asBrickPhys(phys);
			const auto              drawn = p ? drawnJoint(*p) : std::nullopt;
			if (!drawn) continue;
			const Interaction& I     = *item.second;
			const auto &       first = Body::byId(I.getId1(), &scene), &second = Body::byId(I.getId2(), &scene);
			if (first && second) use(*drawn, I, *first, *second);
		}
	}

	Real utilisationOf(const Body& b, Scene& scene)
	{
		Real largest = 0;
		forEachJoint(b, scene, [&](const DrawnJoint& drawn, const Interaction& I, const Body& first, const Body& second) {
			largest = std::max(largest, brick::utilisation(drawn.joint, drawnMotion(drawn, first, second, shiftOf(I, scene), 1).motion));
		});
		return largest;
	}

	/// Joints that are gone count as failed.
	Real failedShareOf(const Body& b, const Brick& shape, Scene& scene)
	{
		if (shape.joints == 0) return 0;
		Real holding = 0;
		forEachJoint(b, scene, [&](const DrawnJoint& drawn, const Interaction&, const Body&, const Body&) { holding += 1 - drawn.failedShare(); });
		return std::max<Real>(0, 1 - holding / shape.joints);
	}

} // namespace

Real valueOf(const Body& b, const Brick& shape, BrickField field, Scene& scene)
{
	const State& state = *b.state;
	switch (field) {
		case BrickField::color: return NaN;
		case BrickField::displacement: return (state.pos - state.refPos).norm();
		case BrickField::speed: return state.vel.norm();
		case BrickField::meanStress: return stressOf(shape).trace() / 3;
		case BrickField::verticalStress: {
			const Vector3r up = state.ori.conjugate() * Vector3r(Vector3r::UnitZ()); // in the axes of the body
			return up.dot(stressOf(shape) * up);
		}
		case BrickField::principalStress: return largestPrincipal(stressOf(shape));
		case BrickField::vonMisesStress: return vonMises(stressOf(shape));
		case BrickField::level: return int(shape.level.deformation);
		case BrickField::utilisation: return utilisationOf(b, scene);
		case BrickField::failed: return failedShareOf(b, shape, scene);
	}
	return NaN;
}

/// The view asks in the order of ids, so it is mostly the next.
int BrickValues::idOf(const Shape& shape, Scene& scene) const
{
	const int  count = int(scene.bodies->size());
	const auto has   = [&](int id) {
                const auto& b = (*scene.bodies)[id];
                return b && b->shape.get() == &shape;
	};
	for (int k = 0; k < count; ++k) {
		const int id = (std::max(last, 0) + k) % count;
		if (has(id)) return id;
	}
	return -1;
}

/// A painting begins when ids do not ascend, and when the last one is long ago, should other bodies be shown now.
bool BrickValues::beginsPainting(int id, BrickField asked) const
{
	return asked != field || id <= last || id >= int(values.size()) || Clock::now() - begin > std::chrono::milliseconds(200);
}

void BrickValues::read(Scene& scene, BrickField asked)
{
	field = asked, begin = Clock::now();
	values.assign(scene.bodies->size(), NaN);
	Real                         least = std::numeric_limits<Real>::infinity(), largest = -least;
	std::unique_lock<std::mutex> interactions(scene.interactions->drawloopmutex, std::defer_lock);
	if (isOfJoints(field)) interactions.lock();
	for (const auto& b : *scene.bodies) {
		const Brick* shape = asBrick(b->shape);
		if (!shape || !b->state) continue;
		const Real value = values[b->getId()] = valueOf(*b, *shape, field, scene);
		if (!std::isfinite(value)) continue;
		least   = std::min(least, value);
		largest = std::max(largest, value);
	}
	ends = least <= largest ? Vector2r(least, largest) : Vector2r(NaN, NaN);
}

Real BrickValues::of(const Shape& shape, Scene& scene, BrickField asked)
{
	const int id = idOf(shape, scene);
	if (id < 0) return NaN;
	if (beginsPainting(id, asked)) read(scene, asked);
	last = id;
	return values[id];
}

} // namespace yade
