// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes on the surface of an n x n x n grid of a hexahedron, and each face as a grid of n x n bilinear cells. Topology and natural coordinates only:
// shared by all bricks with the same n. A face's coordinates (xi, eta) and the order of a cell's nodes are those of the faces in Types.hpp.
//
//     (xi, eta) = (-1, 1)  3 ---+-----+--- 2  (1, 1)
//                          |    |     |    |      row r holds eta in [-1 + 2 r/n, -1 + 2 (r + 1)/n],
//                    row 1 +----3-----2----+      column c holds xi likewise. The four nodes of
//                          |    |     |    |      a cell, counter-clockwise from outside:
//                    row 0 +----0-----1----+      (c, r), (c + 1, r), (c + 1, r + 1), (c, r + 1).
//                          |    |     |    |
//            (-1, -1)      0 ---+-----+--- 1  (1, -1)
#pragma once

#include "Hexahedron.hpp"

#include <vector>

namespace brick {

/// Most cells along an edge: 386 nodes, whose modes (CondensedPart.hpp) are a matrix of 11 MB that a step has to read twice.
constexpr int largestCells = 8;

/// Where a place of the grid is in a hexahedron, by its trilinear map [m]; a corner's place gives the corner to the last bit.
/// @param place 0 to cells in each direction
Vector3r gridPoint(const Nodes& corners, const std::array<int, 3>& place, int cells);

/// Part of a face's surface: four nodes and what each contributes there.
struct SurfaceSpot {
	std::array<int, 4> nodes;
	Vector4r           weights; ///< bilinear; they sum to 1
};

class SurfaceGrid {
public:
	/// @param cells n along each edge, 1 to largestCells, otherwise std::invalid_argument
	explicit SurfaceGrid(int cells);

	int cells() const { return n; }
	/// Number of nodes: 6 n^2 + 2.
	int size() const { return int(steps.size()); }

	/// Place of a node in the grid, each coordinate 0 to n. Nodes 0 to 7 are the hexahedron's corners in their own order; the others follow in
	/// lexicographic order of (k, j, i): x runs fastest.
	const std::array<int, 3>& gridPlace(int node) const { return steps[node]; }
	/// The same as natural coordinates in [-1,1]^3; exact at the ends.
	Vector3r naturalCoordinates(int node) const;
	/// Where the nodes are in a hexahedron [m]: gridPoint of each.
	std::vector<Vector3r> positions(const Nodes& corners) const;

	/// Node of a face at xi = -1 + 2 column/n, eta = -1 + 2 row/n; column and row 0 to n.
	int faceNode(int face, int column, int row) const { return faceGrids[(face * (n + 1) + row) * (n + 1) + column]; }
	/// Nodes of a cell of a face, in the order of faceNodes; column and row 0 to n - 1.
	std::array<int, 4> cellNodes(int face, int column, int row) const
	{
		return { faceNode(face, column, row), faceNode(face, column + 1, row), faceNode(face, column + 1, row + 1), faceNode(face, column, row + 1) };
	}
	/// The cell that holds a point of a face and its weights there; with n = 1 faceNodes and bilinear(xi, eta) to the last bit.
	/// @param xi, eta clamped to [-1,1]   Never throws or allocates; NaN makes the weights NaN.
	SurfaceSpot locate(int face, Real xi, Real eta) const
	{
		const Real x = clamped(xi), y = clamped(eta);
		const int  column = cellAt(x), row = cellAt(y);
		return { cellNodes(face, column, row), bilinear(insideCell(x, column), insideCell(y, row)) };
	}

private:
	int                             n;
	std::vector<std::array<int, 3>> steps;
	std::vector<int>                faceGrids; ///< face by face, row by row

	static Real clamped(Real value) { return std::min(std::max(value, Real(-1)), Real(1)); }
	int         cellAt(Real coordinate) const
	{
		const Real place = (coordinate + 1) / 2 * n;
		return place > 0 ? std::min(int(place), n - 1) : 0; // NaN: 0
	}
	/// Coordinate in [-1,1] within a cell; nothing is rounded when n = 1 or at the ends of the face.
	Real insideCell(Real coordinate, int cell) const { return n * coordinate + (n - 1 - 2 * cell); }
};

/// The grid of n cells, made once, shared. @throws std::invalid_argument as the constructor
const SurfaceGrid& surfaceGrid(int cells);

} // namespace brick
