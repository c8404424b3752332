// SPDX-License-Identifier: GPL-2.0-or-later
//
// Functors of the 3-D view. The view makes its own objects of them, once, and calls them while it paints, in the thread of the GUI: shapes in the axes of their
// body, geometry and physics of interactions in those of the scene. It holds BodyContainer::drawloopmutex meanwhile, for interactions also theirs.
#pragma once

#include <core/Body.hpp>
#include <core/Functor.hpp>
#include <core/Interaction.hpp>

namespace yade {

struct GLViewInfo {
	Vector3r sceneCenter { 0, 0, 0 };
	Real     sceneRadius = 1;
};
YADE_ABI_ASSERT(sizeof(GLViewInfo) == 32, "GLViewInfo")

/// go(shape, state, as wire frame, view)
class GlShapeFunctor : public Functor1D<Shape, void, boost::mpl::vector<const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&>> {
public:
	GlShapeFunctor() { }
	YADE_HOST_CLASS(GlShapeFunctor)
	YADE_HOST_ARCHIVE(Functor, )
	virtual std::string renders() const;
	virtual void        initgl();
};

/// go(geometry, interaction, body of id1, of id2, as wire frame)
class GlIGeomFunctor
        : public Functor1D<
                  IGeom,
                  void,
                  boost::mpl::vector<const shared_ptr<IGeom>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool>> {
public:
	GlIGeomFunctor() { }
	YADE_HOST_CLASS(GlIGeomFunctor)
	YADE_HOST_ARCHIVE(Functor, )
	virtual std::string renders() const;
	virtual void        initgl();
};

/// go(physics, interaction, body of id1, of id2, as wire frame)
class GlIPhysFunctor
        : public Functor1D<
                  IPhys,
                  void,
                  boost::mpl::vector<const shared_ptr<IPhys>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool>> {
public:
	GlIPhysFunctor() { }
	YADE_HOST_CLASS(GlIPhysFunctor)
	YADE_HOST_ARCHIVE(Functor, )
	virtual std::string renders() const;
	virtual void        initgl();
};

YADE_ABI_SIZE(GlShapeFunctor, 88)
YADE_ABI_SIZE(GlIGeomFunctor, 88)
YADE_ABI_SIZE(GlIPhysFunctor, 88)
REGISTER_SERIALIZABLE(GlShapeFunctor)
REGISTER_SERIALIZABLE(GlIGeomFunctor)
REGISTER_SERIALIZABLE(GlIPhysFunctor)

} // namespace yade

/// Which type a functor draws.
#define RENDERS(Type)                                                                                                                                          \
public:                                                                                                                                                        \
	std::string renders() const override { return #Type; }                                                                                                 \
	FUNCTOR1D(Type)
