// SPDX-License-Identifier: GPL-2.0-or-later
//
// Call slots of the functors: go and goReverse with one to seven arguments, whose types are those of the list; past its end the
// empty type of Boost.MPL stands. A functor overrides the one with its full argument list.
#pragma once

#include <boost/mpl/at.hpp>
#include <boost/mpl/vector.hpp>

#include <stdexcept>
#include <string>

namespace yade {

template <class Result, class List> class FunctorWrapper {
	template <int n> using Arg = typename boost::mpl::at_c<List, n>::type;
	[[noreturn]] static Result refuse() { throw std::runtime_error("a functor was called with arguments that it does not take"); }

public:
	FunctorWrapper() { }
	virtual ~FunctorWrapper() { }
	virtual std::string checkOrder() const { return {}; }

	virtual Result go(Arg<0>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>, Arg<2>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>) { return refuse(); }
	virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>, Arg<6>) { return refuse(); }
	virtual Result goReverse(Arg<0>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>) { return refuse(); }
	virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>, Arg<6>) { return refuse(); }
};

} // namespace yade

/// In every IGeom functor, also for twice the same shape: the order in which the pair of shapes is passed.
#define DEFINE_FUNCTOR_ORDER_2D(First, Second)                                                                                                                 \
public:                                                                                                                                                        \
	std::string checkOrder() const override { return #First " " #Second; }
