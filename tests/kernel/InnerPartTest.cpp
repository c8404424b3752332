// SPDX-License-Identifier: GPL-2.0-or-later
#include "References.hpp"

#include <pkg/brick/kernel/InnerPart.hpp>
#include <pkg/brick/kernel/Stiffness.hpp>
#include <pkg/brick/kernel/SurfaceGrid.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace brick;

namespace {

constexpr Real roundOff = 1e-11; ///< relative, of eigenvalues of 24 x 24 matrices

InnerPartType cube(Inner inner = Inner::Inset, Deformation level = Deformation::Trilinear, Real r = .005)
{
	return { cuboidCorners(Vector3r::Constant(.2)), level, Element::Full, inner, r, 9.8e6, .25, 1800 };
}

InnerPartType refined(int cells, Inner inner = Inner::Inset)
{
	InnerPartType type = cube(inner, Deformation::Refined);
	type.cells         = cells;
	return type;
}

/// Displacements of a uniform gradient, x0 y0 z0 x1 ...
VectorX linearField(const std::vector<Vector3r>& nodes, const Matrix3r& gradient)
{
	VectorX u(3 * nodes.size());
	for (std::size_t a = 0; a < nodes.size(); ++a)
		u.segment<3>(3 * a) = gradient * nodes[a];
	return u;
}

} // namespace

TEST(InnerPartTest, nodes_sit_a_contact_part_inside_the_corners_or_at_them)
{
	const Nodes     corners = cuboidCorners(Vector3r::Constant(.2));
	const InnerPart inset(cube()), full(cube(Inner::FullSize));
	for (int a = 0; a < nodeCount; ++a) {
		EXPECT_LT((inset.nodes[a] - .95 * corners[a]).norm(), 1e-15);
		EXPECT_EQ(full.nodes[a], corners[a]);
	}
}

TEST(InnerPartTest, level_decides_the_number_of_modes)
{
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Rigid)).modes.count(), 0);
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Uniform)).modes.count(), 6);
	EXPECT_EQ(InnerPart(cube(Inner::Inset, Deformation::Trilinear)).modes.count(), 18);
}

TEST(InnerPartTest, nodes_carry_the_whole_bricks_mass)
{
	// Spectrum of a cube's K is E L times fixed numbers, the largest 1 / (1 - 2 nu) / 2 = 1; nodes weigh an eighth of the brick each, whatever their hexahedron.
	for (Real r : { .001, .005, .02 }) {
		const Real node = 1800 * .2 * .2 * .2 / 8;
		EXPECT_NEAR(InnerPart(cube(Inner::Inset, Deformation::Trilinear, r)).modes.omegaSquared[17] * node / (9.8e6 * (.2 - 2 * r)), 1, roundOff);
		EXPECT_NEAR(InnerPart(cube(Inner::FullSize, Deformation::Trilinear, r)).modes.omegaSquared[17] * node / (9.8e6 * .2), 1, roundOff);
	}
}

TEST(InnerPartTest, inset_softens_a_brick_as_its_smaller_section_says)
{
	// pulled by two opposite faces: the nodes' spread is N l / (E l^2), with l = L - 2 r
	const InnerPart part(cube());
	Vector24        f, u = Vector24::Zero();
	for (int a = 0; a < nodeCount; ++a)
		f.segment<3>(3 * a) = Vector3r(nodeSigns[a][0] * 25, 0, 0);
	for (int k = 0; k < part.modes.count(); ++k)
		u += part.modes.shapes.col(k) * part.modes.shapes.col(k).dot(f) / part.modes.omegaSquared[k];
	const Real spread = u[3] - u[0]; // nodes 1 and 0
	EXPECT_NEAR(spread, 100 / (9.8e6 * .19), roundOff * spread);
}

TEST(InnerPartTest, contact_part_too_thick_for_the_brick_is_refused)
{
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	for (Real r : { .1, .2, 0., -.01, nan })
		EXPECT_THROW(InnerPart(cube(Inner::Inset, Deformation::Trilinear, r)), std::invalid_argument) << r;
	auto poisson    = cube();
	poisson.poisson = .5;
	EXPECT_THROW(InnerPart { poisson }, std::invalid_argument);
}

TEST(InnerPartTest, cells_count_for_refined_parts_only)
{
	InnerPartType type = cube();
	type.cells         = 3;
	const InnerPart plain(cube()), part(type);
	EXPECT_EQ(part.cells, 1);
	EXPECT_EQ(part.nodes, plain.nodes);
	EXPECT_EQ(part.modes.shapes, plain.modes.shapes);
	EXPECT_TRUE(part.surfaceMasses.empty());
	EXPECT_EQ(part.rigidMass, Matrix6r::Zero());
	for (int cells : { 0, -1, largestCells + 1 })
		EXPECT_THROW(InnerPart(refined(cells)), std::invalid_argument) << cells;
}

TEST(InnerPartTest, one_refined_cell_is_the_trilinear_hexahedron)
{
	for (Inner inner : { Inner::Inset, Inner::FullSize }) {
		const InnerPart plain(cube(inner)), part(refined(1, inner));
		ASSERT_EQ(part.nodes.size(), plain.nodes.size());
		for (int a = 0; a < nodeCount; ++a) {
			EXPECT_EQ(part.nodes[a], plain.nodes[a]);
			EXPECT_NEAR(part.surfaceMasses[a], 1800 * .2 * .2 * .2 / 8, roundOff);
		}
		ASSERT_EQ(part.modes.count(), plain.modes.count());
		for (int k = 0; k < modeCount; ++k)
			EXPECT_NEAR(part.modes.omegaSquared[k], plain.modes.omegaSquared[k], roundOff * plain.modes.omegaSquared.back());
		// round-off over the distance of neighbouring frequencies, 1e-3 of the largest at least
		EXPECT_LT((part.modes.shapes - plain.modes.shapes).norm(), 1e3 * roundOff * plain.modes.shapes.norm());
		EXPECT_LT((part.stressOf - plain.stressOf).norm(), roundOff * plain.stressOf.norm());
	}
}

TEST(InnerPartTest, refined_part_has_the_nodes_of_its_surface_and_all_their_deformations)
{
	for (int n : { 2, 3 }) {
		const InnerPart part(refined(n));
		const int       size = surfaceGrid(n).size();
		EXPECT_EQ(part.cells, n);
		EXPECT_EQ(part.nodes, surfaceGrid(n).positions(insetCorners(Hexahedron(refined(n).corners), .005)));
		EXPECT_EQ(part.modes.count(), 3 * size - 6);
		EXPECT_EQ(part.columns.modes(), 3 * size - 6);
		EXPECT_EQ(part.columns.dofs(), 3 * size);
		std::vector<Real> unit(part.columns.paddedModes(), 0), u(part.columns.paddedDofs());
		unit[4] = 1;
		part.columns.displacements(unit.data(), u.data());
		EXPECT_EQ(Eigen::Map<VectorX>(u.data(), 3 * size), part.modes.shapes.col(4));
	}
}

TEST(InnerPartTest, refined_part_carries_the_whole_bricks_mass)
{
	const Real mass = 1800 * .2 * .2 * .2;
	for (int n : { 2, 4 })
		for (Inner inner : { Inner::Inset, Inner::FullSize }) {
			const InnerPart part(refined(n, inner));
			const Real      side = inner == Inner::Inset ? .19 : .2, moment = mass * side * side / 6 * (1 + 2. / (n * n)); // CondensedPart.hpp
			Matrix6r        expected = Matrix6r::Zero();
			expected.diagonal() << Vector3r::Constant(mass), Vector3r::Constant(moment);
			EXPECT_LT((part.rigidMass - expected).norm(), roundOff * mass);
			Real onSurface = 0; // all but (n - 1)^3 of n^3 cells' worth
			for (Real m : part.surfaceMasses)
				onSurface += m;
			EXPECT_NEAR(onSurface, mass * (1 - std::pow(1 - 1. / n, 3)), roundOff * mass);
		}
}

TEST(InnerPartTest, uniform_strain_has_its_stress_at_every_level)
{
	const Matrix3r gradient = references::distortedGradient();
	const Vector6r strain
	        = (Vector6r() << gradient.diagonal(), gradient(0, 1) + gradient(1, 0), gradient(1, 2) + gradient(2, 1), gradient(2, 0) + gradient(0, 2))
	                  .finished();
	const Vector6r             stress = elasticity(9.8e6, .25) * strain;
	std::vector<InnerPartType> types { cube(), cube(Inner::FullSize), cube(Inner::Inset, Deformation::Uniform), refined(1), refined(3) };
	types.push_back(types.back());
	types.back().inner   = Inner::FullSize;
	types.back().corners = references::distortedNodes(); // the volume average, whatever the shape
	for (const InnerPartType& type : types) {
		const InnerPart part(type);
		EXPECT_LT((part.meanStress(linearField(part.nodes, gradient)) - stress).norm(), roundOff * stress.norm()) << int(type.deformation);
	}
}

TEST(InnerPartTest, stress_of_one_hexahedron_is_that_at_its_centre)
{
	const InnerPart part(cube());
	Vector24        u;
	Nodes           corners;
	for (int i = 0; i < dofCount; ++i)
		u[i] = std::sin(1 + 2.3 * i);
	std::copy(part.nodes.begin(), part.nodes.end(), corners.begin());
	const Vector6r expected = centreStress(corners, 9.8e6, .25, u);
	EXPECT_LT((part.meanStress(u) - expected).norm(), roundOff * expected.norm());
	const std::vector<Real> stored(u.data(), u.data() + dofCount);
	EXPECT_EQ(part.meanStress(Eigen::Map<const VectorX>(stored.data(), dofCount)), part.meanStress(u));
}
