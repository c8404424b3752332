// SPDX-License-Identifier: GPL-2.0-or-later
#include "Modes.hpp"
#include "Frequencies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <cmath>
#include <stdexcept>

namespace brick {

namespace {

	using Fields6 = Eigen::Matrix<Real, dofCount, 6>;

	/// Squared frequencies below this, of the largest, are none. The softest mode of a cube with nu = 0.4999999 is 1e-7 of it, that of a slab of 1:100 with
	/// nu = 0.4999 2e-12: bending over volume change.
	constexpr Real noFrequency = 1e-12;

	Vector3r mean(const Nodes& nodes)
	{
		Vector3r sum = Vector3r::Zero();
		for (const auto& x : nodes)
			sum += x;
		return sum / nodeCount;
	}

	/// Three translations and three rotations about the middle of the nodes, one field a column.
	Fields6 rigidFields(const Nodes& nodes)
	{
		Fields6 fields;
		for (int a = 0; a < nodeCount; ++a)
			for (int i = 0; i < 3; ++i) {
				fields.block<3, 1>(3 * a, i)     = Vector3r::Unit(i);
				fields.block<3, 1>(3 * a, 3 + i) = Vector3r::Unit(i).cross(nodes[a] - mean(nodes));
			}
		return fields;
	}

	/// The six fields  u = eps x  of constant strain eps_ij, one a column.
	Fields6 strainFields(const Nodes& nodes)
	{
		const int voigt[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 2, 0 } };

		Fields6 fields = Fields6::Zero();
		for (int a = 0; a < nodeCount; ++a)
			for (int k = 0; k < 6; ++k) {
				const int      i = voigt[k][0], j = voigt[k][1];
				const Vector3r x     = nodes[a] - mean(nodes);
				fields(3 * a + i, k) = x[j];
				fields(3 * a + j, k) = x[i];
			}
		return fields;
	}

	/// Orthonormal columns, the first six spanning the given fields. Columns are scaled first so that metres and radians weigh alike.
	Matrix24 orthonormal(Fields6 fields)
	{
		fields.colwise().normalize();
		return Eigen::HouseholderQR<Fields6>(fields).householderQ() * Matrix24::Identity();
	}

	/// A basis of the space of orthonormal columns that depends on that space alone, not on the columns.
	Eigen::MatrixXd canonicalBasis(const Eigen::MatrixXd& columns)
	{
		Eigen::MatrixXd projector = columns * columns.transpose();
		Eigen::MatrixXd basis(columns.rows(), columns.cols());
		for (int i = 0; i < basis.cols(); ++i) {
			const Eigen::VectorXd aligned = projector.diagonal();
			int                   k       = 0;
			while (aligned[k] < (1 - sameComponent) * aligned.maxCoeff())
				++k;
			basis.col(i) = projector.col(k) / std::sqrt(aligned[k]);
			projector -= basis.col(i) * basis.col(i).transpose();
		}
		return basis;
	}

	void requireInput(const Matrix24& K, const Nodes& nodes, const std::array<Real, nodeCount>& masses)
	{
		for (int a = 0; a < nodeCount; ++a) {
			if (!nodes[a].allFinite()) throw std::invalid_argument(message("node ", a, " is (", nodes[a].transpose(), "); it must be finite"));
			if (!(std::isfinite(masses[a]) && masses[a] > 0))
				throw std::invalid_argument(message("the mass of node ", a, " is ", masses[a], " kg; it must be finite and above 0"));
		}
		const Real asymmetry = (K - K.transpose()).cwiseAbs().maxCoeff();
		if (!K.allFinite()) throw std::invalid_argument("the stiffness matrix must be finite");
		if (!(asymmetry <= symmetryTolerance * K.cwiseAbs().maxCoeff()))
			throw std::invalid_argument(message("the stiffness matrix must be symmetric; entries differ by ", asymmetry, " N/m"));
	}

} // namespace

Modes deformationModes(const Matrix24& K, const Nodes& nodes, const std::array<Real, nodeCount>& masses, Deformation level)
{
	requireInput(K, nodes, masses);
	if (level == Deformation::Refined) throw std::invalid_argument("one hexahedron has no refined deformation; allowed are rigid, uniform and trilinear");
	if (level == Deformation::Rigid) return { MatrixX(dofCount, 0), {} };

	// Coordinates scaled with sqrt(mass): orthogonal in the mass becomes orthogonal, and A = M^-1/2 K M^-1/2.
	Vector24 rootMass;
	for (int a = 0; a < nodeCount; ++a)
		rootMass.segment<3>(3 * a).setConstant(std::sqrt(masses[a]));
	const Vector24 inverse = rootMass.cwiseInverse();
	const Matrix24 A       = inverse.asDiagonal() * K * inverse.asDiagonal();

	Eigen::MatrixXd basis = orthonormal(rootMass.asDiagonal() * rigidFields(nodes)).rightCols<modeCount>(); // every deformation, no rigid motion
	if (level == Deformation::Uniform) {
		const Fields6 strains = basis * (basis.transpose() * (rootMass.asDiagonal() * strainFields(nodes)));
		basis                 = orthonormal(strains).leftCols<6>();
	}
	const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.transpose() * A * basis);
	const Eigen::VectorXd                                frequencies = solver.eigenvalues();
	const Eigen::MatrixXd                                vectors     = basis * solver.eigenvectors();

	requireStiffness(frequencies, noFrequency);
	const int count = int(frequencies.size());
	Modes     modes { MatrixX(dofCount, count), {} };
	for (int first = 0, size = 0; first < count; first += size) {
		size                                 = countOfSame(frequencies, first);
		modes.shapes.middleCols(first, size) = inverse.asDiagonal() * canonicalBasis(vectors.middleCols(first, size));
		modes.omegaSquared.insert(modes.omegaSquared.end(), size, frequencies.segment(first, size).mean());
	}
	return modes;
}

} // namespace brick
