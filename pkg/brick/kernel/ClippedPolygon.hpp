// SPDX-License-Identifier: GPL-2.0-or-later
// A small convex polygon whose vertices carry further values (distances, natural coordinates) that vary linearly over it,
// and which can be cut where one of these values changes sign. Nothing is allocated.
#pragma once

#include "Types.hpp"

#include <algorithm>

namespace brick {

/// @tparam dimensions  entries of a vertex; the first three are its place
/// @tparam cuts        how often it may be cut. A plane cut adds one vertex; a value that is not quite linear (a bulged face) up to two
template <int dimensions, int cuts> class ClippedPolygon {
public:
	using Vertex = Eigen::Matrix<Real, dimensions, 1>;

	/// Starts from a convex quadrilateral.
	ClippedPolygon(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d)
	        : count(4)
	{
		vertices[0] = a, vertices[1] = b, vertices[2] = c, vertices[3] = d;
	}

	bool empty() const { return count < 3; }

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

	/// Area [m2], and the values at the centroid.
	Real areaAndCentroid(Vertex& centroid) const
	{
		centroid.setZero();
		Real area = 0;
		for (int i = 1; i + 1 < count; ++i) {
			const Vertex &a = vertices[0], &b = vertices[i], &c = vertices[i + 1];
			const Real    triangle = (b - a).template head<3>().cross((c - a).template head<3>()).norm() / 2;
			area += triangle;
			centroid += triangle / 3 * (a + b + c);
		}
		if (area > 0) centroid /= area;
		return area;
	}

private:
	/// Keeps the part where a value is negative.
	template <class Value> void keep(Value value)
	{
		std::array<Vertex, capacity> kept;
		int                          n = 0;
		for (int i = 0; i < count && n + 2 <= capacity; ++i) {
			const Vertex &here = vertices[i], &next = vertices[i + 1 < count ? i + 1 : 0];
			const Real    a = value(here), b = value(next);
			if (a < 0) kept[n++] = here;
			if ((a < 0) != (b < 0)) kept[n++] = here + a / (a - b) * (next - here);
		}
		std::copy(kept.begin(), kept.begin() + n, vertices.begin());
		count = n;
	}

	static constexpr int         capacity = 4 + 2 * cuts;
	std::array<Vertex, capacity> vertices;
	int                          count;
};

} // namespace brick
