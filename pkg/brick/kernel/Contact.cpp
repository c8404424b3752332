// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of the spots that findContact has found (ContactSearch.cpp).
#include "Contact.hpp"

#include <algorithm>
#include <limits>

namespace brick {

namespace {

	/// The tractions of the step before, spot by spot; zero where there was none.
	void recall(const ContactMemory& memory, const std::vector<ContactSpot>& spots, ContactMemory& out)
	{
		out.keys.resize(spots.size());
		out.tractions.resize(spots.size());
		std::size_t cursor = 0;
		for (std::size_t i = 0; i < spots.size(); ++i) {
			const int key = spots[i].key;
			while (cursor < memory.size() && memory.keys[cursor] < key)
				++cursor;
			out.keys[i] = key;
			if (cursor < memory.size() && memory.keys[cursor] == key) out.tractions[i] = memory.tractions[cursor];
			else
				out.tractions[i].setZero();
		}
	}

	void clear(Loads& loads, int cells)
	{
		loads.force.setZero(), loads.torque.setZero();
		loads.nodal.assign(surfaceGrid(cells).size(), Vector3r(Vector3r::Zero()));
	}

	/// Null where a face is a single cell.
	const SurfaceGrid* cellsOf(const Side& side) { return side.cells > 1 ? &surfaceGrid(side.cells) : nullptr; }

} // namespace

} // namespace brick

#define BRICK_LANES_FILE "ContactLanes.hpp"
#include "ForEachInstructionSet.hpp"

namespace brick {

SpotSprings springsOf(const ContactSpot& spot, const Side& side0, const Side& side1, const PairSprings& pair)
{
	const int face0 = spot.owner == 0 ? spot.ownerFace : spot.otherFace, face1 = spot.owner == 0 ? spot.otherFace : spot.ownerFace;
	return pair.at((*side0.contactLength)[face0], (*side1.contactLength)[face1]);
}

void contactLoads(
        const Side&                     side0,
        const Side&                     side1,
        const std::vector<ContactSpot>& spots,
        const PairSprings&              pair,
        Real                            dt,
        ContactMemory&                  memory,
        ContactMemory&                  scratch,
        std::array<Loads, 2>&           loads,
        PairSummary&                    sum,
        const LawTerms&                 terms)
{
	clear(loads[0], side0.cells), clear(loads[1], side1.cells);
	if (terms.friction) {
		recall(memory, spots, scratch);
		std::swap(memory, scratch);
	} else
		memory.clear();
	BRICK_BEST_INSTRUCTION_SET(addLoads)(side0, side1, spots, pair, dt, terms, memory.tractions.data(), loads, sum);
	sum.shearForce = loads[1].force - sum.normalForce;
	if (sum.area > 0) sum.point /= sum.area;
	if (sum.normal.norm() > 0) sum.normal.normalize();
}

Real pressedDepth(const ContactSpot& spot, const Side& other)
{
	const Face& face = other.solid->faces[spot.otherFace];
	Real        top  = face.offset;
	if (other.placement.displacement) {
		const SurfaceSpot at = surfaceGrid(other.cells).locate(spot.otherFace, spot.otherNatural[0], spot.otherNatural[1]);
		for (int a = 0; a < 4; ++a)
			top += at.weights[a] * face.normal.dot(other.placement.displacement[at.nodes[a]]);
	}
	return top - face.normal.dot(spot.position);
}

Real contactEnergy(const Side& side0, const Side& side1, const std::vector<ContactSpot>& spots, const PairSprings& pair, const ContactMemory& memory)
{
	ContactMemory recalled;
	recall(memory, spots, recalled);
	Real energy = 0;
	for (std::size_t i = 0; i < spots.size(); ++i) {
		const SpotSprings k = springsOf(spots[i], side0, side1, pair);
		const Real depth = pressedDepth(spots[i], spots[i].owner == 0 ? side1 : side0);
		energy += spots[i].area / 2 * (k.normal * spots[i].penetration * depth + recalled.tractions[i].squaredNorm() / k.shear);
	}
	return energy;
}

namespace {

	/// Number of a joint's face; a support's is told by its normal.
	int faceNumber(const JointFace& jointFace, const Hexahedron& solid)
	{
		int face = 0;
		while (jointFace.face < 0 && face + 1 < faceCount && solid.faces[face].normal != jointFace.normal)
			++face;
		return jointFace.face < 0 ? face : jointFace.face;
	}

} // namespace

namespace {

	/// Shear stress on side 0 of the joint's segment nearest to a point of side s, body axes; of segments equally near the mean, so that round-off does not choose.
	Vector3r nearestShear(const Joint& joint, const JointMotion& motion, Real tanFriction, int s, const Vector3r& point, Real roundOff)
	{
		const auto distance = [&](int i) {
			const JointSegment segment = segmentOf(joint, i);
			return (joint.shape->patches[segment.patch].sides[s].corners.transpose() * cornerWeights(segment.p, segment.q) - point).norm();
		};
		Real least = std::numeric_limits<Real>::infinity();
		for (int i = 0; i < joint.count(); ++i)
			least = std::min(least, distance(i));
		Vector3r sum   = Vector3r::Zero();
		int      count = 0;
		for (int i = 0; i < joint.count(); ++i)
			if (distance(i) <= least + roundOff) sum += segmentTraction(joint, i, motion, tanFriction).shear, ++count;
		return sum / count;
	}

} // namespace

ContactMemory tractionsOfJoint(const Joint& joint, const JointMotion& motion, Real tanFriction, const Side& side0, const Side& side1)
{
	constexpr Real                   roundOff = 1e-6; // of a segment
	ContactMemory                    memory;
	const std::array<const Side*, 2> sides { &side0, &side1 };
	for (int s = 0; s < 2; ++s) {
		if (sides[s]->support) continue;
		const JointFace& jointFace = joint.shape->faces[s];
		const Face&      face      = sides[s]->solid->faces[jointFace.face];
		const int        n = sides[s]->segments, otherFace = faceNumber(joint.shape->faces[!s], *sides[!s]->solid);
		for (int cell = 0; cell < n * n; ++cell) {
			// a cell that the joint does not reach will find no partner and forget it
			const Vector3r centre  = face.at((2. * (cell % n) + 1) / n - 1, (2. * (cell / n) + 1) / n - 1);
			const Vector3r onSide0 = nearestShear(joint, motion, tanFriction, s, centre, roundOff * std::sqrt(face.area) / n);
			memory.keys.push_back(contactKey(s, jointFace.face, otherFace, cell));
			memory.tractions.push_back((s == 0 ? 1 : -1) * (sides[s]->placement.rotation.transpose() * onSide0));
		}
	}
	return memory;
}

} // namespace brick
