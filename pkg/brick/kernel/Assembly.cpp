// SPDX-License-Identifier: GPL-2.0-or-later
#include "Assembly.hpp"

#include "Message.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

namespace brick {

namespace {

	using Triplets = std::vector<Eigen::Triplet<Real>>;

	Matrix3r crossMatrix(const Vector3r& a) { return (Matrix3r() << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0).finished(); }

	using PointMap = Eigen::Matrix<Real, 3, Eigen::Dynamic>;

	/// Displacement of one node, at `arm` from the brick's centre, for each coordinate of the brick.
	PointMap nodeMap(const AssembledBrick& b, const Matrix3r& R, int node, const Vector3r& arm)
	{
		PointMap map(3, b.coordinates());
		map.leftCols<3>().setIdentity();
		map.middleCols<3>(3) = -crossMatrix(arm);
		if (b.modes) map.rightCols(b.modes->count()) = R * b.modes->shapes.block(3 * node, 0, 3, b.modes->count());
		return map;
	}

	/// Displacement of one corner of a patch's rectangle, likewise.
	PointMap cornerMap(const AssembledBrick& b, const Matrix3r& R, const PatchSide& side, int corner, const Vector3r& arm)
	{
		PointMap map = PointMap::Zero(3, b.coordinates());
		map.leftCols<3>().setIdentity();
		map.middleCols<3>(3) = -crossMatrix(arm);
		if (b.modes)
			for (int a = 0; a < 4; ++a)
				map.rightCols(b.modes->count()) += side.weights(corner, a) * R * b.modes->shapes.block(3 * side.nodes[a], 0, 3, b.modes->count());
		return map;
	}

	void addBlock(Triplets& out, int row, int column, const MatrixX& block)
	{
		for (int j = 0; j < block.cols(); ++j)
			for (int i = 0; i < block.rows(); ++i)
				out.emplace_back(row + i, column + j, block(i, j));
	}

	SparseMatrix assembled(int size, const Triplets& entries)
	{
		SparseMatrix matrix(size, size);
		matrix.setFromTriplets(entries.begin(), entries.end());
		return matrix;
	}

	void checkIntact(const AssembledJoint& j)
	{
		if (!j.joint.holds())
			throw std::invalid_argument(
			        message("the joint of bricks ",
			                j.bricks[0],
			                " and ",
			                j.bricks[1],
			                " (-1: a support) has ",
			                j.joint.failures.total(),
			                " failed segments; allowed are joints that hold"));
	}

	/// The same joint with mortar that cannot fail.
	Joint unbreakable(Joint joint)
	{
		constexpr Real infinity = std::numeric_limits<Real>::infinity();
		joint.setMortar(joint.springs, { infinity, infinity, 0, infinity, 0 });
		return joint;
	}

} // namespace

NodalVectors AssembledBrick::displacement() const
{
	VectorX u = VectorX::Zero(3 * nodes());
	for (int k = 0; k < coordinates() - 6; ++k)
		u += amplitudes[k] * modes->shapes.col(k);
	NodalVectors out;
	for (int a = 0; a < nodes(); ++a)
		out.push_back(u.segment<3>(3 * a));
	return out;
}

Assembly::Assembly(std::vector<AssembledBrick> bricks, std::vector<AssembledJoint> given)
        : parts(std::move(bricks))
        , joints(std::move(given))
{
	for (const auto& b : parts) {
		if (int(b.amplitudes.size()) != b.coordinates() - 6)
			throw std::invalid_argument(message("a brick has ", b.amplitudes.size(), " amplitudes; needed are ", b.coordinates() - 6));
		places.push_back(coordinateCount);
		coordinateCount += b.coordinates();
		held.insert(held.end(), b.held.begin(), b.held.end());
		held.resize(coordinateCount, false);
	}
	for (const auto& j : joints)
		checkIntact(j);
}

Placement Assembly::placement(const AssembledJoint& j, int side, NodalVectors& displacement) const
{
	if (j.bricks[side] < 0) return j.support;
	const AssembledBrick& b = parts[j.bricks[side]];
	Placement             p;
	p.position = b.position;
	p.rotation = b.orientation.toRotationMatrix();
	if (b.modes) displacement = b.displacement(), p.displacement = displacement.data();
	return p;
}

JointMotion Assembly::motionOf(const AssembledJoint& j) const
{
	std::array<NodalVectors, 2> u;
	JointMotion                 m;
	jointMotion(j.joint, placement(j, 0, u[0]), placement(j, 1, u[1]), m);
	return m;
}

void Assembly::addJoint(const AssembledJoint& j, Triplets& out) const
{
	std::array<NodalVectors, 2>    u;
	const std::array<Placement, 2> at { placement(j, 0, u[0]), placement(j, 1, u[1]) };
	JointMotion                    m;
	jointMotion(j.joint, at[0], at[1], m);
	const SpotSprings& springs = j.joint.springs;
	const Matrix3r     D       = springs.shear * Matrix3r::Identity() + (springs.normal - springs.shear) * m.normal * m.normal.transpose();

	std::array<std::array<MatrixX, 2>, 2> blocks;
	for (int s = 0; s < 2; ++s)
		for (int t = 0; t < 2; ++t)
			if (j.bricks[s] >= 0 && j.bricks[t] >= 0)
				blocks[s][t] = MatrixX::Zero(parts[j.bricks[s]].coordinates(), parts[j.bricks[t]].coordinates());
	for (std::size_t i = 0; i < m.patches.size(); ++i)
		addPatch(j, int(i), at, m.patches[i], D, blocks);
	for (int s = 0; s < 2; ++s)
		for (int t = 0; t < 2; ++t)
			if (blocks[s][t].size() > 0) addBlock(out, places[j.bricks[s]], places[j.bricks[t]], blocks[s][t]);
}

void Assembly::addPatch(
        const AssembledJoint&                  j,
        int                                    number,
        const std::array<Placement, 2>&        at,
        const PatchMotion&                     m,
        const Matrix3r&                        D,
        std::array<std::array<MatrixX, 2>, 2>& blocks) const
{
	const JointPatch&                      patch = j.joint.shape->patches[number];
	const std::array<CornerVectors, 2>     corners { m.place, m.place + m.opening };
	std::array<std::array<PointMap, 4>, 2> maps;
	for (int side = 0; side < 2; ++side) {
		if (j.bricks[side] < 0) continue;
		const AssembledBrick& b = parts[j.bricks[side]];
		for (int c = 0; c < 4; ++c) {
			const Vector3r arm = at[0].position + Vector3r(corners[side].row(c)) - b.position;
			maps[side][c]      = cornerMap(b, at[side].rotation, patch.sides[side], c, arm);
		}
	}
	for (int s = 0; s < 2; ++s)
		for (int t = 0; t < 2; ++t) {
			if (blocks[s][t].size() == 0) continue;
			for (int c = 0; c < 4; ++c) {
				PointMap moved = PointMap::Zero(3, maps[t][0].cols());
				for (int d = 0; d < 4; ++d)
					moved += patch.weight(c, d) * maps[t][d];
				blocks[s][t] += (s == t ? 1 : -1) * maps[s][c].transpose() * (D * moved);
			}
		}
}

SparseMatrix Assembly::stiffness() const
{
	Triplets entries;
	for (const auto& j : joints)
		addJoint(j, entries);
	for (std::size_t i = 0; i < parts.size(); ++i)
		for (int k = 0; k < parts[i].coordinates() - 6; ++k)
			entries.emplace_back(places[i] + 6 + k, places[i] + 6 + k, parts[i].modes->omegaSquared[k]);
	return assembled(coordinateCount, entries);
}

SparseMatrix Assembly::mass() const
{
	Triplets entries;
	for (std::size_t i = 0; i < parts.size(); ++i) {
		const auto&    b       = parts[i];
		const Matrix3r R       = b.orientation.toRotationMatrix();
		const Matrix3r inertia = R * b.inertia.asDiagonal() * R.transpose();
		addBlock(entries, places[i], places[i], b.mass * Matrix3r::Identity());
		addBlock(entries, places[i] + 3, places[i] + 3, inertia);
		for (int k = 6; k < b.coordinates(); ++k)
			entries.emplace_back(places[i] + k, places[i] + k, 1);
	}
	return assembled(coordinateCount, entries);
}

VectorX Assembly::internalForces() const
{
	VectorX forces = VectorX::Zero(coordinateCount);
	for (const auto& j : joints) {
		std::array<NodalVectors, 2> u;
		const Placement             p0 = placement(j, 0, u[0]), p1 = placement(j, 1, u[1]);
		JointMotion                 m;
		JointLoads                  loads;
		PairSummary                 sum;
		Joint                       holding = unbreakable(j.joint);
		jointMotion(holding, p0, p1, m);
		jointLoads(holding, m, nullptr, 0, loads, sum);
		const std::array<const Placement*, 2> at { &p0, &p1 };
		for (int side = 0; side < 2; ++side) {
			if (j.bricks[side] < 0) continue;
			const AssembledBrick& b     = parts[j.bricks[side]];
			const int             place = places[j.bricks[side]];
			forces.segment<3>(place) += loads.forceOn(side);
			forces.segment<3>(place + 3) += loads.torque[side];
			if (!b.modes) continue;
			NodalVectors nodal(b.nodes(), Vector3r::Zero());
			addNodalForces(holding, loads, side, at[side]->rotation, nodal.data());
			for (int k = 0; k < b.modes->count(); ++k)
				for (int a = 0; a < b.nodes(); ++a)
					forces[place + 6 + k] += b.modes->shapes.col(k).segment<3>(3 * a).dot(nodal[a]);
		}
	}
	for (std::size_t i = 0; i < parts.size(); ++i)
		for (int k = 0; k < parts[i].coordinates() - 6; ++k)
			forces[places[i] + 6 + k] -= parts[i].modes->omegaSquared[k] * parts[i].amplitudes[k];
	return forces;
}

MatrixX Assembly::nodalMap(int brick, const std::vector<Vector3r>& nodes) const
{
	const AssembledBrick& b = parts[brick];
	const Matrix3r        R = b.orientation.toRotationMatrix();
	const NodalVectors    u = b.displacement();
	MatrixX               map(3 * int(nodes.size()), b.coordinates());
	for (int a = 0; a < int(nodes.size()); ++a)
		map.middleRows<3>(3 * a) = nodeMap(b, R, a, R * (nodes[a] + u[a]));
	return map;
}

int Assembly::freeBrick() const
{
	// groups of joined bricks, each named by one of its members; the support's is the last
	const int        support = int(parts.size());
	std::vector<int> parent(parts.size() + 1);
	std::iota(parent.begin(), parent.end(), 0);
	auto group = [&](int i) {
		while (parent[i] != i)
			i = parent[i] = parent[parent[i]];
		return i;
	};
	for (const auto& j : joints)
		parent[group(j.bricks[0] < 0 ? support : j.bricks[0])] = group(j.bricks[1] < 0 ? support : j.bricks[1]);
	for (int i = 0; i < support; ++i)
		if (std::any_of(parts[i].held.begin(), parts[i].held.end(), [](bool h) { return h; })) parent[group(i)] = group(support);
	for (int i = 0; i < support; ++i)
		if (group(i) != group(support)) return i;
	return -1;
}

void Assembly::move(const VectorX& increment)
{
	for (std::size_t i = 0; i < parts.size(); ++i) {
		AssembledBrick& b    = parts[i];
		const Vector3r  turn = increment.segment<3>(places[i] + 3);
		b.position += increment.segment<3>(places[i]);
		if (turn != Vector3r::Zero())
			b.orientation = (Quaternionr(Eigen::AngleAxis<Real>(turn.norm(), turn.normalized())) * b.orientation).normalized();
		for (int k = 0; k < b.coordinates() - 6; ++k)
			b.amplitudes[k] += increment[places[i] + 6 + k];
	}
}

Failures Assembly::overloaded() const
{
	Failures count;
	for (const auto& j : joints) {
		const Failures found = brick::overloaded(j.joint, motionOf(j));
		count.tension += found.tension;
		count.shear += found.shear;
		count.compression += found.compression;
	}
	return count;
}

Real Assembly::elasticEnergy() const
{
	Real energy = 0;
	for (const auto& j : joints)
		energy += jointEnergy(j.joint, motionOf(j), 0);
	for (const auto& b : parts)
		for (int k = 0; k < b.coordinates() - 6; ++k)
			energy += b.modes->omegaSquared[k] * b.amplitudes[k] * b.amplitudes[k] / 2;
	return energy;
}

namespace {

	/// The coordinates that are not held, and the structure's stiffness in them, factorised.
	class FreeStiffness {
	public:
		explicit FreeStiffness(const Assembly& structure)
		        : whole(structure.size())
		{
			std::vector<int> place(whole, -1);
			for (int i = 0; i < whole; ++i)
				if (!structure.isHeld(i)) place[i] = int(free.size()), free.push_back(i);
			const SparseMatrix all = structure.stiffness();
			Triplets           entries;
			for (int column = 0; column < whole; ++column)
				for (SparseMatrix::InnerIterator k(all, column); k; ++k)
					if (place[k.row()] >= 0 && place[column] >= 0) entries.emplace_back(place[k.row()], place[column], k.value());
			const SparseMatrix K = assembled(int(free.size()), entries);
			solver.compute(K);
			checkPivots(structure, K.diagonal());
		}

		/// K^-1 f, zero where held.
		VectorX operator()(const VectorX& f) const
		{
			VectorX reduced(free.size()), out = VectorX::Zero(whole);
			for (std::size_t i = 0; i < free.size(); ++i)
				reduced[i] = f[free[i]];
			const VectorX solution = solver.solve(reduced);
			for (std::size_t i = 0; i < free.size(); ++i)
				out[free[i]] = solution[i];
			return out;
		}

	private:
		int                                 whole;
		std::vector<int>                    free;
		Eigen::SimplicialLDLT<SparseMatrix> solver;

		/// A pivot that has vanished against its diagonal entry: the structure moves without force.
		void checkPivots(const Assembly& structure, const VectorX& diagonal) const
		{
			constexpr Real roundOff = 1e-14;
			if (solver.info() == Eigen::Success) {
				const VectorX pivots = solver.permutationPinv() * solver.vectorD();
				for (std::size_t i = 0; i < free.size(); ++i)
					if (!(pivots[i] > roundOff * diagonal[i])) refuse(structure, free[i]);
				return;
			}
			throw std::runtime_error("the structure is a mechanism: its stiffness cannot be factorised");
		}

		[[noreturn]] static void refuse(const Assembly& structure, int coordinate)
		{
			int brick = 0;
			while (brick + 1 < int(structure.bricks().size()) && structure.place(brick + 1) <= coordinate)
				++brick;
			throw Mechanism(message("the structure is a mechanism: nothing resists a motion of brick ", brick), brick);
		}
	};

} // namespace

Equilibrium settle(Assembly& structure, const VectorX& loads, Real tolerance, int mostIterations)
{
	if (const int loose = structure.freeBrick(); loose >= 0)
		throw Mechanism(message("the structure is a mechanism: no chain of joints leads from brick ", loose, " to a support"), loose);
	constexpr Real slow  = 0.2; // an iteration that leaves more than this share of the imbalance asks for the present stiffness
	auto           solve = std::make_unique<FreeStiffness>(structure);
	const Real     scale = loads.dot((*solve)(loads));
	Equilibrium    result;
	if (scale == 0 && structure.internalForces().isZero(0)) return result;
	// on to where round-off stops it: that depends on the springs, since they act on differences of places
	for (Real before = std::numeric_limits<Real>::infinity();; before = result.imbalance, ++result.iterations) {
		const VectorX rest = loads + structure.internalForces();
		VectorX       step = (*solve)(rest);
		const Real    work = rest.dot(step);
		result.imbalance   = std::sqrt(std::abs(work) / (scale > 0 ? scale : 1));
		if (result.imbalance <= tolerance && result.imbalance >= before / 2) return result;
		if (result.iterations == mostIterations || !std::isfinite(work))
			throw std::runtime_error(message(
			        "no equilibrium found: imbalance ", result.imbalance, " after ", result.iterations, " iterations; allowed is ", tolerance));
		if (result.imbalance > slow * before && result.imbalance > tolerance) {
			solve = std::make_unique<FreeStiffness>(structure);
			step  = (*solve)(rest);
		}
		structure.move(step);
	}
}

} // namespace brick
