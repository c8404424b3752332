// SPDX-License-Identifier: GPL-2.0-or-later
//
// Makes objects by class name, and YADE_PLUGIN, by which a source file adds its classes.
#pragma once

#include <lib/base/Singleton.hpp>
#include <lib/factory/Factorable.hpp>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>

#include <boost/serialization/export.hpp>

#include <boost/preprocessor/cat.hpp>
#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/seq/seq.hpp>
#include <boost/preprocessor/stringize.hpp>

#include <list>

namespace yade {

class ClassFactory : public Singleton<ClassFactory> {
	void* opaque[17]; // library manager and creators
	ClassFactory() = delete;
	virtual ~ClassFactory();

public:
	bool registerFactorable(std::string name, Factorable* (*)(), shared_ptr<Factorable> (*)(), void* (*)()); // false if the name is taken
	void registerPluginClasses(const char* fileAndNames[]);                                                  // ends with a null pointer
	shared_ptr<Factorable> createShared(std::string name);

	std::list<std::string> pluginClasses; // every name announced so far
};

/// Empty if the running YADE has the object sizes and defaults that this library was compiled for, else what differs.
/// Evaluated once, before the first class is registered (HostCheck.cpp).
const std::string& hostMismatch();

namespace detail {
	template <class Class> struct Creators {
		static Factorable*            plain() { return new Class; }
		static shared_ptr<Factorable> shared() { return shared_ptr<Class>(new Class); }
		static void*                  untyped() { return new Class; }
	};

	/// A library that does not fit adds nothing, so that no code of YADE ever meets its objects.
	template <class Class> void announce(const char* file, const char* name)
	{
		if (!hostMismatch().empty()) return;
		const char* fileAndName[] = { file, name, nullptr };
		ClassFactory::instance().registerFactorable(name, &Creators<Class>::plain, &Creators<Class>::shared, &Creators<Class>::untyped);
		ClassFactory::instance().registerPluginClasses(fileAndName);
	}
} // namespace detail

} // namespace yade

#define YADE_ABI_ARCHIVE_CLASS(r, unused, Class) BOOST_CLASS_EXPORT_IMPLEMENT(yade::Class)
#define YADE_ABI_ANNOUNCE_CLASS(r, unused, Class) ::yade::detail::announce<::yade::Class>(__FILE__, BOOST_PP_STRINGIZE(Class));

/// YADE_PLUGIN((A)(B)): in the source file that defines classes A and B, inside namespace yade.
#define YADE_PLUGIN(classes)                                                                                                                                   \
	}                                                                                                                                                      \
	BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ARCHIVE_CLASS, ~, classes)                                                                                              \
	namespace {                                                                                                                                            \
		__attribute__((constructor)) void BOOST_PP_CAT(announcePluginClasses_, BOOST_PP_SEQ_HEAD(classes))()                                           \
		{                                                                                                                                              \
			BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ANNOUNCE_CLASS, ~, classes)                                                                             \
		}                                                                                                                                              \
	}                                                                                                                                                      \
	namespace yade {
