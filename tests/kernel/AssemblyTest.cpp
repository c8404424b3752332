// SPDX-License-Identifier: GPL-2.0-or-later
#include "Pairs.hpp"
#include "Refusal.hpp"

#include <pkg/brick/kernel/Assembly.hpp>
#include <pkg/brick/kernel/InnerPart.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace brick;
using pairs::Body;
using pairs::edge;

namespace {

constexpr Real gravity = 9.8, weight = pairs::density * edge * edge * edge * gravity;
constexpr int  below = 4, above = 5; // faces -z and +z

MortarStrength strong() { return { 1e30, 1e30, pairs::friction, 1e30, 9 }; }

/// Cubes on a support, joined, turned as a whole; every second one shifted by half a cube when staggered.
class Tower {
public:
	Tower(int count, Deformation level, bool staggered = false, const Vector3r& turn = Vector3r::Zero(), const MortarStrength& strength = strong())
	{
		const Vector3r moved(turn == Vector3r::Zero() ? Vector3r(Vector3r::Zero()) : Vector3r(1, -2, .5));
		bodies.push_back(Body::slab({ 2, 2, edge }, { 0, 0, -edge / 2 }));
		for (int k = 0; k < count; ++k)
			bodies.push_back(Body::cube({ staggered && k % 2 ? edge / 2 : 0, 0, edge * (k + .5) }));
		const bool rigid = level == Deformation::Rigid;
		for (auto& b : bodies) {
			if (!b.support) b.contactLength.fill(rigid ? edge / 2 : .001);
			b.move(turn, moved);
		}
		if (!rigid)
			inner = std::make_unique<InnerPart>(InnerPartType { cuboidCorners(Vector3r::Constant(edge)),
			                                                    level,
			                                                    Element::Full,
			                                                    Inner::Inset,
			                                                    .001,
			                                                    pairs::young,
			                                                    pairs::poisson,
			                                                    pairs::density });
		for (int k = 0; k < count; ++k)
			bricks.push_back(brickOf(bodies[k + 1]));
		for (int k = 0; k < count; ++k)
			joints.push_back(jointBelow(k, strength));
	}
	Assembly assembly() const { return Assembly(bricks, joints); }

	std::vector<AssembledBrick> bricks;
	std::vector<AssembledJoint> joints;

private:
	std::vector<Body>          bodies;
	std::unique_ptr<InnerPart> inner;

	AssembledBrick brickOf(const Body& b) const
	{
		AssembledBrick out;
		out.position    = b.placement.position;
		out.orientation = Quaternionr(b.placement.rotation);
		out.mass        = pairs::density * edge * edge * edge;
		out.inertia     = Vector3r::Constant(out.mass * edge * edge / 6);
		if (inner) out.modes = &inner->modes, out.amplitudes.assign(inner->modes.count(), 0);
		return out;
	}
	AssembledJoint jointBelow(int k, const MortarStrength& strength) const
	{
		const Body &   lower = bodies[k], &upper = bodies[k + 1];
		AssembledJoint out;
		out.bricks         = { k - 1, k };
		out.support        = bodies[0].placement;
		const auto springs = k == 0 ? pairs::onSupport(pairs::springs(), 0) : pairs::springs();
		out.joint          = joinFaces(lower.side(), above, upper.side(), below, 3e-7).value();
		out.joint.setMortar(springs.at(lower.contactLength[above], upper.contactLength[below]), strength);
		return out;
	}
};

VectorX weightOf(const Assembly& a)
{
	VectorX f = VectorX::Zero(a.size());
	for (int i = 0; i < int(a.bricks().size()); ++i)
		f[a.place(i) + 2] = -weight;
	return f;
}

} // namespace

TEST(Assembly, stiffness_is_the_derivative_of_the_forces)
{
	constexpr Real step = 1e-7; // central difference: the next order is of some 1e-7 of the forces, round-off of lengths of 1e-16 / step
	for (const auto level : { Deformation::Rigid, Deformation::Uniform, Deformation::Trilinear }) {
		const Tower        tower(3, level, true, { .3, -1.1, .7 });
		const SparseMatrix K = tower.assembly().stiffness();
		for (int i = 0; i < K.cols(); ++i) {
			VectorX change   = VectorX::Zero(K.cols());
			change[i]        = step;
			Assembly forward = tower.assembly(), backward = tower.assembly();
			forward.move(change), backward.move(-change);
			const VectorX slope = (backward.internalForces() - forward.internalForces()) / (2 * step), column = K.col(i);
			EXPECT_LT((slope - column).cwiseAbs().maxCoeff(), 1e-6 * column.cwiseAbs().maxCoeff())
			        << "level " << int(level) << ", coordinate " << i;
		}
	}
}

TEST(Assembly, rigid_motion_of_the_whole_meets_no_force)
{
	Tower tower(3, Deformation::Trilinear, true, { .3, -1.1, .7 });
	tower.joints.erase(tower.joints.begin()); // off the support
	const Assembly     free = tower.assembly();
	const SparseMatrix K    = free.stiffness();
	for (int k = 0; k < 6; ++k) {
		VectorX motion = VectorX::Zero(free.size());
		for (int i = 0; i < 3; ++i) {
			const Vector3r axis = Vector3r::Unit(k % 3);
			if (k < 3) motion.segment<3>(free.place(i)) = axis;
			else {
				motion.segment<3>(free.place(i))     = axis.cross(free.bricks()[i].position);
				motion.segment<3>(free.place(i) + 3) = axis;
			}
		}
		EXPECT_LT((K * motion).norm(), 1e-12 * K.norm() * motion.norm()); // round-off of sums over segments
	}
	EXPECT_EQ(free.freeBrick(), 0);
	EXPECT_EQ(Tower(3, Deformation::Rigid).assembly().freeBrick(), -1);
}

TEST(Assembly, nodal_map_and_mass_give_back_the_solid)
{
	const Tower    tower(1, Deformation::Trilinear, false, { .3, -1.1, .7 });
	const Assembly a = tower.assembly();
	const MatrixX  M = a.mass();
	EXPECT_NEAR(M(0, 0), tower.bricks[0].mass, 1e-12);
	EXPECT_NEAR(M(4, 4), tower.bricks[0].mass * edge * edge / 6, 1e-12); // of a cube about any axis
	EXPECT_LT((M - MatrixX(M.diagonal().asDiagonal())).norm(), 1e-12);
	// eight equal masses at the nodes see translations and modes as the assembly does, rotations with lumped inertia
	const Nodes   nodes  = cuboidCorners(Vector3r::Constant(edge - .002));
	const MatrixX map    = a.nodalMap(0, { nodes.begin(), nodes.end() });
	const MatrixX lumped = tower.bricks[0].mass / 8 * map.transpose() * map;
	EXPECT_LT((lumped.bottomRightCorner(18, 18) - M.bottomRightCorner(18, 18)).norm(), 1e-12);
	EXPECT_LT(lumped.bottomLeftCorner(18, 6).norm(), 1e-12);
	EXPECT_NEAR(lumped(0, 0), M(0, 0), 1e-12);
}

TEST(Settle, rigid_tower_settles_as_springs_in_series)
{
	const Tower tower(4, Deformation::Rigid);
	Assembly    a      = tower.assembly();
	const auto  result = settle(a, weightOf(a), 1e-6, 30);
	EXPECT_LT(result.imbalance, 1e-10); // round-off of lengths of order 1 m times springs of 2e6 N/m, over a weight of 141 N
	Real sunk = 0;
	for (int k = 0; k < 4; ++k) {
		const auto& joint = tower.joints[k].joint;
		sunk += (4 - k) * weight / (joint.springs.normal * edge * edge);
		EXPECT_NEAR(tower.bricks[k].position[2] - a.bricks()[k].position[2], sunk, 1e-12);
		EXPECT_NEAR(a.bricks()[k].position[0], 0, 1e-14);
	}
	Real half = 0; // energy of linear springs: half the work of the loads
	for (int k = 0; k < 4; ++k)
		half += weight * (tower.bricks[k].position[2] - a.bricks()[k].position[2]) / 2;
	EXPECT_NEAR(a.elasticEnergy(), half, 1e-12 * half);
}

TEST(Settle, balances_a_structure_in_any_position)
{
	// a fiftieth of the weight: this tower leans out so far that it would sag by half its height under all of it
	for (const auto level : { Deformation::Rigid, Deformation::Uniform, Deformation::Trilinear }) {
		const Tower   tower(5, level, true, { .3, -1.1, .7 });
		Assembly      a      = tower.assembly();
		const VectorX loads  = weightOf(a) / 50;
		const auto    result = settle(a, loads, 1e-6, 30);
		const VectorX rest   = loads + a.internalForces();
		EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-7 * weight) << int(level); // round-off of lengths times springs of 2e8 N/m
		EXPECT_LT(result.imbalance, 1e-8) << int(level);
	}
}

TEST(Settle, says_so_when_it_finds_no_equilibrium)
{
	const Tower tower(5, Deformation::Rigid, true, { .3, -1.1, .7 });
	Assembly    a = tower.assembly();
	EXPECT_THROW(settle(a, weightOf(a), 1e-6, 30), std::runtime_error);
}

TEST(Settle, counts_segments_beyond_their_strength)
{
	// hung from the support: the topmost joint bears all weight
	const Tower tower(4, Deformation::Rigid, false, Vector3r::Zero(), { 4.5 * weight / (edge * edge), 1e30, 0, 1e30, 9 });
	for (const Real share : { 1.1, 1.2 }) {
		Assembly a = tower.assembly();
		settle(a, -share * weightOf(a), 1e-6, 30);
		EXPECT_EQ(a.overloaded().tension, share > 4.5 / 4 ? 16 : 0);
		EXPECT_EQ(a.overloaded().total(), a.overloaded().tension);
	}
}

TEST(Settle, held_coordinates_do_not_move)
{
	Tower tower(2, Deformation::Trilinear);
	tower.bricks[1].held.fill(true);
	Assembly a = tower.assembly();
	settle(a, weightOf(a), 1e-6, 30);
	EXPECT_EQ(a.bricks()[1].position, tower.bricks[1].position);
	EXPECT_EQ(a.bricks()[1].orientation.coeffs(), tower.bricks[1].orientation.coeffs());
	EXPECT_LT(a.bricks()[0].position[2], tower.bricks[0].position[2]);
}

TEST(Assembly, refuses_what_is_not_intact)
{
	Tower tower(2, Deformation::Trilinear);
	++tower.joints[1].joint.failures.shear;
	EXPECT_NE(refusal([&] { tower.assembly(); }).find("failed segments"), std::string::npos);
	--tower.joints[1].joint.failures.shear;
	tower.bricks[1].amplitudes.pop_back();
	EXPECT_NE(refusal([&] { tower.assembly(); }).find("17 amplitudes"), std::string::npos);
}

TEST(Settle, names_the_brick_that_nothing_holds)
{
	Tower tower(3, Deformation::Trilinear);
	tower.joints.pop_back();
	Assembly a = tower.assembly();
	try {
		settle(a, weightOf(a), 1e-6, 30);
		FAIL() << "a brick without joints was accepted";
	} catch (const std::runtime_error& error) {
		EXPECT_NE(std::string(error.what()).find("brick 2"), std::string::npos) << error.what();
	}
}
