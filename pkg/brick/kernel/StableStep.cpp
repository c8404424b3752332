// SPDX-License-Identifier: GPL-2.0-or-later
// See StableStep.hpp. Sums run in a fixed order on one thread, so that a step does not depend on the machine.
#include "StableStep.hpp"
#include "SurfaceGrid.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brick {

namespace {

	using Springs = std::array<FaceSprings, faceCount>;

	Matrix3r springMatrix(const FaceSprings& springs, const Vector3r& normal)
	{
		return springs.shear * Matrix3r::Identity() + (springs.normal - springs.shear) * normal * normal.transpose();
	}

	/// Whatever the rounding.
	bool isMore(Real a, Real b) { return a > 1.001 * b; }

	/// The first face of the largest share.
	template <class Share> int faceOfMost(Share share)
	{
		Real most = 0;
		int  face = 0;
		for (int f = 0; f < faceCount; ++f) {
			const Real own = share(f);
			if (isMore(own, most)) most = own, face = f;
		}
		return face;
	}

	// Surfaces of one cell a face: exact

	constexpr int largestSize = 6 + modeCount;
	using Square              = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, 0, largestSize, largestSize>;
	using Rows                = Eigen::Matrix<Real, 3, Eigen::Dynamic, 0, 3, largestSize>;

	/// Displacement of a point of a face by the unit of each mass-scaled degree of freedom: translation, rotation, modes.
	Rows pointMotion(const Hexahedron& solid, int face, const Vector4r& weights, Real mass, const Vector3r& inertia, const Modes* modes)
	{
		Rows     J = Rows::Zero(3, 6 + (modes ? modes->count() : 0));
		Vector3r x = Vector3r::Zero();
		for (int a = 0; a < 4; ++a)
			x += weights[a] * solid.corners[faceNodes[face][a]];
		J.leftCols<3>() = Matrix3r::Identity() / std::sqrt(mass);
		for (int k = 0; k < 3; ++k)
			J.col(3 + k) = Vector3r::Unit(k).cross(x) / std::sqrt(inertia[k]);
		if (modes)
			for (int a = 0; a < 4; ++a)
				J.rightCols(modes->count()) += weights[a] * modes->shapes.block(3 * faceNodes[face][a], 0, 3, modes->count());
		return J;
	}

	FastestMotion exactMotion(const Hexahedron& solid, const Springs& springs, Real mass, const Vector3r& inertia, const Modes* modes)
	{
		const int                     size = 6 + (modes ? modes->count() : 0);
		const Real                    g    = 1 / std::sqrt(3.);
		std::array<Square, faceCount> byFace;
		Square                        K = Square::Zero(size, size);
		for (int f = 0; f < faceCount; ++f) {
			const Face&    face = solid.faces[f];
			const Matrix3r D    = springMatrix(springs[f], face.normal);
			byFace[f].setZero(size, size);
			for (int q = 0; q < 4; ++q) {
				const Real xi = q % 2 ? g : -g, eta = q / 2 ? g : -g;
				const Real area = (face.e1 + eta * face.e12).cross(face.e2 + xi * face.e12).norm(); // Gauss weight 1
				const Rows J    = pointMotion(solid, f, bilinear(xi, eta), mass, inertia, modes);
				byFace[f].noalias() += area * J.transpose() * D * J;
			}
			K += byFace[f];
		}
		const Eigen::SelfAdjointEigenSolver<Square> solver(K);
		const auto                                  fastest = solver.eigenvectors().col(size - 1);
		return { solver.eigenvalues()[size - 1], faceOfMost([&](int f) { return fastest.dot(byFace[f] * fastest); }) };
	}

	// Surfaces of several cells

	constexpr Real infinity = std::numeric_limits<Real>::infinity();

	/// Up to so many cells along an edge the matrix of all degrees of freedom (294) is small enough to be solved.
	constexpr int largestExact = 4;

	using Matrix4   = Eigen::Matrix<Real, 4, 4>;
	using Matrix36  = Eigen::Matrix<Real, 3, 6>;
	using Matrix312 = Eigen::Matrix<Real, 3, 12>;
	using Matrix12  = Eigen::Matrix<Real, 12, 12>;

	/// A cell of a face at rest.
	struct Cell {
		int                face;
		std::array<int, 4> nodes;
		Face               geometry;
		Matrix4            areas; ///< integral of N N^T [m2]
	};

	/// Calls visit(N, x, area) for each of 2 x 2 Gauss points: products of two N times the area are integrated exactly.
	template <class Visit> void visitPoints(const Face& cell, Visit visit)
	{
		const Real g = 1 / std::sqrt(3.);
		for (int q = 0; q < 4; ++q) {
			const Real xi = q % 2 ? g : -g, eta = q / 2 ? g : -g;
			visit(bilinear(xi, eta), cell.at(xi, eta), (cell.e1 + eta * cell.e12).cross(cell.e2 + xi * cell.e12).norm());
		}
	}

	Cell cellOf(int face, const std::array<int, 4>& nodes, const std::vector<Vector3r>& x)
	{
		Cell cell { face, nodes, Face::of(x[nodes[0]], x[nodes[1]], x[nodes[2]], x[nodes[3]]), Matrix4::Zero() };
		visitPoints(cell.geometry, [&](const Vector4r& N, const Vector3r&, Real area) { cell.areas += area * N * N.transpose(); });
		return cell;
	}

	Matrix36 rigidMotion(const Vector3r& x)
	{
		Matrix36 J;
		J.leftCols<3>().setIdentity();
		for (int k = 0; k < 3; ++k)
			J.col(3 + k) = Vector3r::Unit(k).cross(x);
		return J;
	}

	/// A refined brick on its springs, K = sum over faces and cells of  D integral of N N^T.
	class RefinedBrick {
	public:
		RefinedBrick(const Hexahedron&, const Springs&, Real mass, const Vector3r& inertia, const InnerPart&);
		FastestMotion bound() const;
		Real          exact() const;

	private:
		/// An upper bound of omega^2 of the nodes alone, and the positive weights that it was found with.
		struct Weighted {
			Real                        omegaSquared;
			VectorX                     weights;
			std::array<Real, faceCount> stiffness; ///< of each face, for its share
		};

		std::vector<Vector3r>           outer; ///< nodes of the brick's surface at rest
		std::vector<Cell>               cells;
		std::array<Matrix3r, faceCount> D;
		Vector6r                        rigidScale; ///< 1/sqrt of mass and moments
		const InnerPart&                inner;

		int                               size() const { return int(outer.size()); }
		VectorX                           areasTimes(int face, const VectorX& x) const;
		template <class Product> Weighted iterate(Product product) const;
		Weighted                          byDirection(int axis) const;
		Weighted                          byNode() const;
		Real                              rigidExcess() const;
	};

	RefinedBrick::RefinedBrick(const Hexahedron& solid, const Springs& springs, Real mass, const Vector3r& inertia, const InnerPart& part)
	        : outer(surfaceGrid(part.cells).positions(solid.corners))
	        , inner(part)
	{
		const SurfaceGrid& grid = surfaceGrid(inner.cells);
		for (int f = 0; f < faceCount; ++f) {
			D[f] = springMatrix(springs[f], solid.faces[f].normal);
			for (int cell = 0; cell < inner.cells * inner.cells; ++cell)
				cells.push_back(cellOf(f, grid.cellNodes(f, cell % inner.cells, cell / inner.cells), outer));
		}
		rigidScale << Vector3r::Constant(1 / std::sqrt(mass)), inertia.cwiseSqrt().cwiseInverse();
	}

	/// Integral of N N^T over a face, times x.
	VectorX RefinedBrick::areasTimes(int face, const VectorX& x) const
	{
		VectorX   y    = VectorX::Zero(size());
		const int each = inner.cells * inner.cells;
		for (int c = face * each; c < (face + 1) * each; ++c) {
			const auto&    n       = cells[c].nodes;
			const Vector4r product = cells[c].areas * Vector4r(x[n[0]], x[n[1]], x[n[2]], x[n[3]]);
			for (int a = 0; a < 4; ++a)
				y[n[a]] += product[a];
		}
		return y;
	}

	/// The largest ratio of product(x) to M_s x is a bound for any positive x; it does not grow when product(x) takes the place of M_s x.
	template <class Product> RefinedBrick::Weighted RefinedBrick::iterate(Product product) const
	{
		constexpr int  mostIterations = 100;
		constexpr Real settled = 1e-4, least = 1e-200; // of x: positive where no spring is
		Weighted       best { infinity, VectorX::Ones(size()), {} };
		for (int i = 0; i < mostIterations; ++i) {
			const VectorX y       = product(best.weights).cwiseQuotient(Eigen::Map<const VectorX>(inner.surfaceMasses.data(), size()));
			const Real    largest = y.cwiseQuotient(best.weights).maxCoeff();
			const bool    enough  = !(largest < (1 - settled) * best.omegaSquared);
			best.omegaSquared     = std::min(best.omegaSquared, largest);
			if (enough || largest == 0) break;
			best.weights = (y / largest).cwiseMax(least);
		}
		return best;
	}

	/// Motion along one axis only, D replaced by its row's sum of magnitudes.
	RefinedBrick::Weighted RefinedBrick::byDirection(int axis) const
	{
		std::array<Real, faceCount> stiffness;
		for (int f = 0; f < faceCount; ++f)
			stiffness[f] = D[f].row(axis).cwiseAbs().sum();
		const auto product = [&](const VectorX& x) {
			VectorX y = VectorX::Zero(size());
			for (int f = 0; f < faceCount; ++f)
				y += stiffness[f] * areasTimes(f, x);
			return y;
		};
		Weighted best  = iterate(product);
		best.stiffness = stiffness;
		return best;
	}

	/// Motion of each node in the direction that its own springs like best.
	RefinedBrick::Weighted RefinedBrick::byNode() const
	{
		Weighted best = iterate([&](const VectorX& x) {
			std::vector<Matrix3r> sums(size(), Matrix3r::Zero());
			for (int f = 0; f < faceCount; ++f) {
				const VectorX y = areasTimes(f, x);
				for (int a = 0; a < size(); ++a)
					sums[a] += y[a] * D[f];
			}
			VectorX largest(size());
			for (int a = 0; a < size(); ++a)
				largest[a] = Eigen::SelfAdjointEigenSolver<Matrix3r>(sums[a], Eigen::EigenvaluesOnly).eigenvalues()[2];
			return largest;
		});
		for (int f = 0; f < faceCount; ++f)
			best.stiffness[f] = D[f].trace();
		return best;
	}

	/// What the brick's own inertia can add to omega^2: the largest eigenvalue of  (R J^-1 R^T - R_i J_i^-1 R_i^T) K , the 12 columns U of which have signs s:
	/// that of  B^1/2 s B^1/2,  B = U^T K U.
	Real RefinedBrick::rigidExcess() const
	{
		const Matrix6r within = Matrix6r(inner.rigidMass.llt().matrixL()).inverse().transpose();
		Matrix12       B      = Matrix12::Zero();
		for (const Cell& cell : cells)
			visitPoints(cell.geometry, [&](const Vector4r& N, const Vector3r& x, Real area) {
				Vector3r xInner = Vector3r::Zero();
				for (int a = 0; a < 4; ++a)
					xInner += N[a] * inner.nodes[cell.nodes[a]];
				Matrix312 U;
				U << rigidMotion(x) * rigidScale.asDiagonal(), rigidMotion(xInner) * within;
				B += area * U.transpose() * D[cell.face] * U;
			});
		const Eigen::SelfAdjointEigenSolver<Matrix12> solver(B);
		const Matrix12 root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * solver.eigenvectors().transpose();
		Eigen::Matrix<Real, 12, 1> signs;
		signs << Vector6r::Ones(), -Vector6r::Ones();
		const Matrix12 difference = root * signs.asDiagonal() * root;
		return std::max(Real(0), Eigen::SelfAdjointEigenSolver<Matrix12>(difference, Eigen::EigenvaluesOnly).eigenvalues()[11]);
	}

	FastestMotion RefinedBrick::bound() const
	{
		Weighted fastest      = byDirection(0);
		Real     omegaSquared = fastest.omegaSquared;
		for (int axis : { 1, 2 }) {
			const Weighted other = byDirection(axis);
			omegaSquared         = std::max(omegaSquared, other.omegaSquared);
			if (isMore(other.omegaSquared, fastest.omegaSquared)) fastest = other;
		}
		const Weighted other = byNode();
		if (isMore(omegaSquared, other.omegaSquared)) fastest = other;
		const int face = faceOfMost([&](int f) { return fastest.stiffness[f] * fastest.weights.dot(areasTimes(f, fastest.weights)); });
		return { std::min(omegaSquared, other.omegaSquared) + rigidExcess(), face };
	}

	/// The largest eigenvalue of  Y^T K Y,  Y the displacements of the nodes by the unit of each mass-scaled degree of freedom.
	Real RefinedBrick::exact() const
	{
		const int dofs = 3 * size();
		MatrixX   Y(dofs, dofs); // transposed: a column for each component of a node
		for (int a = 0; a < size(); ++a)
			Y.block(0, 3 * a, 6, 3) = (rigidMotion(outer[a]) * rigidScale.asDiagonal()).transpose();
		Y.bottomRows(dofs - 6) = inner.modes.shapes.transpose();
		MatrixX forces         = MatrixX::Zero(dofs, dofs);
		for (const Cell& cell : cells)
			for (int a = 0; a < 4; ++a)
				for (int b = 0; b < 4; ++b) {
					const Matrix3r k = cell.areas(a, b) * D[cell.face];
					forces.middleCols<3>(3 * cell.nodes[a]) += Y.middleCols<3>(3 * cell.nodes[b]).lazyProduct(k);
				}
		MatrixX K = MatrixX::Zero(dofs, dofs);
		for (int j = 0; j < dofs; ++j)
			for (int k = 0; k < dofs; ++k) // only the lower half is read
				K.col(j).tail(dofs - j) += Y(j, k) * forces.col(k).tail(dofs - j);
		return Eigen::SelfAdjointEigenSolver<MatrixX>(K, Eigen::EigenvaluesOnly).eigenvalues()[dofs - 1];
	}

} // namespace

FastestMotion fastestMotion(const Hexahedron& solid, const Springs& springs, Real mass, const Vector3r& inertia, const InnerPart* inner)
{
	if (!inner || inner->cells == 1) return exactMotion(solid, springs, mass, inertia, inner ? &inner->modes : nullptr);
	const RefinedBrick brick(solid, springs, mass, inertia, *inner);
	FastestMotion      fastest = brick.bound();
	if (inner->cells <= largestExact) fastest.omegaSquared = brick.exact();
	return fastest;
}

Real stableStep(Real omegaSquared, Real dashpotTime)
{
	const Real omega = std::sqrt(omegaSquared), xi = omega * dashpotTime / 2;
	return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

namespace {

	/// Springs whose frequencies are  dt^2/4 K + dt/2 C.
	Springs inStep(const Springs& springs, Real dt)
	{
		Springs out = springs;
		for (FaceSprings& f : out) {
			const Real weight = dt * dt / 4 + dt / 2 * f.dashpotTime;
			f.normal *= weight, f.shear *= weight;
		}
		return out;
	}

} // namespace

LargestStep largestStep(const Hexahedron& solid, const Springs& springs, Real mass, const Vector3r& inertia, const InnerPart* inner)
{
	constexpr Real enough         = 1e-3;
	constexpr int  mostIterations = 50; // some six are needed; beyond, numbers are too far apart for each other
	const auto     motion = fastestMotion(solid, springs, mass, inertia, inner);
	Real           shortest = std::numeric_limits<Real>::infinity(), longest = 0;
	for (const FaceSprings& f : springs)
		if (f.normal > 0) shortest = std::min(shortest, f.dashpotTime), longest = std::max(longest, f.dashpotTime);
	LargestStep step { stableStep(motion.omegaSquared, longest), motion.face };
	if (!(shortest < longest) || (inner && inner->cells > 1)) return step;

	// lambda grows with dt and is convex in it: a chord meets 1 below the step; halving the far end's value brings the next one closer [Illinois]
	const auto beyond = [&](Real dt) { return fastestMotion(solid, inStep(springs, dt), mass, inertia, inner).omegaSquared - 1; };
	Real       low = step.seconds, high = stableStep(motion.omegaSquared, shortest), atLow = beyond(low), atHigh = beyond(high);
	for (int i = 0; i < mostIterations && high - low > enough * high && atLow < 0; ++i) {
		const Real chord = low - atLow * (high - low) / (atHigh - atLow);
		const Real dt    = std::min(chord, (1 - enough / 2) * high), at = beyond(dt); // the step may be at the far end itself
		if (at < 0) low = dt, atLow = at, atHigh /= 2;
		else
			high = dt, atHigh = at, atLow /= 2;
	}
	return { low, fastestMotion(solid, inStep(springs, low), mass, inertia, inner).face };
}

} // namespace brick
