// SPDX-License-Identifier: GPL-2.0-or-later
// Contact between any two bodies in any position.                                        [Furukawa2014, sections 2.2 (3) and 2.4, eqs. (4), (9)]
//
// Each segment of a face of one body (the owner) is cut to the part that lies inside the other body; this part is a spot of contact:
//   penetration  mean distance to the nearest face of the other body, along that face's normal; where an edge or a corner of the other body digs in, the
//                segment is divided into the parts that are nearest to each of its faces, a spot each
//   place        centre of pressure: where the force of a pressure acts that grows with this distance, so that work is done as if on the integral's own potential
//   area         of the part, times the cosine between the two faces, so that what counts is the footprint on the other body's face
// Both bodies own spots, each with half its weight, so that the order of the bodies does not matter (a support owns none, and a brick's spots on it
// count fully). The normal force of two flat faces is therefore the exact integral of penetration over their overlap for any number of segments, and
// it grows from zero when an edge or a corner comes first.
// Faces stand where their nodes are: the owner's segments are displaced with them, and the other's face bulges over its mean plane by the normal part of their
// displacement; bilinear over the face, or over each of its cells where the body is refined (SurfaceGrid.hpp; each segment lies in one cell).
//   sigma = kn penetration - cn vn >= 0,   tau from  tau' = -ks vt,  |tau| <= sigma tan(phi),  dashpot -cs vt within the same bound
// Without friction tau = 0, without dashpots cn = cs = 0. (LawTerms.hpp)
#pragma once

#include "Joint.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brick {

/// Most segments along an edge of a face.
constexpr int largestSegments = 64;

/// One spot of contact. Frame: body axes of the other body, origin at its position.
struct ContactSpot {
	int          key; ///< of owner, the two faces and the segment: the same in every step; spots are sorted by it
	std::uint8_t owner, ownerFace, otherFace;
	Vector2r     ownerNatural, otherNatural; ///< coordinates on the whole faces
	Vector3r     position;                   ///< centre of pressure [m]
	Real         penetration;                ///< mean [m]
	Real         area;                       ///< footprint times weight [m2]
};

/// Whether two spots are between the same faces, and so on the same springs.
inline bool sameFaces(const ContactSpot& a, const ContactSpot& b) { return a.owner == b.owner && a.ownerFace == b.ownerFace && a.otherFace == b.otherFace; }

/// Spots of a pair of faces come one after the other, by segment.
inline int contactKey(int owner, int ownerFace, int otherFace, int segment)
{
	return ((owner * faceCount + ownerFace) * faceCount + otherFace) * largestSegments * largestSegments + segment;
}

/// Spots of contact between two bodies; the vector is cleared first and only grows when it has to. Bodies between which a face plane passes are told apart
/// by their nodes alone.
void findContact(const Side& side0, const Side& side1, std::vector<ContactSpot>& spots);

/// Shear traction of each spot, carried from step to step: body axes of the owner, acting on the owner [Pa].
struct ContactMemory {
	std::vector<int>      keys; ///< ascending
	std::vector<Vector3r> tractions;
	void                  clear() { keys.clear(), tractions.clear(); }
	std::size_t           size() const { return keys.size(); }
};

/// Springs of a spot, by the contact lengths of the two faces.
SpotSprings springsOf(const ContactSpot& spot, const Side& side0, const Side& side1, const PairSprings& pair);

/// Forces of all spots on both bodies; `memory` is replaced by the present tractions (none without friction), `scratch` is working space. Nothing is allocated
/// for loads that have had the sizes of the two surfaces before.
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
        const LawTerms&                 terms = {});

/// How deep the centre of pressure of a spot is below the other's face [m]: this times the mean penetration is the mean of its square.
Real pressedDepth(const ContactSpot&, const Side& other);

/// Elastic energy of the springs of all spots, with the shear tractions of the last loads [J].
Real contactEnergy(const Side& side0, const Side& side1, const std::vector<ContactSpot>& spots, const PairSprings& pair, const ContactMemory& memory);

/// The tractions of a joint whose last segment has failed, laid on the segments of the two faces, so that the contact that takes over goes on with
/// the same shear.
ContactMemory tractionsOfJoint(const Joint&, const JointMotion&, Real tanFriction, const Side& side0, const Side& side1);

} // namespace brick
