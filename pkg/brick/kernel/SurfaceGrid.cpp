// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes and cells on the surface of a refined brick: see SurfaceGrid.hpp.
#include "SurfaceGrid.hpp"
#include "Message.hpp"

#include <stdexcept>

namespace brick {

namespace {

	using Place = std::array<int, 3>;

	void requireCells(int n)
	{
		if (n < 1 || n > largestCells) throw std::invalid_argument(message("a part has ", n, " cells along an edge; allowed is 1 to ", largestCells));
	}

	Place cornerPlace(int corner, int n)
	{
		const int* signs = nodeSigns[corner];
		return { n * (1 + signs[0]) / 2, n * (1 + signs[1]) / 2, n * (1 + signs[2]) / 2 };
	}

	/// How many of the coordinates are at an end: 0 inside, 1 on a face, 2 on an edge, 3 at a corner.
	int endsAt(const Place& place, int n)
	{
		int ends = 0;
		for (int coordinate : place)
			ends += coordinate == 0 || coordinate == n;
		return ends;
	}

	/// Place of a node of a face: from its first corner, column steps towards the second and row steps towards the fourth.
	Place facePlace(int face, int column, int row, int n)
	{
		const Place origin = cornerPlace(faceNodes[face][0], n), right = cornerPlace(faceNodes[face][1], n), up = cornerPlace(faceNodes[face][3], n);
		Place       place;
		for (int i = 0; i < 3; ++i)
			place[i] = origin[i] + (column * (right[i] - origin[i]) + row * (up[i] - origin[i])) / n;
		return place;
	}

	Vector3r natural(const Place& place, int n) { return Vector3r(2 * place[0] - n, 2 * place[1] - n, 2 * place[2] - n) / n; }

} // namespace

Vector3r gridPoint(const Nodes& corners, const Place& place, int cells)
{
	const auto N = shapeFunctions(natural(place, cells)); // at a corner seven are 0 and one is 1, exactly
	Vector3r   x = Vector3r::Zero();
	for (int a = 0; a < nodeCount; ++a)
		x += N[a] * corners[a];
	return x;
}

SurfaceGrid::SurfaceGrid(int cells)
        : n(cells)
{
	requireCells(n);
	std::vector<int> nodeAt((n + 1) * (n + 1) * (n + 1), -1);
	const auto       index = [this](const Place& p) { return p[0] + (n + 1) * (p[1] + (n + 1) * p[2]); };
	const auto       add   = [&](const Place& p) { nodeAt[index(p)] = size(), steps.push_back(p); };
	for (int a = 0; a < nodeCount; ++a)
		add(cornerPlace(a, n));
	for (int k = 0; k <= n; ++k)
		for (int j = 0; j <= n; ++j)
			for (int i = 0; i <= n; ++i) {
				const int ends = endsAt({ i, j, k }, n);
				if (ends == 1 || ends == 2) add({ i, j, k });
			}
	for (int face = 0; face < faceCount; ++face)
		for (int row = 0; row <= n; ++row)
			for (int column = 0; column <= n; ++column)
				faceGrids.push_back(nodeAt[index(facePlace(face, column, row, n))]);
}

Vector3r SurfaceGrid::naturalCoordinates(int node) const { return natural(steps[node], n); }

std::vector<Vector3r> SurfaceGrid::positions(const Nodes& corners) const
{
	std::vector<Vector3r> nodes;
	for (const Place& place : steps)
		nodes.push_back(gridPoint(corners, place, n));
	return nodes;
}

const SurfaceGrid& surfaceGrid(int cells)
{
	requireCells(cells);
	static const std::vector<SurfaceGrid> grids = [] {
		std::vector<SurfaceGrid> all;
		for (int n = 1; n <= largestCells; ++n)
			all.emplace_back(n);
		return all;
	}();
	return grids[cells - 1];
}

} // namespace brick
