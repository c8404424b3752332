// SPDX-License-Identifier: GPL-2.0-or-later
//
// Number types shared with YADE, and how they are written to archives.
#pragma once

#include <lib/base/AbiAssert.hpp>

#if !defined(EIGEN_DONT_ALIGN) && !defined(YADE_ABI_UNCHECKED)
#error "compile with -DEIGEN_DONT_ALIGN: YADE keeps Eigen members at their natural alignment of 8 bytes"
#endif

// Boost.Python has to see Python.h before any standard header does
#include <boost/python/detail/wrap_python.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <boost/serialization/is_bitwise_serializable.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/shared_ptr.hpp>

#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#define YADE_PTR_CAST ::boost::static_pointer_cast
#define YADE_PTR_DYN_CAST ::boost::dynamic_pointer_cast

namespace boost {
namespace python {
}
}

namespace yade {

namespace py = ::boost::python;

using boost::shared_ptr;
using std::invalid_argument;
using std::logic_error;
using std::runtime_error;
using std::string;
using std::vector;

using Real = double;

using Vector2r = Eigen::Matrix<Real, 2, 1>;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Vector6r = Eigen::Matrix<Real, 6, 1>;
using Vector2i = Eigen::Matrix<int, 2, 1>;
using Vector3i = Eigen::Matrix<int, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;

using Quaternionr = Eigen::Quaternion<Real>;
using AngleAxisr  = Eigen::AngleAxis<Real>;

constexpr Real NaN = std::numeric_limits<Real>::quiet_NaN();

/// Rigid placement: position and orientation of a body frame.
template <class Scalar> class Se3 {
public:
	Eigen::Matrix<Scalar, 3, 1> position;
	Eigen::Quaternion<Scalar>   orientation;
	Se3() { }
	Se3(const Eigen::Matrix<Scalar, 3, 1>& p, const Eigen::Quaternion<Scalar>& q)
	        : position(p)
	        , orientation(q)
	{
	}
};
using Se3r = Se3<Real>;

YADE_ABI_ASSERT(sizeof(Vector3r) == 24 && alignof(Vector3r) == 8, "Vector3r")
YADE_ABI_ASSERT(sizeof(Quaternionr) == 32 && alignof(Quaternionr) == 8, "Quaternionr")
YADE_ABI_ASSERT(sizeof(Matrix3r) == 72 && sizeof(Se3r) == 56, "Matrix3r, Se3r")

} // namespace yade

BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector6r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Matrix3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Quaternionr)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Se3r)

namespace boost {
namespace serialization {

	/// Column vectors: entries x y z up to length 3, v0..v5 at length 6.
	template <class Archive, class Scalar, int N> void serialize(Archive& ar, Eigen::Matrix<Scalar, N, 1>& v, unsigned)
	{
		static_assert(N == 2 || N == 3 || N == 6, "YADE has no archive layout for vectors of this length");
		static const char* const shortTag[] = { "x", "y", "z" };
		static const char* const longTag[]  = { "v0", "v1", "v2", "v3", "v4", "v5" };
		for (int i = 0; i < N; ++i)
			ar& make_nvp(N == 6 ? longTag[i] : shortTag[i], v[i]);
	}

	/// Entries row by row.
	template <class Archive> void serialize(Archive& ar, yade::Matrix3r& m, unsigned)
	{
		static const char* const tag[3][3] = { { "m00", "m01", "m02" }, { "m10", "m11", "m12" }, { "m20", "m21", "m22" } };
		for (int row = 0; row < 3; ++row)
			for (int col = 0; col < 3; ++col)
				ar& make_nvp(tag[row][col], m(row, col));
	}

	template <class Archive> void serialize(Archive& ar, yade::Quaternionr& q, unsigned)
	{
		ar& make_nvp("w", q.w());
		ar& make_nvp("x", q.x());
		ar& make_nvp("y", q.y());
		ar& make_nvp("z", q.z());
	}

	template <class Archive> void serialize(Archive& ar, yade::Se3r& placement, unsigned)
	{
		ar& make_nvp("position", placement.position);
		ar& make_nvp("orientation", placement.orientation);
	}

} // namespace serialization
} // namespace boost
