// SPDX-License-Identifier: GPL-2.0-or-later
// What joints do in a step, and what can be read of it.
#include "PairLedger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brick {

namespace {

	constexpr Real infinity = std::numeric_limits<Real>::infinity();

	/// Normal and tangential axes of a joint; they turn with the mean of both faces.
	struct JointAxes {
		Vector3r normal, tangent1, tangent2;

		explicit JointAxes(const JointMotion& m)
		        : normal(m.normal)
		{
			constexpr Real upright = 1e-6; // p has turned into the normal
			const Vector3r along   = m.along - normal * normal.dot(m.along);
			const Real     length  = along.norm();
			tangent1               = length > upright ? Vector3r(1 / length * along) : Vector3r(normal.unitOrthogonal());
			tangent2               = normal.cross(tangent1);
		}
	};

} // namespace

} // namespace brick

#define BRICK_LANES_FILE "PatchLanes.hpp"
#include "ForEachInstructionSet.hpp"

namespace brick {

Vector3r JointMotion::middle(const JointSegment& segment) const
{
	const PatchMotion& at = patches[segment.patch];
	return (at.place + at.opening / 2).transpose() * cornerWeights(segment.p, segment.q);
}

Vector3r JointLoads::forceOn(int side) const
{
	Vector3r sum = Vector3r::Zero();
	for (const auto& patch : forces)
		for (int i = 0; i < 3; ++i) {
			const Real* const f = patch.data() + 4 * i;
			sum[i] += (f[0] + f[1]) + (f[2] + f[3]);
		}
	return side == 0 ? sum : Vector3r(-sum);
}

Real JointMotion::meanOpening() const
{
	Real sum = 0;
	for (const auto& patch : patches)
		sum += (patch.opening * normal).mean();
	return sum / Real(patches.size());
}

void jointMotion(const Joint& joint, const Placement& p0, const Placement& p1, JointMotion& m)
{
	const JointShape& shape = *joint.shape;
	m.offset                = p1.position - p0.position;
	const Vector3r mean     = p0.rotation * shape.faces[0].normal - p1.rotation * shape.faces[1].normal;
	m.normal                = 1 / mean.norm() * mean;
	m.along                 = p0.rotation * shape.along;
	m.patches.resize(shape.patches.size(), boost::container::default_init);
	BRICK_BEST_INSTRUCTION_SET(movePatches)(shape, p0, p1, m);
}

namespace {

	/// Moments with the corners' weights from moments with 1, p, q, pq.
	Vector4r atCorners(const Real (&m)[4]) { return { (m[0] - m[1]) - (m[2] - m[3]), m[1] - m[3], m[3], m[2] - m[3] }; }

	/// The hinge rule (see the head of Joint.hpp) as the sweep wants it.
	void setHinge(const Joint& joint, Real edge, SegmentSweep& sweep)
	{
		constexpr Real hinge   = 10; // far beyond any stress of a joint that bends with its wall
		const bool     cracked = !joint.holds();
		sweep.bending          = joint.springs.normal * edge;
		sweep.hingeTension     = cracked ? joint.shape->strength.tension : hinge * joint.shape->strength.tension;
		sweep.hingeShare       = cracked ? 0 : hinge;
		sweep.hingeSign        = cracked ? 1 : 0;
	}

	SegmentField openingOf(const Joint& joint, const PatchMotion& m, const JointAxes& axes)
	{
		SegmentField field;
		BRICK_BEST_INSTRUCTION_SET(setOpening)(m, axes, field);
		field.normal[0] -= joint.restGap;
		return field;
	}

	/// @param moving null when the rate does not matter: all segments hold, or there are no dashpots
	SegmentSweep
	sweepOf(const Joint&           joint,
	        const JointMotion&     m,
	        int                    patch,
	        const JointAxes&       axes,
	        const JointPlacements* moving,
	        Real                   tanFriction,
	        const LawTerms&        terms)
	{
		SegmentSweep sweep;
		sweep.opening = openingOf(joint, m.patches[patch], axes);
		sweep.terms   = terms;
		if (!moving) sweep.rate = {};
		else
			BRICK_BEST_INSTRUCTION_SET(setRate)(joint.shape->patches[patch], m.patches[patch], m.offset, *moving, axes, sweep.rate);
		sweep.springs     = joint.springs;
		sweep.strength    = joint.shape->strength;
		sweep.tanFriction = tanFriction;
		if (terms.failure) setHinge(joint, edgeOpening(joint, m, patch), sweep);
		return sweep;
	}

	/// Whether no segment fails, in a joint that holds. Finds the largest penetration of a segment.
	bool keepsHolding(const Joint& joint, const JointMotion& m, bool failure, Real& penetration)
	{
		penetration = -infinity;
		if (!failure) {
			for (std::size_t i = 0; i < m.patches.size(); ++i)
				BRICK_BEST_INSTRUCTION_SET(outermostPenetration)(joint, m, int(i), penetration);
			return true;
		}
		const bool hinge = joint.shape->rows[0] == 1 || joint.shape->rows[1] == 1;
		for (std::size_t i = 0; i < m.patches.size(); ++i) {
			if (!BRICK_BEST_INSTRUCTION_SET(outermostHold)(joint, m, int(i), penetration)) return false;
			if (!hinge) continue;
			SegmentSweep rule;
			setHinge(joint, edgeOpening(joint, m, int(i)), rule);
			if (rule.bending > rule.hingeTension) return false;
		}
		return true;
	}

	Failures countFailures(const std::vector<JointSegments>& patches)
	{
		Failures out;
		for (const auto& segments : patches)
			for (int s = 0; s < segments.count(); ++s) {
				const auto state = SegmentState(int(segments.row(JointSegments::State)[s]));
				out.tension += state == SegmentState::Tension;
				out.shear += state == SegmentState::Shear;
				out.compression += state == SegmentState::Compression;
			}
		return out;
	}

	/// One step of a patch's segments.
	SegmentSums sweepPatch(JointSegments& segments, std::size_t patch, const SegmentSweep& sweep, JointLedger* ledger)
	{
		if (!ledger) return sweepSegments(segments, sweep);
		const JointSegments before = segments;
		const SegmentSums   sums   = sweepSegments(segments, sweep);
		ledger->addSwept(patch, before, segments, sweep);
		return sums;
	}

	/// Force on side 0 of each patch, segment by segment, with all that can happen to them.
	void sweepPatches(
	        Joint&                 joint,
	        const JointMotion&     m,
	        const JointPlacements* moving,
	        Real                   tanFriction,
	        JointLoads&            loads,
	        Real&                  penetration,
	        JointLedger*           ledger,
	        const LawTerms&        terms)
	{
		makeSegments(joint);
		const JointAxes axes(m);
		bool            anyFailed = false;
		penetration               = -infinity;
		for (std::size_t i = 0; i < m.patches.size(); ++i) {
			const SegmentSums sums = sweepPatch(joint.segments[i], i, sweepOf(joint, m, int(i), axes, moving, tanFriction, terms), ledger);
			anyFailed |= sums.anyFailed;
			penetration               = std::max(penetration, sums.penetration);
			const Vector4r normal     = atCorners(sums.force.normal), tangent1 = atCorners(sums.force.tangent1), tangent2 = atCorners(sums.force.tangent2);
			for (int k = 0; k < 3; ++k)
				loads.forces[i].col(k) = normal * axes.normal[k] + tangent1 * axes.tangent1[k] + tangent2 * axes.tangent2[k];
		}
		if (anyFailed) joint.failures = countFailures(joint.segments);
	}

} // namespace

Real edgeOpening(const Joint& joint, const JointMotion& m, int patch)
{
	// the opening's change over half a segment along the middle of the rectangle
	const auto&    rows = joint.shape->patches[patch].rows;
	const Vector4r un   = m.patches[patch].opening * m.normal;
	Real           edge = 0;
	if (!joint.holds() || joint.shape->rows[0] == 1) edge += std::abs((un[1] - un[0]) + (un[2] - un[3])) / (4 * rows[0]);
	if (!joint.holds() || joint.shape->rows[1] == 1) edge += std::abs((un[3] - un[0]) + (un[2] - un[1])) / (4 * rows[1]);
	return edge;
}

namespace {

	/// Elastic energy of a patch that holds, from its forces.
	Real holdingEnergy(const Joint& joint, const PatchMotion& m, const Vector3r& normal, const CornerVectors& forces)
	{
		return forces.cwiseProduct(m.opening.rowwise() - joint.restGap * normal.transpose()).sum() / 2;
	}

	void bookHolding(const Joint& joint, const JointMotion& m, const JointLoads& loads, JointLedger& ledger)
	{
		const JointAxes axes(m);
		for (std::size_t i = 0; i < m.patches.size(); ++i)
			ledger.addHolding(joint, i, openingOf(joint, m.patches[i], axes), holdingEnergy(joint, m.patches[i], m.normal, loads.forces[i]));
	}

} // namespace

Failures jointLoads(
        Joint&                 joint,
        const JointMotion&     m,
        const JointPlacements* moving,
        Real                   tanFriction,
        JointLoads&            loads,
        PairSummary&           sum,
        JointLedger*           ledger,
        const LawTerms&        terms)
{
	const Failures before = joint.failures;
	loads.forces.resize(m.patches.size(), boost::container::default_init);
	if (ledger) ledger->begin(joint);
	if (joint.holds() && keepsHolding(joint, m, terms.failure, sum.penetration)) {
		for (std::size_t i = 0; i < m.patches.size(); ++i)
			BRICK_BEST_INSTRUCTION_SET(setHoldingForce)(joint, m, int(i), loads.forces[i]);
		if (ledger) bookHolding(joint, m, loads, *ledger);
	} else
		sweepPatches(joint, m, joint.holds() || !terms.dashpots ? nullptr : moving, tanFriction, loads, sum.penetration, ledger, terms);

	Vector3r force = Vector3r::Zero();
	loads.torque[0].setZero(), sum.point.setZero();
	for (std::size_t i = 0; i < m.patches.size(); ++i)
		BRICK_BEST_INSTRUCTION_SET(addPatch)(joint.shape->patches[i], m.patches[i], loads.forces[i], force, loads.torque[0], sum.point);
	loads.torque[1] = m.offset.cross(force) - loads.torque[0];

	sum.area        = joint.area();
	sum.normal      = m.normal;
	sum.normalForce = -force.dot(m.normal) * m.normal;
	sum.shearForce  = -force - sum.normalForce;
	sum.point /= sum.area;
	sum.kn = joint.springs.normal * sum.area;
	sum.ks = joint.springs.shear * sum.area;
	return { joint.failures.tension - before.tension, joint.failures.shear - before.shear, joint.failures.compression - before.compression };
}

void addNodalForces(const Joint& joint, const JointLoads& loads, int side, const Matrix3r& rotation, Vector3r* nodal)
{
	for (std::size_t i = 0; i < loads.forces.size(); ++i)
		BRICK_BEST_INSTRUCTION_SET(addToNodes)(joint.shape->patches[i].sides[side], loads.forces[i], side == 0 ? 1 : -1, rotation, nodal);
}

namespace {

	Vector2r slipOf(const Joint& joint, int index)
	{
		const JointSegments& segments = joint.segments[takePatch(joint, index)];
		return { segments.row(JointSegments::Slip1)[index], segments.row(JointSegments::Slip2)[index] };
	}

} // namespace

SegmentTraction segmentTraction(const Joint& joint, int index, const JointMotion& m, Real tanFriction)
{
	const JointSegment segment = segmentOf(joint, index);
	const JointAxes    axes(m);
	const SegmentField opening = openingOf(joint, m.patches[segment.patch], axes);
	const Real         un = at(opening.normal, segment.p, segment.q);
	Vector2r           ut(at(opening.tangent1, segment.p, segment.q), at(opening.tangent2, segment.p, segment.q));
	Real               normal = joint.springs.normal * un;
	if (segment.state == SegmentState::Intact) ut *= joint.springs.shear;
	else {
		normal = std::min(0., normal);
		ut -= slipOf(joint, index);
		ut *= joint.springs.shear;
		const Real limit = -normal * tanFriction;
		if (ut.norm() > limit) ut *= limit / ut.norm();
	}
	return { normal, ut[0] * axes.tangent1 + ut[1] * axes.tangent2 };
}

Vector3r segmentOpening(const Joint& joint, int index, const JointMotion& m)
{
	const JointSegment segment = segmentOf(joint, index);
	return m.patches[segment.patch].opening.transpose() * cornerWeights(segment.p, segment.q) - joint.restGap * m.normal;
}

std::array<Vector3r, 4> segmentOutline(const Joint& joint, int index, const JointMotion& m)
{
	JointSegment        corner  = segmentOf(joint, index);
	const JointPatch&   patch   = joint.shape->patches[corner.patch];
	const CornerVectors at      = patch.sides[0].corners;
	const Real          extent  = (at.row(1) - at.row(0)).norm() * (at.row(3) - at.row(0)).norm();
	const Real          cells   = patch.rows[0] * patch.rows[1], scale = std::sqrt(corner.area * cells / extent);
	const Real          p = corner.p, q = corner.q, dp = scale / (2 * patch.rows[0]), dq = scale / (2 * patch.rows[1]);
	constexpr int       signs[4][2] { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	std::array<Vector3r, 4> outline;
	for (int c = 0; c < 4; ++c) {
		corner.p = p + signs[c][0] * dp, corner.q = q + signs[c][1] * dq;
		outline[c] = m.middle(corner);
	}
	return outline;
}

Failures overloaded(const Joint& joint, const JointMotion& m)
{
	Joint tried = joint;
	makeSegments(tried);
	for (std::size_t i = 0; i < m.patches.size(); ++i)
		sweepSegments(tried.segments[i], sweepOf(tried, m, int(i), JointAxes(m), nullptr, 0, { true, false, false }));
	return countFailures(tried.segments);
}

Real jointEnergy(const Joint& joint, const JointMotion& m, Real tanFriction)
{
	Real energy = 0;
	if (joint.holds()) {
		CornerVectors forces;
		for (std::size_t i = 0; i < m.patches.size(); ++i) {
			BRICK_BEST_INSTRUCTION_SET(setHoldingForce)(joint, m, int(i), forces);
			energy += holdingEnergy(joint, m.patches[i], m.normal, forces);
		}
		return energy;
	}
	for (int s = 0; s < joint.count(); ++s) {
		const SegmentTraction t = segmentTraction(joint, s, m, tanFriction);
		energy += segmentOf(joint, s).area / 2 * (t.normal * t.normal / joint.springs.normal + t.shear.squaredNorm() / joint.springs.shear);
	}
	return energy;
}

} // namespace brick
