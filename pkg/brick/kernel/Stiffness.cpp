// SPDX-License-Identifier: GPL-2.0-or-later
#include "Stiffness.hpp"
#include "Hexahedron.hpp"
#include "Message.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace brick {

namespace {

	template <int count> using Gradients    = Eigen::Matrix<Real, count, 3>;     // of scalar functions, one a row, in x y z
	template <int count> using StrainMatrix = Eigen::Matrix<Real, 6, 3 * count>; // strain of count vector unknowns
	using Row24                             = Eigen::Matrix<Real, 1, dofCount>;

	constexpr int bendingModes = 3; ///< 1 - xi^2, 1 - eta^2, 1 - zeta^2, each in three directions

	void requireNodes(const Nodes& nodes)
	{
		const std::string problem = nodesProblem(nodes);
		if (!problem.empty()) throw std::invalid_argument(problem);
	}

	Vector3r gaussPoint(int q) { return Vector3r(nodeSigns[q][0], nodeSigns[q][1], nodeSigns[q][2]) / std::sqrt(3.); }

	/// B of  eps = B u.  One unknown vector with gradient g = (gx, gy, gz) contributes the columns
	///     xx  gx  .   .
	///     yy  .   gy  .
	///     zz  .   .   gz
	///     xy  gy  gx  .
	///     yz  .   gz  gy
	///     zx  gz  .   gx
	template <int count> StrainMatrix<count> strainMatrix(const Gradients<count>& gradients)
	{
		StrainMatrix<count> B;
		for (int a = 0; a < count; ++a) {
			const Real gx = gradients(a, 0), gy = gradients(a, 1), gz = gradients(a, 2);
			B.template middleCols<3>(3 * a) << gx, 0, 0, 0, gy, 0, 0, 0, gz, gy, gx, 0, 0, gz, gy, gz, 0, gx;
		}
		return B;
	}

	/// One of the 2 x 2 x 2 integration points.
	struct GaussPoint {
		StrainMatrix<nodeCount> B;
		Real                    volume; ///< det J times the weight, which is 1 [m3]
		GaussPoint(const Nodes& nodes, int q)
		{
			const Matrix3r J = jacobian(nodes, gaussPoint(q));
			B                = strainMatrix<nodeCount>(shapeDerivatives(gaussPoint(q)) * J.inverse());
			volume           = J.determinant();
		}
		Row24 dilatation() const { return B.topRows<3>().colwise().sum(); }
	};

	/// B averaged over the volume; 2 x 2 x 2 points are exact for B det J.
	StrainMatrix<nodeCount> meanStrainMatrix(const Nodes& nodes)
	{
		StrainMatrix<nodeCount> sum    = StrainMatrix<nodeCount>::Zero();
		Real                    volume = 0;
		for (int q = 0; q < nodeCount; ++q) {
			const GaussPoint point(nodes, q);
			sum += point.volume * point.B;
			volume += point.volume;
		}
		return sum / volume;
	}

	Matrix24 fullStiffness(const Nodes& nodes, const Matrix6r& D)
	{
		Matrix24 K = Matrix24::Zero();
		for (int q = 0; q < nodeCount; ++q) {
			const GaussPoint point(nodes, q);
			K += point.volume * point.B.transpose() * D * point.B;
		}
		return K;
	}

	Matrix24 bbarStiffness(const Nodes& nodes, const Matrix6r& D)
	{
		const Row24 meanDilatation = meanStrainMatrix(nodes).topRows<3>().colwise().sum();
		Matrix24    K              = Matrix24::Zero();
		for (int q = 0; q < nodeCount; ++q) {
			GaussPoint point(nodes, q);
			point.B.topRows<3>().rowwise() += (meanDilatation - point.dilatation()) / 3;
			K += point.volume * point.B.transpose() * D * point.B;
		}
		return K;
	}

	Matrix24 incompatibleStiffness(const Nodes& nodes, const Matrix6r& D)
	{
		using Internal = Eigen::Matrix<Real, 3 * bendingModes, 3 * bendingModes>;
		using Coupling = Eigen::Matrix<Real, 3 * bendingModes, dofCount>;

		const Matrix3r J0       = jacobian(nodes, Vector3r::Zero());
		Matrix24       K        = Matrix24::Zero();
		Coupling       coupling = Coupling::Zero();
		Internal       internal = Internal::Zero();
		for (int q = 0; q < nodeCount; ++q) {
			const GaussPoint                 point(nodes, q);
			const Matrix3r                   derivatives = (-2 * gaussPoint(q)).asDiagonal();
			const StrainMatrix<bendingModes> G = strainMatrix<bendingModes>(derivatives * J0.inverse() * (J0.determinant() / point.volume));
			K += point.volume * point.B.transpose() * D * point.B;
			coupling += point.volume * G.transpose() * D * point.B;
			internal += point.volume * G.transpose() * D * G;
		}
		return K - coupling.transpose() * internal.ldlt().solve(coupling);
	}

} // namespace

Matrix6r elasticity(Real young, Real poisson)
{
	if (!(std::isfinite(young) && young > 0)) throw std::invalid_argument(message("Young's modulus is ", young, " Pa; it must be finite and above 0"));
	if (!(poisson > -1 && poisson < 0.5)) throw std::invalid_argument(message("Poisson's ratio is ", poisson, "; it must be above -1 and below 0.5"));
	const Real lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = young / (2 * (1 + poisson));
	Matrix6r   D                    = Matrix6r::Zero();
	D.topLeftCorner<3, 3>().array() = lambda;
	D.diagonal() << Vector3r::Constant(lambda + 2 * mu), Vector3r::Constant(mu);
	return D;
}

Matrix24 stiffness(const Nodes& nodes, Real young, Real poisson, Element element)
{
	requireNodes(nodes);
	const Matrix6r D         = elasticity(young, poisson);
	const auto     integrate = element == Element::Full ? fullStiffness : element == Element::Bbar ? bbarStiffness : incompatibleStiffness;
	const Matrix24 K         = integrate(nodes, D);
	return (K + K.transpose()) / 2;
}

Vector6r centreStress(const Nodes& nodes, Real young, Real poisson, const Vector24& u)
{
	requireNodes(nodes);
	return elasticity(young, poisson) * (meanStrainMatrix(nodes) * u);
}

std::array<Real, nodeCount> lumpedMasses(const Nodes& nodes, Real mass)
{
	requireNodes(nodes);
	if (!(std::isfinite(mass) && mass > 0)) throw std::invalid_argument(message("the mass is ", mass, " kg; it must be finite and above 0"));
	Eigen::Matrix<Real, nodeCount, 1> volumes = Eigen::Matrix<Real, nodeCount, 1>::Zero();
	for (int q = 0; q < nodeCount; ++q) // N det J is cubic in each coordinate: exact
		volumes += jacobian(nodes, gaussPoint(q)).determinant() * shapeFunctions(gaussPoint(q));
	std::array<Real, nodeCount> masses;
	for (int a = 0; a < nodeCount; ++a)
		masses[a] = mass * volumes[a] / volumes.sum();
	return masses;
}

} // namespace brick
