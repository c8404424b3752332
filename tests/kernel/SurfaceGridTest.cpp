// SPDX-License-Identifier: GPL-2.0-or-later
// Tests of the nodes, cells and spots on the surface of a refined brick.
#include "References.hpp"
#include "Refusal.hpp"
#include <pkg/brick/kernel/SurfaceGrid.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace brick;

namespace {

/// A few roundings of numbers up to n = 8.
constexpr Real roundOff = 1e-14;

std::vector<int> allCells()
{
	std::vector<int> all;
	for (int n = 1; n <= largestCells; ++n)
		all.push_back(n);
	return all;
}

/// Point of a face of the natural cube [-1,1]^3 at its coordinates.
Vector3r naturalPoint(int face, Real xi, Real eta)
{
	const Vector4r weights = bilinear(xi, eta);
	Vector3r       point   = Vector3r::Zero();
	for (int a = 0; a < 4; ++a) {
		const int* signs = nodeSigns[faceNodes[face][a]];
		point += weights[a] * Vector3r(signs[0], signs[1], signs[2]);
	}
	return point;
}

Vector3r pointAt(const std::vector<Vector3r>& nodes, const SurfaceSpot& spot)
{
	Vector3r point = Vector3r::Zero();
	for (int a = 0; a < 4; ++a)
		point += spot.weights[a] * nodes[spot.nodes[a]];
	return point;
}

} // namespace

TEST(SurfaceGridTest, nodes_are_those_of_the_grid_that_lie_on_the_surface)
{
	for (int n : allCells()) {
		const SurfaceGrid            grid(n);
		std::set<std::array<int, 3>> places;
		for (int a = 0; a < grid.size(); ++a) {
			const auto& place = grid.gridPlace(a);
			places.insert(place);
			bool atEnd = false;
			for (int coordinate : place) {
				EXPECT_TRUE(coordinate >= 0 && coordinate <= n);
				atEnd = atEnd || coordinate == 0 || coordinate == n;
			}
			EXPECT_TRUE(atEnd);
		}
		EXPECT_EQ(grid.cells(), n);
		EXPECT_EQ(grid.size(), 6 * n * n + 2);
		EXPECT_EQ(int(places.size()), grid.size());
	}
}

TEST(SurfaceGridTest, corners_come_first_in_their_order_and_the_others_with_x_fastest)
{
	for (int n : allCells()) {
		const SurfaceGrid grid(n);
		for (int a = 0; a < nodeCount; ++a)
			EXPECT_EQ(grid.naturalCoordinates(a), Vector3r(nodeSigns[a][0], nodeSigns[a][1], nodeSigns[a][2]));
		const auto rank = [&](int a) { return grid.gridPlace(a)[0] + (n + 1) * (grid.gridPlace(a)[1] + (n + 1) * grid.gridPlace(a)[2]); };
		for (int a = nodeCount + 1; a < grid.size(); ++a)
			EXPECT_GT(rank(a), rank(a - 1));
	}
}

TEST(SurfaceGridTest, grid_of_a_face_runs_along_the_order_of_its_nodes)
{
	for (int n : allCells()) {
		const SurfaceGrid grid(n);
		for (int face = 0; face < faceCount; ++face) {
			EXPECT_EQ(grid.faceNode(face, 0, 0), faceNodes[face][0]);
			EXPECT_EQ(grid.faceNode(face, n, 0), faceNodes[face][1]);
			EXPECT_EQ(grid.faceNode(face, n, n), faceNodes[face][2]);
			EXPECT_EQ(grid.faceNode(face, 0, n), faceNodes[face][3]);
			for (int row = 0; row <= n; ++row)
				for (int column = 0; column <= n; ++column) {
					const Vector3r expected = naturalPoint(face, -1 + 2. * column / n, -1 + 2. * row / n);
					EXPECT_LT((grid.naturalCoordinates(grid.faceNode(face, column, row)) - expected).norm(), roundOff);
				}
		}
	}
}

TEST(SurfaceGridTest, faces_share_the_nodes_of_their_edges)
{
	for (int n : allCells()) {
		const SurfaceGrid  grid(n);
		std::map<int, int> faces;
		for (int face = 0; face < faceCount; ++face)
			for (int row = 0; row <= n; ++row)
				for (int column = 0; column <= n; ++column)
					++faces[grid.faceNode(face, column, row)];
		EXPECT_EQ(int(faces.size()), grid.size());
		for (const auto& [node, count] : faces) {
			const Vector3r natural = grid.naturalCoordinates(node);
			EXPECT_EQ(count, (natural.array().abs() == 1).count()); // 1 within a face, 2 on an edge, 3 at a corner
		}
	}
}

TEST(SurfaceGridTest, cells_look_outward_and_fill_their_face)
{
	for (int n : allCells()) {
		const SurfaceGrid           grid(n);
		const std::vector<Vector3r> nodes = grid.positions(cuboidCorners({ 2, 2, 2 }));
		const Hexahedron            cube(cuboidCorners({ 2, 2, 2 }));
		for (int face = 0; face < faceCount; ++face) {
			Vector3r sum = Vector3r::Zero();
			for (int row = 0; row < n; ++row)
				for (int column = 0; column < n; ++column) {
					const auto     cell = grid.cellNodes(face, column, row);
					const Vector3r area = (nodes[cell[2]] - nodes[cell[0]]).cross(nodes[cell[3]] - nodes[cell[1]]) / 2;
					EXPECT_LT((area - 4. / (n * n) * cube.faces[face].normal).norm(), roundOff);
					sum += area;
				}
			EXPECT_LT((sum - 4 * cube.faces[face].normal).norm(), 10 * roundOff); // 64 cells
		}
	}
}

TEST(SurfaceGridTest, one_cell_is_the_face_of_the_hexahedron_to_the_last_bit)
{
	const SurfaceGrid grid(1);
	for (int face = 0; face < faceCount; ++face)
		for (Real xi : { -1., -.7, -1e-17, .3, 1. })
			for (Real eta : { -1., -.1, 0., .9, 1. }) {
				const SurfaceSpot spot = grid.locate(face, xi, eta);
				for (int a = 0; a < 4; ++a)
					EXPECT_EQ(spot.nodes[a], faceNodes[face][a]);
				EXPECT_EQ(spot.weights, bilinear(xi, eta));
			}
	const Nodes corners = references::distortedNodes();
	for (int a = 0; a < nodeCount; ++a)
		EXPECT_EQ(grid.positions(corners)[a], corners[a]);
}

TEST(SurfaceGridTest, located_spots_lie_where_the_face_has_them)
{
	// on any hexahedron, warped faces too: the trilinear map is bilinear on a face, and so on each of its cells
	const Nodes corners = references::distortedNodes();
	for (int n : allCells()) {
		const SurfaceGrid           grid(n);
		const std::vector<Vector3r> nodes = grid.positions(corners);
		for (int face = 0; face < faceCount; ++face)
			for (int i = 0; i <= 40; ++i)
				for (int j = 0; j <= 40; ++j) {
					const Real        xi = -1 + i / 20., eta = -1 + j / 20.;
					const SurfaceSpot spot     = grid.locate(face, xi, eta);
					const Vector4r    weights  = bilinear(xi, eta);
					Vector3r          expected = Vector3r::Zero();
					for (int a = 0; a < 4; ++a)
						expected += weights[a] * corners[faceNodes[face][a]];
					EXPECT_LT((pointAt(nodes, spot) - expected).norm(), roundOff);
					EXPECT_NEAR(spot.weights.sum(), 1, roundOff);
					EXPECT_GE(spot.weights.minCoeff(), -roundOff); // on the border of two cells either may be found
				}
	}
}

TEST(SurfaceGridTest, spots_at_nodes_belong_to_these_alone)
{
	for (int n : allCells()) {
		const SurfaceGrid grid(n);
		for (int face = 0; face < faceCount; ++face)
			for (int row = 0; row <= n; ++row)
				for (int column = 0; column <= n; ++column) {
					const SurfaceSpot spot = grid.locate(face, -1 + 2. * column / n, -1 + 2. * row / n);
					Real              own  = 0;
					for (int a = 0; a < 4; ++a)
						if (spot.nodes[a] == grid.faceNode(face, column, row)) own += spot.weights[a];
					EXPECT_NEAR(own, 1, roundOff);
				}
	}
}

TEST(SurfaceGridTest, coordinates_outside_a_face_are_clamped_to_it)
{
	const SurfaceGrid grid(3);
	const Real        infinity = std::numeric_limits<Real>::infinity();
	for (Real beyond : { 1 + 1e-15, 1.5, 1e300, infinity })
		for (Real eta : { -1., .2, 1. }) {
			EXPECT_EQ(grid.locate(4, beyond, eta).nodes, grid.locate(4, 1, eta).nodes);
			EXPECT_EQ(grid.locate(4, beyond, eta).weights, grid.locate(4, 1, eta).weights);
			EXPECT_EQ(grid.locate(4, eta, -beyond).nodes, grid.locate(4, eta, -1).nodes);
			EXPECT_EQ(grid.locate(4, eta, -beyond).weights, grid.locate(4, eta, -1).weights);
		}
	const Real        nan  = std::numeric_limits<Real>::quiet_NaN();
	const SurfaceSpot spot = grid.locate(2, nan, 0); // of no use, but no node out of range either
	for (int node : spot.nodes)
		EXPECT_TRUE(node >= 0 && node < grid.size());
	EXPECT_TRUE(std::isnan(spot.weights.sum()));
}

TEST(SurfaceGridTest, tables_are_shared)
{
	for (int n : allCells()) {
		EXPECT_EQ(&surfaceGrid(n), &surfaceGrid(n));
		EXPECT_EQ(surfaceGrid(n).cells(), n);
	}
}

TEST(SurfaceGridTest, too_few_and_too_many_cells_are_refused)
{
	for (int n : { -1, 0, largestCells + 1, 1000000 }) {
		EXPECT_NE(refusal([&] { SurfaceGrid grid(n); }).find("allowed is 1 to 8"), std::string::npos) << n;
		EXPECT_NE(refusal([&] { surfaceGrid(n); }).find(std::to_string(n)), std::string::npos) << n;
	}
}
