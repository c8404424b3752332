// SPDX-License-Identifier: GPL-2.0-or-later
// See CondensedPart.hpp. Of Eigen's operations on large matrices only those are used that one thread does: a general product splits its sums by the number of
// threads and rounds differently with each; a product with a sparse matrix stored by rows, as any transposed one is, starts all threads once a column.
#include "CondensedPart.hpp"
#include "Frequencies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <stdexcept>

namespace brick {

namespace {

	using SparseMatrix = Eigen::SparseMatrix<Real>;
	using Columns6     = Eigen::Matrix<Real, Eigen::Dynamic, 6>;
	using Rows6        = Eigen::Matrix<Real, 6, Eigen::Dynamic>;

	/// Squared frequencies below this, of the largest, are round-off.
	constexpr Real noFrequency = 1e-13;

	/// n x n x n elements; nodes of the surface first, in the order of their grid, then those inside in lexicographic order.
	struct Mesh {
		std::vector<Vector3r>                   nodes;
		std::vector<std::array<int, nodeCount>> hexahedra;
		int                                     surface; ///< number of nodes there

		Mesh(const Nodes& corners, int n)
		{
			const SurfaceGrid& grid = surfaceGrid(n);
			nodes                   = grid.positions(corners);
			surface                 = grid.size();
			std::vector<int> nodeAt((n + 1) * (n + 1) * (n + 1));
			const auto       at = [&](int i, int j, int k) -> int& { return nodeAt[i + (n + 1) * (j + (n + 1) * k)]; };
			for (int a = 0; a < surface; ++a)
				at(grid.gridPlace(a)[0], grid.gridPlace(a)[1], grid.gridPlace(a)[2]) = a;
			for (int k = 1; k < n; ++k)
				for (int j = 1; j < n; ++j)
					for (int i = 1; i < n; ++i) {
						at(i, j, k) = int(nodes.size());
						nodes.push_back(gridPoint(corners, { i, j, k }, n));
					}
			for (int k = 0; k < n; ++k)
				for (int j = 0; j < n; ++j)
					for (int i = 0; i < n; ++i) {
						hexahedra.emplace_back();
						for (int a = 0; a < nodeCount; ++a)
							hexahedra.back()[a] = at(
							        i + (1 + nodeSigns[a][0]) / 2, j + (1 + nodeSigns[a][1]) / 2, k + (1 + nodeSigns[a][2]) / 2);
					}
		}

		int   inside() const { return int(nodes.size()) - surface; }
		Nodes cornersOf(const std::array<int, nodeCount>& hexahedron) const
		{
			Nodes corners;
			for (int a = 0; a < nodeCount; ++a)
				corners[a] = nodes[hexahedron[a]];
			return corners;
		}
	};

	/// Stiffness of a mesh, parted in surface and inside.
	struct StiffnessBlocks {
		MatrixX      surface;  ///< K_ss
		SparseMatrix coupling; ///< K_is
		SparseMatrix inside;   ///< K_ii

		StiffnessBlocks(const Mesh& mesh, Real young, Real poisson, Element element)
		        : surface(MatrixX::Zero(3 * mesh.surface, 3 * mesh.surface))
		        , coupling(3 * mesh.inside(), 3 * mesh.surface)
		        , inside(3 * mesh.inside(), 3 * mesh.inside())
		{
			std::vector<Eigen::Triplet<Real>> across, within;
			const int                         first = 3 * mesh.surface;
			for (const auto& hexahedron : mesh.hexahedra) {
				const Matrix24 K = stiffness(mesh.cornersOf(hexahedron), young, poisson, element);
				for (int p = 0; p < dofCount; ++p)
					for (int q = 0; q < dofCount; ++q) {
						const int row = 3 * hexahedron[p / 3] + p % 3, column = 3 * hexahedron[q / 3] + q % 3;
						if (row < first && column < first) surface(row, column) += K(p, q);
						if (row >= first && column < first) across.emplace_back(row - first, column, K(p, q));
						if (row >= first && column >= first) within.emplace_back(row - first, column - first, K(p, q));
					}
			}
			coupling.setFromTriplets(across.begin(), across.end());
			inside.setFromTriplets(within.begin(), within.end());
		}
	};

	/// Lumped mass of each node [kg].
	std::vector<Real> nodalMasses(const Mesh& mesh, Real mass)
	{
		std::vector<Real> volumes, masses(mesh.nodes.size(), 0);
		Real              volume = 0;
		for (const auto& hexahedron : mesh.hexahedra) {
			volumes.push_back(solidProperties(mesh.cornersOf(hexahedron)).volume);
			volume += volumes.back();
		}
		for (std::size_t h = 0; h < volumes.size(); ++h) {
			const auto shares = lumpedMasses(mesh.cornersOf(mesh.hexahedra[h]), mass * volumes[h] / volume);
			for (int a = 0; a < nodeCount; ++a)
				masses[mesh.hexahedra[h][a]] += shares[a];
		}
		return masses;
	}

	Vector3r middleOf(const std::vector<Vector3r>& nodes)
	{
		Vector3r middle = Vector3r::Zero();
		for (const auto& x : nodes)
			middle += x / nodes.size();
		return middle;
	}

	/// Three translations and three rotations about a point, one field a column.
	Columns6 rigidFields(const std::vector<Vector3r>& nodes, const Vector3r& middle)
	{
		Columns6 fields(3 * nodes.size(), 6);
		for (std::size_t a = 0; a < nodes.size(); ++a)
			for (int i = 0; i < 3; ++i) {
				fields.block<3, 1>(3 * a, i)     = Vector3r::Unit(i);
				fields.block<3, 1>(3 * a, 3 + i) = Vector3r::Unit(i).cross(nodes[a] - middle);
			}
		return fields;
	}

	/// Turns a group of M-orthonormal shapes into those that depend on the space that they span alone. Each is the group's answer to a force on one degree of
	/// freedom; what the next ones span is M-orthogonal to it.
	void makeCanonical(Eigen::Ref<MatrixX> shapes, const VectorX& weights)
	{
		MatrixX remaining = shapes;
		for (int i = 0; i < shapes.cols(); ++i) {
			const VectorX aligned = weights.cwiseProduct(remaining.rowwise().squaredNorm());
			const Real    enough  = (1 - sameComponent) * aligned.maxCoeff();
			int           k       = 0;
			while (aligned[k] < enough)
				++k;
			const VectorX along = remaining.row(k).transpose().normalized();
			shapes.col(i)       = remaining * along;
			remaining -= shapes.col(i) * along.transpose();
		}
	}

	/// Shapes that are M-orthonormal, and their squared frequencies. In coordinates L^T u, M = L L^T, orthogonal is what is M-orthogonal; reflected so that the
	/// first six span the rigid motions, the others are all deformations.
	std::pair<MatrixX, VectorX> solvedModes(const MatrixX& K, const MatrixX& M, const std::vector<Vector3r>& nodes)
	{
		const Eigen::LLT<MatrixX> factor(M);
		if (factor.info() != Eigen::Success) throw std::invalid_argument("the mass matrix must be positive definite");
		MatrixX A = K;
		factor.matrixL().solveInPlace(A);
		factor.matrixU().solveInPlace<Eigen::OnTheRight>(A);

		Columns6 rigid = factor.matrixU() * rigidFields(nodes, middleOf(nodes));
		rigid.colwise().normalize();
		const Eigen::HouseholderQR<Columns6> reflected(rigid);
		A.applyOnTheLeft(reflected.householderQ().adjoint());
		A.applyOnTheRight(reflected.householderQ());

		const int                                    count = int(A.rows()) - 6;
		const MatrixX                                B     = (A.bottomRightCorner(count, count) + A.bottomRightCorner(count, count).transpose()) / 2;
		const Eigen::SelfAdjointEigenSolver<MatrixX> solver(B);
		MatrixX                                      shapes = MatrixX::Zero(A.rows(), count);
		shapes.bottomRows(count)                            = solver.eigenvectors();
		shapes.applyOnTheLeft(reflected.householderQ());
		factor.matrixU().solveInPlace(shapes);
		return { shapes, solver.eigenvalues() };
	}

	/// Each node's  integral over the surface of  N n dA  [m2]: what its displacement sweeps is their product.
	std::vector<Vector3r> areaVectors(const SurfaceGrid& grid, const std::vector<Vector3r>& nodes)
	{
		std::vector<Vector3r> areas(grid.size(), Vector3r::Zero());
		const Real            gauss = 1 / std::sqrt(3.); // 2 x 2 points are exact: N and n dA are both linear in each coordinate
		for (int face = 0; face < faceCount; ++face)
			for (int cell = 0; cell < grid.cells() * grid.cells(); ++cell) {
				const auto      n  = grid.cellNodes(face, cell % grid.cells(), cell / grid.cells());
				const Vector3r &x0 = nodes[n[0]], &x1 = nodes[n[1]], &x2 = nodes[n[2]], &x3 = nodes[n[3]];
				for (Real xi : { -gauss, gauss })
					for (Real eta : { -gauss, gauss }) {
						const Vector3r along  = ((1 - eta) * (x1 - x0) + (1 + eta) * (x2 - x3)) / 4;
						const Vector3r across = ((1 - xi) * (x3 - x0) + (1 + xi) * (x2 - x1)) / 4;
						const Vector4r N      = bilinear(xi, eta);
						for (int a = 0; a < 4; ++a)
							areas[n[a]] += N[a] * along.cross(across);
					}
			}
		return areas;
	}

	/// Mean strain of displacements of the surface nodes [1/m], engineering shear strains.
	Rows6 meanStrainOf(const std::vector<Vector3r>& areas, Real volume)
	{
		Rows6 B(6, 3 * areas.size());
		for (std::size_t a = 0; a < areas.size(); ++a) {
			const Real gx = areas[a][0] / volume, gy = areas[a][1] / volume, gz = areas[a][2] / volume;
			B.middleCols<3>(3 * a) << gx, 0, 0, 0, gy, 0, 0, 0, gz, gy, gx, 0, 0, gz, gy, gz, 0, gx;
		}
		return B;
	}

	void requirePart(const Nodes& corners, Real mass)
	{
		const std::string problem = nodesProblem(corners);
		if (!problem.empty()) throw std::invalid_argument(problem);
		if (!(std::isfinite(mass) && mass > 0)) throw std::invalid_argument(message("the mass is ", mass, " kg; it must be finite and above 0"));
	}

	void requireMatrix(const MatrixX& matrix, int size, const char* name)
	{
		if (matrix.rows() != size || matrix.cols() != size)
			throw std::invalid_argument(message(
			        "the ", name, " matrix is ", matrix.rows(), " x ", matrix.cols(), "; it must have ", size, " rows and columns, three a node"));
		if (!matrix.allFinite()) throw std::invalid_argument(message("the ", name, " matrix must be finite"));
		const Real asymmetry = (matrix - matrix.transpose()).cwiseAbs().maxCoeff();
		if (!(asymmetry <= symmetryTolerance * matrix.cwiseAbs().maxCoeff()))
			throw std::invalid_argument(message("the ", name, " matrix must be symmetric; entries differ by ", asymmetry));
	}

} // namespace

CondensedMatrices condense(const Nodes& corners, int cells, Real young, Real poisson, Element element, Real mass)
{
	requirePart(corners, mass);
	const Mesh              mesh(corners, cells);
	StiffnessBlocks         K(mesh, young, poisson, element);
	const std::vector<Real> masses = nodalMasses(mesh, mass);
	const int               size   = 3 * mesh.surface;
	CondensedMatrices       part { std::move(K.surface), MatrixX::Zero(size, size), { masses.begin(), masses.begin() + mesh.surface } };
	for (int i = 0; i < size; ++i)
		part.mass(i, i) = part.surfaceMasses[i / 3];
	if (mesh.inside() > 0) {
		const Eigen::SimplicialLDLT<SparseMatrix> solver(K.inside);
		MatrixX                                   follows = solver.solve(MatrixX(K.coupling)); // -T_i
		const SparseMatrix                        outward = K.coupling.transpose();            // K_si
		part.stiffness -= outward * follows;
		for (int i = 0; i < follows.rows(); ++i)
			follows.row(i) *= std::sqrt(masses[mesh.surface + i / 3]);
		part.mass.selfadjointView<Eigen::Lower>().rankUpdate(follows.transpose());
	}
	part.stiffness                                   = ((part.stiffness + part.stiffness.transpose()) / 2).eval();
	part.mass.triangularView<Eigen::StrictlyUpper>() = part.mass.transpose();
	return part;
}

Modes deformationModes(const MatrixX& K, const MatrixX& M, const std::vector<Vector3r>& nodes)
{
	const int size = 3 * int(nodes.size());
	requireMatrix(K, size, "stiffness");
	requireMatrix(M, size, "mass");
	auto [shapes, frequencies] = solvedModes(K, M, nodes);
	requireStiffness(frequencies, noFrequency);
	const int count = int(frequencies.size());
	Modes     modes { std::move(shapes), {} };
	for (int first = 0, group = 0; first < count; first += group) {
		group = countOfSame(frequencies, first);
		makeCanonical(modes.shapes.middleCols(first, group), M.diagonal());
		modes.omegaSquared.insert(modes.omegaSquared.end(), group, frequencies.segment(first, group).mean());
	}
	return modes;
}

CondensedPart::CondensedPart(const Nodes& corners, int cells, Real young, Real poisson, Element element, Real mass)
        : cells(cells)
        , nodes(surfaceGrid(cells).positions(corners))
{
	const CondensedMatrices part  = condense(corners, cells, young, poisson, element, mass);
	const Columns6          rigid = rigidFields(nodes, Vector3r::Zero());
	surfaceMasses                 = part.surfaceMasses;
	rigidMass                     = rigid.transpose() * (part.mass * rigid).eval();
	modes                         = deformationModes(part.stiffness, part.mass, nodes);
	stressOf                      = elasticity(young, poisson) * meanStrainOf(areaVectors(surfaceGrid(cells), nodes), solidProperties(corners).volume);
}

} // namespace brick
