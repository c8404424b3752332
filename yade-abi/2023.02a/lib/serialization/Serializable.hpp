// SPDX-License-Identifier: GPL-2.0-or-later
//
// Base of all classes with attributes, and the macros by which a class states them. Names, arguments and effects of the macros are
// those of YADE's programmer's manual; a class written with them compiles against YADE's own headers as well.
//
// Attributes are ((type, name, initial value, flags, "documentation")); initial value and flags may be left empty.
#pragma once

#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/Attributes.hpp>

#include <boost/serialization/base_object.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/tuple/elem.hpp>

namespace yade {

/// Hooks around archiving and setting of attributes. A class has its own by a member function of this name, e.g. `void postLoad(Brick&)`.
template <class T> void preLoad(T&) { }
template <class T> void postLoad(T&) { }
template <class T> void preSave(T&) { }
template <class T> void postSave(T&) { }

class Serializable : public Factorable {
public:
	Serializable() { }
	~Serializable() override;

	std::string getBaseClassName(unsigned int = 0) const override;
	int         getBaseClassNumber() const override;
	std::string getClassName() const override;

	virtual void     pySetAttr(const std::string&, const py::object&);
	virtual py::dict pyDict() const;
	virtual py::dict pyDictCustom() const;
	virtual void     callPostLoad();
	virtual void     checkPyClassRegistersItself(const std::string&) const;
	virtual void     pyRegisterClass(py::object scope);
	virtual void     pyHandleCustomCtorArgs(py::tuple& positional, py::dict& keywords);

	void pyUpdateAttrs(const py::dict&); // sets each, then callPostLoad

	template <class Archive> void serialize(Archive&, unsigned) { }
};
YADE_ABI_SIZE(Serializable, 24)

} // namespace yade

// ---------------------------------------------------------------------------------------------------------------------------------
// YADE's own classes: what every one of them overrides, declared so that the bodies in its libraries are used.
#define YADE_HOST_CLASS(Class)                                                                                                                                 \
	~Class() override;                                                                                                                                     \
	std::string    getBaseClassName(unsigned int = 0) const override;                                                                                      \
	int            getBaseClassNumber() const override;                                                                                                    \
	std::string    getClassName() const override;                                                                                                          \
	void           pySetAttr(const std::string&, const ::boost::python::object&) override;                                                                 \
	::boost::python::dict pyDict() const override;                                                                                                         \
	void           callPostLoad() override;                                                                                                                \
	void           pyRegisterClass(::boost::python::object) override;

// What YADE archives of a class: its base, then the members in this order. Its own code comes first at run time; this is the
// description the compiler needs for derived classes, and the same data.
#define YADE_HOST_MEMBER(r, unused, member) ar& boost::serialization::make_nvp(BOOST_PP_STRINGIZE(member), member);
#define YADE_HOST_ARCHIVE(Base, members)                                                                                                                       \
	template <class Archive> void serialize(Archive& ar, unsigned)                                                                                         \
	{                                                                                                                                                      \
		ar& boost::serialization::make_nvp(#Base, boost::serialization::base_object<Base>(*this));                                                     \
		BOOST_PP_SEQ_FOR_EACH(YADE_HOST_MEMBER, ~, members)                                                                                            \
	}

// ---------------------------------------------------------------------------------------------------------------------------------
// The plugin's classes.
#define YADE_ABI_ATTR_TYPE(attr) BOOST_PP_TUPLE_ELEM(5, 0, attr)
#define YADE_ABI_ATTR_NAME(attr) BOOST_PP_TUPLE_ELEM(5, 1, attr)
#define YADE_ABI_ATTR_INIT(attr) BOOST_PP_TUPLE_ELEM(5, 2, attr)
#define YADE_ABI_ATTR_FLAGS(attr) BOOST_PP_TUPLE_ELEM(5, 3, attr)
#define YADE_ABI_ATTR_DOC(attr) BOOST_PP_TUPLE_ELEM(5, 4, attr)

#define YADE_ABI_DECLARE(r, unused, attr) YADE_ABI_ATTR_TYPE(attr) YADE_ABI_ATTR_NAME(attr);
#define YADE_ABI_DECLARE_STATIC(r, unused, attr) static YADE_ABI_ATTR_TYPE(attr) YADE_ABI_ATTR_NAME(attr);
#define YADE_ABI_ASSIGN(r, Class, attr) Class::YADE_ABI_ATTR_NAME(attr) = YADE_ABI_ATTR_TYPE(attr)(YADE_ABI_ATTR_INIT(attr));
#define YADE_ABI_INITIALIZE(r, unused, attr) , YADE_ABI_ATTR_NAME(attr)(YADE_ABI_ATTR_INIT(attr))
#define YADE_ABI_INITIALIZE_OTHER(r, unused, init) , BOOST_PP_TUPLE_ELEM(2, 0, init)(BOOST_PP_TUPLE_ELEM(2, 1, init))
#define YADE_ABI_VISIT(r, Class, attr)                                                                                                                         \
	visit(BOOST_PP_STRINGIZE(YADE_ABI_ATTR_NAME(attr)), &Class::YADE_ABI_ATTR_NAME(attr), ::yade::detail::attrFlags(YADE_ABI_ATTR_FLAGS(attr)),            \
	      std::string(YADE_ABI_ATTR_DOC(attr)) + " :ydefault:`" BOOST_PP_STRINGIZE(YADE_ABI_ATTR_INIT(attr)) "`"                                            \
	      " :yattrtype:`" BOOST_PP_STRINGIZE(YADE_ABI_ATTR_TYPE(attr)) "`");

#define YADE_CLASS_BASE_DOC(Class, Base, doc) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, , , , )
#define YADE_CLASS_BASE_DOC_ATTRS(Class, Base, doc, attrs) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attrs, , , )
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(Class, Base, doc, attrs, ctor) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attrs, , ctor, )
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Class, Base, doc, attrs, ctor, py) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attrs, , ctor, py)

/// @param inits  further members to initialise: ((member, value))((member, value))
/// @param ctor   body of the constructor
/// @param pyDefs chain on the Python class: .def("name", &Class::function, "doc").add_property(...)
#define YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attrs, inits, ctor, pyDefs)                                                                   \
public:                                                                                                                                                        \
	BOOST_PP_SEQ_FOR_EACH(YADE_ABI_DECLARE, ~, attrs)                                                                                                      \
	Class()                                                                                                                                                \
	        : Base() BOOST_PP_SEQ_FOR_EACH(YADE_ABI_INITIALIZE_OTHER, ~, inits) BOOST_PP_SEQ_FOR_EACH(YADE_ABI_INITIALIZE, ~, attrs)                       \
	{                                                                                                                                                      \
		ctor;                                                                                                                                          \
	}                                                                                                                                                      \
	YADE_ABI_CLASS_BODY(Class, Base, doc, attrs, , pyDefs)

/// Attributes that all objects of the class share, such as those of the functors of the 3-D view, which makes its own. They get their initial values when the
/// class is made known to Python; the source file has to define them.
#define YADE_CLASS_BASE_DOC_STATICATTRS(Class, Base, doc, attrs)                                                                                               \
public:                                                                                                                                                        \
	BOOST_PP_SEQ_FOR_EACH(YADE_ABI_DECLARE_STATIC, ~, attrs)                                                                                               \
	YADE_ABI_CLASS_BODY(Class, Base, ::yade::detail::classDocumentation<Class>(doc).c_str(), attrs, BOOST_PP_SEQ_FOR_EACH(YADE_ABI_ASSIGN, Class, attrs), )

// What every class overrides.
// @param begin statements before the class is made known to Python
#define YADE_ABI_CLASS_BODY(Class, Base, doc, attrs, begin, pyDefs)                                                                                            \
	std::string getClassName() const override { return #Class; }                                                                                           \
	std::string getBaseClassName(unsigned int i = 0) const override { return i == 0 ? #Base : ""; }                                                        \
	int         getBaseClassNumber() const override { return 1; }                                                                                          \
	template <class Visitor> static void visitAttrs(Visitor&& visit)                                                                                       \
	{                                                                                                                                                      \
		(void)visit;                                                                                                                                   \
		BOOST_PP_SEQ_FOR_EACH(YADE_ABI_VISIT, Class, attrs)                                                                                            \
	}                                                                                                                                                      \
	void pySetAttr(const std::string& name, const ::boost::python::object& value) override                                                                 \
	{                                                                                                                                                      \
		::yade::detail::SetAttr<Class> set { *this, name, value, false };                                                                              \
		visitAttrs(set);                                                                                                                               \
		if (!set.found) Base::pySetAttr(name, value);                                                                                                  \
	}                                                                                                                                                      \
	::boost::python::dict pyDict() const override                                                                                                          \
	{                                                                                                                                                      \
		::boost::python::dict all;                                                                                                                     \
		visitAttrs(::yade::detail::ListAttr<Class> { *this, all });                                                                                    \
		all.update(this->pyDictCustom());                                                                                                              \
		all.update(Base::pyDict());                                                                                                                    \
		return all;                                                                                                                                    \
	}                                                                                                                                                      \
	void callPostLoad() override                                                                                                                           \
	{                                                                                                                                                      \
		Base::callPostLoad();                                                                                                                          \
		postLoad(*this);                                                                                                                               \
	}                                                                                                                                                      \
	void pyRegisterClass(::boost::python::object scope_) override                                                                                          \
	{                                                                                                                                                      \
		using PyClass = ::boost::python::class_<Class, ::boost::shared_ptr<Class>, ::boost::python::bases<Base>, boost::noncopyable>;                  \
		this->checkPyClassRegistersItself(#Class);                                                                                                     \
		begin                                                                                                                                          \
		::boost::python::scope             inScope(scope_);                                                                                            \
		::boost::python::docstring_options noCppSignatures(true, true, false);                                                                         \
		PyClass                            _classObj(#Class, doc);                                                                                     \
		_classObj.def("__init__", ::yade::detail::initFunction<Class>());                                                                              \
		visitAttrs(::yade::detail::ShowAttr<Class, PyClass> { _classObj });                                                                            \
		(void)_classObj pyDefs;                                                                                                                        \
	}                                                                                                                                                      \
	template <class Archive> void serialize(Archive& archive, unsigned)                                                                                    \
	{                                                                                                                                                      \
		if constexpr (Archive::is_loading::value) preLoad(*this);                                                                                      \
		else                                                                                                                                           \
			preSave(*this);                                                                                                                        \
		archive& boost::serialization::make_nvp(#Base, boost::serialization::base_object<Base>(*this));                                                \
		visitAttrs(::yade::detail::ArchiveAttr<Archive, Class> { archive, *this });                                                                    \
		if constexpr (Archive::is_loading::value) postLoad(*this);                                                                                     \
		else                                                                                                                                           \
			postSave(*this);                                                                                                                       \
	}

/// After the class, inside namespace yade. Gives it its name in archives; YADE_PLUGIN does the rest.
#define REGISTER_SERIALIZABLE(Class)                                                                                                                           \
	}                                                                                                                                                      \
	BOOST_CLASS_EXPORT_KEY(yade::Class)                                                                                                                    \
	namespace yade {
