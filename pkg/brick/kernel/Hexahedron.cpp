// SPDX-License-Identifier: GPL-2.0-or-later
#include "Hexahedron.hpp"
#include "Message.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace brick {

namespace {

	Vector3r naturalCorner(int node) { return { Real(nodeSigns[node][0]), Real(nodeSigns[node][1]), Real(nodeSigns[node][2]) }; }

	Vector3r mean(const Nodes& nodes)
	{
		Vector3r sum = Vector3r::Zero();
		for (const auto& x : nodes)
			sum += x;
		return sum / nodeCount;
	}

	/// Calls visit(a, b) for the edges of all faces: each edge comes twice, once in either direction.
	template <class Visitor> void forEachEdge(Visitor visit)
	{
		for (const auto& nodes : faceNodes)
			for (int i = 0; i < 4; ++i)
				visit(nodes[i], nodes[(i + 1) % 4]);
	}

	Real longestEdge(const Nodes& nodes)
	{
		Real longest = 0;
		forEachEdge([&](int a, int b) { longest = std::max(longest, (nodes[b] - nodes[a]).norm()); });
		return longest;
	}

	std::string edgeProblem(const Nodes& nodes)
	{
		const Real  shortest = cornerTolerance * longestEdge(nodes);
		std::string problem;
		forEachEdge([&](int a, int b) {
			const Real length = (nodes[b] - nodes[a]).norm();
			if (problem.empty() && !(length > shortest))
				problem = message("the edge from corner ", a, " to ", b, " has length ", length, " m; it must be longer than ", shortest, " m");
		});
		return problem;
	}

	std::string jacobianProblem(const Nodes& nodes, const Vector3r& natural, const std::string& where)
	{
		const Matrix3r J      = jacobian(nodes, natural);
		const Real     spans  = J.col(0).norm() * J.col(1).norm() * J.col(2).norm();
		const Real     volume = J.determinant() / spans;
		if (volume > cornerTolerance) return "";
		return message(
		        "det J at ",
		        where,
		        " is ",
		        volume,
		        " of the product of the edges there; it must be above ",
		        cornerTolerance,
		        ": the hexahedron is inverted, flat or not convex, or its corners are in another order than 0-1-2-3 counter-clockwise from above "
		        "(below), 4-5-6-7 over them");
	}

	Face makeFace(const Nodes& corners, int face)
	{
		const auto& n = faceNodes[face];
		return Face::of(corners[n[0]], corners[n[1]], corners[n[2]], corners[n[3]]);
	}

	std::string planarityProblem(const Nodes& corners, int face)
	{
		const Face f       = makeFace(corners, face);
		const Real allowed = planarityTolerance * longestEdge(corners);
		const Real warp    = std::abs(f.normal.dot(f.e12)); // the four corners lie this far from the mean plane, to either side in turn
		if (!(f.area > 0)) return message("face ", face, " has no area");
		if (!(warp <= allowed))
			return message(
			        "face ",
			        face,
			        " is not planar: its corners are ",
			        warp,
			        " m off their mean plane; at most ",
			        allowed,
			        " m (",
			        planarityTolerance,
			        " of the longest edge) is allowed");
		return "";
	}

	std::string convexityProblem(const Nodes& corners, int face)
	{
		const Face f      = makeFace(corners, face);
		const Real needed = planarityTolerance * longestEdge(corners);
		for (int a = 0; a < nodeCount; ++a) {
			const Real depth = f.offset - f.normal.dot(corners[a]);
			if (std::count(std::begin(faceNodes[face]), std::end(faceNodes[face]), a) == 0 && !(depth > needed))
				return message(
				        "the hexahedron is not convex: corner ",
				        a,
				        " lies ",
				        depth,
				        " m behind the plane of face ",
				        face,
				        "; more than ",
				        needed,
				        " m is needed");
		}
		return "";
	}

	/// Where the planes of the three faces that meet at a corner intersect after moving inward by r.
	Vector3r planesMeet(const Hexahedron& brick, int node, Real r)
	{
		Matrix3r normals;
		Vector3r offsets;
		for (int axis = 0; axis < 3; ++axis) {
			const Face& f     = brick.faces[2 * axis + (nodeSigns[node][axis] > 0 ? 1 : 0)];
			normals.row(axis) = f.normal.transpose();
			offsets[axis]     = f.offset - r;
		}
		return normals.inverse() * offsets;
	}

	/// Turns the axes i and j in their plane so that they come as close as they can to the coordinate axes i and j.
	void turnPair(Matrix3r& axes, int i, int j)
	{
		const Real     angle = std::atan2(axes(i, j) - axes(j, i), axes(i, i) + axes(j, j));
		const Vector3r first = axes.col(i), second = axes.col(j);
		axes.col(i) = std::cos(angle) * first + std::sin(angle) * second;
		axes.col(j) = std::cos(angle) * second - std::sin(angle) * first;
	}

	void requireInertia(const Matrix3r& inertia)
	{
		if (!inertia.allFinite()) throw std::invalid_argument("the inertia must be finite");
		const Real asymmetry = (inertia - inertia.transpose()).cwiseAbs().maxCoeff();
		if (!(asymmetry <= inertiaTolerance * inertia.cwiseAbs().maxCoeff()))
			throw std::invalid_argument(message("the inertia must be symmetric; entries differ by ", asymmetry));
	}

} // namespace

Eigen::Matrix<Real, nodeCount, 1> shapeFunctions(const Vector3r& natural)
{
	Eigen::Matrix<Real, nodeCount, 1> N;
	for (int a = 0; a < nodeCount; ++a)
		N[a] = (Vector3r::Ones() + naturalCorner(a).cwiseProduct(natural)).prod() / 8;
	return N;
}

Eigen::Matrix<Real, nodeCount, 3> shapeDerivatives(const Vector3r& natural)
{
	Eigen::Matrix<Real, nodeCount, 3> derivatives;
	for (int a = 0; a < nodeCount; ++a) {
		const Vector3r sign = naturalCorner(a);
		const Vector3r term = Vector3r::Ones() + sign.cwiseProduct(natural);
		derivatives.row(a) << sign[0] * term[1] * term[2], sign[1] * term[2] * term[0], sign[2] * term[0] * term[1];
	}
	return derivatives / 8;
}

Matrix3r jacobian(const Nodes& corners, const Vector3r& natural)
{
	const auto derivatives = shapeDerivatives(natural);
	Matrix3r   J           = Matrix3r::Zero();
	for (int a = 0; a < nodeCount; ++a)
		J += corners[a] * derivatives.row(a);
	return J;
}

SolidProperties solidProperties(const Nodes& corners)
{
	const Real points[3] = { -std::sqrt(0.6), 0, std::sqrt(0.6) }, weights[3] = { 5. / 9, 8. / 9, 5. / 9 };

	const Vector3r origin      = mean(corners); // moments about a point inside: no digits lost when the brick is far from the frame's origin
	Real           volume      = 0;
	Vector3r       firstMoment = Vector3r::Zero();
	Matrix3r       second      = Matrix3r::Zero();
	for (int q = 0; q < 27; ++q) {
		const int      i = q % 3, j = q / 3 % 3, k = q / 9;
		const Vector3r natural(points[i], points[j], points[k]);
		const Real     dV = weights[i] * weights[j] * weights[k] * jacobian(corners, natural).determinant();
		const auto     N  = shapeFunctions(natural);
		Vector3r       x  = Vector3r::Zero();
		for (int a = 0; a < nodeCount; ++a)
			x += N[a] * (corners[a] - origin);
		volume += dV;
		firstMoment += dV * x;
		second += dV * x * x.transpose();
	}
	const Vector3r centroid = firstMoment / volume;
	second -= volume * centroid * centroid.transpose();
	return { volume, origin + centroid, second.trace() * Matrix3r::Identity() - second };
}

PrincipalFrame principalFrame(const Matrix3r& inertia)
{
	requireInertia(inertia);
	const Eigen::SelfAdjointEigenSolver<Matrix3r> solver(inertia);
	const Vector3r                                moments   = solver.eigenvalues();
	const Real                                    roundOff  = inertiaTolerance * moments[2];
	const Matrix3r                                remainder = inertia - Matrix3r(inertia.diagonal().asDiagonal());
	if (!(moments[0] > 0)) throw std::invalid_argument(message("the inertia must be positive definite; its smallest moment is ", moments[0]));
	if (remainder.cwiseAbs().maxCoeff() <= roundOff) return { inertia.diagonal(), Quaternionr::Identity() };

	// Of the 24 right-handed ways to name and sign the axes, the one of least rotation: largest trace. A later one has to win by more
	// than round-off, so that ties fall the same way everywhere.
	PrincipalFrame best;
	Real           bestTrace  = -2;
	int            order[3]   = { 0, 1, 2 };
	const int      pairs[][2] = { { 0, 1 }, { 1, 2 }, { 0, 2 } };
	do {
		for (int signs = 0; signs < 8; ++signs) {
			Matrix3r axes;
			Vector3r named;
			for (int i = 0; i < 3; ++i) {
				axes.col(i) = (signs >> i & 1 ? -1 : 1) * solver.eigenvectors().col(order[i]);
				named[i]    = moments[order[i]];
			}
			if (axes.determinant() < 0) continue;
			for (const auto& pair : pairs)
				if (std::abs(named[pair[0]] - named[pair[1]]) <= roundOff) turnPair(axes, pair[0], pair[1]);
			if (axes.trace() <= bestTrace + inertiaTolerance) continue;
			bestTrace = axes.trace();
			best      = { named, Quaternionr(axes).normalized() };
		}
	} while (std::next_permutation(order, order + 3));
	return best;
}

std::string nodesProblem(const Nodes& nodes)
{
	for (int a = 0; a < nodeCount; ++a)
		if (!nodes[a].allFinite()) return message("corner ", a, " is (", nodes[a].transpose(), "); it must be finite");
	std::string problem = edgeProblem(nodes);
	for (int a = 0; a < nodeCount && problem.empty(); ++a)
		problem = jacobianProblem(nodes, naturalCorner(a) / std::sqrt(3.), message("the Gauss point nearest corner ", a));
	return problem.empty() ? jacobianProblem(nodes, Vector3r::Zero(), "the centre") : problem;
}

std::string cornersProblem(const Nodes& corners)
{
	std::string problem = nodesProblem(corners);
	for (int a = 0; a < nodeCount && problem.empty(); ++a)
		problem = jacobianProblem(corners, naturalCorner(a), message("corner ", a));
	for (int face = 0; face < faceCount && problem.empty(); ++face)
		problem = planarityProblem(corners, face);
	for (int face = 0; face < faceCount && problem.empty(); ++face)
		problem = convexityProblem(corners, face);
	return problem;
}

Face Face::of(const Vector3r& x0, const Vector3r& x1, const Vector3r& x2, const Vector3r& x3)
{
	const Vector3r twiceArea = (x2 - x0).cross(x3 - x1);
	Face           f;
	f.normal        = twiceArea / twiceArea.norm();
	f.area          = twiceArea.norm() / 2;
	f.centre        = (x0 + x1 + x2 + x3) / 4;
	f.offset        = f.normal.dot(f.centre);
	f.e1            = (x1 + x2 - x0 - x3) / 4;
	f.e2            = (x2 + x3 - x0 - x1) / 4;
	f.e12           = (x0 + x2 - x1 - x3) / 4;
	f.parallelogram = f.e12.squaredNorm() <= 1e-24 * (f.e1.squaredNorm() + f.e2.squaredNorm());
	const Real side = f.normal.dot(f.e1.cross(f.e2));
	f.dual1         = f.e2.cross(f.normal) / side;
	f.dual2         = f.normal.cross(f.e1) / side;
	return f;
}

Vector2r Face::coordinatesOnQuadrilateral(const Vector3r& x) const
{
	const auto     clamped = [](Real value) { return std::max(Real(-1), std::min(value, Real(1))); };
	const Vector3r d       = x - centre;
	const Real     p = dual1.dot(d), q = dual2.dot(d), a = dual1.dot(e12), b = dual2.dot(e12);
	// xi (1 + a eta) = p and eta (1 + b xi) = q, so that a eta^2 + (1 + b p - a q) eta - q = 0. On a convex face |a| + |b| < 1; inside it the root is J, the
	// positive Jacobian, and half + J = 2 (1 + b xi) > 0. Outside, where they may vanish, eta goes to the end that q points to.
	const Real half    = 1 + b * p - a * q;
	const Real divisor = half + std::sqrt(std::max(Real(0), half * half + 4 * a * q));
	const Real eta     = 2 * std::abs(q) >= divisor ? (q < 0 ? -1 : 1) : 2 * q / divisor;
	return { clamped(p / (1 + a * eta)), eta };
}

Vector3r Face::at(Real xi, Real eta) const { return centre + xi * e1 + eta * e2 + xi * eta * e12; }

Hexahedron::Hexahedron(const Nodes& restCorners)
        : corners(restCorners)
{
	const std::string problem = cornersProblem(corners);
	if (!problem.empty()) throw std::invalid_argument(problem);
	reach.setZero();
	for (const auto& corner : corners)
		reach = reach.cwiseMax(corner.cwiseAbs());
	for (int face = 0; face < faceCount; ++face) {
		faces[face] = makeFace(corners, face);
		if (!(faces[face].offset > 0))
			throw std::invalid_argument(
			        message("the origin of the body frame, the centre of gravity, is ",
			                faces[face].offset,
			                " m behind the plane of face ",
			                face,
			                "; it must be inside, above 0 m"));
	}
}

Real insetLimit(const Hexahedron& brick)
{
	Nodes moved; // what a thickness of 1 m moves each corner by: they move in proportion
	for (int a = 0; a < nodeCount; ++a)
		moved[a] = planesMeet(brick, a, 1) - planesMeet(brick, a, 0);
	Real limit = std::numeric_limits<Real>::infinity();
	forEachEdge([&](int a, int b) {
		const Vector3r edge   = brick.corners[b] - brick.corners[a];
		const Real     shrink = edge.dot(moved[a] - moved[b]);
		if (shrink > 0) limit = std::min(limit, edge.squaredNorm() / shrink);
	});
	return limit;
}

Nodes insetCorners(const Hexahedron& brick, Real r)
{
	const Real limit = insetLimit(brick);
	if (!(r > 0 && r < (1 - cornerTolerance) * limit))
		throw std::invalid_argument(
		        message("the thickness r of the contact part is ", r, " m; it must be above 0 and, for this brick, below ", limit, " m"));
	Nodes inner;
	for (int a = 0; a < nodeCount; ++a)
		inner[a] = planesMeet(brick, a, r);
	return inner;
}

Nodes cuboidCorners(const Vector3r& size)
{
	if (!(size.allFinite() && size.minCoeff() > 0))
		throw std::invalid_argument(message("the size of a cuboid is (", size.transpose(), ") m; each must be finite and above 0"));
	Nodes corners;
	for (int a = 0; a < nodeCount; ++a)
		corners[a] = naturalCorner(a).cwiseProduct(size) / 2;
	return corners;
}

} // namespace brick
