// SPDX-License-Identifier: GPL-2.0-or-later
#include "StableStep.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace brick {

namespace {

	constexpr int largestSize = 6 + modeCount;
	using Square              = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0, largestSize, largestSize>;
	using Rows                = Eigen::Matrix<Real, 3, Eigen::Dynamic, 0, 3, largestSize>;

	/// Displacement of a point of a face by the unit of each mass-scaled degree of freedom: translation, rotation, modes.
	Rows pointMotion(const Hexahedron& solid, int face, const Vector4r& weights, Real mass, const Vector3r& inertia, const Modes* modes)
	{
		Rows     J = Rows::Zero(3, 6 + (modes ? modes->count : 0));
		Vector3r x = Vector3r::Zero();
		for (int a = 0; a < 4; ++a)
			x += weights[a] * solid.corners[faceNodes[face][a]];
		J.leftCols<3>() = Matrix3r::Identity() / std::sqrt(mass);
		for (int k = 0; k < 3; ++k)
			J.col(3 + k) = Vector3r::Unit(k).cross(x) / std::sqrt(inertia[k]);
		if (modes)
			for (int a = 0; a < 4; ++a)
				J.rightCols(modes->count) += weights[a] * modes->shapes.block(3 * faceNodes[face][a], 0, 3, modes->count);
		return J;
	}

} // namespace

FastestMotion fastestMotion(const Hexahedron& solid, const std::array<FaceSprings, faceCount>& springs, Real mass, const Vector3r& inertia, const Modes* modes)
{
	const int                     size = 6 + (modes ? modes->count : 0);
	const Real                    g    = 1 / std::sqrt(3.);
	std::array<Square, faceCount> byFace;
	Square                        K = Square::Zero(size, size);
	for (int f = 0; f < faceCount; ++f) {
		const Face& face = solid.faces[f];
		byFace[f].setZero(size, size);
		for (int q = 0; q < 4; ++q) {
			const Real     xi = q % 2 ? g : -g, eta = q / 2 ? g : -g;
			const Real     area = (face.e1 + eta * face.e12).cross(face.e2 + xi * face.e12).norm(); // Gauss weight 1
			const Matrix3r D
			        = springs[f].shear * Matrix3r::Identity() + (springs[f].normal - springs[f].shear) * face.normal * face.normal.transpose();
			const Rows J = pointMotion(solid, f, bilinear(xi, eta), mass, inertia, modes);
			byFace[f].noalias() += area * J.transpose() * D * J;
		}
		K += byFace[f];
	}
	const Eigen::SelfAdjointEigenSolver<Square> solver(K);
	const auto                                  fastest = solver.eigenvectors().col(size - 1);
	FastestMotion                               out;
	out.omegaSquared = solver.eigenvalues()[size - 1];
	Real most        = 0;
	for (int f = 0; f < faceCount; ++f) {
		const Real share = fastest.dot(byFace[f] * fastest);
		if (share > 1.001 * most) most = share, out.face = f; // the first of equals, whatever the rounding
	}
	return out;
}

Real stableStep(Real omegaSquared, Real dashpotTime)
{
	const Real omega = std::sqrt(omegaSquared), xi = omega * dashpotTime / 2;
	return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

} // namespace brick
