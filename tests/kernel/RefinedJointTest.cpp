// SPDX-License-Identifier: GPL-2.0-or-later
// Joints of bodies whose faces have several cells: what they share with faces of one cell, and what only they can do.
#include "Pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brick;
using pairs::edge;

namespace {

constexpr Real roundOff  = 1e-12; ///< relative: sums over some hundred segments
constexpr Real tolerance = 3e-7;  ///< within which faces touch [m]
constexpr int  below = 4, above = 5; // faces -z and +z

/// A deformable body with a surface of cells.
struct Surface {
	pairs::Body           body;
	int                   cells;
	std::vector<Vector3r> displacement, rate;

	Surface(const pairs::Body& body, int cells)
	        : body(body)
	        , cells(cells)
	        , displacement(surfaceGrid(cells).size(), Vector3r::Zero())
	        , rate(displacement)
	{
	}
	Side side() const
	{
		Side s                       = body.side();
		s.cells                      = cells;
		s.placement.displacement     = displacement.data();
		s.placement.displacementRate = rate.data();
		return s;
	}
	/// The field that eight nodes give.
	static std::vector<Vector3r> trilinear(int cells, const Nodes& nodes)
	{
		std::vector<Vector3r> out;
		for (int a = 0; a < surfaceGrid(cells).size(); ++a) {
			const auto N = shapeFunctions(surfaceGrid(cells).naturalCoordinates(a));
			out.push_back(Vector3r::Zero());
			for (int b = 0; b < nodeCount; ++b)
				out.back() += N[b] * nodes[b];
		}
		return out;
	}
};

struct Pair {
	Surface     first, second;
	PairSprings springs = pairs::springs();
	Joint       joint;

	Pair(const Surface& first, const Surface& second, const MortarStrength& strength = { 1e30, 1e30, pairs::friction, 1e30, 9 })
	        : first(first)
	        , second(second)
	{
		joint = *joinFaces(first.side(), above, second.side(), below, tolerance);
		joint.setMortar(springs.at(first.body.contactLength[above], second.body.contactLength[below]), strength);
	}
	/// Cubes of eight segments an edge, one on the other.
	static Pair stacked(int cells0, int cells1, const Vector2r& shift = Vector2r::Zero(), const MortarStrength& strength = { 1e30, 1e30, pairs::friction, 1e30, 9 })
	{
		return Pair(
		        { pairs::Body::cube({ 0, 0, 0 }, 8), cells0 }, { pairs::Body::cube({ shift[0], shift[1], edge }, 8), cells1 }, strength);
	}

	JointMotion motion() const
	{
		JointMotion m;
		jointMotion(joint, first.side().placement, second.side().placement, m);
		return m;
	}
	struct Answer {
		JointLoads                           loads;
		PairSummary                          sum;
		std::array<std::vector<Vector3r>, 2> nodal; ///< world axes
		Failures                             failures;
	};
	Answer step()
	{
		Answer                a;
		const JointPlacements moving { first.side().placement, second.side().placement };
		a.failures = jointLoads(joint, motion(), &moving, springs.tanFriction, a.loads, a.sum);
		for (int s = 0; s < 2; ++s) {
			const Surface& surface = s ? second : first;
			a.nodal[s].assign(surface.displacement.size(), Vector3r::Zero());
			addNodalForces(joint, a.loads, s, surface.body.placement.rotation, a.nodal[s].data());
		}
		return a;
	}
};

/// Moves both bodies a little, with fields of eight nodes.
struct TrilinearMotion {
	std::array<Nodes, 2>    displacement, rate;
	std::array<Vector3r, 2> turn, shift, velocity, spin;

	explicit TrilinearMotion(unsigned seed)
	{
		pairs::Random random(seed);
		for (int s = 0; s < 2; ++s) {
			displacement[s] = random.nodes(1e-5), rate[s] = random.nodes(.01);
			turn[s] = random.vector(1e-4), shift[s] = random.vector(1e-5), velocity[s] = random.vector(.01), spin[s] = random.vector(.1);
		}
	}
	void apply(Pair& pair) const
	{
		for (int s = 0; s < 2; ++s) {
			Surface& surface     = s ? pair.second : pair.first;
			surface.displacement = Surface::trilinear(surface.cells, displacement[s]), surface.rate = Surface::trilinear(surface.cells, rate[s]);
			surface.body.move(turn[s], shift[s], surface.body.placement.position);
			surface.body.placement.velocity = velocity[s], surface.body.placement.angularVelocity = spin[s];
		}
	}
};

/// What the nodal forces do on the fields of eight nodes.
std::vector<Vector3r> onEightNodes(int cells, const std::vector<Vector3r>& nodal)
{
	std::vector<Vector3r> out(nodeCount, Vector3r::Zero());
	for (int a = 0; a < int(nodal.size()); ++a) {
		const auto N = shapeFunctions(surfaceGrid(cells).naturalCoordinates(a));
		for (int b = 0; b < nodeCount; ++b)
			out[b] += N[b] * nodal[a];
	}
	return out;
}

/// Makes every other segment of a joint a failed one, told by its place on the lower body.
void crackInPart(Pair& pair)
{
	for (int s = 0; s < pair.joint.count(); ++s) {
		const JointSegment segment = segmentOf(pair.joint, s);
		const Vector3r     x       = pair.joint.shape->patches[segment.patch].sides[0].corners.transpose() * cornerWeights(segment.p, segment.q);
		if (int(std::floor(40 * x[0]) + std::floor(40 * x[1])) % 2) pairs::fail(pair.joint, s, SegmentState::Shear);
	}
}

} // namespace

TEST(RefinedJoint, patches_are_the_overlaps_of_cells_and_cover_the_joint)
{
	for (const Vector2r& shift : { Vector2r(0, 0), Vector2r(edge / 2, 0), Vector2r(.3 * edge, -.15 * edge) })
		for (const auto& [cells0, cells1] : { std::pair(2, 2), std::pair(4, 2), std::pair(1, 8) }) {
			const Pair coarse = Pair::stacked(1, 1, shift), fine = Pair::stacked(cells0, cells1, shift);
			EXPECT_NEAR(fine.joint.area(), coarse.joint.area(), roundOff * edge * edge);
			EXPECT_EQ(fine.joint.restGap, coarse.joint.restGap);
			int count = 0;
			for (const auto& patch : fine.joint.shape->patches) {
				count += patch.count;
				const Surface* surfaces[2] { &fine.first, &fine.second };
				for (int s = 0; s < 2; ++s) {
					CornerVectors nodes;
					for (int a = 0; a < 4; ++a)
						nodes.row(a) = surfaceGrid(surfaces[s]->cells).positions(surfaces[s]->body.solid.corners)[patch.sides[s].nodes[a]];
					EXPECT_LT((patch.sides[s].weights * nodes - patch.sides[s].corners).norm(), roundOff * edge);
				}
			}
			EXPECT_EQ(fine.joint.count(), count);
		}
	EXPECT_EQ(Pair::stacked(4, 4).joint.shape->patches.size(), 16u);
	EXPECT_EQ(Pair::stacked(4, 4).joint.count(), 64);
	EXPECT_EQ(Pair::stacked(2, 2, { edge / 2, 0 }).joint.shape->patches.size(), 2u);
	EXPECT_EQ(Pair::stacked(1, 1).joint.shape->rows, Pair::stacked(4, 2).joint.shape->rows);
}

// A field of eight nodes is seen the same through any cells: forces, and the work that nodal forces do on such fields; with all segments and with a part of them.
TEST(RefinedJoint, fields_of_eight_nodes_give_what_one_cell_gives)
{
	for (unsigned trial = 0; trial < 8; ++trial)
		for (const auto& [cells0, cells1] : { std::pair(2, 2), std::pair(4, 2), std::pair(1, 8) }) {
			const TrilinearMotion motion(trial);
			Pair                  coarse = Pair::stacked(1, 1, { edge / 2, 0 }), fine = Pair::stacked(cells0, cells1, { edge / 2, 0 });
			if (trial % 2) crackInPart(coarse), crackInPart(fine);
			ASSERT_EQ(coarse.joint.failures.total(), fine.joint.failures.total());
			motion.apply(coarse), motion.apply(fine);
			const auto a = coarse.step(), b = fine.step();
			const Real F = a.loads.forceOn(0).norm(), small = pairs::knThin * edge * edge / 2 * 1e-16; // places of some 0.1 m keep 1e-17 m, over all springs
			EXPECT_LT((a.loads.forceOn(0) - b.loads.forceOn(0)).norm(), small);
			EXPECT_NEAR(a.sum.penetration, b.sum.penetration, roundOff * edge);
			EXPECT_LT((a.sum.point - b.sum.point).norm(), roundOff * edge);
			EXPECT_NEAR(jointEnergy(coarse.joint, coarse.motion(), 0), jointEnergy(fine.joint, fine.motion(), 0), 1e-10 * F * edge);
			for (int s = 0; s < 2; ++s) {
				EXPECT_LT((a.loads.torque[s] - b.loads.torque[s]).norm(), small * edge);
				const auto nodal = onEightNodes(s ? cells1 : cells0, b.nodal[s]);
				for (int n = 0; n < nodeCount; ++n)
					EXPECT_LT((nodal[n] - a.nodal[s][n]).norm(), small);
			}
		}
}

// The forces on the nodes are those of a potential: minus the gradient of the springs' energy in the displacements of all nodes.
TEST(RefinedJoint, nodal_forces_are_the_gradient_of_the_energy)
{
	pairs::Random random(3);
	Pair          pair = Pair::stacked(4, 2, { .3 * edge, 0 });
	for (Surface* surface : { &pair.first, &pair.second })
		for (auto& u : surface->displacement)
			u = random.vector(1e-5);
	const auto a = pair.step();
	Real       F = 0;
	for (const auto& f : a.nodal[0])
		F = std::max(F, f.norm());
	constexpr Real step = 1e-8;
	for (int s = 0; s < 2; ++s)
		for (std::size_t node = 0; node < a.nodal[s].size(); ++node)
			for (int i = 0; i < 3; ++i) {
				Real energy[2];
				for (int sign = 0; sign < 2; ++sign) {
					Pair moved = pair;
					(s ? moved.second : moved.first).displacement[node][i] += sign ? step : -step;
					energy[sign] = jointEnergy(moved.joint, moved.motion(), 0);
				}
				// energies of 1e-2 J keep 1e-15 of them, over 2e-8 m
				EXPECT_NEAR(a.nodal[s][node][i], (energy[0] - energy[1]) / (2 * step), 1e-6 * F);
			}
	EXPECT_LT((a.loads.torque[0] + a.loads.torque[1] - a.loads.forceOn(0).cross(-pair.motion().offset)).norm(), roundOff * F * edge);
}

// One node in the middle of a face bulges by just enough, or just not: its four cells tear where they open most, which the shortcut has to notice.
TEST(RefinedJoint, a_bulge_between_the_corners_tears_where_it_is)
{
	const Real     opens = pairs::tensile / pairs::knThin; // of a segment
	const Real     share = (1 - .5 / 4) * (1 - .5 / 4);    // of the bulge at the middle of the nearest segment: four of them to a cell's edge
	for (const Real bulge : { .999 * opens / share, 1.001 * opens / share }) {
		Pair      pair = Pair::stacked(2, 2, Vector2r::Zero(), { pairs::tensile, pairs::cohesive, pairs::friction, pairs::crush, 9 });
		const int node = surfaceGrid(2).faceNode(below, 1, 1);
		pair.second.displacement[node][2] += bulge;
		const auto a = pair.step();
		if (bulge < opens / share) {
			EXPECT_EQ(a.failures.total(), 0);
			EXPECT_TRUE(pair.joint.segments.empty());
			continue;
		}
		EXPECT_EQ(a.failures.tension, 4);
		for (int s = 0; s < pair.joint.count(); ++s) {
			const JointSegment segment = segmentOf(pair.joint, s);
			const Vector3r     x       = pair.joint.shape->patches[segment.patch].sides[0].corners.transpose() * cornerWeights(segment.p, segment.q);
			EXPECT_EQ(segment.state != SegmentState::Intact, std::max(std::abs(x[0]), std::abs(x[1])) < edge / 8) << x.transpose();
		}
		EXPECT_EQ(overloaded(Pair::stacked(2, 2).joint, pair.motion()).total(), 0); // unbreakable
	}
}

TEST(RefinedJoint, contact_takes_over_the_shear_of_each_patch)
{
	Pair pair = Pair::stacked(2, 2, Vector2r::Zero(), { 1, 1, pairs::friction, 1, 9 });
	pair.second.displacement[surfaceGrid(2).faceNode(below, 1, 1)] += Vector3r(1e-7, 0, 0);
	pair.second.body.placement.position[2] -= 1e-6;
	while (pair.joint.intact() > 0)
		ASSERT_GT(pair.step().failures.total(), 0);
	const auto memory = tractionsOfJoint(pair.joint, pair.motion(), pairs::friction, pair.first.side(), pair.second.side());
	ASSERT_EQ(memory.size(), 128u);
	for (int s = 0; s < pair.joint.count(); ++s) {
		const JointSegment segment = segmentOf(pair.joint, s);
		const Vector3r     x       = pair.joint.shape->patches[segment.patch].sides[0].corners.transpose() * cornerWeights(segment.p, segment.q);
		const Vector2r     natural = pair.first.body.solid.faces[above].coordinates(x);
		const int          number  = int(4 * (natural[1] + 1)) * 8 + int(4 * (natural[0] + 1));
		const auto         found   = std::find(memory.keys.begin(), memory.keys.end(), contactKey(0, above, below, number));
		ASSERT_NE(found, memory.keys.end());
		const Vector3r expected = segmentTraction(pair.joint, s, pair.motion(), pairs::friction).shear;
		EXPECT_LT((memory.tractions[found - memory.keys.begin()] - expected).norm(), roundOff * pairs::ksThin * 1e-7);
	}
}
