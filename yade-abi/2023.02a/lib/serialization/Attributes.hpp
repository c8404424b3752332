// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is done with the attributes of a class: archive, set by name, list, show to Python. Every class offers its attributes to a
// visitor, called with (name, pointer to member, flags, documentation), a plain pointer where all objects share the attribute; the
// visitors are here, so that the macros of Serializable.hpp stay short.
#pragma once

#include <lib/factory/Factorable.hpp>

#include <boost/python/class.hpp>
#include <boost/python/dict.hpp>
#include <boost/python/docstring_options.hpp>
#include <boost/python/make_constructor.hpp>
#include <boost/python/object.hpp>
#include <boost/python/raw_function.hpp>
#include <boost/python/scope.hpp>
#include <boost/python/tuple.hpp>

#include <type_traits>

namespace yade {

/// May be combined with |.
namespace Attr {
	enum flags {
		noSave          = 1,  // not archived
		readonly        = 2,  // no assignment from Python; constructor keywords still set it
		triggerPostLoad = 4,  // assignment from Python runs postLoad
		hidden          = 8,  // archived, but not shown to Python
		noResize        = 16, // a hint for editors
	};
}

namespace detail {

	constexpr int attrFlags(int flags = 0) { return flags; } // the flags of an attribute may be left out

	/// Types that Python gets by reference, so that `object.vector[0] = 1` changes the object. All others go by value.
	template <class T> struct ByReference : std::false_type { };
	template <> struct ByReference<Vector2r> : std::true_type { };
	template <> struct ByReference<Vector2i> : std::true_type { };
	template <> struct ByReference<Vector3r> : std::true_type { };
	template <> struct ByReference<Vector3i> : std::true_type { };
	template <> struct ByReference<Matrix3r> : std::true_type { };
	template <> struct ByReference<Quaternionr> : std::true_type { };

	template <class Archive, class Class> struct ArchiveAttr {
		Archive& archive;
		Class&   object;
		template <class Member> void operator()(const char* name, Member Class::*member, int flags, const std::string&)
		{
			if (!(flags & Attr::noSave)) archive& boost::serialization::make_nvp(name, object.*member);
		}
		template <class Member> void operator()(const char* name, Member* shared, int flags, const std::string&)
		{
			if (!(flags & Attr::noSave)) archive& boost::serialization::make_nvp(name, *shared);
		}
	};

	template <class Class> struct SetAttr {
		Class&             object;
		const std::string& wanted;
		const py::object&  value;
		bool               found;
		template <class Member> void operator()(const char* name, Member Class::*member, int, const std::string&)
		{
			if (found || wanted != name) return;
			object.*member = py::extract<Member>(value)();
			found          = true;
		}
		template <class Member> void operator()(const char* name, Member* shared, int, const std::string&)
		{
			if (found || wanted != name) return;
			*shared = py::extract<Member>(value)();
			found   = true;
		}
	};

	template <class Class> struct ListAttr {
		const Class& object;
		py::dict&    list;
		template <class Member> void operator()(const char* name, Member Class::*member, int flags, const std::string&)
		{
			if (!(flags & Attr::hidden)) list[name] = py::object(object.*member);
		}
		template <class Member> void operator()(const char* name, Member* shared, int flags, const std::string&)
		{
			if (!(flags & Attr::hidden)) list[name] = py::object(*shared);
		}
	};

	/// A value that postLoad refuses by throwing is taken back, so that a script that catches the error goes on with a valid object.
	template <class Class, class Member> struct Assign {
		Member Class::*member;
		bool           runPostLoad;
		void           operator()(Class& object, const Member& value) const
		{
			const Member before = object.*member;
			object.*member      = value;
			try {
				if (runPostLoad) object.callPostLoad();
			} catch (...) {
				object.*member = before;
				throw;
			}
		}
	};

	template <class Class, class PyClass> struct ShowAttr {
		PyClass& pyClass;
		template <class Member> void operator()(const char* name, Member Class::*member, int flags, const std::string& doc)
		{
			if (flags & Attr::hidden) return;
			const std::string text = doc + " :yattrflags:`" + std::to_string(flags) + "` ";
			py::object        get;
			if constexpr (ByReference<Member>::value) get = py::make_getter(member);
			else
				get = py::make_getter(member, py::return_value_policy<py::return_by_value>());
			if (flags & Attr::readonly) {
				pyClass.add_property(name, get, text.c_str());
				return;
			}
			const Assign<Class, Member> assign { member, bool(flags & Attr::triggerPostLoad) };
			using Signature = boost::mpl::vector3<void, Class&, const Member&>;
			pyClass.add_property(name, get, py::make_function(assign, py::default_call_policies(), Signature()), text.c_str());
		}
		/// Boost.Python has no documentation for what the class itself has: see classDocumentation.
		template <class Member> void operator()(const char* name, Member* shared, int flags, const std::string&)
		{
			if (flags & Attr::hidden) return;
			py::object get;
			if constexpr (ByReference<Member>::value) get = py::make_getter(shared);
			else
				get = py::make_getter(shared, py::return_value_policy<py::return_by_value>());
			if (flags & Attr::readonly) pyClass.add_static_property(name, get);
			else
				pyClass.add_static_property(name, get, py::make_setter(shared));
		}
	};

	/// Documentation of a class with that of its shared attributes, in the form in which YADE's GUI looks for it.
	template <class Class> std::string classDocumentation(std::string text)
	{
		text += "\n\n";
		Class::visitAttrs([&text](const char* name, const auto&, int flags, const std::string& doc) {
			const std::string given = doc.substr(doc.find(":ydefault:`") + 11), initial = given.substr(0, given.find('`'));
			text += ".. ystaticattr:: " + Class().getClassName() + "." + name + "(=" + initial + ")\n\n\t" + doc + " :yattrflags:`" + std::to_string(flags)
			        + "` \n\n";
		});
		return text;
	}

	/// __init__(self, *positional, **attributes). As in YADE, positional arguments are for pyHandleCustomCtorArgs only.
	template <class Class> shared_ptr<Class> construct(py::tuple positional, py::dict attributes)
	{
		shared_ptr<Class> made(new Class);
		made->pyHandleCustomCtorArgs(positional, attributes);
		if (py::len(positional) > 0)
			throw std::runtime_error(
			        made->getClassName() + " takes keyword arguments only (" + std::to_string(py::len(positional)) + " positional given)");
		if (py::len(attributes) > 0) made->pyUpdateAttrs(attributes);
		return made;
	}

	struct Init {
		py::object construct;
		py::object operator()(py::tuple args, py::dict keywords) const
		{
			return construct(py::object(args[0]), py::tuple(args.slice(1, py::_)), keywords);
		}
	};

	template <class Class> py::object initFunction() { return py::raw_function(Init { py::make_constructor(&construct<Class>) }, 1); }

} // namespace detail
} // namespace yade
