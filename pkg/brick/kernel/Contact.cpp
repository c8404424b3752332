// SPDX-License-Identifier: GPL-2.0-or-later
#include "Contact.hpp"

#include "ClippedPolygon.hpp"

#include <algorithm>
#include <cmath>

namespace brick {

namespace {

	// vertex: place in the other body's frame, natural coordinates on the owner's face, height over each face of the other body
	constexpr int naturalEntry = 3, heightEntry = 5;
	using Patch   = ClippedPolygon<11, 2 * faceCount>;
	using Heights = Eigen::Matrix<Real, faceCount, 1>;

	/// Where a segment can press on several faces of the other body, it is divided into the parts nearest to each, unless it is nearly perpendicular to one:
	/// that one's part would press with the square of this cosine, and stacked bricks that lean a little would have the segments at their rims divided for nothing.
	constexpr Real leastCosine = .02;

	int keyOf(int owner, int face, int segment, int otherFace)
	{
		return ((owner * faceCount + face) * largestSegments * largestSegments + segment) * faceCount + otherFace;
	}

	/// The owner's corners in the other body's frame, and the planes of that body.
	class View {
	public:
		View(const Side& owner, const Side& other)
		        : owner(owner)
		        , other(other)
		        , turn(other.placement.rotation.transpose() * owner.placement.rotation)
		{
			const Vector3r offset = other.placement.rotation.transpose() * (owner.placement.position - other.placement.position);
			for (int a = 0; a < nodeCount; ++a) {
				Vector3r x = owner.solid->corners[a];
				if (owner.placement.displacement) x += owner.placement.displacement[a];
				corners[a] = offset + turn * x;
			}
			for (int f = 0; f < faceCount; ++f) {
				const Face& face = other.solid->faces[f];
				meanOffset[f] = highestOffset[f] = face.offset;
				if (!other.placement.displacement) continue;
				for (int a = 0; a < 4; ++a)
					faceBulge[f][a] = face.normal.dot(other.placement.displacement[faceNodes[f][a]]);
				meanOffset[f] += faceBulge[f].mean();
				highestOffset[f] += faceBulge[f].maxCoeff();
			}
		}

		/// Some face of the other body has all corners of the owner outside.
		bool apart() const
		{
			for (int f = 0; f < faceCount; ++f) {
				bool outside = true;
				for (int a = 0; a < nodeCount && outside; ++a)
					outside = other.solid->faces[f].normal.dot(corners[a]) >= highestOffset[f];
				if (outside) return true;
			}
			return false;
		}

		/// How far the surface of a deformed face stands above its mean plane, near a point.
		Real bulge(int f, const Vector3r& x) const
		{
			const Face&    target  = other.solid->faces[f];
			const Vector2r natural = target.coordinates(x);
			const Vector4r weights = bilinear(natural[0], natural[1]);
			Real           out     = target.offset - meanOffset[f];
			for (int a = 0; a < 4; ++a)
				out += weights[a] * faceBulge[f][a];
			return out;
		}

		const Side &                owner, &other;
		const Matrix3r              turn; ///< owner's axes to the other body's
		Nodes                       corners;
		std::array<Real, faceCount> meanOffset, highestOffset;
		Vector4r                    faceBulge[faceCount]; ///< of the corners of each face along its normal; only of deformable bodies
	};

	/// One face of the owner against the other body.
	class FaceSearch {
	public:
		FaceSearch(const View& view, int ownerIndex, int face, Real weight)
		        : view(view)
		        , ownerIndex(ownerIndex)
		        , face(face)
		        , weight(weight)
		{
			const Vector3r normal = view.turn * view.owner.solid->faces[face].normal;
			for (int f = 0; f < faceCount; ++f) {
				const Face& target = view.other.solid->faces[f];
				cosine[f]          = -normal.dot(target.normal);
				for (int a = 0; a < 4; ++a)
					cornerHeights[a][f] = target.normal.dot(view.corners[faceNodes[face][a]]) - view.meanOffset[f];
			}
		}

		void run(std::vector<ContactSpot>& spots)
		{
			if (!canTouch()) return;
			const int n = view.owner.segments;
			// two rows of grid vertices at a time
			std::array<std::array<Patch::Vertex, largestSegments + 1>, 2> rows;
			fillRow(0, rows[0]);
			for (int row = 0; row < n; ++row) {
				auto &below = rows[row % 2], &above = rows[(row + 1) % 2];
				fillRow(row + 1, above);
				for (int column = 0; column < n; ++column)
					addSpot(row * n + column, below[column], below[column + 1], above[column + 1], above[column], spots);
			}
		}

	private:
		/// Cheap refusal, by the corners alone: entirely beyond a face of the other body, or everywhere nearer to a face that it cannot press on.
		/// Finds out which faces could be the nearest, whose bulging matters.
		bool canTouch()
		{
			constexpr Real unbounded = std::numeric_limits<Real>::infinity();
			Heights        least, most;
			for (int f = 0; f < faceCount; ++f) {
				Real lowest = unbounded, highest = -unbounded;
				for (int a = 0; a < 4; ++a)
					lowest = std::min(lowest, cornerHeights[a][f]), highest = std::max(highest, cornerHeights[a][f]);
				const Real bulging = view.highestOffset[f] - view.meanOffset[f];
				least[f] = -highest, most[f] = bulging - lowest; // depths
				if (most[f] <= 0) return false;
			}
			Real shallowestTouchable = unbounded, deepestElsewhere = unbounded;
			for (int f = 0; f < faceCount; ++f)
				if (cosine[f] > 0) shallowestTouchable = std::min(shallowestTouchable, least[f]);
				else
					deepestElsewhere = std::min(deepestElsewhere, most[f]);
			if (shallowestTouchable > deepestElsewhere) return false;
			for (int f = 0; f < faceCount; ++f)
				bulges[f] = view.other.placement.displacement && cosine[f] > 0 && least[f] <= most.minCoeff();
			return true;
		}

		void fillRow(int row, std::array<Patch::Vertex, largestSegments + 1>& out) const
		{
			const int n = view.owner.segments;
			for (int column = 0; column <= n; ++column) {
				const Real     xi = 2. * column / n - 1, eta = 2. * row / n - 1;
				const Vector4r w       = bilinear(xi, eta);
				Vector3r       x       = Vector3r::Zero();
				Heights        heights = Heights::Zero();
				for (int a = 0; a < 4; ++a)
					x += w[a] * view.corners[faceNodes[face][a]], heights += w[a] * cornerHeights[a];
				for (int f = 0; f < faceCount; ++f)
					if (bulges[f]) heights[f] -= view.bulge(f, x);
				out[column] << x, xi, eta, heights;
			}
		}

		void
		addSpot(int                       segment,
		        const Patch::Vertex&      a,
		        const Patch::Vertex&      b,
		        const Patch::Vertex&      c,
		        const Patch::Vertex&      d,
		        std::vector<ContactSpot>& spots) const
		{
			const Heights highest = a.tail<faceCount>().cwiseMax(b.tail<faceCount>()).cwiseMax(c.tail<faceCount>()).cwiseMax(d.tail<faceCount>());
			const Heights lowest  = a.tail<faceCount>().cwiseMin(b.tail<faceCount>()).cwiseMin(c.tail<faceCount>()).cwiseMin(d.tail<faceCount>());
			if (lowest.maxCoeff() >= 0) return;
			Patch patch(a, b, c, d);
			for (int f = 0; f < faceCount && !patch.empty(); ++f)
				if (highest[f] >= 0) patch.keepNegative(heightEntry + f);
			if (patch.empty()) return;
			std::array<int, faceCount> nearest;
			const int                  count = nearestFaces(lowest, highest, nearest);
			if (count < 2) {
				addPart(segment, patch, anyFace, spots);
				return;
			}
			for (int i = 0; i < count; ++i) {
				Patch part = patch;
				for (int j = 0; j < count && !part.empty(); ++j)
					if (j != i) part.keepAbove(heightEntry + nearest[i], heightEntry + nearest[j]);
				if (!part.empty()) addPart(segment, part, nearest[i], spots);
			}
		}

		/// The faces of the other body that can be pressed on and could be the nearest to some part of a segment, from its corners' heights.
		int nearestFaces(const Heights& lowest, const Heights& highest, std::array<int, faceCount>& out) const
		{
			const Real least = lowest.maxCoeff();
			int        count = 0;
			for (int f = 0; f < faceCount; ++f)
				if (cosine[f] > leastCosine && highest[f] > least) out[count++] = f;
			return count;
		}

		/// @param expected the nearest face, otherwise there is no spot; or anyFace
		void addPart(int segment, const Patch& patch, int expected, std::vector<ContactSpot>& spots) const
		{
			Patch::Vertex centre;
			const Real    area = patch.areaAndCentroid(centre);
			int           nearest;
			const Real    penetration = -centre.tail<faceCount>().maxCoeff(&nearest);
			if (!(area > 0) || !(penetration > 0) || cosine[nearest] <= 0) return;
			if (expected != anyFace && nearest != expected) return;

			ContactSpot spot;
			spot.key              = keyOf(ownerIndex, face, segment, nearest);
			spot.owner            = ownerIndex;
			spot.ownerFace        = face;
			spot.otherFace        = nearest;
			spot.position         = centre.head<3>();
			const Face&    target = view.other.solid->faces[nearest];
			const Vector2r at     = target.coordinates(spot.position);
			spot.ownerWeights     = bilinear(centre[naturalEntry], centre[naturalEntry + 1]);
			spot.otherWeights     = bilinear(at[0], at[1]);
			spot.normal           = target.normal;
			spot.penetration      = penetration;
			spot.area             = weight * cosine[nearest] * area;
			spots.push_back(spot);
		}

		static constexpr int anyFace = -1;

		const View&                 view;
		int                         ownerIndex, face;
		Real                        weight;
		Heights                     cosine;           ///< between the owner's inward normal and the outward normal of each face of the other body
		Heights                     cornerHeights[4]; ///< over the mean planes of the other body's faces
		std::array<bool, faceCount> bulges;           ///< faces of the other body whose bulging matters
	};

	void searchSide(const View& view, int ownerIndex, Real weight, std::vector<ContactSpot>& spots)
	{
		if (view.owner.support) return;
		for (int face = 0; face < faceCount; ++face)
			FaceSearch(view, ownerIndex, face, weight).run(spots);
	}

} // namespace

void findContact(const Side& side0, const Side& side1, std::vector<ContactSpot>& spots)
{
	spots.clear();
	const View view0(side0, side1), view1(side1, side0);
	if (view0.apart() || view1.apart()) return;
	const Real weight = side0.support || side1.support ? 1 : .5;
	searchSide(view0, 0, weight, spots);
	searchSide(view1, 1, weight, spots);
}

namespace {

	/// Velocity of a point of a body, world axes; x from the body's position, world axes.
	Vector3r pointVelocity(const Placement& at, const Vector3r& x, int face, const Vector4r& weights)
	{
		Vector3r v = at.velocity + at.angularVelocity.cross(x);
		if (at.displacementRate) {
			Vector3r rate = Vector3r::Zero();
			for (int a = 0; a < 4; ++a)
				rate += weights[a] * at.displacementRate[faceNodes[face][a]];
			v += at.rotation * rate;
		}
		return v;
	}

	void addForce(Loads& loads, const Placement& at, const Vector3r& force, const Vector3r& x, int face, const Vector4r& weights)
	{
		loads.force += force;
		loads.torque += x.cross(force);
		const Vector3r local = at.rotation.transpose() * force;
		for (int a = 0; a < 4; ++a)
			loads.nodal[faceNodes[face][a]] += weights[a] * local;
	}

	Vector3r remembered(const ContactMemory& memory, std::size_t& cursor, int key)
	{
		while (cursor < memory.size() && memory.keys[cursor] < key)
			++cursor;
		return cursor < memory.size() && memory.keys[cursor] == key ? memory.tractions[cursor] : Vector3r(Vector3r::Zero());
	}

} // namespace

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
        PairSummary&                    sum)
{
	const std::array<const Side*, 2> sides { &side0, &side1 };
	loads = { Loads(), Loads() };
	scratch.clear();
	std::size_t cursor = 0;
	for (const auto& spot : spots) {
		const Side &      owner = *sides[spot.owner], &other = *sides[!spot.owner];
		const Placement & mine = owner.placement, &its = other.placement;
		const Vector3r    n       = its.rotation * spot.normal;
		const Vector3r    fromIts = its.rotation * spot.position, fromMine = fromIts + (its.position - mine.position);
		const SpotSprings k = springsOf(spot, side0, side1, pair);

		const Vector3r velocity
		        = pointVelocity(mine, fromMine, spot.ownerFace, spot.ownerWeights) - pointVelocity(its, fromIts, spot.otherFace, spot.otherWeights);
		const Real     leaving  = velocity.dot(n);
		const Vector3r sliding  = velocity - leaving * n;
		const Real     pressure = std::max(0., k.normal * spot.penetration - k.normalDashpot * leaving);

		Vector3r tau = mine.rotation * remembered(memory, cursor, spot.key);
		tau -= n * n.dot(tau);
		tau = limited(tau - k.shear * dt * sliding, pressure * pair.tanFriction);
		scratch.keys.push_back(spot.key);
		scratch.tractions.push_back(mine.rotation.transpose() * tau);
		const Vector3r shear = limited(tau - k.shearDashpot * sliding, pressure * pair.tanFriction);

		const Vector3r force = spot.area * (pressure * n + shear);
		addForce(loads[spot.owner], mine, force, fromMine, spot.ownerFace, spot.ownerWeights);
		addForce(loads[!spot.owner], its, -force, fromIts, spot.otherFace, spot.otherWeights);

		const Real towards1 = spot.owner == 0 ? -1 : 1; // of n
		sum.normal += towards1 * spot.area * n;
		sum.normalForce += towards1 * spot.area * pressure * n;
		sum.point += spot.area * (spot.owner == 0 ? fromMine : fromIts);
		sum.kn += spot.area * k.normal;
		sum.ks += spot.area * k.shear;
		sum.area += spot.area;
		sum.penetration = std::max(sum.penetration, spot.penetration);
	}
	std::swap(memory, scratch);
	sum.shearForce = loads[1].force - sum.normalForce;
	if (sum.area > 0) sum.point /= sum.area;
	if (sum.normal.norm() > 0) sum.normal.normalize();
}

Real contactEnergy(const Side& side0, const Side& side1, const std::vector<ContactSpot>& spots, const PairSprings& pair, const ContactMemory& memory)
{
	Real        energy = 0;
	std::size_t cursor = 0;
	for (const auto& spot : spots) {
		const SpotSprings k = springsOf(spot, side0, side1, pair);
		energy += spot.area / 2 * (k.normal * spot.penetration * spot.penetration + remembered(memory, cursor, spot.key).squaredNorm() / k.shear);
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

ContactMemory tractionsOfJoint(const Joint& joint, const JointMotion& motion, Real tanFriction, const Side& side0, const Side& side1)
{
	ContactMemory                    memory;
	const std::array<const Side*, 2> sides { &side0, &side1 };
	for (int s = 0; s < 2; ++s) {
		if (sides[s]->support) continue;
		const JointFace& jointFace = joint.faces[s];
		const Face&      face      = sides[s]->solid->faces[jointFace.face];
		const int        n = sides[s]->segments, otherFace = faceNumber(joint.faces[!s], *sides[!s]->solid);
		for (int cell = 0; cell < n * n; ++cell) {
			const Vector3r centre = face.at((2. * (cell % n) + 1) / n - 1, (2. * (cell / n) + 1) / n - 1);
			// nearest segment of the joint; a cell that the joint does not reach will find no partner and forget it
			int  nearest  = 0;
			Real distance = std::numeric_limits<Real>::infinity();
			for (int i = 0; i < joint.count; ++i) {
				const JointSegment segment = segmentOf(joint, i);
				const Vector3r     x       = jointFace.corners.transpose() * cornerWeights(segment.p, segment.q);
				if ((x - centre).squaredNorm() < distance) distance = (x - centre).squaredNorm(), nearest = i;
			}
			const Vector3r onSide0 = segmentTraction(joint, nearest, motion, tanFriction).shear;
			memory.keys.push_back(keyOf(s, jointFace.face, cell, otherFace));
			memory.tractions.push_back(s == 0 ? onSide0 : Vector3r(-(motion.turn.transpose() * onSide0)));
		}
	}
	return memory;
}

} // namespace brick
