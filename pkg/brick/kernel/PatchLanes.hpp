// SPDX-License-Identifier: GPL-2.0-or-later
// A joint's patches in a step, the four corners of a rectangle at once: included by JointStep.cpp once for each instruction set (InstructionSets.hpp).

constexpr int lanes = 4;

#include "LaneVectors.hpp"

/// In the same order whatever the instruction set.
BRICK_INLINE Real sumOf(const Lanes& x) { return (x[0] + x[1]) + (x[2] + x[3]); }
BRICK_INLINE bool any(const Mask& m) { return (m[0] | m[1]) | (m[2] | m[3]); }

/// A vector at each of the four corners: its components.
struct Corners {
	Lanes               x[3];
	BRICK_INLINE Lanes& operator[](int i) { return x[i]; }
	BRICK_INLINE const Lanes& operator[](int i) const { return x[i]; }
};

BRICK_INLINE Corners loadCorners(const CornerVectors& from)
{
	return { { loadLanes(from.data()), loadLanes(from.data() + lanes), loadLanes(from.data() + 2 * lanes) } };
}
BRICK_INLINE void storeCorners(CornerVectors& to, const Corners& c)
{
	for (int i = 0; i < 3; ++i)
		storeLanes(to.data() + i * lanes, c[i]);
}
BRICK_INLINE Lanes dot(const Corners& c, const Vector3r& axis) { return (c[0] * axis[0] + c[1] * axis[1]) + c[2] * axis[2]; }

/// Adds the columns of a 4 x 4 matrix times rows: one of the values of four nodes, or of four corners.
BRICK_INLINE void addWeighted(const CornerWeights& weights, int column, Real x, Real y, Real z, Corners& sum)
{
	const Lanes w = loadLanes(weights.data() + column * lanes);
	sum[0] += w * x, sum[1] += w * y, sum[2] += w * z;
}
BRICK_INLINE Corners weighted(const CornerWeights& weights, const CornerVectors& at)
{
	Corners sum {};
	for (int c = 0; c < lanes; ++c)
		addWeighted(weights, c, at(c, 0), at(c, 1), at(c, 2), sum);
	return sum;
}
BRICK_INLINE void addNodal(const PatchSide& side, const Vector3r* field, Corners& sum)
{
	for (int a = 0; a < lanes; ++a) {
		const Vector3r& u = field[side.nodes[a]];
		addWeighted(side.weights, a, u[0], u[1], u[2], sum);
	}
}

BRICK_INLINE Corners turned(const Matrix3r& R, const Corners& c)
{
	Corners out;
	for (int i = 0; i < 3; ++i)
		out[i] = (R(i, 0) * c[0] + R(i, 1) * c[1]) + R(i, 2) * c[2];
	return out;
}

/// Corners of a body, from its position, world axes.
BRICK_INLINE Corners cornersOf(const PatchSide& side, const Placement& at)
{
	Corners c = loadCorners(side.corners);
	if (at.displacement) addNodal(side, at.displacement, c);
	return turned(at.rotation, c);
}

/// Velocities of a body's corners at x from its position, world axes.
BRICK_INLINE Corners cornerRates(const PatchSide& side, const Corners& x, const Placement& at)
{
	Corners out {};
	if (at.displacementRate) {
		addNodal(side, at.displacementRate, out);
		out = turned(at.rotation, out);
	}
	const Vector3r& w = at.angularVelocity;
	for (int i = 0; i < 3; ++i) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		out[i] += (w[j] * x[k] - w[k] * x[j]) + at.velocity[i];
	}
	return out;
}

void movePatches(const JointShape& shape, const Placement& p0, const Placement& p1, JointMotion& m)
{
	for (std::size_t n = 0; n < shape.patches.size(); ++n) {
		const JointPatch& patch = shape.patches[n];
		const Corners     place = cornersOf(patch.sides[0], p0);
		Corners           other = cornersOf(patch.sides[1], p1);
		for (int i = 0; i < 3; ++i)
			other[i] = (other[i] + m.offset[i]) - place[i];
		storeCorners(m.patches[n].place, place);
		storeCorners(m.patches[n].opening, other);
	}
}

/// Coefficients of 1, p, q, pq of a component given at the corners.
BRICK_INLINE void coefficients(const Lanes& c, Real (&out)[4]) { out[0] = c[0], out[1] = c[1] - c[0], out[2] = c[3] - c[0], out[3] = (c[2] - c[1]) - (c[3] - c[0]); }

BRICK_INLINE void setField(const Corners& at, const JointAxes& axes, SegmentField& field)
{
	coefficients(dot(at, axes.normal), field.normal);
	coefficients(dot(at, axes.tangent1), field.tangent1);
	coefficients(dot(at, axes.tangent2), field.tangent2);
}

void setOpening(const PatchMotion& m, const JointAxes& axes, SegmentField& field) { setField(loadCorners(m.opening), axes, field); }

void setRate(const JointPatch& patch, const PatchMotion& m, const Vector3r& offset, const JointPlacements& moving, const JointAxes& axes, SegmentField& field)
{
	const Corners place = loadCorners(m.place), opening = loadCorners(m.opening);
	Corners       other;
	for (int i = 0; i < 3; ++i)
		other[i] = (place[i] + opening[i]) - offset[i];
	Corners       rate = cornerRates(patch.sides[1], other, moving.side1);
	const Corners mine = cornerRates(patch.sides[0], place, moving.side0);
	for (int i = 0; i < 3; ++i)
		rate[i] -= mine[i];
	setField(rate, axes, field);
}

/// Raises the largest penetration of a segment, by the openings of a patch's outermost ones.
BRICK_INLINE void raisePenetration(const Joint& joint, const Lanes& un, Real& penetration)
{
	for (int c = 0; c < lanes; ++c)
		penetration = std::max(penetration, joint.restGap - un[c]);
}
void outermostPenetration(const Joint& joint, const JointMotion& m, int number, Real& penetration)
{
	raisePenetration(joint, dot(weighted(joint.shape->patches[number].outermost, m.patches[number].opening), m.normal), penetration);
}

/// Whether no outermost segment of a patch fails, in a joint that holds. Raises the largest penetration of a segment.
bool outermostHold(const Joint& joint, const JointMotion& m, int number, Real& penetration)
{
	const JointShape&     shape    = *joint.shape;
	const MortarStrength& strength = shape.strength;
	const Corners         d        = weighted(shape.patches[number].outermost, m.patches[number].opening);
	const Lanes           un       = dot(d, m.normal);
	const Lanes           t[3] { d[0] - un * m.normal[0], d[1] - un * m.normal[1], d[2] - un * m.normal[2] };
	const Lanes           sigma   = joint.springs.normal * (un - joint.restGap);
	const Lanes           squared = joint.springs.shear * joint.springs.shear * ((t[0] * t[0] + t[1] * t[1]) + t[2] * t[2]); // of the shear stress
	const Lanes           held    = strength.cohesion - sigma * strength.tanFriction; // what it must not exceed
	raisePenetration(joint, un, penetration);
	return !any((sigma > strength.tension) | (held < 0) | (squared > held * held)
	            | ((sigma < 0) & (sigma * sigma + strength.capShape * squared > strength.compression * strength.compression)));
}

/// Force on side 0 of a patch that holds, at the corners of its rectangle.
void setHoldingForce(const Joint& joint, const JointMotion& m, int number, CornerVectors& force)
{
	const Real           kn = joint.springs.normal, ks = joint.springs.shear;
	const JointPatch&    patch  = joint.shape->patches[number];
	const Corners        mean   = weighted(patch.weight, m.patches[number].opening);
	const Lanes          normal = (kn - ks) * dot(mean, m.normal) - kn * joint.restGap * loadLanes(patch.cornerAreas.data());
	Corners              out;
	for (int i = 0; i < 3; ++i)
		out[i] = ks * mean[i] + normal * m.normal[i];
	storeCorners(force, out);
}

/// Adds a patch's force, its torque about side 0's position and its middle times its area.
void addPatch(const JointPatch& patch, const PatchMotion& m, const CornerVectors& forces, Vector3r& force, Vector3r& torque, Vector3r& point)
{
	const Corners place = loadCorners(m.place), opening = loadCorners(m.opening), f = loadCorners(forces);
	const Lanes   areas = loadLanes(patch.cornerAreas.data());
	Corners       middle;
	for (int i = 0; i < 3; ++i) {
		middle[i] = place[i] + opening[i] / 2;
		force[i] += sumOf(f[i]);
		point[i] += sumOf(middle[i] * areas);
	}
	for (int i = 0; i < 3; ++i) {
		const int j = (i + 1) % 3, k = (i + 2) % 3;
		torque[i] += sumOf(middle[j] * f[k] - middle[k] * f[j]);
	}
}

/// Adds what a patch does to four nodes of one of its bodies, body axes.
void addToNodes(const PatchSide& side, const CornerVectors& forces, Real sign, const Matrix3r& rotation, Vector3r* nodal)
{
	const Corners f = loadCorners(forces);
	Corners       body;
	for (int i = 0; i < 3; ++i)
		body[i] = sign * ((rotation(0, i) * f[0] + rotation(1, i) * f[1]) + rotation(2, i) * f[2]);
	for (int a = 0; a < lanes; ++a) {
		const Lanes w = loadLanes(side.weights.data() + a * lanes);
		for (int i = 0; i < 3; ++i)
			nodal[side.nodes[a]][i] += sumOf(w * body[i]);
	}
}
