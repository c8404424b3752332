// SPDX-License-Identifier: GPL-2.0-or-later
// Joints and contacts of bricks with bricks and supports: geometry, physics and law. The numerics is in kernel/Joint and kernel/Contact.
//
// Side 0 is the support, or of two bricks the one with the lower id, whatever the order of the interaction's ids (which depends on the collider's past).
#pragma once

#include "Brick.hpp"
#include "KernelArchive.hpp"

#include "kernel/PairLedger.hpp"

#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <atomic>

namespace yade {

class BrickGeom : public GenericSpheresContact {
public:
	// present geometry, found anew in each step
	struct Contact {
		std::array<brick::Side, 2>      sides;
		std::vector<brick::ContactSpot> spots;
	};
	std::unique_ptr<Contact>            contact;                         // of an ordinary contact
	brick::JointMotion                  motion;                      // of a joint
	Vector3r                            origin { NaN, NaN, NaN };    // position of side 0 in a joint
	shared_ptr<const brick::Hexahedron> supportSolid;
	bool                                reversed = false; // side 0 is the interaction's id2

	bool isKnown() const { return contact || !std::isnan(origin[0]); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(BrickGeom, GenericSpheresContact, "Geometry of a joint or contact of a :yref:`Brick`: where the segments of either body are inside the other, or how far the two faces of a joint have moved apart. :yref:`normal<GenericSpheresContact.normal>` points from id1 to id2, :yref:`contactPoint<GenericSpheresContact.contactPoint>` is the middle of the area in contact.",
		((Real, penetration, 0, Attr::readonly, "Largest penetration of a segment [m]; negative when a joint is open everywhere."))
		((Real, area, 0, Attr::readonly, "Area of the joint or of the present contact [m2]."))
		((int, spotCount, 0, Attr::readonly, "Segments of either body in contact; 0 for a joint.")),
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BrickGeom, GenericSpheresContact);
};
REGISTER_SERIALIZABLE(BrickGeom);

/// What an ordinary contact needs besides what a joint does.
struct OrdinaryContact {
	brick::PairSprings          springs;
	brick::ContactMemory        memory;       // shear tractions
	std::vector<int>            failureModes; // of the segments of the joint that it has been
	std::array<brick::Loads, 2> loads;        // on side 0 and 1 in the present step
};

template <class Archive> void serialize(Archive& ar, OrdinaryContact& c, unsigned)
{
	using boost::serialization::make_nvp;
	ar& make_nvp("springs", c.springs) & make_nvp("memory", c.memory) & make_nvp("failureModes", c.failureModes);
}
template <class Archive> void serialize(Archive& ar, std::shared_ptr<OrdinaryContact>& contact, const unsigned) { boost::serialization::serializeShared(ar, contact); }

/// Energy of a joint or contact, while O.trackEnergy.
struct PairLedger {
	brick::JointLedger   joint;
	brick::ContactLedger contact;
};

class BrickPhys : public FrictPhys {
public:
	// what this interaction does to its two bodies in the present step; side 0 as in BrickGeom
	std::array<Body::id_t, 2> ids { -1, -1 };
	brick::JointLoads         loads;     // of a joint
	long                      step   = -1;   // in which they were computed
	bool                      damped = true; // whether the law of that step has dashpots: for StepLimit
	std::atomic<bool>         cracked { false }; // whether the joint's segments are laid out: for the 3-D view, which may look at any time

	std::unique_ptr<PairLedger> ledger; // null unless energy is tracked

	static long made(); ///< objects of this class made so far in this process: whether there may be new ones

	bool                      isJoint() const { return joint.exists(); }
	const brick::PairSprings& springs() const { return isJoint() ? joint.shape->pair : contact->springs; }

	std::vector<int>      segmentState() const;
	std::vector<Real>     segmentArea() const;
	std::vector<Vector3r> segmentPoints(const shared_ptr<BrickGeom>&) const;
	std::vector<Real>     normalStress(const shared_ptr<BrickGeom>&) const;
	std::vector<Vector3r> shearStress(const shared_ptr<BrickGeom>&) const;
	std::vector<Real>     opening(const shared_ptr<BrickGeom>&) const;
	std::vector<Vector3r> slip(const shared_ptr<BrickGeom>&) const;
	std::vector<Real>     utilisation(const shared_ptr<BrickGeom>&) const;
	std::vector<Vector3r> segmentOutlines(const shared_ptr<BrickGeom>&) const;
	boost::python::object segmentTable(const shared_ptr<BrickGeom>&) const;
	Real                  elasticEnergy(const shared_ptr<BrickGeom>&) const;

	void postLoad(BrickPhys&) { cracked = !joint.segments.empty(); }

	/// A value for each segment of the joint.
	template <class Value, class Read> std::vector<Value> ofSegments(Read read) const
	{
		std::vector<Value> out;
		for (int s = 0; s < joint.count(); ++s)
			out.push_back(read(s));
		return out;
	}

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BrickPhys, FrictPhys, R"(Springs, mortar and friction between a :yref:`Brick` and another body [Furukawa2014]_, eqs. (2)-(9), (16).

:yref:`kn<NormPhys.kn>` and :yref:`ks<NormShearPhys.ks>` are sums over the area in contact [N/m]; the method's springs are per unit area. :yref:`normalForce<NormPhys.normalForce>` and :yref:`shearForce<NormShearPhys.shearForce>` act on id2.)",
		((brick::Joint, joint, , Attr::hidden, "Mortar joint; none for an ordinary contact."))
		((std::shared_ptr<OrdinaryContact>, contact, , Attr::hidden, "Springs and tractions of an ordinary contact; null for a joint."))
		((Real, contactPart, NaN, Attr::hidden, "Thickness of the thinner contact part [m]."))
		((Real, deepest, 0, Attr::readonly, "Largest penetration so far as a fraction of the thinner contact part; above 1 the contact is outside the method (crushing).")),
		createIndex(); count();,
		/*py*/
		.add_property("jointed", &BrickPhys::isJoint, "Whether this is a mortar joint with at least one segment that holds; otherwise an ordinary contact.")
		.add_property("segmentState", &BrickPhys::segmentState, "State of each segment of a joint: 0 intact, 1 failed in tension, 2 in shear, 3 in compression; also of the joint that an ordinary contact has been since it was last made, empty if none.")
		.add_property("segmentArea", &BrickPhys::segmentArea, "Area of each segment of a joint [m2].")
		.def("segmentPoints", &BrickPhys::segmentPoints, (boost::python::arg("geom")), "Place of each segment of a joint in the last step, world axes [m].")
		.def("normalStress", &BrickPhys::normalStress, (boost::python::arg("geom")), "Normal stress of each segment of a joint in the last step, tension positive, dashpots left out [Pa].")
		.def("shearStress", &BrickPhys::shearStress, (boost::python::arg("geom")), "Shear stress of each segment of a joint in the last step, acting on the body with the lower id (or the support), world axes [Pa].")
		.def("opening", &BrickPhys::opening, (boost::python::arg("geom")), "By how much the two sides of each segment of a joint have moved apart since they were joined, along the normal, in the last step [m]; negative where they are pressed together.")
		.def("slip", &BrickPhys::slip, (boost::python::arg("geom")), "How far the second body (that with the higher id, or the brick on a support) has moved along the joint against the first since they were joined, at the middle of each segment, in the last step, world axes [m].")
		.def("utilisation", &BrickPhys::utilisation, (boost::python::arg("geom")), "Stress of each segment of a joint in the last step as a share of the mortar's strength, in the mode that is nearest to failure [-]; 0 for one that has failed.")
		.def("segmentOutlines", &BrickPhys::segmentOutlines, (boost::python::arg("geom")), "Four corners of each segment of a joint in the last step, midway between its sides, one segment after the other, world axes [m]. A segment that the border of the joint cuts is shown as a rectangle of the same middle and area.")
		.def("segmentTable", &BrickPhys::segmentTable, (boost::python::arg("geom")), "All of this at once, for results of many joints: bytes of float64, 24 for each segment: its outline (12), place (3), opening, slip (3) [m], normal stress, shear stress (3) [Pa], utilisation [-].")
		.def("elasticEnergy", &BrickPhys::elasticEnergy, (boost::python::arg("geom")), "Elastic energy of the springs of this joint or contact in the last step [J].")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BrickPhys, FrictPhys);

private:
	static void count();
};
REGISTER_SERIALIZABLE(BrickPhys);

/// An interaction's physics as that of bricks; null for any other.
inline BrickPhys* asBrickPhys(const shared_ptr<IPhys>& phys)
{
	return phys && phys->getClassIndex() == BrickPhys::getClassIndexStatic() ? static_cast<BrickPhys*>(phys.get()) : nullptr;
}

class Ig2_Brick_Brick_BrickGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&)
	        override;
	FUNCTOR2D(Brick, Brick);
	DEFINE_FUNCTOR_ORDER_2D(Brick, Brick);
	YADE_CLASS_BASE_DOC_ATTRS(
	        Ig2_Brick_Brick_BrickGeom,
	        IGeomFunctor,
	        "Joint or contact of two bricks in any position. Bricks that were laid edge to edge, with joints to the same neighbour, are not searched for contact as "
	        "long as they are :yref:`whole<Brick.whole>`: their joints hold them apart.",
	        ((Real, seconds, 0, Attr::readonly, "Time spent here while O.timingEnabled, summed over threads [s].")));
};
REGISTER_SERIALIZABLE(Ig2_Brick_Brick_BrickGeom);

class Ig2_Wall_Brick_BrickGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&)
	        override;
	FUNCTOR2D(Wall, Brick);
	DEFINE_FUNCTOR_ORDER_2D(Wall, Brick);
	YADE_CLASS_BASE_DOC_ATTRS(
	        Ig2_Wall_Brick_BrickGeom,
	        IGeomFunctor,
	        "Joint or contact of a brick with a :yref:`Wall`. The wall is rigid: the brick's segments and springs count alone. A wall of sense 0 is "
	        "touched from the side on which the brick's centre is.",
	        ((Real, seconds, 0, Attr::readonly, "Time spent here while O.timingEnabled, summed over threads [s].")));
};
REGISTER_SERIALIZABLE(Ig2_Wall_Brick_BrickGeom);

class Ig2_Box_Brick_BrickGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&)
	        override;
	FUNCTOR2D(Box, Brick);
	DEFINE_FUNCTOR_ORDER_2D(Box, Brick);
	YADE_CLASS_BASE_DOC_ATTRS(
	        Ig2_Box_Brick_BrickGeom,
	        IGeomFunctor,
	        "Joint or contact of a brick with a :yref:`Box`, which is a rigid support or platen: the brick's segments and springs count alone, so a corner "
	        "of a box that points into the middle of a brick's face is felt only through the brick's segments around it.",
	        ((Real, seconds, 0, Attr::readonly, "Time spent here while O.timingEnabled, summed over threads [s].")));
};
REGISTER_SERIALIZABLE(Ig2_Box_Brick_BrickGeom);

class Ip2_BrickMat_BrickMat_BrickPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(BrickMat, BrickMat);
	YADE_CLASS_BASE_DOC(
	        Ip2_BrickMat_BrickMat_BrickPhys,
	        IPhysFunctor,
	        "Springs of an ordinary contact, eqs. (3), (4), (16); the lower of the two friction angles. Joints are made by :yref:`MortarJoints`.");
};
REGISTER_SERIALIZABLE(Ip2_BrickMat_BrickMat_BrickPhys);

class Ip2_FrictMat_BrickMat_BrickPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(FrictMat, BrickMat);
	YADE_CLASS_BASE_DOC(
	        Ip2_FrictMat_BrickMat_BrickPhys,
	        IPhysFunctor,
	        "The same for a support (:yref:`Wall` or :yref:`Box`) of plain :yref:`FrictMat`: only its friction angle is used.");
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_BrickMat_BrickPhys);

class Law2_BrickGeom_BrickPhys_Mortar : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(BrickGeom, BrickPhys);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(Law2_BrickGeom_BrickPhys_Mortar, LawFunctor, R"(Mortar that cracks segment by segment, and contact with friction and dashpots [Furukawa2014]_, eqs. (4)-(9).

In a joint that has cracked a segment also fails in tension when its edge opens beyond the strength, or the last row would be a hinge. When the last segment of a joint has failed, the pair goes on as an ordinary contact with the same shear. The law computes what each interaction does; :yref:`BrickDynamics` adds it up.

What a study can do without is left out by :yref:`failure<Law2_BrickGeom_BrickPhys_Mortar.failure>`, :yref:`friction<Law2_BrickGeom_BrickPhys_Mortar.friction>` and :yref:`dashpots<Law2_BrickGeom_BrickPhys_Mortar.dashpots>`: each chooses a variant of the loops over segments that has no trace of it. A pair without friction (angle 0) or without damping (hn = hs = 0) has the leaner variant by itself. All three may be changed in mid-run, between steps.)",
		((bool, failure, true, , "Whether segments of mortar fail, eqs. (6)-(8). False: those that hold are elastic whatever the load, as in a study of vibrations or of elastic stresses; a segment that has failed stays failed, and a joint all of whose segments have failed stays an ordinary contact. Switched on again, what is beyond its strength fails in the next step."))
		((bool, friction, true, , "Whether contacts and failed segments of joints carry shear, eq. (9). False: they are smooth, as one takes them for a limit case or where nothing slides; mortar that holds still carries shear, and :yref:`Mortar.frictionAngle` still counts in its strength, eq. (7). Switched off, their shear is gone with the next step; switched on again, it grows from zero."))
		((bool, dashpots, true, , "Whether contacts and failed segments of joints have dashpots, eq. (4). False: only friction, failure and the bricks' own damping take energy; :yref:`BrickTimeStepper` then allows the longer step of a pair without damping. hn and hs of the materials stay as they are."))
		((long, tensionFailures, 0, Attr::readonly, "Segments failed in tension so far, eq. (6)."))
		((long, shearFailures, 0, Attr::readonly, "Segments failed in shear so far, eq. (7)."))
		((long, compressionFailures, 0, Attr::readonly, "Segments failed in compression so far, eq. (8)."))
		((long, crushedContacts, 0, Attr::readonly, "Interactions so far whose penetration came to exceed the contact part: outside the method, computed on with the same springs."))
		((Real, jointSeconds, 0, Attr::readonly, "Time spent on joints while O.timingEnabled, summed over threads [s]."))
		((Real, contactSeconds, 0, Attr::readonly, "Time spent on ordinary contacts while O.timingEnabled, summed over threads [s]."))
	);
	// clang-format on

private:
	void            applyJoint(BrickGeom&, BrickPhys&);
	void            applyContact(BrickGeom&, BrickPhys&);
	PairLedger*     ledgerOf(BrickPhys&) const;
	brick::LawTerms termsOf(BrickPhys&) const;
};
REGISTER_SERIALIZABLE(Law2_BrickGeom_BrickPhys_Mortar);

/// A wall as a slab whose one face is the wall, on the side of the given point.
brick::Side sideOfWall(const Wall&, const State&, const Vector3r& brickPosition);
brick::Side sideOfBox(const State&, const brick::Hexahedron&);
/// @throws std::invalid_argument for extents with a boxProblem
shared_ptr<const brick::Hexahedron> solidOfBox(const Box&);
/// What is wrong with the extents of a Box, with their values; empty if nothing is.
string boxProblem(const Box&);
/// @param box solid of a Box, only of such a body   @param brickPosition of the other body, a brick
brick::Side sideOfBody(const Body&, const shared_ptr<const brick::Hexahedron>& box, const Vector3r& brickPosition);

/// Why bricks cannot touch a body, or it cannot touch them, as it is; empty when they can.
string touchProblem(const Body&);

/// A body with a touchProblem that was met in YADE's parallel loop, where an error would end the process: its pair was left without contact, and
/// BrickDynamics refuses it later in the same step. -1: none. Asking forgets it.
Body::id_t takeUntouchable();

/// Gives the pairs of a brick what follows from the contact lengths that it has now: the springs of joints, and how thin the thinner contact part is.
/// @throws std::invalid_argument when a contact part is thinner than half of the mortar
void takeUpContactLengths(const Body&, Scene&);

/// Thickness of the thinner contact part of a pair's bricks [m].
Real thinnestContactPart(const std::array<brick::Side, 2>&);

/// Compliances, densities, damping and friction of two bodies; side 0 may be a support of any FrictMat.
brick::PairSprings pairSprings(const Material& side0, bool support, const BrickMat& side1);

} // namespace yade
