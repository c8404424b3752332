// SPDX-License-Identifier: GPL-2.0-or-later
//
// The functor families of the collider and of the interaction loop. An exception that leaves one of them ends the program.
#pragma once

#include <core/Aabb.hpp>
#include <core/Functor.hpp>
#include <core/Interaction.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

/// Bound of a body: go(shape, bound, placement, body).
class BoundFunctor : public Functor1D<Shape, void, boost::mpl::vector<const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*>> {
public:
	BoundFunctor() { }
	YADE_HOST_CLASS(BoundFunctor)
	YADE_HOST_ARCHIVE(Functor, )
};

/// Geometry of a contact: go(shape1, shape2, state1, state2, shift2, force, interaction), true if there is (now) a geometry.
class IGeomFunctor : public Functor2D<
                             Shape,
                             Shape,
                             bool,
                             boost::mpl::vector<
                                     const shared_ptr<Shape>&,
                                     const shared_ptr<Shape>&,
                                     const State&,
                                     const State&,
                                     const Vector3r&,
                                     const bool&,
                                     const shared_ptr<Interaction>&>> {
public:
	IGeomFunctor() { }
	YADE_HOST_CLASS(IGeomFunctor)
	YADE_HOST_ARCHIVE(Functor, )
	virtual void preStep();
};

/// Physics of a contact: go(material1, material2, interaction), called in every step.
class IPhysFunctor
        : public Functor2D<
                  Material,
                  Material,
                  void,
                  boost::mpl::vector<const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&>> {
public:
	IPhysFunctor() { }
	YADE_HOST_CLASS(IPhysFunctor)
	YADE_HOST_ARCHIVE(Functor, )
};

/// Forces of a contact: go(geom, phys, interaction), false to break it.
class LawFunctor : public Functor2D<IGeom, IPhys, bool, boost::mpl::vector<shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*>> {
public:
	LawFunctor() { }
	YADE_HOST_CLASS(LawFunctor)
	YADE_HOST_ARCHIVE(Functor, )
};

YADE_ABI_SIZE(BoundFunctor, 88)
YADE_ABI_SIZE(IGeomFunctor, 88)
YADE_ABI_SIZE(IPhysFunctor, 88)
YADE_ABI_SIZE(LawFunctor, 88)
REGISTER_SERIALIZABLE(BoundFunctor)
REGISTER_SERIALIZABLE(IGeomFunctor)
REGISTER_SERIALIZABLE(IPhysFunctor)
REGISTER_SERIALIZABLE(LawFunctor)

} // namespace yade
