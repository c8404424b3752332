// SPDX-License-Identifier: GPL-2.0-or-later
// The brick: rest geometry, how its deformation is followed, and the present deformation. Its rigid motion is the body's State.
#pragma once

#include "BrickMat.hpp"

#include <core/Aabb.hpp>
#include <core/Dispatching.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

#include "kernel/InnerPart.hpp"
#include "kernel/Placement.hpp"

#include <algorithm>
#include <memory>

namespace brick {
struct JointShape;
}

namespace yade {

/// A mortar joint of a brick all of whose segments have failed: for the 3-D view, not saved.
struct LostJoint {
	int                                      other; // body of side 0
	std::shared_ptr<const brick::JointShape> shape;
	Real                                     restGap;
	std::vector<int>                         states; // of its segments, as BrickPhys.segmentState
};

/// How a brick's deformation is followed: what its attributes of the same names say.
struct BrickLevel {
	brick::Deformation deformation = brick::Deformation::Trilinear;
	brick::Element     element     = brick::Element::Full;
	brick::Inner       inner       = brick::Inner::Inset;
	int                cells       = 1; // 1 unless refined
	Real               thickness   = NaN;

	bool isRigid() const { return deformation == brick::Deformation::Rigid; }
	bool operator==(const BrickLevel& o) const
	{
		if (isRigid() || o.isRigid()) return isRigid() && o.isRigid();
		return deformation == o.deformation && element == o.element && inner == o.inner && cells == o.cells && thickness == o.thickness;
	}
	bool operator!=(const BrickLevel& o) const { return !(*this == o); }
};

template <class Archive> void serialize(Archive& ar, BrickLevel& level, unsigned)
{
	using boost::serialization::make_nvp;
	int deformation = int(level.deformation), element = int(level.element), inner = int(level.inner);
	ar& make_nvp("deformation", deformation) & make_nvp("element", element) & make_nvp("inner", inner);
	ar& make_nvp("cells", level.cells) & make_nvp("thickness", level.thickness);
	level.deformation = brick::Deformation(deformation), level.element = brick::Element(element), level.inner = brick::Inner(inner);
}

class Brick : public Shape {
public:
	// Derived from the attributes by postLoad; null as long as no corners are given.
	shared_ptr<const brick::Hexahedron> solid;
	std::array<Real, brick::faceCount>  contactLength { 0, 0, 0, 0, 0, 0 }; // at present, see share

	bool isDeformable() const { return !level.isRigid(); }
	bool isSettled() const { return level == wanted && share == 1; } ///< no change of level goes on
	bool isChanging() const { return changing; }                     ///< one does, or joints have yet to take up what the contact lengths are now

	/// A step of the change of level towards the attributes: the brick's compliance moves from the springs into the element, or back.
	/// @param duration of the whole change [s]; NaN: changeTime(), 0: at once   @return what the end of the deformation takes from all energy, where its loads are in equilibrium [J]
	Real changeLevel(const BrickMat&, Real dt, Real duration);
	Real changeTime() const; ///< some periods of the slowest mode [s]; NaN where it is not known
	void noteTakenUp() { changing = !isSettled(); } ///< joints have taken up the contact lengths

	/// What the contact lengths are when no change goes on: the shortest that they can have at this level.
	Real settledContactLength(int face) const { return isDeformable() ? level.thickness : solid->distance(face); }

	/// Whether this brick and another were laid edge to edge and all joints of both hold (see whole).
	bool isHeldApartFrom(const Brick& other, int id) const { return whole && other.whole && std::find(beside.begin(), beside.end(), id) != beside.end(); }

	/// An ordinary contact bears on this brick in the given step. May be called by several threads.
	void noteContact(long step)
	{
#pragma omp atomic write
		contactStep = step;
	}
	long contactStep = -1; // the last step with an ordinary contact
	bool counted     = false; // by BrickTimeStepper, with the joints that it has now

private:
	bool changing = false; // see isChanging; here, where it takes no room of its own

public:
	std::unique_ptr<std::vector<LostJoint>> lostJoints; // of which it was side 1; null as long as there are none

	brick::Placement placement(const Vector3r& position, const State& state) const;
	brick::Side      side(const Vector3r& position, const State& state) const;

	/// Modes of this brick in this material; equal bricks share them. Null for a rigid brick. Not to be called in parallel.
	const brick::InnerPart* innerPart(const BrickMat& material);

	/// Whether innerPart() has been asked for with this material, as it is, and the level of deformation is not to be changed.
	bool isReady(const BrickMat& m) const
	{
		return !isDeformable() || (inside && inside->type.young == m.young && inside->type.poisson == m.poisson && inside->type.density == m.density);
	}

	/// Moves the deformation part by a step under nodal forces in body axes [N].
	/// @param localDamping of the modes, as NewtonIntegrator.damping is of the rigid motion   @param nodeRates whether the rates of the nodes are wanted
	/// @param energy of the modes in this step; null: not wanted   @param work that of the forces on the modes is added to [J]; null: not wanted
	void advance(
	        const brick::NodalVectors& forces, Real dampingRatio, Real localDamping, Real dt, bool nodeRates, brick::ModeEnergy* energy, Real* work);

	/// Whether a node of the surface will be outside of a box, world axes, when the body has moved for another step.
	/// @param margin that it has to stay within the box: what the velocity may change by in the step, times the step [m]
	bool willReachOut(const State&, Real dt, Real margin, const Vector3r& lower, const Vector3r& upper) const;

	/// Deforms it at rest.
	void setAmplitudes(const std::vector<Real>&);

	int                   surfaceCells() const { return level.cells; } ///< along each edge of a face
	int                   surfaceNodes() const { return brick::surfaceGrid(surfaceCells()).size(); }
	Vector3r              deformedNode(int a) const; ///< of the surface, the corners first; body axes [m]
	std::vector<Vector3r> innerNodes() const;        ///< surface of the inner part at rest, body axes [m]; the corners of a rigid brick
	Real         elasticEnergy() const;
	Real         kineticEnergy() const;

	/// Deformed corners in world axes, in the order of `corners` [m].
	std::vector<Vector3r>      worldCorners(const shared_ptr<State>& state) const;
	std::vector<Vector3r>      worldVelocities(const shared_ptr<State>& state) const;
	Vector6r                   stress() const;
	Real                       volume() const;
	static boost::python::dict solidProperties(const std::vector<Vector3r>& corners);
	static Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>
	stiffness(const std::vector<Vector3r>& nodes, Real young, Real poisson, const string& element);

	void postLoad(Brick&);
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Brick, Shape, R"(Convex hexahedron with planar faces, rigid or deformable [Furukawa2014]_.

A deformable brick has an inner hexahedron, an 8-node finite element that deforms relative to the body's rigid motion, and an outer contact part of constant thickness cut into segments. Mass and inertia (:yref:`State.mass`, :yref:`State.inertia`) are those of the whole solid: use ``yade_brick.brick`` to make bodies.

Instead of one element, the inner part of a 'refined' brick is :yref:`cells<Brick.cells>` x cells x cells of them, condensed to the nodes on its surface [Guyan1965]_; joints and contacts see each face as cells x cells bilinear patches. What the inside does by itself, above its own lowest frequency, is left out.

:yref:`deformation<Brick.deformation>` and what belongs to it can be changed during a run. Of a brick that has moved, the change takes :yref:`BrickDynamics.levelTime`: its compliance goes from the springs of its joints and contacts into the element or back, so that places, velocities and forces do not jump; see :yref:`share<Brick.share>`.

Limitations: small strain in the co-rotated frame; inertia forces of the rotation (centrifugal) do not load the element.)",
		((vector<Vector3r>, corners, , Attr::triggerPostLoad, "Eight corners at rest in body axes [m]: the origin is the centre of gravity and the axes are principal axes of inertia. Order: (---), (+--), (++-), (-+-), then the same with z +."))
		((string, deformation, "trilinear", Attr::triggerPostLoad, "How deformation is followed: 'rigid' (not at all: refined DEM), 'uniform' (the 6 states of constant strain), 'trilinear' (all 18 modes of the element) or 'refined' (elements in each brick, see :yref:`cells<Brick.cells>`)."))
		((int, cells, 2, Attr::triggerPostLoad, "Elements along each edge of the inner part of a 'refined' brick, 1 to 8; :yref:`segments<Brick.segments>` must be a multiple. A step costs about as the fourth power of it."))
		((string, element, "full", Attr::triggerPostLoad, "Stiffness of the inner hexahedron: 'full' (2x2x2 Gauss points, as the paper; too stiff in bending), 'incompatible' (bends right) or 'bbar' (for nu near 0.5)."))
		((string, inner, "inset", Attr::triggerPostLoad, "Where the inner hexahedron ends: 'inset' by :yref:`contactThickness<Brick.contactThickness>` (the paper) or 'full', the brick's own corners."))
		((Real, contactThickness, NaN, Attr::triggerPostLoad, "Thickness r of the contact part [m], eq. (16). Needed unless rigid."))
		((int, segments, 4, Attr::triggerPostLoad, "Segments along each edge of a face in contact, 1 to 64. A joint has so many along a face's longest edge, and about square ones across, one row at least; a single row is a hinge."))
		((vector<Real>, amplitudes, , Attr::readonly, "Amplitude of each deformation mode [sqrt(kg) m]; empty before the first step and for rigid bricks."))
		((vector<Real>, rates, , Attr::readonly, "Rate of each amplitude, half a step before [sqrt(kg) m/s]."))
		((vector<Vector3r>, displacement, , Attr::readonly, "Displacement of the eight nodes relative to the rigid motion, body axes [m]; empty for rigid bricks. Of a 'refined' brick all 6 cells^2 + 2 nodes on the surface: the corners first, then by place in the grid, x fastest and z slowest."))
		((vector<Vector3r>, displacementRate, , Attr::readonly, "Its rate, half a step before [m/s]; empty while no dashpot asks for it: all joints hold and nothing else touches the brick."))
		((Real, share, 1, Attr::readonly, "Share of its compliance that the element of a deformable brick has at present, above 0. Below 1 while the level of deformation changes: its stiffness is divided by this share, and the contact lengths are between the distance of the face and r, by the same share."))
		((Real, progress, 1, Attr::hidden, "Of the change of level, 0 to 1: time since its beginning by its duration, or that which is left while it goes back."))
		((bool, moved, false, Attr::hidden, "Whether it has been in a step, or brought to rest under loads: a change of level then takes time."))
		((BrickLevel, level, , Attr::hidden, "In use; during a change not that of the attributes."))
		((bool, whole, false, Attr::readonly, "Whether the brick has mortar joints and all segments of all of them hold."))
		((int, joints, 0, Attr::readonly, "Mortar joints that were laid at this brick."))
		((vector<int>, beside, , Attr::readonly, "Bodies that touch this brick at an edge or corner only, with a common neighbour that both are joined to: not searched for contact, nor kept as interactions, while both are :yref:`whole<Brick.whole>`.")),
		/*ctor*/ createIndex();,
		/*py*/
		.def("worldCorners", &Brick::worldCorners, (boost::python::arg("state")), "Deformed corners in world axes for the given state [m], in the order of corners.")
		.def("worldVelocities", &Brick::worldVelocities, (boost::python::arg("state")), "Velocities of the nodes on the surface in world axes, half a step before, rigid motion and deformation together [m/s]; in the order of displacement: the corners first.")
		.def("stress", &Brick::stress, "Mean stress of the inner part in body axes [Pa], tension positive: xx, yy, zz, xy, yz, zx. Zero for a rigid brick; NaN before the first step after making or loading, when the material is not known yet.")
		.def("elasticEnergy", &Brick::elasticEnergy, "Elastic energy of the deformation [J]; zero for a rigid brick, NaN as stress.")
		.def("kineticEnergy", &Brick::kineticEnergy, "Kinetic energy of the deformation, half a step before [J]; that of the rigid motion is not in it.")
		.add_property("volume", &Brick::volume, "Volume at rest [m3].")
		.def("solidProperties", &Brick::solidProperties, (boost::python::arg("corners")), "Properties of the solid with eight given corners in any axes: dict of volume [m3], centroid [m], inertia (principal, for unit density [m5]), orientation (principal axes in the corners' axes), corners (in the principal frame [m]). Raises ValueError when the corners are no brick.")
		.staticmethod("solidProperties")
		.def("stiffness", &Brick::stiffness, (boost::python::arg("nodes"), boost::python::arg("young"), boost::python::arg("poisson"), boost::python::arg("element") = "full"), "The 24 x 24 stiffness matrix of the 8-node hexahedron with the given nodes [N/m], eq. (17): to compare with other finite element codes. Raises ValueError for wrong nodes or elasticity.")
		.staticmethod("stiffness")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(Brick, Shape);

private:
	BrickLevel                         wanted; // by the attributes as they were last found right
	Real                               lastShare = 1; // in the last step
	shared_ptr<const brick::InnerPart> inside;
	BrickLevel                         wantedLevel() const;
	void                               keepDeformation(const brick::Nodes&);
	void                               beginLevel();
	void                               setContactLengths();
	brick::InnerPartType               innerPartType() const;
	const std::vector<Real>&           presentOmegaSquared() const;
	void                               updateNodes(bool rates);
};
REGISTER_SERIALIZABLE(Brick);

/// A body's shape as a brick; null for any other.
inline Brick* asBrick(const shared_ptr<Shape>& shape)
{
	return shape && shape->getClassIndex() == Brick::getClassIndexStatic() ? static_cast<Brick*>(shape.get()) : nullptr;
}

class Bo1_Brick_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;
	FUNCTOR1D(Brick);
	YADE_CLASS_BASE_DOC(
	        Bo1_Brick_Aabb,
	        BoundFunctor,
	        "Axis-aligned box around the deformed corners of a :yref:`Brick`. With :yref:`InsertionSortCollider.verletDist` > 0, :yref:`BrickDynamics` "
	        "asks for new boxes when a brick turns or bulges out of its box.");
};
REGISTER_SERIALIZABLE(Bo1_Brick_Aabb);

} // namespace yade
