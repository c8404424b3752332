// SPDX-License-Identifier: GPL-2.0-or-later
// Spots of contact. Faces that cannot touch are refused by their nodes; of the others only the rows and columns near the overlap are looked at, eight cells
// at a time. Most cells lie inside the other body as a whole and have one nearest face: their spots follow in closed form; the others are cut as polygons.
#include "ClippedPolygon.hpp"
#include "Contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brick {

namespace {

	constexpr Real unbounded = std::numeric_limits<Real>::infinity();

	Vector3r displacementOf(const Placement& at, int node) { return at.displacement ? at.displacement[node] : Vector3r(Vector3r::Zero()); }

	/// Of a body whose faces deform cell by cell; null for one whose displacement, if any, is bilinear over a whole face.
	const SurfaceGrid* cellsOf(const Side& side) { return side.cells > 1 && side.placement.displacement ? &surfaceGrid(side.cells) : nullptr; }

	/// Displacement of the nodes of a face outwards.
	struct FaceLift {
		Real mean = 0, highest = -unbounded, lowest = unbounded;

		FaceLift(const Side& side, const SurfaceGrid& grid, int face)
		{
			for (int row = 0; row <= grid.cells(); ++row)
				for (int column = 0; column <= grid.cells(); ++column) {
					const Real up = side.solid->faces[face].normal.dot(side.placement.displacement[grid.faceNode(face, column, row)]);
					mean += up, highest = std::max(highest, up), lowest = std::min(lowest, up);
				}
			mean /= (grid.cells() + 1) * (grid.cells() + 1);
		}
	};

	/// Not above any point of a refined body, along a direction in body axes.
	Real lowestAlong(const Vector3r& direction, const Side& side, const SurfaceGrid& grid)
	{
		Real atRest = unbounded, lift = unbounded;
		for (const Vector3r& corner : side.solid->corners)
			atRest = std::min(atRest, direction.dot(corner));
		for (int node = 0; node < grid.size(); ++node)
			lift = std::min(lift, direction.dot(side.placement.displacement[node]));
		return atRest + lift;
	}

	/// The face of `a` that the middle of `b` is farthest beyond has all of b's nodes outside: so most pairs that do not touch are told, at little cost.
	bool isBeyondOneFace(const Side& a, const Side& b)
	{
		const Vector3r offset = a.placement.rotation.transpose() * (b.placement.position - a.placement.position);
		int            likely = 0;
		Real           height = -unbounded;
		for (int f = 0; f < faceCount; ++f) {
			const Real h = a.solid->faces[f].normal.dot(offset) - a.solid->faces[f].offset;
			if (h > height) height = h, likely = f;
		}
		const Face& face    = a.solid->faces[likely];
		Real        highest = 0;
		if (const SurfaceGrid* grid = cellsOf(a)) highest = FaceLift(a, *grid, likely).highest;
		else if (a.placement.displacement) {
			highest = -unbounded;
			for (int node : faceNodes[likely])
				highest = std::max(highest, face.normal.dot(a.placement.displacement[node]));
		}
		const Vector3r normal = b.placement.rotation.transpose() * (a.placement.rotation * face.normal);
		if (const SurfaceGrid* grid = cellsOf(b)) return height + lowestAlong(normal, b, *grid) >= highest;
		Real lowest = unbounded;
		for (int node = 0; node < nodeCount; ++node)
			lowest = std::min(lowest, normal.dot(b.solid->corners[node] + displacementOf(b.placement, node)));
		return height + lowest >= highest;
	}

} // namespace

} // namespace brick

#define BRICK_LANES_FILE "ContactSearchLanes.hpp"
#include "ForEachInstructionSet.hpp"

namespace brick {

void findContact(const Side& side0, const Side& side1, std::vector<ContactSpot>& spots)
{
	spots.clear();
	if (isBeyondOneFace(side0, side1) || isBeyondOneFace(side1, side0)) return;
	BRICK_BEST_INSTRUCTION_SET(findTouching)(side0, side1, spots);
}

} // namespace brick
