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

	/// One of the cells of a face, at rest.
	struct FaceCell {
		std::array<int, 4>      nodes;
		std::array<Vector3r, 4> corners; ///< body axes [m]
		Face                    shape;
	};

	std::vector<FaceCell> cellsOf(const Side& side, int face)
	{
		std::vector<FaceCell> out;
		const SurfaceGrid&    grid = surfaceGrid(side.cells);
		for (int row = 0; row < grid.cells(); ++row)
			for (int column = 0; column < grid.cells(); ++column) {
				FaceCell cell { grid.cellNodes(face, column, row), {}, {} };
				for (int a = 0; a < 4; ++a)
					cell.corners[a] = gridPoint(side.solid->corners, grid.gridPlace(cell.nodes[a]), grid.cells());
				cell.shape = Face::of(cell.corners[0], cell.corners[1], cell.corners[2], cell.corners[3]);
				out.push_back(cell);
			}
		return out;
	}

	/// A cell laid into the plane, counter-clockwise.
	struct FlatCell {
		std::array<Vector2r, 4> corners;
		Vector2r                lower, upper;

		FlatCell(const Side& side, const FaceCell& cell, const Plane& plane, bool reversed)
		{
			for (int a = 0; a < 4; ++a)
				corners[a] = plane.flat(worldPoint(side, cell.corners[reversed ? 3 - a : a]));
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

	Cell::Vertex vertexAt(const Vector2r& p, const FlatCell& a, const FlatCell& b)
	{
		Cell::Vertex v;
		v.head<3>() << p, 0;
		for (int e = 0; e < 4; ++e)
			v[3 + e] = a.beyond(e, p), v[7 + e] = b.beyond(e, p);
		return v;
	}

	/// The part of a grid's cell inside both cells.
	Cell cellInOverlap(const Vector2r& at, const Vector2r& step, const FlatCell& a, const FlatCell& b)
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

	/// Weights of a cell's nodes that give a point x of its plane: the bilinear ones, also beyond its edges, if it is a parallelogram; otherwise the smallest
	/// that sum to one.
	Vector4r weightsAt(const FaceCell& cell, const Vector3r& x)
	{
		const Face& f = cell.shape;
		if (f.parallelogram) return bilinear(f.dual1.dot(x - f.centre), f.dual2.dot(x - f.centre));
		Eigen::Matrix<Real, 3, 4> A;
		for (int a = 0; a < 4; ++a) {
			const Vector3r d = cell.corners[a] - f.centre;
			A.col(a) << 1, f.dual1.dot(d), f.dual2.dot(d);
		}
		const Vector3r wanted(1, f.dual1.dot(x - f.centre), f.dual2.dot(x - f.centre));
		return A.transpose() * (A * A.transpose()).inverse() * wanted;
	}

	/// A cell with the rectangle that the patch lies in.
	PatchSide patchSide(const Side& side, const FaceCell& cell, const std::array<Vector3r, 4>& rectangle)
	{
		PatchSide out;
		for (int c = 0; c < 4; ++c) {
			const Vector3r x   = bodyPoint(side, rectangle[c]);
			out.corners.row(c) = x;
			if (side.support) continue;
			out.nodes[c]       = cell.nodes[c];
			out.weights.row(c) = weightsAt(cell, x);
		}
		return out;
	}

	std::array<int, 2> gridRows(const Vector2r& extent, Real size)
	{
		return { std::max(1, int(std::lround(extent[0] / size))), std::max(1, int(std::lround(extent[1] / size))) };
	}

	/// Segments of the grid in the overlap of two cells.
	struct Grid {
		Vector2r                  lower, step;
		std::array<int, 2>        rows;
		std::vector<JointSegment> segments;
		bool                      whole = true; ///< every cell of it lies in both
	};

	Grid gridOf(const FlatCell& a, const FlatCell& b, const Vector2r& lower, const Vector2r& extent, Real size)
	{
		constexpr Real sliver = 1e-9; // of a cell
		Grid           grid;
		grid.rows  = gridRows(extent, size);
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
				grid.segments.push_back({ 0, (centre[0] - lower[0]) / extent[0], (centre[1] - lower[1]) / extent[1], area, SegmentState::Intact });
			}
		return grid;
	}

	void takeSegments(const Grid& grid, JointPatch& patch)
	{
		patch.rows      = grid.rows;
		patch.count     = int(grid.segments.size());
		Real p0 = 1, p1 = 0, q0 = 1, q1 = 0;
		if (!grid.whole) patch.cut = grid.segments;
		for (const JointSegment& segment : grid.segments) {
			const Vector4r w = cornerWeights(segment.p, segment.q);
			patch.weight += segment.area * w * w.transpose();
			p0 = std::min(p0, segment.p), p1 = std::max(p1, segment.p), q0 = std::min(q0, segment.q), q1 = std::max(q1, segment.q);
		}
		patch.outermost << cornerWeights(p0, q0).transpose(), cornerWeights(p1, q0).transpose(), cornerWeights(p1, q1).transpose(), cornerWeights(p0, q1).transpose();
		patch.cornerAreas = patch.weight.rowwise().sum();
	}

	/// Two faces that touch, seen in the plane of one, the host's: a brick's, never a support's, which may reach far.
	struct Overlap {
		const Side & host, &guest;
		int          hostFace, guestFace;
		Plane        plane;
		Real         restGap, size; ///< of the joint, of a segment [m]

		Overlap(const Side& host, int hostFace, const Side& guest, int guestFace)
		        : host(host)
		        , guest(guest)
		        , hostFace(hostFace)
		        , guestFace(guestFace)
		        , plane(planeOf(host, hostFace))
		        , size(std::min(segmentSize(host, hostFace), segmentSize(guest, guestFace)))
		{
			const Face& face = guest.solid->faces[guestFace];
			restGap          = face.normal.dot(bodyPoint(guest, plane.origin)) - face.offset;
		}
		/// The patch of two cells, the host's side first; without segments when they do not overlap.
		JointPatch patch(const FaceCell& mine, const FaceCell& its, Real tolerance) const;
		/// Segments along both axes, as if the faces had one cell.
		std::array<int, 2> rows(const std::vector<FaceCell>& mine, const std::vector<FaceCell>& its) const;
	};

	JointPatch Overlap::patch(const FaceCell& mine, const FaceCell& its, Real tolerance) const
	{
		JointPatch     out;
		const FlatCell a(host, mine, plane, false), b(guest, its, plane, true);
		const Vector2r lower = a.lower.cwiseMax(b.lower), upper = a.upper.cwiseMin(b.upper), extent = upper - lower;
		if (extent.minCoeff() <= tolerance) return out;
		takeSegments(gridOf(a, b, lower, extent, size), out);
		// the guest's corners are moved along the host's normal to where the joint is `restGap` wide everywhere, so that nothing is strained at rest; a brick may
		// be tilted a little, which mortar fills
		std::array<Vector3r, 4> rectangle {
			plane.world(lower[0], lower[1]), plane.world(upper[0], lower[1]), plane.world(upper[0], upper[1]), plane.world(lower[0], upper[1])
		};
		out.sides[0] = patchSide(host, mine, rectangle);
		for (auto& corner : rectangle)
			corner += restGap * plane.axis1.cross(plane.axis2);
		out.sides[1] = patchSide(guest, its, rectangle);
		return out;
	}

	std::array<int, 2> Overlap::rows(const std::vector<FaceCell>& mine, const std::vector<FaceCell>& its) const
	{
		FlatCell a(host, mine.front(), plane, false), b(guest, its.front(), plane, true);
		for (const auto& cell : mine) {
			const FlatCell flat(host, cell, plane, false);
			a.lower = a.lower.cwiseMin(flat.lower), a.upper = a.upper.cwiseMax(flat.upper);
		}
		for (const auto& cell : its) {
			const FlatCell flat(guest, cell, plane, true);
			b.lower = b.lower.cwiseMin(flat.lower), b.upper = b.upper.cwiseMax(flat.upper);
		}
		return gridRows(a.upper.cwiseMin(b.upper) - a.lower.cwiseMax(b.lower), size);
	}

} // namespace

std::optional<Joint> joinFaces(const Side& side0, int face0, const Side& side1, int face1, Real tolerance, Real angleTolerance)
{
	if ((worldNormal(side0, face0) + worldNormal(side1, face1)).norm() > angleTolerance) return std::nullopt;
	const bool    swapped = side0.support;
	const Overlap overlap = swapped ? Overlap(side1, face1, side0, face0) : Overlap(side0, face0, side1, face1);
	if (!(std::abs(overlap.restGap) <= tolerance)) return std::nullopt;

	JointShape shape;
	const auto mine = cellsOf(overlap.host, overlap.hostFace), its = cellsOf(overlap.guest, overlap.guestFace);
	for (const auto& cell : mine)
		for (const auto& other : its) {
			JointPatch patch = overlap.patch(cell, other, tolerance);
			if (patch.count == 0) continue;
			for (auto& segment : patch.cut)
				segment.patch = int(shape.patches.size());
			if (swapped) std::swap(patch.sides[0], patch.sides[1]);
			shape.count += patch.count;
			shape.area += patch.weight.sum();
			shape.patches.push_back(patch);
		}
	if (shape.patches.empty()) return std::nullopt;
	shape.rows     = overlap.rows(mine, its);
	shape.faces[0] = { side0.support ? -1 : face0, side0.solid->faces[face0].normal };
	shape.faces[1] = { side1.support ? -1 : face1, side1.solid->faces[face1].normal };
	shape.along    = side0.placement.rotation.transpose() * overlap.plane.axis1;
	return Joint { std::make_shared<JointShape>(shape), {}, {}, {}, overlap.restGap };
}

void Joint::setMortar(const SpotSprings& given, const MortarStrength& strength, const PairSprings& pair)
{
	// what is given may be the present shape's own
	auto changed      = std::make_shared<JointShape>(*shape);
	springs           = given;
	changed->strength = strength;
	changed->pair     = pair;
	shape             = std::move(changed);
}

namespace {

	bool same(const PairSprings& a, const PairSprings& b)
	{
		return a.normalCompliance == b.normalCompliance && a.shearCompliance == b.shearCompliance && a.density == b.density && a.mortarNormal == b.mortarNormal
		        && a.mortarShear == b.mortarShear && a.mortarThickness == b.mortarThickness && a.normalDamping == b.normalDamping && a.shearDamping == b.shearDamping && a.tanFriction == b.tanFriction;
	}

	bool same(const MortarStrength& a, const MortarStrength& b)
	{
		return a.tension == b.tension && a.cohesion == b.cohesion && a.tanFriction == b.tanFriction && a.compression == b.compression
		        && a.capShape == b.capShape;
	}

} // namespace

namespace {

	template <class Matrix> bool near(const Matrix& a, const Matrix& b, Real by) { return ((a - b).array().abs() <= by).all(); }

	/// @param tolerance of lengths [m]   @param share of numbers without a unit
	bool alike(const JointPatch& a, const JointPatch& b, Real tolerance, Real share)
	{
		for (int s = 0; s < 2; ++s)
			if (a.sides[s].nodes != b.sides[s].nodes || !near(a.sides[s].corners, b.sides[s].corners, tolerance)
			    || !near(a.sides[s].weights, b.sides[s].weights, share))
				return false;
		return a.cut.empty() && b.cut.empty() && a.rows == b.rows && near(a.weight, b.weight, share * a.weight.sum());
	}

} // namespace

bool alike(const JointShape& a, const JointShape& b, Real tolerance)
{
	const Real share = tolerance / std::sqrt(a.area);
	for (int s = 0; s < 2; ++s)
		if (a.faces[s].face != b.faces[s].face || !near(a.faces[s].normal, b.faces[s].normal, share)) return false;
	if (a.patches.size() != b.patches.size() || a.rows != b.rows || !same(a.strength, b.strength) || !same(a.pair, b.pair)
	    || !near(a.along, b.along, share))
		return false;
	for (std::size_t i = 0; i < a.patches.size(); ++i)
		if (!alike(a.patches[i], b.patches[i], tolerance, share)) return false;
	return true;
}

int takePatch(const Joint& joint, int& index)
{
	int patch = 0;
	for (; index >= joint.shape->patches[patch].count; ++patch)
		index -= joint.shape->patches[patch].count;
	return patch;
}

JointSegment segmentOf(const Joint& joint, int index)
{
	JointSegment segment;
	int          at         = index;
	segment.patch           = takePatch(joint, at);
	const JointPatch& patch = joint.shape->patches[segment.patch];
	if (!patch.cut.empty()) segment = patch.cut[at];
	else {
		segment.p    = (at % patch.rows[0] + .5) / patch.rows[0];
		segment.q    = (at / patch.rows[0] + .5) / patch.rows[1];
		segment.area = patch.weight.sum() / patch.count;
	}
	if (!joint.segments.empty()) segment.state = SegmentState(int(joint.segments[segment.patch].row(JointSegments::State)[at]));
	return segment;
}

void makeSegments(Joint& joint)
{
	if (!joint.segments.empty()) return;
	std::vector<JointSegments> all;
	int                        first = 0;
	for (const auto& patch : joint.shape->patches) {
		JointSegments arrays(patch.count);
		for (int s = 0; s < patch.count; ++s) {
			const JointSegment segment         = segmentOf(joint, first + s);
			arrays.row(JointSegments::P)[s]    = segment.p;
			arrays.row(JointSegments::Q)[s]    = segment.q;
			arrays.row(JointSegments::Area)[s] = segment.area;
		}
		first += patch.count;
		all.push_back(arrays);
	}
	joint.segments = std::move(all);
}

} // namespace brick
