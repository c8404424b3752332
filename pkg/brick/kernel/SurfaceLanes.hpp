// SPDX-License-Identifier: GPL-2.0-or-later
// Eight points of a face of a refined body, whose fields are bilinear in each cell of the face: included by the other ...Lanes.hpp (InstructionSets.hpp).

#include "EightLanes.hpp"

/// Three components of a vector.
struct Vectors {
	Lanes                     x[3];
	BRICK_INLINE Lanes&       operator[](int i) { return x[i]; }
	BRICK_INLINE const Lanes& operator[](int i) const { return x[i]; }
};
BRICK_INLINE Lanes dot(const Vectors& a, const Vector3r& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Not inlined, so that the code of bodies that are not refined stays small.
class SurfaceLanes {
public:
	/// The cells in which points lie.
	__attribute__((noinline)) void locate(const SurfaceGrid& grid, int face, const Lanes& xi, const Lanes& eta)
	{
		for (int lane = 0; lane < lanes; ++lane)
			at[lane] = grid.locate(face, xi[lane], eta[lane]);
	}
	/// A field of the surface's nodes at the points.
	__attribute__((noinline)) void interpolate(const Vector3r* field, Vectors& out) const
	{
		for (int lane = 0; lane < lanes; ++lane) {
			const auto&    w = at[lane].weights;
			const auto&    n = at[lane].nodes;
			const Vector3r v = (w[0] * field[n[0]] + w[1] * field[n[1]]) + (w[2] * field[n[2]] + w[3] * field[n[3]]);
			out[0][lane] = v[0], out[1][lane] = v[1], out[2][lane] = v[2];
		}
	}
	/// Shares forces at the first points, as many as count, out to the nodes.
	__attribute__((noinline)) void addForces(const Vectors& force, int count, Vector3r* nodal) const
	{
		for (int lane = 0; lane < std::min(lanes, count); ++lane) {
			const Vector3r f(force[0][lane], force[1][lane], force[2][lane]);
			for (int a = 0; a < 4; ++a)
				nodal[at[lane].nodes[a]] += at[lane].weights[a] * f;
		}
	}

private:
	SurfaceSpot at[lanes];
};
