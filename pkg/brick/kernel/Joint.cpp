// SPDX-License-Identifier: GPL-2.0-or-later
#include "Joint.hpp"

#include "ClippedPolygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brick {

namespace {

	// vertex: place in the common plane (p, q, 0), then distances beyond the four edges of both faces
	using Cell = ClippedPolygon<11, 8>;

	Vector3r worldPoint(const Side& side, const Vector3r& rest) { return side.placement.position + side.placement.rotation * rest; }
	Vector3r bodyPoint(const Side& side, const Vector3r& x) { return side.placement.rotation.transpose() * (x - side.placement.position); }
	Vector3r worldNormal(const Side& side, int face) { return side.placement.rotation * side.solid->faces[face].normal; }

	/// Axes of the plane in which two touching faces overlap, world axes.
	struct Plane {
		Vector3r origin, axis1, axis2;
		Vector2r flat(const Vector3r& x) const { return { axis1.dot(x - origin), axis2.dot(x - origin) }; }
		Vector3r world(Real p, Real q) const { return origin + p * axis1 + q * axis2; }
	};

	Plane planeOf(const Side& side, int face)
	{
		const Face& f = side.solid->faces[face];
		Plane       plane;
		plane.origin = worldPoint(side, f.centre);
		plane.axis1  = (side.placement.rotation * f.e1).normalized();
		plane.axis2  = worldNormal(side, face).cross(plane.axis1);
		return plane;
	}

	/// A face laid into the plane, counter-clockwise.
	struct FlatFace {
		std::array<Vector2r, 4> corners;
		Vector2r                lower, upper;

		FlatFace(const Side& side, int face, const Plane& plane, bool reversed)
		{
			for (int a = 0; a < 4; ++a)
				corners[a] = plane.flat(worldPoint(side, side.solid->corners[faceNodes[face][reversed ? 3 - a : a]]));
			lower = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).cwiseMin(corners[3]);
			upper = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).cwiseMax(corners[3]);
		}
		/// Distance of a point from an edge's line, positive outside.
		Real beyond(int edge, const Vector2r& p) const
		{
			const Vector2r along = (corners[(edge + 1) % 4] - corners[edge]).normalized(), away = p - corners[edge];
			return along[1] * away[0] - along[0] * away[1];
		}
	};

	Cell::Vertex vertexAt(const Vector2r& p, const FlatFace& a, const FlatFace& b)
	{
		Cell::Vertex v;
		v.head<3>() << p, 0;
		for (int e = 0; e < 4; ++e)
			v[3 + e] = a.beyond(e, p), v[7 + e] = b.beyond(e, p);
		return v;
	}

	/// The part of a grid cell inside both faces.
	Cell cellInOverlap(const Vector2r& at, const Vector2r& step, const FlatFace& a, const FlatFace& b)
	{
		const Vector2r right(step[0], 0), up(0, step[1]);
		Cell           cell(vertexAt(at, a, b), vertexAt(at + right, a, b), vertexAt(at + step, a, b), vertexAt(at + up, a, b));
		for (int edge = 3; edge < 11 && !cell.empty(); ++edge)
			cell.keepNegative(edge);
		return cell;
	}

	Real segmentSize(const Side& side, int face)
	{
		if (side.support) return std::numeric_limits<Real>::infinity();
		const Face& f = side.solid->faces[face];
		return 2 * std::max(f.e1.norm(), f.e2.norm()) / side.segments;
	}

	JointFace brickFace(const Side& side, int face)
	{
		JointFace out;
		out.face   = face;
		out.normal = side.solid->faces[face].normal;
		for (int a = 0; a < 4; ++a)
			out.nodes[a] = faceNodes[face][a], out.corners[a] = side.solid->corners[out.nodes[a]];
		return out;
	}

	/// The guest's face as the joint knows it: corners moved along the host's normal to a plane that is `gap` away everywhere, so that nothing is strained at rest.
	/// A brick's may be tilted a little, which mortar fills; a support's own may be far away, so it takes the host's.
	JointFace guestFaceOf(const Side& guest, int face, const Side& host, const JointFace& hostSide, const Plane& plane, Real gap)
	{
		JointFace      out  = guest.support ? JointFace() : brickFace(guest, face);
		const Vector3r away = plane.axis1.cross(plane.axis2);
		out.normal          = guest.solid->faces[face].normal;
		for (int a = 0; a < 4; ++a) {
			const Vector3r x = guest.support ? worldPoint(host, hostSide.corners[a]) : worldPoint(guest, out.corners[a]);
			out.corners[a]   = bodyPoint(guest, x + (gap - away.dot(x - plane.origin)) * away);
		}
		return out;
	}

	/// Weights of a face's nodes where the line through x along a direction meets it.
	Vector4r weightsAt(const Side& side, int face, const Vector3r& x, const Vector3r& direction)
	{
		const Face&    f     = side.solid->faces[face];
		const Vector3r local = bodyPoint(side, x), along = side.placement.rotation.transpose() * direction;
		const Vector2r natural = f.coordinates(local + (f.offset - f.normal.dot(local)) / f.normal.dot(along) * along);
		return bilinear(natural[0], natural[1]);
	}

} // namespace

std::optional<Joint> joinFaces(const Side& side0, int face0, const Side& side1, int face1, Real tolerance, Real angleTolerance)
{
	if ((worldNormal(side0, face0) + worldNormal(side1, face1)).norm() > angleTolerance) return std::nullopt;

	// the overlap is laid out on a brick's face, never on a support's, which may reach far
	const bool     swapped = side0.support;
	const Side &   host = swapped ? side1 : side0, &guest = swapped ? side0 : side1;
	const int      hostFace = swapped ? face1 : face0, guestFace = swapped ? face0 : face1;
	const Plane    plane = planeOf(host, hostFace);
	const Vector3r away  = plane.axis1.cross(plane.axis2);
	Joint          joint;
	joint.restGap = guest.solid->faces[guestFace].normal.dot(bodyPoint(guest, plane.origin)) - guest.solid->faces[guestFace].offset;
	if (!(std::abs(joint.restGap) <= tolerance)) return std::nullopt;

	const FlatFace a(host, hostFace, plane, false), b(guest, guestFace, plane, true);
	const Vector2r lower = a.lower.cwiseMax(b.lower), extent = a.upper.cwiseMin(b.upper) - lower;
	if (extent.minCoeff() <= tolerance) return std::nullopt;

	const Real     size    = std::min(segmentSize(host, hostFace), segmentSize(guest, guestFace));
	const int      columns = std::max(1, int(std::lround(extent[0] / size))), rows = std::max(1, int(std::lround(extent[1] / size)));
	const Vector2r step(extent[0] / columns, extent[1] / rows);
	for (int row = 0; row < rows; ++row)
		for (int column = 0; column < columns; ++column) {
			const Cell cell = cellInOverlap(lower + Vector2r(column * step[0], row * step[1]), step, a, b);
			if (cell.empty()) continue;
			Cell::Vertex centre;
			JointSegment segment;
			segment.area = cell.areaAndCentroid(centre);
			if (segment.area <= 1e-9 * step[0] * step[1]) continue;
			const Vector3r x          = plane.world(centre[0], centre[1]);
			segment.weights[swapped]  = weightsAt(host, hostFace, x, away);
			segment.weights[!swapped] = guest.support ? segment.weights[swapped] : weightsAt(guest, guestFace, x, away);
			joint.segments.push_back(segment);
		}
	if (!joint.exists()) return std::nullopt;
	joint.faces[swapped]  = brickFace(host, hostFace);
	joint.faces[!swapped] = guestFaceOf(guest, guestFace, host, joint.faces[swapped], plane, joint.restGap);
	joint.intact          = int(joint.segments.size());
	joint.rows            = { columns, rows };
	joint.halves
	        = { side0.placement.rotation.transpose() * (step[0] / 2 * plane.axis1), side0.placement.rotation.transpose() * (step[1] / 2 * plane.axis2) };
	return joint;
}

JointMotion jointMotion(const Joint& joint, const Placement& p0, const Placement& p1)
{
	JointMotion    m;
	const Matrix3r toFrame = p0.rotation.transpose();
	m.turn                 = toFrame * p1.rotation;
	m.offset               = toFrame * (p1.position - p0.position);
	m.normal               = (joint.faces[0].normal - m.turn * joint.faces[1].normal).normalized();
	const bool moving      = joint.intact < int(joint.segments.size());
	for (int a = 0; a < 4; ++a) {
		const int n0 = joint.faces[0].nodes[a], n1 = joint.faces[1].nodes[a];
		m.positions[0][a] = joint.faces[0].corners[a];
		m.positions[1][a] = joint.faces[1].corners[a];
		if (p0.displacement && n0 >= 0) m.positions[0][a] += p0.displacement[n0];
		if (p1.displacement && n1 >= 0) m.positions[1][a] += p1.displacement[n1];
		m.positions[1][a] = m.offset + m.turn * m.positions[1][a];
	}
	if (!moving) return m;

	const Vector3r drift = toFrame * (p1.velocity - p0.velocity), spin0 = toFrame * p0.angularVelocity, spin1 = toFrame * p1.angularVelocity;
	for (int a = 0; a < 4; ++a) {
		const int n0 = joint.faces[0].nodes[a], n1 = joint.faces[1].nodes[a];
		m.velocities[0][a] = spin0.cross(m.positions[0][a]);
		m.velocities[1][a] = drift + spin1.cross(m.positions[1][a] - m.offset);
		if (p0.displacementRate && n0 >= 0) m.velocities[0][a] += p0.displacementRate[n0];
		if (p1.displacementRate && n1 >= 0) m.velocities[1][a] += m.turn * p1.displacementRate[n1];
	}
	return m;
}

namespace {

	Vector3r weighted(const Vector4r& w, const std::array<Vector3r, 4>& x) { return w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3]; }

	/// Traction on side 0 of a failed segment: unilateral spring and dashpot, Coulomb friction; moves the slip.
	Vector3r
	contactTraction(JointSegment& segment, const SpotSprings& k, Real tanFriction, const Vector3r& n, Real un, const Vector3r& ut, const Vector3r& rate)
	{
		const Real opening  = rate.dot(n);
		const Real pressure = un < 0 ? std::max(0., -(k.normal * un + k.normalDashpot * opening)) : 0;
		if (pressure == 0) {
			segment.slip = ut;
			return Vector3r::Zero();
		}
		segment.slip -= n * n.dot(segment.slip);
		const Vector3r elastic = limited(k.shear * (ut - segment.slip), pressure * tanFriction);
		segment.slip           = ut - elastic / k.shear;
		return limited(elastic + k.shearDashpot * (rate - opening * n), pressure * tanFriction) - pressure * n;
	}

	/// Slope of a face over the joint's mean plane along a vector in it.
	Real slope(const std::array<Vector3r, 4>& face, const Vector3r& normal, const Vector3r& along)
	{
		constexpr Real upright = 1e-6; // of a face that has turned out of the mean plane altogether
		const Vector3r across  = (face[2] - face[0]).cross(face[3] - face[1]).normalized();
		const Real     up      = across.dot(normal);
		return -across.dot(along) / std::copysign(std::max(std::abs(up), upright), up);
	}

	void countFailure(SegmentState mode, Failures& failures)
	{
		failures.tension += mode == SegmentState::Tension;
		failures.shear += mode == SegmentState::Shear;
		failures.compression += mode == SegmentState::Compression;
	}

} // namespace

Real edgeOpening(const Joint& joint, const JointMotion& m)
{
	const bool cracked = joint.intact < int(joint.segments.size());
	Real       edge    = 0;
	for (int k = 0; k < 2; ++k)
		if (cracked || joint.rows[k] == 1) {
			const Vector3r along = joint.halves[k] - m.normal * m.normal.dot(joint.halves[k]);
			edge += std::abs(slope(m.positions[1], m.normal, along) - slope(m.positions[0], m.normal, along));
		}
	return edge;
}

SegmentState segmentFailure(const Joint& joint, Real opening, Real shear, Real edge)
{
	constexpr Real     hinge  = 10; // far beyond any stress of a joint that bends with its wall
	const Real         stress = joint.springs.normal * opening, bending = joint.springs.normal * edge;
	const SegmentState mode = failureMode(joint.strength, stress, shear);
	if (mode != SegmentState::Intact || edge == 0) return mode;
	const bool cracked = joint.intact < int(joint.segments.size());
	const bool opens   = cracked ? stress + bending > joint.strength.tension : bending > hinge * (joint.strength.tension + std::abs(stress));
	return opens ? SegmentState::Tension : SegmentState::Intact;
}

Failures jointLoads(Joint& joint, const JointMotion& m, const PairSprings& pair, const Matrix3r& rotation0, std::array<Loads, 2>& loads, PairSummary& sum)
{
	Failures                failed;
	std::array<Vector3r, 4> onNodes0, onNodes1;
	onNodes0.fill(Vector3r::Zero()), onNodes1.fill(Vector3r::Zero());
	Vector3r   force = Vector3r::Zero(), torque = Vector3r::Zero(), middle = Vector3r::Zero();
	Real       normalForce = 0;
	const auto n           = m.normal;
	const Real edge        = edgeOpening(joint, m);
	for (auto& segment : joint.segments) {
		const Vector3r x0 = weighted(segment.weights[0], m.positions[0]);
		const Vector3r d  = weighted(segment.weights[1], m.positions[1]) - x0;
		const Real     un = d.dot(n) - joint.restGap;
		const Vector3r ut = d - d.dot(n) * n;
		Vector3r       traction; // on side 0
		if (segment.state == SegmentState::Intact) {
			traction                = joint.springs.normal * un * n + joint.springs.shear * ut;
			const SegmentState mode = segmentFailure(joint, un, joint.springs.shear * ut.norm(), edge);
			if (mode != SegmentState::Intact) {
				segment.state = mode;
				--joint.intact;
				countFailure(mode, failed);
				traction = contactTraction(segment, joint.springs, pair.tanFriction, n, un, ut, Vector3r::Zero());
			}
		} else {
			const Vector3r rate = weighted(segment.weights[1], m.velocities[1]) - weighted(segment.weights[0], m.velocities[0]);
			traction            = contactTraction(segment, joint.springs, pair.tanFriction, n, un, ut, rate);
		}
		const Vector3r f = segment.area * traction, at = x0 + d / 2;
		for (int a = 0; a < 4; ++a)
			onNodes0[a] += segment.weights[0][a] * f, onNodes1[a] -= segment.weights[1][a] * f;
		force += f;
		torque += at.cross(f);
		middle += segment.area * at;
		normalForce -= f.dot(n);
		sum.area += segment.area;
		sum.penetration = std::max(sum.penetration, -un);
	}

	for (int s = 0; s < 2; ++s)
		loads[s] = Loads();
	for (int a = 0; a < 4; ++a) {
		if (joint.faces[0].face >= 0) loads[0].nodal[joint.faces[0].nodes[a]] = onNodes0[a];
		if (joint.faces[1].face >= 0) loads[1].nodal[joint.faces[1].nodes[a]] = m.turn.transpose() * onNodes1[a];
	}
	loads[0].force  = rotation0 * force;
	loads[1].force  = -loads[0].force;
	loads[0].torque = rotation0 * torque;
	loads[1].torque = rotation0 * (m.offset.cross(force) - torque);
	sum.normal      = rotation0 * n;
	sum.normalForce = normalForce * sum.normal;
	sum.shearForce  = loads[1].force - sum.normalForce;
	sum.point       = rotation0 * (middle / sum.area);
	sum.kn          = joint.springs.normal * sum.area;
	sum.ks          = joint.springs.shear * sum.area;
	return failed;
}

SegmentTraction segmentTraction(const Joint& joint, const JointSegment& segment, const JointMotion& m, Real tanFriction)
{
	const Vector3r d  = weighted(segment.weights[1], m.positions[1]) - weighted(segment.weights[0], m.positions[0]);
	const Real     un = d.dot(m.normal) - joint.restGap;
	const Vector3r ut = d - d.dot(m.normal) * m.normal;
	if (segment.state == SegmentState::Intact) return { joint.springs.normal * un, joint.springs.shear * ut };
	const Real     pressure = std::max(0., -joint.springs.normal * un);
	const Vector3r slip     = segment.slip - m.normal * m.normal.dot(segment.slip);
	return { -pressure, limited(joint.springs.shear * (ut - slip), pressure * tanFriction) };
}

Real jointEnergy(const Joint& joint, const JointMotion& m, Real tanFriction)
{
	Real energy = 0;
	for (const auto& segment : joint.segments) {
		const SegmentTraction t = segmentTraction(joint, segment, m, tanFriction);
		energy += segment.area / 2 * (t.normal * t.normal / joint.springs.normal + t.shear.squaredNorm() / joint.springs.shear);
	}
	return energy;
}

} // namespace brick
