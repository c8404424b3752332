// SPDX-License-Identifier: GPL-2.0-or-later
// A mortar joint: the overlap of two faces that touched at the start, cut into segments, each with a restoring spring that can fail
// and is then replaced, for good, by a contact spring and dashpot.                       [Furukawa2014, sections 2.1-2.4, eqs. (5)-(9)]
//
// Everything is computed in the frame of side 0. Segment s joins two material points, x0 and x1; d = x1 - x0 is split along the mean
// normal n of both faces (it turns with the mean of the two rotations, which makes the springs conservative when the force acts half
// way between the points; a common point keeps linear and angular momentum to round-off):
//     un = d.n  (> 0 open),  ut = d - un n
//     intact   sigma = kn un,  tau = ks ut
//     failed   sigma = min(0, kn un + cn un'),  tau = ks (ut - slip) + cs ut',  |tau| <= |sigma| tan(phi)
// slip is the plastic part of ut: it follows ut while the segment is open or slides.
//
// A segment is seen at its middle only, so a last row of segments that hold would be a hinge: the bricks turn about it and sink into each other beside it, and when
// it fails contact meets that overlap at once, which is energy from nothing. So in a joint that has cracked a segment fails in tension when its edge opens beyond the
// strength, by the angle between the two faces. Where a joint cracks first is the paper's rule alone; only one that is a single segment wide, and so a hinge from the
// start, fails when its edges differ from its middle by ten times what tears it (its bending is otherwise not felt, as in the paper).
#pragma once

#include "MortarLaw.hpp"
#include "Placement.hpp"
#include "Springs.hpp"

#include <optional>
#include <vector>

namespace brick {

struct JointSegment {
	std::array<Vector4r, 2> weights;   ///< of the face's nodes on both sides
	Real                    area  = 0; ///< [m2]
	SegmentState            state = SegmentState::Intact;
	Vector3r                slip { Vector3r::Zero() }; ///< frame of side 0 [m]; zero while intact
};

struct JointFace {
	int                     face = -1;                ///< of the brick; -1 on a support
	std::array<int, 4>      nodes { -1, -1, -1, -1 }; ///< -1 on a support, whose points do not move against it
	std::array<Vector3r, 4> corners;                  ///< at rest, body axes [m]; of the second face: moved to where every segment is restGap wide
	Vector3r                normal;                   ///< outward, body axes
};

struct Joint {
	std::array<JointFace, 2>  faces;
	std::vector<JointSegment> segments;
	SpotSprings               springs;
	MortarStrength            strength;
	std::array<Vector3r, 2>   halves;        ///< half the edges of a segment that is not cut, frame of side 0 at rest [m]
	std::array<int, 2>        rows { 1, 1 }; ///< of segments, along these edges
	Real                      restGap = 0;   ///< distance of the faces, at the centre of one, when they were joined [m]; taken as closed
	int                       intact  = 0;   ///< segments that hold
	bool                      exists() const { return !segments.empty(); }
};

/// Joint of two faces if they touch: normals opposite within `angleTolerance` [rad], planes within `tolerance` [m], overlapping.
/// Segments are cells of a grid along the first side's face edges that are as large as the smaller segments of the two faces; cells at the
/// border are cut to the overlap. Allocates; for set-up.
std::optional<Joint> joinFaces(const Side& side0, int face0, const Side& side1, int face1, Real tolerance, Real angleTolerance = 1e-3);

/// The eight face nodes of a joint in the frame of side 0.
struct JointMotion {
	std::array<std::array<Vector3r, 4>, 2> positions;  ///< relative to side 0's position [m]
	std::array<std::array<Vector3r, 4>, 2> velocities; ///< relative to side 0's, only when some segment has failed [m/s]
	Vector3r                               normal;     ///< from side 0 to side 1
	Matrix3r                               turn;       ///< axes of side 1 to axes of side 0
	Vector3r                               offset;     ///< position of side 1 [m]
};
JointMotion jointMotion(const Joint&, const Placement& side0, const Placement& side1);

/// Sums over an interaction, for its reader; forces act on side 1, world axes.
struct PairSummary {
	Vector3r normalForce { Vector3r::Zero() }, shearForce { Vector3r::Zero() };
	Vector3r point { Vector3r::Zero() };  ///< middle of the joint or contact, relative to side 0's position, world axes
	Vector3r normal { Vector3r::Zero() }; ///< from side 0 to side 1
	Real     kn = 0, ks = 0;              ///< sums over the area [N/m]
	Real     area        = 0;             ///< [m2]
	Real     penetration = 0;             ///< largest [m]
};

/// Segments that failed in one step, by mode.
struct Failures {
	int tension = 0, shear = 0, compression = 0;
	int total() const { return tension + shear + compression; }
};

/// Tractions of all segments, failure, friction; forces on both sides. Writes the loads and the segments' state and slip.
Failures jointLoads(Joint&, const JointMotion&, const PairSprings&, const Matrix3r& rotation0, std::array<Loads, 2>& loads, PairSummary&);

/// Normal stress (tension positive) and shear stress vector (frame of side 0) on one segment, dashpots left out [Pa].
struct SegmentTraction {
	Real     normal;
	Vector3r shear;
};
SegmentTraction segmentTraction(const Joint&, const JointSegment&, const JointMotion&, Real tanFriction);

/// How much more than its middle an edge of a segment opens, by the angle between the faces [m]; zero where the joint is no hinge.
Real edgeOpening(const Joint&, const JointMotion&);

/// The mode in which an intact segment fails.
/// @param opening of its middle, un [m]   @param shear traction [Pa]   @param edge see edgeOpening
SegmentState segmentFailure(const Joint&, Real opening, Real shear, Real edge);

/// Elastic energy of the springs of all segments [J].
Real jointEnergy(const Joint&, const JointMotion&, Real tanFriction);

} // namespace brick
