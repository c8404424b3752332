// SPDX-License-Identifier: GPL-2.0-or-later
// The energy of a joint or contact, and where it goes: what springs hold, what failure, friction and dashpots take. Only for scenes that ask for it: the laws
// (JointStep.cpp, Contact.cpp) know nothing of it, segments and spots are compared before and after a step.
//
// Work is booked as leap-frog does it: over the step from n-1 to n a force does the mean of its values at both ends times the displacement between. With
//     springs    U = A/2 (sigma^2/kn + |tau|^2/ks)
//     friction   mean of tau at both ends times the slip
//     failure    U before less U after, less the work that the lost traction did not do: half of it times the displacement
//     dashpots   mean of their tractions at both ends times the displacement
//     level      springs that a change of a brick's level of deformation made stiffer, or softer: less what this put in, half the change of k times the stretches
//                at both ends
//     area       of contact: what comes into contact has the shear traction of its spot at once, what leaves takes it away, and no force does that work
// work done on the springs is accounted for exactly as long as they are linear: what is missing in the sum of all energies was made, or lost, by a nonlinear
// step (a segment that opens or closes within it), by axes that turn, or where a contact's edge lies between faces of unlike springs.
#pragma once

#include "Contact.hpp"

#include <vector>

namespace brick {

/// What the springs of a pair hold at present, and what was taken since the step before [J].
struct PairEnergy {
	Real elastic = 0, fracture = 0, friction = 0, dashpot = 0, area = 0, level = 0;

	PairEnergy& operator+=(const PairEnergy& e)
	{
		elastic += e.elastic, fracture += e.fracture, friction += e.friction, dashpot += e.dashpot, area += e.area, level += e.level;
		return *this;
	}
};

/// Remembers a joint's step.
class JointLedger {
public:
	PairEnergy energy; ///< of the last step

	void begin(const Joint&);
	/// Of a patch all of whose segments hold. @param opening as in SegmentSweep @param elastic [J]
	void addHolding(const Joint&, std::size_t patch, const SegmentField& opening, Real elastic);
	/// Of a patch whose segments were swept. What shear was held when friction is switched off goes to friction, once. @param before the segments then
	void addSwept(std::size_t patch, const JointSegments& before, const JointSegments& after, const SegmentSweep&);

private:
	struct Patch {
		bool         known = false;
		SegmentField opening, dashpot {}; ///< moments of the dashpots' tractions with 1, p, q, pq [N]
	};
	std::vector<Patch> patches;
	SpotSprings        present, last; ///< in this step and in the one before
};

/// Remembers a contact's step.
class ContactLedger {
public:
	PairEnergy energy; ///< of the last step

	/// Begins where a joint ends: what contact holds more than the joint did is energy from nothing, booked as area. The joint's energy becomes this one's.
	void begin(const PairEnergy& ofJoint, const Side& side0, const Side& side1, const std::vector<ContactSpot>&, const PairSprings&, const ContactMemory& memory);
	/// @param memory tractions in this step; not looked at without friction
	void
	add(const Side& side0,
	    const Side& side1,
	    const std::vector<ContactSpot>&,
	    const PairSprings&,
	    Real                 dt,
	    const ContactMemory& memory,
	    const LawTerms&      terms = {});

private:
	/// A spot in the step before; owner's axes.
	struct Spot {
		int         key; // ascending
		Real        area, shearEnergy;
		Vector3r    traction, dashpot; // [Pa], [N]
		SpotSprings springs;
		Real        pressed; // area times the mean of the squared penetration [m4]
	};
	std::vector<Spot> last;

	static Real stiffen(Spot& was, const SpotSprings&, Real pressed);
};

} // namespace brick
