// SPDX-License-Identifier: GPL-2.0-or-later
//
// Function objects chosen by the types of one or two of their arguments. FUNCTOR1D and FUNCTOR2D name those types.
#pragma once

#include <lib/multimethods/FunctorWrapper.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Scene;
class TimingDeltas;

class Functor : public Serializable {
public:
	shared_ptr<TimingDeltas> timingDeltas;
	Scene*                   scene = nullptr; // set by the dispatcher before each loop
	std::string              label;

	Functor() { }
	YADE_HOST_CLASS(Functor)
	YADE_HOST_ARCHIVE(Serializable, (label))
	virtual std::vector<std::string> getFunctorTypes() const;
};
YADE_ABI_SIZE(Functor, 80)
YADE_ABI_OFFSET(Functor, scene, 40)
YADE_ABI_OFFSET(Functor, label, 48)

template <class Type, class Result, class List> class Functor1D : public Functor, public FunctorWrapper<Result, List> {
public:
	std::vector<std::string> getFunctorTypes() const override { return { get1DFunctorType1() }; }
	virtual std::string      get1DFunctorType1() const { throw std::logic_error(this->getClassName() + " lacks FUNCTOR1D"); }
	std::string              getBaseClassName(unsigned i = 0) const override { return i == 0 ? "Functor" : i == 1 ? "FunctorWrapper" : ""; }
	int                      getBaseClassNumber() const override { return 2; }
	std::string              getClassName() const override { return "Functor1D"; }
};

template <class Type1, class Type2, class Result, class List> class Functor2D : public Functor, public FunctorWrapper<Result, List> {
public:
	std::vector<std::string> getFunctorTypes() const override { return { get2DFunctorType1(), get2DFunctorType2() }; }
	virtual std::string      get2DFunctorType1() const { throw std::logic_error(this->getClassName() + " lacks FUNCTOR2D"); }
	virtual std::string      get2DFunctorType2() const { throw std::logic_error(this->getClassName() + " lacks FUNCTOR2D"); }
	std::string              getBaseClassName(unsigned i = 0) const override { return i == 0 ? "Functor" : i == 1 ? "FunctorWrapper" : ""; }
	int                      getBaseClassNumber() const override { return 2; }
	std::string              getClassName() const override { return "Functor2D"; }
};

REGISTER_SERIALIZABLE(Functor)

} // namespace yade

#define FUNCTOR1D(Type)                                                                                                                                        \
public:                                                                                                                                                        \
	std::string get1DFunctorType1() const override { return #Type; }

#define FUNCTOR2D(Type1, Type2)                                                                                                                                \
public:                                                                                                                                                        \
	std::string get2DFunctorType1() const override { return #Type1; }                                                                                      \
	std::string get2DFunctorType2() const override { return #Type2; }
