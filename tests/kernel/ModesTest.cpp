// SPDX-License-Identifier: GPL-2.0-or-later
#include "References.hpp"
#include "Refusal.hpp"
#include <pkg/brick/kernel/Hexahedron.hpp>
#include <pkg/brick/kernel/Modes.hpp>
#include <pkg/brick/kernel/Stiffness.hpp>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace brick;

namespace {

/// Rounding of eigenvectors and of sums over 24 components.
constexpr Real roundOff = 1e-12;

constexpr Real young = 9.8e6, density = 1800;

const Element     elements[] = { Element::Full, Element::Incompatible, Element::Bbar };
const Deformation levels[]   = { Deformation::Uniform, Deformation::Trilinear };

/// One brick type, all that its modes are made from.
struct Sample {
	Nodes                       nodes;
	Matrix24                    K;
	std::array<Real, nodeCount> masses;
	Vector24                    massDiagonal;

	Sample(const Nodes& n, Real nu, Element element)
	        : nodes(n)
	        , K(stiffness(n, young, nu, element))
	        , masses(lumpedMasses(n, density * solidProperties(n).volume))
	{
		for (int i = 0; i < dofCount; ++i)
			massDiagonal[i] = masses[i / 3];
	}
	Modes modes(Deformation level) const { return deformationModes(K, nodes, masses, level); }
};

std::vector<Sample> samples()
{
	std::vector<Sample> all;
	for (const Nodes& nodes : { cuboidCorners({ .2, .2, .2 }), cuboidCorners({ .1, .2, .3 }), references::distortedNodes() })
		for (Element element : elements)
			for (Real nu : { .25, .49 })
				all.emplace_back(nodes, nu, element);
	return all;
}

Vector24 linearField(const Nodes& nodes, const Matrix3r& gradient)
{
	Vector24 u;
	for (int a = 0; a < nodeCount; ++a)
		u.segment<3>(3 * a) = gradient * nodes[a];
	return u;
}

/// Six rigid motions, about a point outside the brick.
std::vector<Vector24> rigidMotions(const Nodes& nodes)
{
	std::vector<Vector24> motions;
	for (int i = 0; i < 3; ++i) {
		Vector24 shift, spin;
		for (int a = 0; a < nodeCount; ++a) {
			shift.segment<3>(3 * a) = Vector3r::Unit(i);
			spin.segment<3>(3 * a)  = Vector3r::Unit(i).cross(nodes[a] - Vector3r(1, 2, -1));
		}
		motions.push_back(shift);
		motions.push_back(spin);
	}
	return motions;
}

/// Consistent mass of unit sum density, 3 x 3 x 3 Gauss points: N_a N_b det J is of degree 4 in each coordinate.
Matrix24 consistentMass(const Nodes& nodes)
{
	const Real points[3] = { -std::sqrt(.6), 0, std::sqrt(.6) }, weights[3] = { 5. / 9, 8. / 9, 5. / 9 };
	Matrix24   M = Matrix24::Zero();
	for (int q = 0; q < 27; ++q) {
		const Vector3r natural(points[q % 3], points[q / 3 % 3], points[q / 9]);
		const auto     N  = shapeFunctions(natural);
		const Real     dm = density * weights[q % 3] * weights[q / 3 % 3] * weights[q / 9] * jacobian(nodes, natural).determinant();
		for (int a = 0; a < nodeCount; ++a)
			for (int b = 0; b < nodeCount; ++b)
				M.block<3, 3>(3 * a, 3 * b).diagonal().array() += dm * N[a] * N[b];
	}
	return M;
}

} // namespace

TEST(ModesTest, each_level_has_its_number_of_modes)
{
	const Sample sample(cuboidCorners({ .2, .2, .2 }), .25, Element::Full);
	const int    counts[] = { 0, 6, 18 };
	for (Deformation level : { Deformation::Rigid, Deformation::Uniform, Deformation::Trilinear }) {
		const Modes modes = sample.modes(level);
		EXPECT_EQ(modes.count(), counts[int(level)]);
		EXPECT_EQ(modes.shapes.rows(), dofCount);
		EXPECT_EQ(modes.shapes.cols(), counts[int(level)]);
	}
}

TEST(ModesTest, modes_are_orthonormal_in_the_mass_and_diagonal_in_the_stiffness)
{
	for (const Sample& sample : samples())
		for (Deformation level : levels) {
			const Modes           modes   = sample.modes(level);
			const Eigen::MatrixXd shapes  = modes.shapes;
			const Eigen::MatrixXd mass    = shapes.transpose() * sample.massDiagonal.asDiagonal() * shapes;
			const Eigen::MatrixXd spring  = shapes.transpose() * sample.K * shapes;
			const Real            largest = modes.omegaSquared[modes.count() - 1];
			EXPECT_LT((mass - Eigen::MatrixXd::Identity(modes.count(), modes.count())).cwiseAbs().maxCoeff(), roundOff);
			for (int i = 0; i < modes.count(); ++i) {
				EXPECT_GT(modes.omegaSquared[i], 0);
				EXPECT_GE(modes.omegaSquared[i], i > 0 ? modes.omegaSquared[i - 1] : 0);
				for (int j = 0; j < modes.count(); ++j)
					EXPECT_NEAR(spring(i, j), i == j ? modes.omegaSquared[i] : 0, roundOff * largest);
			}
		}
}

TEST(ModesTest, modes_are_orthogonal_to_rigid_motion)
{
	for (const Sample& sample : samples())
		for (Deformation level : levels) {
			const Modes modes = sample.modes(level);
			for (const Vector24& rigid : rigidMotions(sample.nodes)) {
				const Vector24 weighted = sample.massDiagonal.cwiseProduct(rigid);
				EXPECT_LT((modes.shapes.transpose() * weighted).norm(), roundOff * std::sqrt(rigid.dot(weighted)));
			}
		}
}

TEST(ModesTest, modes_span_every_deformation)
{
	for (const Sample& sample : samples()) {
		const Modes modes = sample.modes(Deformation::Trilinear);
		Vector24    u;
		for (int i = 0; i < dofCount; ++i)
			u[i] = std::sin(1 + 2.3 * i);
		const Vector24 rest = u - modes.shapes * (modes.shapes.transpose() * sample.massDiagonal.cwiseProduct(u)); // rigid: meets no stiffness
		EXPECT_LT((sample.K * rest).norm(), roundOff * sample.K.norm() * u.norm());
	}
}

TEST(ModesTest, uniform_modes_strain_the_brick_uniformly)
{
	for (const Sample& sample : samples()) {
		const Modes modes = sample.modes(Deformation::Uniform);
		for (int i = 0; i < 6; ++i) {
			// the best linear field c + G x through the nodes leaves nothing over
			Eigen::Matrix<Real, nodeCount, 4> linear;
			Eigen::Matrix<Real, nodeCount, 3> shape;
			for (int a = 0; a < nodeCount; ++a) {
				linear.row(a) << 1, sample.nodes[a].transpose();
				shape.row(a) = modes.shapes.col(i).segment<3>(3 * a).transpose();
			}
			const Eigen::Matrix<Real, 4, 3> fit = (linear.transpose() * linear).inverse() * linear.transpose() * shape;
			EXPECT_LT((shape - linear * fit).norm(), roundOff * shape.norm());
		}
	}
}

TEST(ModesTest, uniform_and_trilinear_answer_alike_to_a_uniform_stress)
{
	const Matrix3r gradient = references::distortedGradient();
	for (const Vector3r& size : { Vector3r(.2, .2, .2), Vector3r(.1, .2, .3) })
		for (Element element : elements) {
			const Sample   sample(cuboidCorners(size), .3, element);
			const Vector24 f = sample.K * linearField(sample.nodes, gradient);
			for (Deformation level : levels) {
				const Modes modes = sample.modes(level);
				Vector24    u     = Vector24::Zero(); // at rest: q = phi^T f / omega^2
				for (int i = 0; i < modes.count(); ++i)
					u += modes.shapes.col(i) * modes.shapes.col(i).dot(f) / modes.omegaSquared[i];
				const Vector6r expected = centreStress(sample.nodes, young, .3, linearField(sample.nodes, gradient));
				EXPECT_LT((centreStress(sample.nodes, young, .3, u) - expected).norm(), roundOff * expected.norm());
				EXPECT_LT((sample.K * u - f).norm(), roundOff * f.norm());
			}
		}
}

TEST(ModesTest, loads_in_proportion_to_the_masses_move_no_mode)
{
	const Sample sample(references::distortedNodes(), .25, Element::Incompatible);
	const Modes  modes = sample.modes(Deformation::Trilinear);
	Vector24     weight;
	for (int a = 0; a < nodeCount; ++a)
		weight.segment<3>(3 * a) = sample.masses[a] * Vector3r(1, -2, -9.8);
	EXPECT_LT((modes.shapes.transpose() * weight).norm(), roundOff * weight.norm());
}

TEST(ModesTest, largest_frequency_of_a_free_brick_is_the_reference)
{
	for (const auto& row : references::freeSteps()) {
		const Sample sample(cuboidCorners(row.size), .25, row.element);
		const Modes  modes = sample.modes(Deformation::Trilinear);
		EXPECT_NEAR(2 / std::sqrt(modes.omegaSquared[17]), row.lumped, references::freeStepTolerance)
		        << int(row.element) << ": " << row.size.transpose();
		const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix24> solver(sample.K, consistentMass(sample.nodes));
		EXPECT_NEAR(2 / std::sqrt(solver.eigenvalues()[23]), row.consistent, references::freeStepTolerance)
		        << int(row.element) << ": " << row.size.transpose();
	}
	// closed form of the cube: L sqrt(rho / (3 lambda + 2 mu))
	const Real nu = .25, bulk = young / (1 - 2 * nu);
	EXPECT_NEAR(
	        2 / std::sqrt(Sample(cuboidCorners({ .2, .2, .2 }), nu, Element::Full).modes(Deformation::Uniform).omegaSquared[5]),
	        .2 * std::sqrt(density / bulk),
	        roundOff);
}

TEST(ModesTest, frequencies_do_not_depend_on_where_the_brick_is_or_how_it_is_turned)
{
	const Matrix3r R = Quaternionr(Eigen::AngleAxis<Real>(1.1, Vector3r(1, -2, .5).normalized())).toRotationMatrix();
	for (const Sample& sample : samples()) {
		Nodes turned = sample.nodes;
		for (auto& x : turned)
			x = R * x + Vector3r(2, -1, 3);
		const Sample other(turned, .25, Element::Full), same(sample.nodes, .25, Element::Full);
		for (Deformation level : levels) {
			const Modes before = same.modes(level), after = other.modes(level);
			for (int i = 0; i < before.count(); ++i) // moved by 3.7 m, the nodes keep 1e-15 of 0.2 m less a factor 20
				EXPECT_NEAR(after.omegaSquared[i], before.omegaSquared[i], 20 * roundOff * before.omegaSquared[before.count() - 1]);
		}
	}
}

TEST(ModesTest, same_shapes_come_out_when_round_off_differs)
{
	// A cube's frequencies come in groups of two, three and five: without a rule their shapes would be arbitrary.
	for (const Vector3r& size : { Vector3r(.2, .2, .2), Vector3r(.1, .2, .2), Vector3r(.1, .2, .3) })
		for (Deformation level : levels) {
			Sample      sample(cuboidCorners(size), .25, Element::Incompatible);
			const Modes before = sample.modes(level);
			Matrix24    noise;
			for (int i = 0; i < dofCount; ++i)
				for (int j = 0; j < dofCount; ++j)
					noise(i, j) = std::sin(3.7 * (i + 1) * (j + 1));
			sample.K += 1e-14 * sample.K.norm() * (noise + noise.transpose());
			const Modes after = sample.modes(level);
			// noise of 1e-14 over the distance of neighbouring frequencies, 1e-3 of the largest at least
			EXPECT_LT((after.shapes - before.shapes).cwiseAbs().maxCoeff(), 1e-9 * before.shapes.cwiseAbs().maxCoeff());
		}
}

TEST(ModesTest, nearly_incompressible_and_slender_bricks_have_all_their_modes)
{
	struct Case {
		Nodes nodes;
		Real  nu;
	};
	const Nodes cube = cuboidCorners({ .2, .2, .2 }), slab = cuboidCorners({ .5, .5, .005 });
	for (const Case& c : { Case { cube, -.99 }, Case { cube, .4999999 }, Case { slab, -.99 }, Case { slab, .4999 } })
		for (Element element : elements)
			for (Deformation level : levels) {
				const Modes modes = Sample(c.nodes, c.nu, element).modes(level);
				EXPECT_GT(modes.omegaSquared[0], 0);
				EXPECT_TRUE(modes.shapes.allFinite());
			}
}

TEST(ModesTest, bad_input_is_refused_with_the_value_and_what_is_allowed)
{
	const Sample good(cuboidCorners({ .2, .2, .2 }), .25, Element::Full);
	const Real   nan = std::numeric_limits<Real>::quiet_NaN();
	for (Real bad : { 0., -1., nan, std::numeric_limits<Real>::infinity() }) {
		Sample sample    = good;
		sample.masses[3] = bad;
		EXPECT_NE(refusal([&] { sample.modes(Deformation::Rigid); }).find("mass of node 3"), std::string::npos) << bad;
	}
	Sample sample   = good;
	sample.nodes[2] = Vector3r(0, nan, 0);
	EXPECT_NE(refusal([&] { sample.modes(Deformation::Uniform); }).find("node 2"), std::string::npos);
	sample         = good;
	sample.K(0, 5) = nan;
	EXPECT_NE(refusal([&] { sample.modes(Deformation::Trilinear); }).find("finite"), std::string::npos);
	sample = good;
	sample.K(0, 5) += 1000;
	EXPECT_NE(refusal([&] { sample.modes(Deformation::Trilinear); }).find("differ by 1000"), std::string::npos);
	sample   = good;
	sample.K = Matrix24::Zero();
	EXPECT_NE(refusal([&] { sample.modes(Deformation::Uniform); }).find("meets no stiffness"), std::string::npos);
	sample.K = -good.K;
	EXPECT_NE(refusal([&] { sample.modes(Deformation::Trilinear); }).find("meets no stiffness"), std::string::npos);
	EXPECT_NE(refusal([&] { good.modes(Deformation::Refined); }).find("allowed are rigid, uniform and trilinear"), std::string::npos);
}
