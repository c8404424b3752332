// SPDX-License-Identifier: GPL-2.0-or-later
// A small convex polygon whose vertices carry further values (distances, natural coordinates) that vary linearly over it,
// and which can be cut where one of these values changes sign. Nothing is allocated.
#pragma once

#include "Types.hpp"

#include <algorithm>

namespace brick {

/// @tparam dimensions  entries of a vertex; the first three are its place
/// @tparam cuts        how often it may be cut. A cut by a plane makes two new vertices, by a value that is not quite linear (a bulged face) up to four
template <int dimensions, int cuts> class ClippedPolygon {
public:
	using Vertex = Eigen::Matrix<Real, dimensions, 1>;

	/// A convex quadrilateral whose vertices are still to be set.
	ClippedPolygon()
	        : outline { 4, 4, { 0, 1, 2, 3 } }
	{
	}
	/// Starts from a convex quadrilateral.
	ClippedPolygon(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d)
	        : ClippedPolygon()
	{
		vertices[0] = a, vertices[1] = b, vertices[2] = c, vertices[3] = d;
	}
	Vertex& vertex(int i) { return vertices[outline.order[i]]; }

	bool empty() const { return outline.count < 3; }

	/// Keeps the part where the given entry is negative.
	void keepNegative(int entry)
	{
		keep([entry](const Vertex& v) { return v[entry]; });
	}

	/// Keeps the part where one entry is above another.
	void keepAbove(int entry, int other)
	{
		keep([entry, other](const Vertex& v) { return v[other] - v[entry]; });
	}

	/// Area [m2], and the values at the centroid. By triangles about the middle of the outline, so that of values that are not quite linear no vertex counts more
	/// for standing first.
	Real areaAndCentroid(Vertex& centroid) const
	{
		Real area = 0;
		centroid.setZero();
		forEachTriangle([&](const Vertex& a, const Vertex& b, const Vertex& c, Real triangle) {
			area += triangle;
			centroid += triangle / 3 * (a + b + c);
		});
		if (area > 0) centroid /= area;
		return area;
	}

	/// The values where the force of a pressure acts that is proportional to minus an entry. Not changed when there is no pressure.
	void pressedCentroid(int entry, Vertex& centroid) const
	{
		Real   all = 0;
		Vertex sum = Vertex::Zero();
		forEachTriangle([&](const Vertex& a, const Vertex& b, const Vertex& c, Real triangle) {
			const Real three = a[entry] + b[entry] + c[entry];
			sum += triangle * ((a[entry] + three) * a + (b[entry] + three) * b + (c[entry] + three) * c);
			all += triangle * 4 * three;
		});
		if (all < 0) centroid = sum / all;
	}

private:
	static constexpr int capacity = 4 + 4 * cuts;
	static_assert(capacity < 128, "numbers of vertices are kept as characters");

public:
	/// Which vertices the polygon has at present. Vertices that are cut off are kept: to cut a polygon in several ways, remember its outline and go back to it.
	struct Outline {
		int         count, stored;
		signed char order[capacity];
	};
	const Outline& present() const { return outline; }
	void           goBackTo(const Outline& earlier)
	{
		outline.count = earlier.count, outline.stored = earlier.stored;
		std::copy(earlier.order, earlier.order + earlier.count, outline.order);
	}

private:
	/// The triangles about the middle of the outline, with their areas. (The mean of the vertices would jump where round-off makes one vertex two.)
	template <class Use> void forEachTriangle(Use use) const
	{
		if (empty()) return;
		Vertex middle = Vertex::Zero();
		Real   around = 0;
		for (int i = 0; i < outline.count; ++i) {
			const Vertex &b = vertices[outline.order[i]], &c = vertices[outline.order[i + 1 < outline.count ? i + 1 : 0]];
			const Real    length = (c - b).template head<3>().norm();
			middle += length / 2 * (b + c), around += length;
		}
		if (around > 0) middle /= around;
		for (int i = 0; i < outline.count; ++i) {
			const Vertex &b = vertices[outline.order[i]], &c = vertices[outline.order[i + 1 < outline.count ? i + 1 : 0]];
			use(middle, b, c, (b - middle).template head<3>().cross((c - middle).template head<3>()).norm() / 2);
		}
	}

	/// Keeps the part where a value is negative.
	template <class Value> void keep(Value value)
	{
		if (empty()) return;
		Outline    kept;
		int        n = 0, stored = outline.stored;
		const Real first = value(vertices[outline.order[0]]);
		Real       a     = first;
		for (int i = 0; i < outline.count && stored < capacity; ++i) {
			const int  here = outline.order[i], next = outline.order[i + 1 < outline.count ? i + 1 : 0];
			const Real b = i + 1 < outline.count ? value(vertices[next]) : first;
			if (a < 0) kept.order[n++] = here;
			if ((a < 0) != (b < 0)) {
				vertices[stored] = vertices[here] + a / (a - b) * (vertices[next] - vertices[here]);
				kept.order[n++]  = stored++;
			}
			a = b;
		}
		kept.count = n, kept.stored = stored;
		goBackTo(kept);
	}

	std::array<Vertex, capacity> vertices;
	Outline                      outline;
};

} // namespace brick
