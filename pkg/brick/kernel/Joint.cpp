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

	/// Weights of a face's nodes that give a point x of its plane: the face's bilinear ones, also beyond its edges, if it is a parallelogram; otherwise the smallest
	/// that sum to one.
	Vector4r faceWeights(const Side& side, int face, const Vector3r& x)
	{
		const Face& f = side.solid->faces[face];
		if (f.parallelogram) return bilinear(f.dual1.dot(x - f.centre), f.dual2.dot(x - f.centre));
		Eigen::Matrix<Real, 3, 4> A;
		for (int a = 0; a < 4; ++a) {
			const Vector3r d = side.solid->corners[faceNodes[face][a]] - f.centre;
			A.col(a) << 1, f.dual1.dot(d), f.dual2.dot(d);
		}
		const Vector3r wanted(1, f.dual1.dot(x - f.centre), f.dual2.dot(x - f.centre));
		return A.transpose() * (A * A.transpose()).inverse() * wanted;
	}

	/// A brick's face with the rectangle that the joint lies in.
	JointFace brickFace(const Side& side, int face, const std::array<Vector3r, 4>& rectangle)
	{
		JointFace out;
		out.face   = face;
		out.normal = side.solid->faces[face].normal;
		for (int c = 0; c < 4; ++c) {
			const Vector3r x   = bodyPoint(side, rectangle[c]);
			out.nodes[c]       = faceNodes[face][c];
			out.corners.row(c) = x;
			out.weights.row(c) = faceWeights(side, face, x);
		}
		return out;
	}

	JointFace supportFace(const Side& side, int face, const std::array<Vector3r, 4>& rectangle)
	{
		JointFace out;
		out.normal = side.solid->faces[face].normal;
		for (int c = 0; c < 4; ++c)
			out.corners.row(c) = bodyPoint(side, rectangle[c]);
		return out;
	}

	/// Segments of the grid in the overlap of two faces.
	struct Grid {
		Vector2r                  lower, step;
		std::array<int, 2>        rows;
		std::vector<JointSegment> segments;
		bool                      whole = true; ///< every cell lies in both faces
	};

	Grid gridOf(const FlatFace& a, const FlatFace& b, const Vector2r& lower, const Vector2r& extent, Real size)
	{
		constexpr Real sliver = 1e-9; // of a cell
		Grid           grid;
		grid.rows  = { std::max(1, int(std::lround(extent[0] / size))), std::max(1, int(std::lround(extent[1] / size))) };
		grid.lower = lower;
		grid.step  = { extent[0] / grid.rows[0], extent[1] / grid.rows[1] };
		const Real whole = grid.step[0] * grid.step[1];
		for (int row = 0; row < grid.rows[1]; ++row)
			for (int column = 0; column < grid.rows[0]; ++column) {
				const Cell   cell = cellInOverlap(lower + Vector2r(column * grid.step[0], row * grid.step[1]), grid.step, a, b);
				Cell::Vertex centre;
				const Real   area = cell.empty() ? 0 : cell.areaAndCentroid(centre);
				grid.whole &= area > (1 - sliver) * whole;
				if (area <= sliver * whole) continue;
				grid.segments.push_back({ (centre[0] - lower[0]) / extent[0], (centre[1] - lower[1]) / extent[1], area, SegmentState::Intact });
			}
		return grid;
	}

	void takeSegments(const Grid& grid, JointShape& shape)
	{
		shape.rows      = grid.rows;
		shape.count     = int(grid.segments.size());
		shape.outermost = { 1, 0, 1, 0 };
		if (!grid.whole) shape.cut = grid.segments;
		for (const JointSegment& segment : grid.segments) {
			const Vector4r w = cornerWeights(segment.p, segment.q);
			shape.weight += segment.area * w * w.transpose();
			shape.outermost = { std::min(shape.outermost[0], segment.p),
				            std::max(shape.outermost[1], segment.p),
				            std::min(shape.outermost[2], segment.q),
				            std::max(shape.outermost[3], segment.q) };
		}
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
	JointShape     shape;
	Joint          joint;
	joint.restGap = guest.solid->faces[guestFace].normal.dot(bodyPoint(guest, plane.origin)) - guest.solid->faces[guestFace].offset;
	if (!(std::abs(joint.restGap) <= tolerance)) return std::nullopt;

	const FlatFace a(host, hostFace, plane, false), b(guest, guestFace, plane, true);
	const Vector2r lower = a.lower.cwiseMax(b.lower), extent = a.upper.cwiseMin(b.upper) - lower;
	if (extent.minCoeff() <= tolerance) return std::nullopt;

	const Grid grid = gridOf(a, b, lower, extent, std::min(segmentSize(host, hostFace), segmentSize(guest, guestFace)));
	if (grid.segments.empty()) return std::nullopt;
	takeSegments(grid, shape);

	// the guest's corners are moved along the host's normal to where the joint is `restGap` wide everywhere, so that nothing is strained at rest; a brick may be
	// tilted a little, which mortar fills
	const Vector2r          upper = lower + extent;
	std::array<Vector3r, 4> onHost { plane.world(lower[0], lower[1]), plane.world(upper[0], lower[1]), plane.world(upper[0], upper[1]), plane.world(lower[0], upper[1]) };
	std::array<Vector3r, 4> onGuest;
	for (int c = 0; c < 4; ++c)
		onGuest[c] = onHost[c] + joint.restGap * away;
	shape.faces[swapped]  = brickFace(host, hostFace, onHost);
	shape.faces[!swapped] = guest.support ? supportFace(guest, guestFace, onGuest) : brickFace(guest, guestFace, onGuest);
	shape.along           = side0.placement.rotation.transpose() * plane.axis1;
	joint.shape           = std::make_shared<JointShape>(shape);
	return joint;
}

void Joint::setMortar(const SpotSprings& springs, const MortarStrength& strength)
{
	shape           = std::make_shared<JointShape>(*shape);
	shape->springs  = springs;
	shape->strength = strength;
}

namespace {

	bool same(const SpotSprings& a, const SpotSprings& b)
	{
		return a.normal == b.normal && a.shear == b.shear && a.normalDashpot == b.normalDashpot && a.shearDashpot == b.shearDashpot;
	}

	bool same(const MortarStrength& a, const MortarStrength& b)
	{
		return a.tension == b.tension && a.cohesion == b.cohesion && a.tanFriction == b.tanFriction && a.compression == b.compression
		        && a.capShape == b.capShape;
	}

} // namespace

bool alike(const JointShape& a, const JointShape& b, Real tolerance)
{
	const auto near  = [](const auto& x, const auto& y, Real by) { return ((x - y).array().abs() <= by).all(); };
	const Real share = tolerance / std::sqrt(a.weight.sum()); // of numbers without a unit
	for (int s = 0; s < 2; ++s) {
		const JointFace &f = a.faces[s], &g = b.faces[s];
		if (f.face != g.face || !near(f.corners, g.corners, tolerance) || !near(f.weights, g.weights, share) || !near(f.normal, g.normal, share)) return false;
	}
	return a.cut.empty() && b.cut.empty() && a.rows == b.rows && same(a.springs, b.springs) && same(a.strength, b.strength)
	        && near(a.along, b.along, share) && near(a.weight, b.weight, share * a.weight.sum());
}

JointSegment segmentOf(const Joint& joint, int index)
{
	const JointShape& shape   = *joint.shape;
	JointSegment      segment = !shape.cut.empty()
	             ? shape.cut[index]
	             : JointSegment { (index % shape.rows[0] + .5) / shape.rows[0], (index / shape.rows[0] + .5) / shape.rows[1], joint.area() / shape.count };
	if (joint.segments.count() > 0) segment.state = SegmentState(int(joint.segments.row(JointSegments::State)[index]));
	return segment;
}

void makeSegments(Joint& joint)
{
	if (joint.segments.count() > 0) return;
	JointSegments arrays(joint.count());
	for (int s = 0; s < arrays.count(); ++s) {
		const JointSegment segment         = segmentOf(joint, s);
		arrays.row(JointSegments::P)[s]    = segment.p;
		arrays.row(JointSegments::Q)[s]    = segment.q;
		arrays.row(JointSegments::Area)[s] = segment.area;
	}
	joint.segments = arrays;
}

namespace {

	/// Displacements of a face's nodes, a row each.
	CornerVectors nodal(const JointFace& face, const Vector3r* field)
	{
		CornerVectors out;
		for (int a = 0; a < 4; ++a)
			out.row(a) = field[face.nodes[a]];
		return out;
	}

	/// Corners of a face as it is deformed, body axes.
	CornerVectors deformed(const JointFace& face, const Vector3r* displacement)
	{
		if (!displacement || face.face < 0) return face.corners;
		return face.corners + face.weights * nodal(face, displacement);
	}

	/// Velocities of a body's corners at x from its position, world axes.
	CornerVectors cornerRates(const JointFace& face, const CornerVectors& x, const Placement& p)
	{
		CornerVectors out;
		for (int c = 0; c < 4; ++c)
			out.row(c) = p.velocity + p.angularVelocity.cross(Vector3r(x.row(c)));
		if (p.displacementRate && face.face >= 0) out += face.weights * nodal(face, p.displacementRate) * p.rotation.transpose();
		return out;
	}

} // namespace

void jointMotion(const Joint& joint, const Placement& p0, const Placement& p1, JointMotion& m)
{
	const JointShape& shape = *joint.shape;
	m.offset                = p1.position - p0.position;
	m.normal                = (p0.rotation * shape.faces[0].normal - p1.rotation * shape.faces[1].normal).normalized();
	m.along                 = p0.rotation * shape.along;
	m.place                 = deformed(shape.faces[0], p0.displacement) * p0.rotation.transpose();
	m.opening               = deformed(shape.faces[1], p1.displacement) * p1.rotation.transpose();
	m.opening.rowwise() += m.offset.transpose();
	m.opening -= m.place;
}

CornerVectors openingRate(const Joint& joint, const JointMotion& m, const Placement& p0, const Placement& p1)
{
	const CornerVectors x1 = (m.place + m.opening).rowwise() - m.offset.transpose();
	return cornerRates(joint.shape->faces[1], x1, p1) - cornerRates(joint.shape->faces[0], m.place, p0);
}

namespace {

	/// Normal and tangential axes of a joint; they turn with the mean of both faces.
	struct Axes {
		Vector3r normal, tangent1, tangent2;

		explicit Axes(const JointMotion& m)
		        : normal(m.normal)
		{
			constexpr Real upright = 1e-6; // p has turned into the normal
			const Vector3r along   = m.along - normal * normal.dot(m.along);
			tangent1               = along.norm() > upright ? Vector3r(along.normalized()) : Vector3r(normal.unitOrthogonal());
			tangent2               = normal.cross(tangent1);
		}
	};

	/// Coefficients of 1, p, q, pq of a component given at the corners.
	void coefficients(const CornerVectors& at, const Vector3r& axis, Real (&out)[4])
	{
		const Vector4r c = at * axis;
		out[0] = c[0], out[1] = c[1] - c[0], out[2] = c[3] - c[0], out[3] = (c[2] - c[1]) - (c[3] - c[0]);
	}

	SegmentField fieldOf(const CornerVectors& at, const Axes& axes)
	{
		SegmentField field;
		coefficients(at, axes.normal, field.normal);
		coefficients(at, axes.tangent1, field.tangent1);
		coefficients(at, axes.tangent2, field.tangent2);
		return field;
	}

	SegmentField openingOf(const Joint& joint, const JointMotion& m, const Axes& axes)
	{
		SegmentField field = fieldOf(m.opening, axes);
		field.normal[0] -= joint.restGap;
		return field;
	}

	/// Moments with the corners' weights from moments with 1, p, q, pq.
	Vector4r atCorners(const Real (&m)[4]) { return { (m[0] - m[1]) - (m[2] - m[3]), m[1] - m[3], m[3], m[2] - m[3] }; }

	Real at(const Real (&c)[4], Real p, Real q) { return c[0] + p * c[1] + (q * c[2] + p * q * c[3]); }

	/// The hinge rule (see the head of Joint.hpp) as the sweep wants it.
	void setHinge(const Joint& joint, Real edge, SegmentSweep& sweep)
	{
		constexpr Real hinge   = 10; // far beyond any stress of a joint that bends with its wall
		const bool     cracked = !joint.holds();
		sweep.bending          = joint.shape->springs.normal * edge;
		sweep.hingeTension     = cracked ? joint.shape->strength.tension : hinge * joint.shape->strength.tension;
		sweep.hingeShare       = cracked ? 0 : hinge;
		sweep.hingeSign        = cracked ? 1 : 0;
	}

	SegmentSweep sweepOf(const Joint& joint, const JointMotion& m, const Axes& axes, const CornerVectors& rate, Real tanFriction)
	{
		SegmentSweep sweep;
		sweep.opening = openingOf(joint, m, axes);
		if (!joint.holds()) sweep.rate = fieldOf(rate, axes);
		sweep.springs     = joint.shape->springs;
		sweep.strength    = joint.shape->strength;
		sweep.tanFriction = tanFriction;
		setHinge(joint, edgeOpening(joint, m), sweep);
		return sweep;
	}

	/// Opening at the outermost segments, a row each.
	CornerVectors outermostOpening(const Joint& joint, const CornerVectors& d)
	{
		const auto& [p0, p1, q0, q1] = joint.shape->outermost;
		auto edgePoint = [&d](int from, int to, Real t) { return Vector3r(d.row(from) + t * (d.row(to) - d.row(from))); };
		const Vector3r low0 = edgePoint(0, 3, q0), low1 = edgePoint(1, 2, q0), high0 = edgePoint(0, 3, q1), high1 = edgePoint(1, 2, q1);
		CornerVectors  out;
		out.row(0) = low0 + p0 * (low1 - low0);
		out.row(1) = low0 + p1 * (low1 - low0);
		out.row(2) = high0 + p1 * (high1 - high0);
		out.row(3) = high0 + p0 * (high1 - high0);
		return out;
	}

	/// Whether no segment of a joint that holds can fail. Finds the largest penetration of a segment.
	bool keepsHolding(const Joint& joint, const JointMotion& m, Real& penetration)
	{
		const CornerVectors d  = outermostOpening(joint, m.opening);
		const Vector4r      un = d * m.normal;
		penetration            = joint.restGap - un.minCoeff();
		for (int c = 0; c < 4; ++c) {
			const Vector3r ut    = Vector3r(d.row(c)) - un[c] * m.normal;
			const Real     sigma = joint.shape->springs.normal * (un[c] - joint.restGap), shear = joint.shape->springs.shear * ut.norm();
			if (failureMode(joint.shape->strength, sigma, shear) != SegmentState::Intact) return false;
		}
		if (joint.shape->rows[0] > 1 && joint.shape->rows[1] > 1) return true;
		SegmentSweep hinge;
		setHinge(joint, edgeOpening(joint, m), hinge);
		return hinge.bending <= hinge.hingeTension;
	}

	/// Force on side 0 of a joint that holds, at the corners of its rectangle.
	CornerVectors intactForce(const Joint& joint, const JointMotion& m)
	{
		const Real          kn = joint.shape->springs.normal, ks = joint.shape->springs.shear;
		const CornerVectors mean   = joint.shape->weight * m.opening;
		const Vector4r      normal = (kn - ks) * (mean * m.normal) - kn * joint.restGap * joint.shape->weight.rowwise().sum();
		return ks * mean + normal * m.normal.transpose();
	}

	Failures countFailures(const JointSegments& segments)
	{
		Failures out;
		for (int s = 0; s < segments.count(); ++s) {
			const auto state = SegmentState(int(segments.row(JointSegments::State)[s]));
			out.tension += state == SegmentState::Tension;
			out.shear += state == SegmentState::Shear;
			out.compression += state == SegmentState::Compression;
		}
		return out;
	}

	/// The same segment by segment, with all that can happen to them.
	CornerVectors sweptForce(Joint& joint, const JointMotion& m, const CornerVectors& rate, Real tanFriction, Real& penetration)
	{
		makeSegments(joint);
		const Axes        axes(m);
		const SegmentSums sums = sweepSegments(joint.segments, sweepOf(joint, m, axes, rate, tanFriction));
		if (sums.anyFailed) joint.failures = countFailures(joint.segments);
		penetration = sums.penetration;
		return atCorners(sums.force.normal) * axes.normal.transpose() + atCorners(sums.force.tangent1) * axes.tangent1.transpose()
		        + atCorners(sums.force.tangent2) * axes.tangent2.transpose();
	}

} // namespace

Real edgeOpening(const Joint& joint, const JointMotion& m)
{
	// the opening's change over half a segment along the middle of the rectangle
	const Vector4r un = m.opening * m.normal;
	Real           edge = 0;
	if (!joint.holds() || joint.shape->rows[0] == 1) edge += std::abs((un[1] - un[0]) + (un[2] - un[3])) / (4 * joint.shape->rows[0]);
	if (!joint.holds() || joint.shape->rows[1] == 1) edge += std::abs((un[3] - un[0]) + (un[2] - un[1])) / (4 * joint.shape->rows[1]);
	return edge;
}

Failures jointLoads(Joint& joint, const JointMotion& m, const CornerVectors& rate, Real tanFriction, JointLoads& loads, PairSummary& sum)
{
	const Failures before = joint.failures;
	const bool     whole  = joint.holds() && keepsHolding(joint, m, sum.penetration);
	loads.force           = whole ? intactForce(joint, m) : sweptForce(joint, m, rate, tanFriction, sum.penetration);

	const CornerVectors middle = m.place + m.opening / 2;
	const Vector3r      force  = loads.forceOn(0);
	loads.torque[0].setZero();
	for (int c = 0; c < 4; ++c)
		loads.torque[0] += Vector3r(middle.row(c)).cross(Vector3r(loads.force.row(c)));
	loads.torque[1] = m.offset.cross(force) - loads.torque[0];

	const Vector4r areas = joint.shape->weight.rowwise().sum();
	sum.area             = areas.sum();
	sum.normal           = m.normal;
	sum.normalForce      = -force.dot(m.normal) * m.normal;
	sum.shearForce       = -force - sum.normalForce;
	sum.point            = middle.transpose() * areas / sum.area;
	sum.kn               = joint.shape->springs.normal * sum.area;
	sum.ks               = joint.shape->springs.shear * sum.area;
	return { joint.failures.tension - before.tension, joint.failures.shear - before.shear, joint.failures.compression - before.compression };
}

void addNodalForces(const Joint& joint, const JointLoads& loads, int side, const Matrix3r& rotation, Vector3r* nodal)
{
	const JointFace&    face = joint.shape->faces[side];
	const CornerVectors f    = (side == 0 ? 1 : -1) * (face.weights.transpose() * (loads.force * rotation));
	for (int a = 0; a < 4; ++a)
		nodal[face.nodes[a]] += f.row(a);
}

SegmentTraction segmentTraction(const Joint& joint, int index, const JointMotion& m, Real tanFriction)
{
	const JointSegment segment = segmentOf(joint, index);
	const Axes         axes(m);
	const SegmentField opening = openingOf(joint, m, axes);
	const Real         un = at(opening.normal, segment.p, segment.q);
	Vector2r           ut(at(opening.tangent1, segment.p, segment.q), at(opening.tangent2, segment.p, segment.q));
	Real               normal = joint.shape->springs.normal * un;
	if (segment.state == SegmentState::Intact) ut *= joint.shape->springs.shear;
	else {
		normal = std::min(0., normal);
		ut -= Vector2r(joint.segments.row(JointSegments::Slip1)[index], joint.segments.row(JointSegments::Slip2)[index]);
		ut *= joint.shape->springs.shear;
		const Real limit = -normal * tanFriction;
		if (ut.norm() > limit) ut *= limit / ut.norm();
	}
	return { normal, ut[0] * axes.tangent1 + ut[1] * axes.tangent2 };
}

Failures overloaded(const Joint& joint, const JointMotion& m)
{
	Joint tried = joint;
	makeSegments(tried);
	sweepSegments(tried.segments, sweepOf(tried, m, Axes(m), CornerVectors::Zero(), 0));
	return countFailures(tried.segments);
}

Real jointEnergy(const Joint& joint, const JointMotion& m, Real tanFriction)
{
	Real energy = 0;
	for (int s = 0; s < joint.count(); ++s) {
		const SegmentTraction t = segmentTraction(joint, s, m, tanFriction);
		energy += segmentOf(joint, s).area / 2 * (t.normal * t.normal / joint.shape->springs.normal + t.shear.squaredNorm() / joint.shape->springs.shear);
	}
	return energy;
}

} // namespace brick
