// SPDX-License-Identifier: GPL-2.0-or-later
//
// Enumerations as attributes: in Python an enumeration that also takes a name or a number, in YADE's GUI a list to choose from.
#pragma once

#include <lib/factory/ClassFactory.hpp>

#include <boost/python/enum.hpp>
#include <boost/python/errors.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>
#include <boost/python/list.hpp>
#include <boost/python/scope.hpp>
#include <boost/python/str.hpp>

namespace yade {
namespace detail {

	/// Conversion of a name or a number. What is none of the enumeration raises ValueError that says what is.
	template <class Enum> struct EnumFromPython {
		using Data = py::converter::rvalue_from_python_stage1_data;

		static py::object& enumeration()
		{
			static py::object* const made = new py::object; // never freed: Python is gone when this library ends
			return *made;
		}

		static void* convertible(PyObject* given) { return PyUnicode_Check(given) || PyLong_Check(given) ? given : nullptr; }

		static void construct(PyObject* given, Data* data)
		{
			const py::object value { py::handle<>(py::borrowed(given)) };
			const py::dict   known { enumeration().attr(PyUnicode_Check(given) ? "names" : "values") };
			if (!known.has_key(value)) {
				const std::string allowed = py::extract<std::string>(py::str(", ").join(py::dict(enumeration().attr("names")).keys()))();
				PyErr_SetString(
				        PyExc_ValueError, (std::string(py::extract<std::string>(py::str(value))()) + " is not known; allowed are " + allowed).c_str());
				py::throw_error_already_set();
			}
			void* const place = reinterpret_cast<py::converter::rvalue_from_python_storage<Enum>*>(data)->storage.bytes;
			new (place) Enum(Enum(py::extract<long>(py::object(known[value]))()));
			data->convertible = place;
		}
	};

	template <class Enum> void showEnum(const char* name, const std::vector<std::pair<const char*, Enum>>& values)
	{
		if (!Py_IsInitialized() || !hostMismatch().empty()) return;
		const py::scope   inYade { py::import("yade") };
		py::enum_<Enum> made(name);
		for (const auto& value : values)
			made.value(value.first, value.second);
		EnumFromPython<Enum>::enumeration() = made;
		py::converter::registry::push_back(&EnumFromPython<Enum>::convertible, &EnumFromPython<Enum>::construct, py::type_id<Enum>());
	}

} // namespace detail
} // namespace yade

#define YADE_ABI_ENUM_VALUE(r, Enum, value) { BOOST_PP_STRINGIZE(value), Enum::value },

/// YADE_ENUM(scope, Type, (a)(b)): in a source file, inside namespace yade; `yade.EnumClass_Type` in Python.
#define YADE_ENUM(Scope, Type, values)                                                                                                                         \
	}                                                                                                                                                      \
	namespace {                                                                                                                                            \
		__attribute__((constructor)) void showEnum##Type()                                                                                             \
		{                                                                                                                                              \
			::yade::detail::showEnum<Scope::Type>("EnumClass_" #Type, { BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ENUM_VALUE, Scope::Type, values) });        \
		}                                                                                                                                              \
	}                                                                                                                                                      \
	namespace yade {
