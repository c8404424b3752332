// SPDX-License-Identifier: GPL-2.0-or-later
#include "References.hpp"
#include "Refusal.hpp"
#include <pkg/brick/kernel/Hexahedron.hpp>
#include <pkg/brick/kernel/Stiffness.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace brick;

namespace {

const Element elements[] = { Element::Full, Element::Incompatible, Element::Bbar };

/// Rounding of sums of a few hundred products, relative to the largest of them.
constexpr Real roundOff = 1e-13;

constexpr Real young = 9.8e6;

Vector24 stacked(const Nodes& vectors)
{
	Vector24 u;
	for (int a = 0; a < nodeCount; ++a)
		u.segment<3>(3 * a) = vectors[a];
	return u;
}

/// Displacements of a uniform gradient, u = G x.
Vector24 linearField(const Nodes& nodes, const Matrix3r& gradient)
{
	Nodes u;
	for (int a = 0; a < nodeCount; ++a)
		u[a] = gradient * nodes[a];
	return stacked(u);
}

Matrix3r tensor(const Vector6r& stress)
{
	Matrix3r s;
	s << stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2];
	return s;
}

/// Symmetric displacement gradient of the given stress.
Matrix3r gradientOf(const Vector6r& stress, Real E, Real nu) { return ((1 + nu) * tensor(stress) - nu * stress.head<3>().sum() * Matrix3r::Identity()) / E; }

Vector6r stressOf(const Matrix3r& gradient, Real E, Real nu)
{
	const Matrix3r strain = (gradient + gradient.transpose()) / 2;
	const Real     lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
	const Matrix3r s      = lambda * strain.trace() * Matrix3r::Identity() + E / (1 + nu) * strain;
	return (Vector6r() << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0)).finished();
}

Matrix24 inverseOfRest(const Matrix24& K)
{
	// pseudo-inverse: the displacement without rigid motion that balances a self-equilibrated load
	const Eigen::SelfAdjointEigenSolver<Matrix24> solver(K);
	Vector24                                      inverse = Vector24::Zero();
	inverse.tail<18>()                                    = solver.eigenvalues().tail<18>().cwiseInverse();
	return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// Displacements of the top nodes 4 to 7 when the bottom ones are fixed and each top node carries a quarter of the load.
Eigen::Matrix<Real, 12, 1> pressedFromAbove(const Matrix24& K, Real load)
{
	Eigen::Matrix<Real, 12, 1> f = Eigen::Matrix<Real, 12, 1>::Zero();
	for (int a = 0; a < 4; ++a)
		f[3 * a + 2] = -load / 4;
	return K.bottomRightCorner<12, 12>().ldlt().solve(f);
}

/// Patch of MacNeal and Harder: a distorted hexahedron inside a unit cube, its faces joined to the cube's by six more.
struct Patch {
	std::array<Vector3r, 16>          nodes; ///< 0 to 7 of the cube, 8 to 15 inside
	std::array<std::array<int, 8>, 7> hexahedra;

	Patch()
	{
		const Real inside[8][3] = { { .249, .342, .192 }, { .826, .288, .288 }, { .850, .649, .263 }, { .273, .750, .230 },
			                    { .320, .186, .643 }, { .677, .305, .683 }, { .788, .693, .644 }, { .165, .745, .702 } };
		for (int a = 0; a < nodeCount; ++a) {
			nodes[a]        = Vector3r(nodeSigns[a][0] + 1, nodeSigns[a][1] + 1, nodeSigns[a][2] + 1) / 2;
			nodes[8 + a]    = Vector3r(inside[a][0], inside[a][1], inside[a][2]);
			hexahedra[6][a] = 8 + a;
		}
		for (int face = 0; face < faceCount; ++face)
			for (int i = 0; i < 4; ++i) {
				hexahedra[face][i]     = 8 + faceNodes[face][i];
				hexahedra[face][4 + i] = faceNodes[face][i];
			}
	}

	Nodes of(int hexahedron) const
	{
		Nodes corners;
		for (int a = 0; a < nodeCount; ++a)
			corners[a] = nodes[hexahedra[hexahedron][a]];
		return corners;
	}

	Eigen::MatrixXd assembled(Real E, Real nu, Element element) const
	{
		Eigen::MatrixXd K = Eigen::MatrixXd::Zero(48, 48);
		for (int h = 0; h < 7; ++h) {
			const Matrix24 part = stiffness(of(h), E, nu, element);
			for (int a = 0; a < nodeCount; ++a)
				for (int b = 0; b < nodeCount; ++b)
					K.block<3, 3>(3 * hexahedra[h][a], 3 * hexahedra[h][b]) += part.block<3, 3>(3 * a, 3 * b);
		}
		return K;
	}
};

/// Outer nodes follow the linear field of a stress; inner ones find their place. Largest error of displacement and stress, relative to the largest value.
std::pair<Real, Real> patchErrors(const Vector6r& stress, Real E, Real nu, Element element)
{
	const Patch           patch;
	const Matrix3r        gradient = gradientOf(stress, E, nu);
	const Eigen::MatrixXd K        = patch.assembled(E, nu, element);
	Eigen::VectorXd       exact(48), u(48);
	for (int a = 0; a < 16; ++a)
		exact.segment<3>(3 * a) = gradient * patch.nodes[a];
	u          = exact;
	u.tail(24) = K.bottomRightCorner(24, 24).ldlt().solve(-K.bottomLeftCorner(24, 24) * exact.head(24));

	Real stressError = 0;
	for (int h = 0; h < 7; ++h) {
		Vector24 own;
		for (int a = 0; a < nodeCount; ++a)
			own.segment<3>(3 * a) = u.segment<3>(3 * patch.hexahedra[h][a]);
		stressError = std::max(stressError, (centreStress(patch.of(h), E, nu, own) - stress).cwiseAbs().maxCoeff());
	}
	return { (u - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(), stressError / stress.cwiseAbs().maxCoeff() };
}

} // namespace

TEST(StiffnessTest, elasticity_is_the_isotropic_law)
{
	const Matrix3r gradient = references::distortedGradient();
	const Vector6r strain
	        = (Vector6r() << gradient.diagonal(), gradient(0, 1) + gradient(1, 0), gradient(1, 2) + gradient(2, 1), gradient(2, 0) + gradient(0, 2))
	                  .finished();
	for (Real nu : { -.9, 0., .25, .49999 }) {
		const Vector6r expected = stressOf(gradient, young, nu);
		EXPECT_LT((elasticity(young, nu) * strain - expected).norm(), roundOff * expected.norm()) << nu;
	}
}

TEST(StiffnessTest, patch_of_seven_distorted_hexahedra_carries_every_uniform_stress)
{
	const Vector6r stresses[] = { (Vector6r() << 2000, 2000, 2000, 400, 400, 400).finished(), // patch.*.MacNeal-Harder
		                      (Vector6r() << 1000, 0, 0, 0, 0, 0).finished(),             // patch.*.uniaxial
		                      (Vector6r() << 1000, 1000, 0, 0, 0, 0).finished(),          // patch.*.biaxial
		                      (Vector6r() << 0, 0, 0, 400, 0, 0).finished(),              // patch.*.shear
		                      (Vector6r() << 2000, 2000, 2000, 0, 0, 0).finished() };     // patch.*.hydrostatic
	for (Element element : elements)
		for (const Vector6r& stress : stresses) {
			const auto [displacement, stressError] = patchErrors(stress, 1e6, .25, element);
			EXPECT_LT(displacement, 10 * roundOff)
			        << int(element) << ": " << stress.transpose(); // the solve adds its condition, some 10; references ask for 1e-9
			EXPECT_LT(stressError, 10 * roundOff) << int(element) << ": " << stress.transpose();
		}
}

TEST(StiffnessTest, patch_test_holds_close_to_incompressibility)
{
	for (Element element : elements)
		for (Real nu : { -.9, .49, .4999, .499999 }) {
			const auto [displacement, stressError] = patchErrors((Vector6r() << 1000, -300, 200, 400, 100, -250).finished(), 1e6, nu, element);
			// lambda / mu = 2 nu / (1 - 2 nu) multiplies the rounding of the volume change
			const Real amplified = 100 * roundOff * (1 + 1 / (1 - 2 * nu));
			EXPECT_LT(displacement, amplified) << int(element) << " nu " << nu;
			EXPECT_LT(stressError, amplified) << int(element) << " nu " << nu;
		}
}

TEST(StiffnessTest, distorted_hexahedron_in_uniform_strain_has_the_reference_forces)
{
	const Nodes nodes = references::distortedNodes(), expected = references::distortedForces();
	for (Element element : elements) {
		const Vector24 f = stiffness(nodes, young, .25, element) * linearField(nodes, references::distortedGradient());
		// coordinates are given to 5e-10 m of 0.1 m, faces so to some 1e-8, and forces of 164 N to 5e-6 N
		EXPECT_LT((f - stacked(expected)).cwiseAbs().maxCoeff(), 1e-5) << int(element);
	}
}

TEST(StiffnessTest, uniform_stress_gives_the_forces_of_virtual_work_exactly)
{
	// f_a = sigma dV/dx_a: the volume is linear in each coordinate of a node, so a difference is its exact derivative
	const Nodes    nodes  = references::distortedNodes();
	const Matrix3r stress = tensor(stressOf(references::distortedGradient(), young, .25));
	Nodes          expected;
	for (int a = 0; a < nodeCount; ++a) {
		Vector3r gradient;
		for (int i = 0; i < 3; ++i) {
			Nodes more = nodes, less = nodes;
			more[a][i] += .1;
			less[a][i] -= .1;
			gradient[i] = (solidProperties(more).volume - solidProperties(less).volume) / .2;
		}
		expected[a] = stress * gradient;
	}
	for (Element element : elements) {
		const Vector24 f = stiffness(nodes, young, .25, element) * linearField(nodes, references::distortedGradient());
		EXPECT_LT((f - stacked(expected)).norm(), roundOff * f.norm()) << int(element);
	}
}

TEST(StiffnessTest, cube_has_the_reference_eigenvalues)
{
	for (Element element : elements) {
		const Real                                    L = .1;
		const Eigen::SelfAdjointEigenSolver<Matrix24> solver(stiffness(cuboidCorners({ L, L, L }), young, .25, element));
		int                                           i = 0;
		for (const auto& [value, times] : references::cubeSpectrum(element))
			for (int k = 0; k < times; ++k, ++i)
				EXPECT_NEAR(solver.eigenvalues()[i] / (young * L), value, roundOff) << int(element) << " eigenvalue " << i;
		EXPECT_EQ(i, dofCount);
	}
}

TEST(StiffnessTest, stiffness_is_symmetric_and_positive_but_for_six_rigid_motions)
{
	for (Element element : elements)
		for (Real nu : { -.9, 0., .25, .499 })
			for (const Nodes& nodes : { references::distortedNodes(), cuboidCorners({ .1, .2, .2 }), cuboidCorners({ .3, .02, .2 }) }) {
				const Matrix24 K = stiffness(nodes, young, nu, element);
				EXPECT_EQ(K, Matrix24(K.transpose()));
				const Eigen::SelfAdjointEigenSolver<Matrix24> solver(K);
				const Real                                    largest = solver.eigenvalues()[23];
				EXPECT_LT(solver.eigenvalues().head<6>().cwiseAbs().maxCoeff(), roundOff * largest);
				// softest deformation: twist of the slab, (0.02 / 0.3)^4 = 2e-5 of E, over lambda / mu = 500
				EXPECT_GT(solver.eigenvalues()[6], 1e-8 * largest);
			}
}

TEST(StiffnessTest, translation_and_rotation_give_no_force)
{
	const Nodes nodes = references::distortedNodes();
	for (Element element : elements) {
		const Matrix24 K = stiffness(nodes, young, .25, element);
		for (int i = 0; i < 3; ++i) {
			Nodes shift, spin;
			for (int a = 0; a < nodeCount; ++a) {
				shift[a] = Vector3r::Unit(i);
				spin[a]  = Vector3r::Unit(i).cross(nodes[a] + Vector3r(3, 1, 2)); // about a point 3.7 m away
			}
			EXPECT_LT((K * stacked(shift)).norm(), roundOff * K.norm());
			EXPECT_LT((K * stacked(spin)).norm(), roundOff * K.norm() * 4);
		}
	}
}

TEST(StiffnessTest, nodal_forces_have_no_resultant_and_the_moment_of_the_mean_stress)
{
	const Nodes nodes = references::distortedNodes();
	Vector24    u; // bending, warping and all
	for (int i = 0; i < dofCount; ++i)
		u[i] = 1e-3 * std::sin(1 + 2.3 * i);
	const Real volume = solidProperties(nodes).volume;
	for (Element element : elements) {
		const Vector24 f     = stiffness(nodes, young, .3, element) * u;
		Vector3r       force = Vector3r::Zero();
		Matrix3r       dyad  = Matrix3r::Zero();
		for (int a = 0; a < nodeCount; ++a) {
			force += f.segment<3>(3 * a);
			dyad += f.segment<3>(3 * a) * nodes[a].transpose();
		}
		EXPECT_LT(force.norm(), roundOff * f.norm());
		EXPECT_LT((dyad - dyad.transpose()).norm(), roundOff * f.norm()); // no moment
		const Matrix3r mean = volume * tensor(centreStress(nodes, young, .3, u));
		EXPECT_LT((dyad - mean).norm(), roundOff * f.norm()) << int(element);
	}
}

TEST(StiffnessTest, poisson_effect_of_table_2_is_that_of_one_full_hexahedron)
{
	const Real side = .1, E = 9.8e7, load = 200;
	for (const auto& row : references::table2) {
		const Matrix24 K     = stiffness(cuboidCorners({ side, side, side }), E, row.poisson, Element::Full);
		const auto     u     = pressedFromAbove(K, load);
		const Real     width = u[3 * 2] - u[3 * 3]; // node 6 is at +x, node 7 at -x
		EXPECT_NEAR(width, row.width, references::table2Tolerance);
		EXPECT_NEAR(u[2], row.settlement, references::table2Tolerance);
		EXPECT_EQ(std::floor(width / references::table2PaperDigit), std::round(row.paper / references::table2PaperDigit)); // the paper's digits
		for (int a = 0; a < 4; ++a) {
			EXPECT_NEAR(u[3 * a] * nodeSigns[4 + a][0], width / 2, roundOff * width);
			EXPECT_NEAR(u[3 * a + 1] * nodeSigns[4 + a][1], width / 2, roundOff * width);
		}
		// closed form with the Lame constants
		const Real lambda = E * row.poisson / ((1 + row.poisson) * (1 - 2 * row.poisson)), mu = E / (2 * (1 + row.poisson));
		const Real sink = load / side / (lambda + 2 * mu - 6 * lambda * lambda / (8 * lambda + 9 * mu));
		EXPECT_NEAR(u[2], -sink, 10 * roundOff * sink);
		EXPECT_NEAR(width, 6 * lambda * sink / (8 * lambda + 9 * mu), 10 * roundOff * sink);
	}
}

TEST(StiffnessTest, only_the_full_element_locks_when_nu_comes_close_to_one_half)
{
	for (const auto& row : references::locking) {
		const Real expected[] = { row.full, row.incompatible, row.bbar };
		for (Element element : elements) {
			const auto u = pressedFromAbove(stiffness(cuboidCorners({ 1, 1, 1 }), young, row.poisson, element), young); // sigma = E
			EXPECT_NEAR(-u[2], expected[int(element)], references::printedDigits) << int(element) << " nu " << row.poisson;
		}
	}
}

TEST(StiffnessTest, pure_bending_is_exact_with_incompatible_modes_and_too_stiff_without)
{
	// curvature in the x-z plane: forces +-F along x on the nodes of the end faces make M = 2 F c, and u_x = kappa x z
	const Real a = .3, b = .15, c = .2, F = 1, nu = .4;
	for (Element element : { Element::Full, Element::Incompatible }) {
		Vector24 f = Vector24::Zero();
		for (int node = 0; node < nodeCount; ++node)
			f[3 * node] = F * nodeSigns[node][0] * nodeSigns[node][2];
		const Vector24 u         = inverseOfRest(stiffness(cuboidCorners({ a, b, c }), young, nu, element)) * f;
		const Real     curvature = u[3 * 6] / (a / 2 * c / 2);
		const Real     ratio     = 2 * F * c / curvature / (young * b * c * c * c / 12);
		const Real     lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu)), m = lambda + 2 * mu;
		const Real     full = m + mu * a * a / (c * c) - lambda * lambda / (m + mu * b * b / (c * c)); // references.md, section 2
		EXPECT_NEAR(ratio, element == Element::Full ? full : 1, 10 * roundOff);
	}
}

TEST(StiffnessTest, stiffness_turns_with_the_nodes)
{
	const Matrix3r R      = Quaternionr(Eigen::AngleAxis<Real>(1.1, Vector3r(1, -2, .5).normalized())).toRotationMatrix();
	Matrix24       T      = Matrix24::Zero();
	Nodes          turned = references::distortedNodes();
	for (int a = 0; a < nodeCount; ++a) {
		T.block<3, 3>(3 * a, 3 * a) = R;
		turned[a]                   = R * turned[a];
	}
	for (Element element : elements) {
		const Matrix24 K = stiffness(references::distortedNodes(), young, .3, element);
		EXPECT_LT((stiffness(turned, young, .3, element) - T * K * T.transpose()).norm(), roundOff * K.norm()) << int(element);
	}
}

TEST(StiffnessTest, lumped_masses_have_the_mass_and_the_centre_of_the_solid)
{
	for (const Nodes& nodes : { references::distortedNodes(), cuboidCorners({ .1, .2, .4 }) }) {
		const auto masses = lumpedMasses(nodes, 14.4);
		Real       sum    = 0;
		Vector3r   first  = Vector3r::Zero();
		for (int a = 0; a < nodeCount; ++a) {
			EXPECT_GT(masses[a], 0);
			sum += masses[a];
			first += masses[a] * nodes[a];
		}
		EXPECT_NEAR(sum, 14.4, roundOff * 14.4);
		EXPECT_LT((first / sum - solidProperties(nodes).centroid).norm(), roundOff);
	}
	for (Real mass : lumpedMasses(cuboidCorners({ .1, .2, .4 }), 14.4))
		EXPECT_NEAR(mass, 1.8, roundOff);
}

TEST(StiffnessTest, bad_input_is_refused_with_the_value_and_what_is_allowed)
{
	const Nodes cube = cuboidCorners({ .1, .1, .1 });
	const Real  nan  = std::numeric_limits<Real>::quiet_NaN();
	for (Real E : { 0., -9.8e6, nan, std::numeric_limits<Real>::infinity() })
		EXPECT_NE(refusal([&] { stiffness(cube, E, .25, Element::Full); }).find("must be finite and above 0"), std::string::npos) << E;
	for (Real nu : { -1., .5, .7, -3., nan })
		EXPECT_NE(refusal([&] { stiffness(cube, young, nu, Element::Full); }).find("above -1 and below 0.5"), std::string::npos) << nu;
	for (Real mass : { 0., -1., nan, std::numeric_limits<Real>::infinity() })
		EXPECT_NE(refusal([&] { lumpedMasses(cube, mass); }).find("must be finite and above 0"), std::string::npos) << mass;
	EXPECT_NE(refusal([&] { elasticity(young, .5); }).find("is 0.5;"), std::string::npos);

	Nodes inverted = cube;
	std::swap(inverted[0], inverted[6]);
	EXPECT_NE(refusal([&] { stiffness(inverted, young, .25, Element::Full); }), "");
	EXPECT_NE(refusal([&] { lumpedMasses(inverted, 1); }), "");
	EXPECT_NE(refusal([&] { centreStress(inverted, young, .25, Vector24::Zero()); }), "");
}
