// SPDX-License-Identifier: GPL-2.0-or-later
// A mortar joint: the overlap of two faces that touched at the start, cut into segments, each with a restoring spring that can fail
// and is then replaced, for good, by a contact spring and dashpot.                       [Furukawa2014, sections 2.1-2.4, eqs. (5)-(9)]
//
// Everything is computed in world axes, from the position of side 0. A point of the overlap is a material point of both faces, x0 and x1; d = x1 - x0 is split along the mean
// normal n of both faces (it turns with the mean of the two rotations, which makes the springs conservative when the force acts half way between the points; a
// common point keeps linear and angular momentum to round-off). JointSegments.hpp has the law of a segment.
//
// The overlap of two faces lies in a rectangle (p, q) in [0,1]^2, of whose corners the faces' displacements are taken; between them they are bilinear. That is the
// faces' own field whenever the rectangle lies along the edges of both faces; otherwise an interpolation of it that is exact for every rigid motion and uniform
// strain. Where a surface has several cells a face (SurfaceGrid.hpp), each pair of cells that overlap is a patch of the joint, with such a rectangle.
//
// **While a joint holds, its segments are not looked at**: d is bilinear over the rectangle and each failure criterion is convex in d, so when none is met at the
// outermost segments, none is met anywhere; and the force of all segments together is a constant matrix (`weight`) times d at the corners. This is the sum over
// the segments to round-off, at a cost that does not depend on their number; arrays of segments are made when the first one fails.
//
// A segment is seen at its middle only, so a last row of segments that hold would be a hinge: the bricks turn about it and sink into each other beside it, and when
// it fails contact meets that overlap at once, which is energy from nothing. So in a joint that has cracked a segment fails in tension when its edge opens beyond the
// strength, by the angle between the two faces. Where a joint cracks first is the paper's rule alone; only one that is a single segment wide, and so a hinge from the
// start, fails when its edges differ from its middle by ten times what tears it (its bending is otherwise not felt, as in the paper).
#pragma once

#include "JointSegments.hpp"
#include "Placement.hpp"

#include <memory>
#include <optional>

namespace brick {

/// A value at each of the four corners of a joint's rectangle, a row each: (p, q) = (0,0), (1,0), (1,1), (0,1).
using CornerVectors = Eigen::Matrix<Real, 4, 3>;
using CornerWeights = Eigen::Matrix<Real, 4, 4>;

/// Bilinear weights of a rectangle's corners.
inline Vector4r cornerWeights(Real p, Real q) { return { (1 - p) * (1 - q), p * (1 - q), p * q, (1 - p) * q }; }

/// Segments that failed, by mode.
struct Failures {
	int tension = 0, shear = 0, compression = 0;
	int total() const { return tension + shear + compression; }
};

/// A face that a joint is at.
struct JointFace {
	int      face = -1;                   ///< of the brick; -1 on a support
	Vector3r normal { Vector3r::Zero() }; ///< outward, body axes
};

/// Where a patch lies on one of the two bodies.
struct PatchSide {
	std::array<int, 4> nodes { -1, -1, -1, -1 };          ///< of the surface; -1 on a support, whose points do not move against it
	CornerVectors      corners { CornerVectors::Zero() }; ///< of the rectangle at rest, body axes [m]; of the second face: moved to where the joint is restGap wide
	CornerWeights      weights { CornerWeights::Zero() }; ///< of the nodes (columns) at the corners (rows)
};

/// One segment of a joint.
struct JointSegment {
	int          patch = 0;
	Real         p = 0, q = 0; ///< in the patch's rectangle
	Real         area  = 0;    ///< [m2]
	SegmentState state = SegmentState::Intact;
};

/// The overlap of two cells.
struct JointPatch {
	std::array<PatchSide, 2>  sides;
	std::array<int, 2>        rows { 1, 1 };                    ///< of segments, along p and q
	int                       count = 0;                        ///< segments
	std::vector<JointSegment> cut;                              ///< the segments; empty when they are a whole grid
	CornerWeights             outermost { CornerWeights::Zero() }; ///< weights of the corners (columns) at the four outermost places of segments (rows)
	CornerWeights             weight { CornerWeights::Zero() }; ///< sum over the segments of area times N N^T, N the bilinear weights of the corners [m2]
	Vector4r                  cornerAreas { Vector4r::Zero() };     ///< sums of its rows [m2]
};

/// What does not change in a joint; joints alike share it.
struct JointShape {
	std::array<JointFace, 2> faces;
	MortarStrength           strength;
	PairSprings              pair;                       ///< of contact once all segments have failed; its friction is that of segments that have
	Vector3r                 along { Vector3r::Zero() }; ///< unit vector along p, body axes of side 0
	std::array<int, 2>       rows { 1, 1 };              ///< of segments over the whole joint, along p and q
	int                      count = 0;                  ///< segments
	Real                     area  = 0;                  ///< [m2]
	std::vector<JointPatch>  patches;                    ///< their segments are numbered one patch after the other
};

struct Joint {
	std::shared_ptr<JointShape> shape;       ///< null when there is no joint; not to be written to
	SpotSprings                 springs;     ///< by the contact lengths that the bricks have at present: see PairSprings::at
	std::vector<JointSegments>  segments;    ///< of each patch; empty as long as all hold
	Failures                    failures;    ///< so far
	Real                        restGap = 0; ///< distance of the faces, at the centre of one, when they were joined [m]; taken as closed

	bool exists() const { return bool(shape); }
	int  count() const { return shape ? shape->count : 0; }      ///< segments
	int  intact() const { return count() - failures.total(); }   ///< segments that hold
	bool holds() const { return failures.total() == 0; }
	Real area() const { return shape->area; } ///< [m2]
	/// Gives the joint, alone, other springs and strength.
	void setMortar(const SpotSprings&, const MortarStrength&, const PairSprings& = {});
};
/// Patch of a segment, whose number becomes that within the patch.
int          takePatch(const Joint&, int& index);
JointSegment segmentOf(const Joint&, int index);

/// Whether two joints could share a shape: lengths differ by round-off only.
/// @param tolerance of lengths [m]
bool alike(const JointShape&, const JointShape&, Real tolerance);

/// Lays the segments out in arrays, if they are not yet.
void makeSegments(Joint&);

/// Joint of two faces if they touch: normals opposite within `angleTolerance` [rad], planes within `tolerance` [m], overlapping.
/// Segments are cells of a grid along a brick's face edges that are as large as the smaller segments of the two faces; cells at the
/// border are cut to the overlap. Allocates; for set-up.
std::optional<Joint> joinFaces(const Side& side0, int face0, const Side& side1, int face1, Real tolerance, Real angleTolerance = 1e-3);

/// A patch as it is placed, world axes.
struct PatchMotion {
	CornerVectors place;   ///< of side 0's corners, from its position [m]
	CornerVectors opening; ///< of side 1's corners, from side 0's [m]
};

/// One of something for each patch; in one piece when there is one.
template <class Value> using OfPatches = boost::container::small_vector<Value, 1>;

/// A joint as it is placed, world axes.
struct JointMotion {
	OfPatches<PatchMotion> patches;
	Vector3r               normal { Vector3r::Zero() }; ///< from side 0 to side 1
	Vector3r               along { Vector3r::Zero() };  ///< p, as side 0 has turned
	Vector3r               offset { Vector3r::Zero() }; ///< position of side 1, from that of side 0 [m]

	Vector3r middle(const JointSegment&) const; ///< of the joint, from side 0's position [m]
	Real     meanOpening() const;               ///< along the normal, at the corners of the patches [m]
};
void jointMotion(const Joint&, const Placement& side0, const Placement& side1, JointMotion&);

/// Sums over an interaction, for its reader; forces act on side 1, world axes.
struct PairSummary {
	Vector3r normalForce { Vector3r::Zero() }, shearForce { Vector3r::Zero() };
	Vector3r point { Vector3r::Zero() };  ///< middle of the joint or contact, relative to side 0's position, world axes
	Vector3r normal { Vector3r::Zero() }; ///< from side 0 to side 1
	Real     kn = 0, ks = 0;              ///< sums over the area [N/m]
	Real     area        = 0;             ///< [m2]
	Real     penetration = 0;             ///< largest [m]
};

/// What a joint does to its bodies, world axes.
struct JointLoads {
	OfPatches<CornerVectors> forces; ///< of each patch on side 0, at the corners; side 1 takes the opposite [N]
	std::array<Vector3r, 2>  torque; ///< about the bodies' positions [N m]

	Vector3r forceOn(int side) const; ///< [N]
};

/// The two bodies of a joint.
struct JointPlacements {
	Placement side0, side1;
};

class JointLedger; // PairLedger.hpp

/// Forces of all segments on both sides, failure, friction. Writes segments; allocates when the first one fails.
/// @param moving where the bodies are and how they move, for the dashpots of failed segments; may be null while all hold, and without dashpots
/// @param ledger of energy; null: none is kept
Failures jointLoads(
        Joint&,
        const JointMotion&,
        const JointPlacements* moving,
        Real                   tanFriction,
        JointLoads&            loads,
        PairSummary&,
        JointLedger*    ledger = nullptr,
        const LawTerms& terms  = {});

/// Adds what a joint does to the nodes of the surface of one of its bodies, body axes [N].
void addNodalForces(const Joint&, const JointLoads&, int side, const Matrix3r& rotation, Vector3r* nodal);

/// Normal stress (tension positive) and shear stress vector (world axes, on side 0) on one segment, dashpots left out [Pa].
struct SegmentTraction {
	Real     normal;
	Vector3r shear;
};
SegmentTraction segmentTraction(const Joint&, int segment, const JointMotion&, Real tanFriction);

/// How far side 1 has moved from side 0 at the middle of a segment since they were joined, world axes [m].
Vector3r segmentOpening(const Joint&, int segment, const JointMotion&);

/// Corners of a segment midway between the two sides, in turn, from side 0's position, world axes [m]. For one that the border of the overlap cuts: a rectangle
/// of the same middle and area.
std::array<Vector3r, 4> segmentOutline(const Joint&, int segment, const JointMotion&);

/// How much more than its middle an edge of a patch's segment opens, by the angle between the faces [m]; zero where the joint is no hinge.
Real edgeOpening(const Joint&, const JointMotion&, int patch);

/// Segments of a joint that holds which this opening is too much for.
Failures overloaded(const Joint&, const JointMotion&);

/// Elastic energy of the springs of all segments [J].
Real jointEnergy(const Joint&, const JointMotion&, Real tanFriction);

} // namespace brick
