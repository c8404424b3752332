// SPDX-License-Identifier: GPL-2.0-or-later
// How the kernel's state is archived: joints, springs, remembered tractions.
#pragma once

#include <boost/serialization/array.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/vector.hpp>

#include "kernel/Contact.hpp"

namespace boost {
namespace serialization {

	inline char standardPointers = 0; // its address tells the archive's helper for std::shared_ptr

	/// As Boost's own, which has one helper in an archive for std::shared_ptr and for boost::shared_ptr: the first, whatever it is. YADE's objects come in the latter.
	template <class A, class T> void serializeShared(A& ar, std::shared_ptr<T>& pointer)
	{
		T* object = pointer.get();
		ar& make_nvp("px", object);
		if constexpr (A::is_loading::value) ar.template get_helper<shared_ptr_helper<std::shared_ptr>>(&standardPointers).reset(pointer, object);
	}

	template <class A> void serialize(A& ar, std::shared_ptr<brick::JointShape>& shape, const unsigned) { serializeShared(ar, shape); }

	template <class A> void serialize(A& ar, brick::PairSprings& s, unsigned)
	{
		for (int i = 0; i < 2; ++i)
			ar& make_nvp("normalCompliance", s.normalCompliance[i]) & make_nvp("shearCompliance", s.shearCompliance[i])
			        & make_nvp("density", s.density[i]);
		ar& make_nvp("mortarNormal", s.mortarNormal) & make_nvp("mortarShear", s.mortarShear) & make_nvp("mortarThickness", s.mortarThickness);
		ar& make_nvp("normalDamping", s.normalDamping) & make_nvp("shearDamping", s.shearDamping) & make_nvp("tanFriction", s.tanFriction);
	}

	template <class A> void serialize(A& ar, brick::SpotSprings& s, unsigned)
	{
		ar& make_nvp("normal", s.normal) & make_nvp("shear", s.shear) & make_nvp("normalDashpot", s.normalDashpot)
		        & make_nvp("shearDashpot", s.shearDashpot);
	}

	template <class A> void serialize(A& ar, brick::MortarStrength& s, unsigned)
	{
		ar& make_nvp("tension", s.tension) & make_nvp("cohesion", s.cohesion) & make_nvp("tanFriction", s.tanFriction);
		ar& make_nvp("compression", s.compression) & make_nvp("capShape", s.capShape);
	}

	template <class A, int rows, int columns> void serializeMatrix(A& ar, const char* name, Eigen::Matrix<brick::Real, rows, columns>& m)
	{
		for (int k = 0; k < m.size(); ++k)
			ar& make_nvp(name, m.data()[k]);
	}

	template <class A> void serialize(A& ar, brick::JointSegments& s, unsigned)
	{
		s.archive([&ar](auto& value) { ar& make_nvp("values", value); });
	}

	template <class A> void serialize(A& ar, brick::JointFace& f, unsigned) { ar& make_nvp("face", f.face) & make_nvp("normal", f.normal); }

	template <class A> void serialize(A& ar, brick::PatchSide& s, unsigned)
	{
		for (int& node : s.nodes)
			ar& make_nvp("node", node);
		serializeMatrix(ar, "corner", s.corners);
		serializeMatrix(ar, "weight", s.weights);
	}

	template <class A> void serialize(A& ar, brick::JointSegment& s, unsigned)
	{
		int state = int(s.state);
		ar& make_nvp("patch", s.patch) & make_nvp("p", s.p) & make_nvp("q", s.q) & make_nvp("area", s.area) & make_nvp("state", state);
		s.state = brick::SegmentState(state);
	}

	template <class A> void serialize(A& ar, brick::JointPatch& p, unsigned)
	{
		ar& make_nvp("side0", p.sides[0]) & make_nvp("side1", p.sides[1]) & make_nvp("count", p.count) & make_nvp("cut", p.cut);
		for (int& number : p.rows)
			ar& make_nvp("rows", number);
		serializeMatrix(ar, "outermost", p.outermost);
		serializeMatrix(ar, "weight", p.weight);
		serializeMatrix(ar, "cornerAreas", p.cornerAreas);
	}

	template <class A> void serialize(A& ar, brick::JointShape& j, unsigned)
	{
		ar& make_nvp("face0", j.faces[0]) & make_nvp("face1", j.faces[1]) & make_nvp("strength", j.strength);
		ar& make_nvp("pair", j.pair) & make_nvp("along", j.along) & make_nvp("count", j.count) & make_nvp("area", j.area) & make_nvp("patches", j.patches);
		for (int& number : j.rows)
			ar& make_nvp("rows", number);
	}

	template <class A> void serialize(A& ar, brick::Joint& j, unsigned)
	{
		ar& make_nvp("shape", j.shape) & make_nvp("springs", j.springs) & make_nvp("segments", j.segments) & make_nvp("restGap", j.restGap);
		ar& make_nvp("tension", j.failures.tension) & make_nvp("shear", j.failures.shear) & make_nvp("compression", j.failures.compression);
	}

	template <class A> void serialize(A& ar, brick::ContactMemory& m, unsigned) { ar& make_nvp("keys", m.keys) & make_nvp("tractions", m.tractions); }

}
}
