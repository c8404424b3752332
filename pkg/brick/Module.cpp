// SPDX-License-Identifier: GPL-2.0-or-later
//
// Entry point. The library is opened by YADE while it starts (if it lies in its plugin folder), or by `import yade_brick`: it is
// a Python extension, yade_brick._core, too. In the second case the classes are made known to the running YADE here, after a
// comparison of our class declarations with live objects.

#include <core/Dispatching.hpp>
#include <core/Omega.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/OpenGLRenderer.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <boost/python/extract.hpp>
#include <boost/python/handle.hpp>
#include <boost/python/import.hpp>
#include <boost/python/list.hpp>
#include <boost/python/make_function.hpp>

#include <algorithm>

namespace yade {
namespace {

	using Names = std::vector<std::string>;

#ifdef YADE_BRICK_REAL_HEADERS
	constexpr const char* headers = "source tree";
#else
	constexpr const char* headers = "yade-abi";
#endif

	// Our class names

	std::set<std::string>& namesBefore()
	{
		static std::set<std::string> names;
		return names;
	}

	Names& ownNames()
	{
		static Names names;
		return names;
	}

	// Our classes are those announced between the first and the last static initialiser of this library: the former has an
	// early priority, the latter stands in the file that is linked last (pkg/brick/CMakeLists.txt).
	__attribute__((constructor(101))) void noteNamesBefore()
	{
		const auto& all = ClassFactory::instance().pluginClasses;
		namesBefore().insert(all.begin(), all.end());
	}

	__attribute__((constructor)) void noteOwnNames()
	{
		for (const std::string& name : ClassFactory::instance().pluginClasses)
			if (!namesBefore().count(name)) ownNames().push_back(name);
	}

	// Probe

	[[noreturn]] void refuse(const std::string& why)
	{
		throw std::runtime_error(
		        "yade_brick does not fit the running YADE: " + why + ". Build it again with its own CMakeLists.txt on the machine whose YADE you run.");
	}

	/// One attribute of an object made by YADE: set by YADE's code, read through our declaration, and the reverse.
	template <class Class, class Member>
	void probe(const std::string& className, const char* attribute, Member Class::*member, const Member& first, const Member& second)
	{
		const auto made = boost::dynamic_pointer_cast<Class>(ClassFactory::instance().createShared(className));
		if (!made) refuse("its class " + className + " is another than the plugin's");
		Class& object = *made;
		object.pySetAttr(attribute, py::object(first));
		const bool written        = object.*member == first;
		object.*member            = second;
		const py::dict attributes = object.pyDict();
		if (!written || py::extract<Member>(attributes[attribute])() != second)
			refuse("attribute " + className + "." + attribute + " is not where the plugin expects it");
	}

	void probeLayout()
	{
		const Vector3r    a(1.5, -2.5, 3.25), b(-4.5, 5.125, 6.75);
		const std::string s("first text, too long for the short form"), t("second");
		probe<Shape>("Box", "color", &Shape::color, a, b);
		probe<Shape>("Wall", "highlight", &Shape::highlight, true, false);
		probe("Box", "extents", &Box::extents, a, b);
		probe("Wall", "sense", &Wall::sense, 1, -1);
		probe("Wall", "axis", &Wall::axis, 1, 2);
		probe("State", "vel", &State::vel, a, b);
		probe("State", "mass", &State::mass, 1.5, 2.5);
		probe("State", "inertia", &State::inertia, a, b);
		probe("State", "refOri", &State::refOri, Quaternionr(.5, .5, -.5, .5), Quaternionr(.5, -.5, .5, .5));
		probe("State", "densityScaling", &State::densityScaling, 3.5, 4.5);
		probe<Material>("FrictMat", "label", &Material::label, s, t);
		probe<Material>("FrictMat", "density", &Material::density, 1.5, 2.5);
		probe("FrictMat", "frictionAngle", &FrictMat::frictionAngle, .25, .75);
		probe<Bound>("Aabb", "min", &Bound::min, a, b);
		probe<Bound>("Aabb", "max", &Bound::max, a, b);
		probe("FrictPhys", "normalForce", &NormPhys::normalForce, a, b);
		probe("FrictPhys", "tangensOfFrictionAngle", &FrictPhys::tangensOfFrictionAngle, .25, .75);
		probe("GenericSpheresContact", "contactPoint", &GenericSpheresContact::contactPoint, a, b);
		probe("GenericSpheresContact", "refR2", &GenericSpheresContact::refR2, .25, .75);
		probe("Body", "clumpId", &Body::clumpId, 5, 7);
		probe("Body", "timeBorn", &Body::timeBorn, .25, .75);
		probe<Engine>("ForceResetter", "dead", &Engine::dead, true, false);
		probe<Engine>("ForceResetter", "label", &Engine::label, s, t);
		probe<PartialEngine>("TranslationEngine", "ids", &PartialEngine::ids, { 1, 2 }, { 3 });
		probe<TimeStepper>("GlobalStiffnessTimeStepper", "timeStepUpdateInterval", &TimeStepper::timeStepUpdateInterval, 3u, 4u);
		probe<Functor>("Bo1_Sphere_Aabb", "label", &Functor::label, s, t);
		probe("Scene", "dt", &Scene::dt, .25, .75);
		probe("Scene", "iter", &Scene::iter, 3l, 4l);
		probe("Scene", "trackEnergy", &Scene::trackEnergy, true, false);
		const Scene& now = *Omega::instance().getScene();
		if (now.bodies->getClassName() != "BodyContainer" || now.interactions->getClassName() != "InteractionContainer"
		    || now.energy->getClassName() != "EnergyTracker" || now.cell->getClassName() != "Cell")
			refuse("the parts of the scene are not where the plugin expects them");
	}

	// Registration

	using Descriptors = std::map<std::string, DynlibDescriptor>;

	/// Makes one class known to Python and to the table of inheritance. False if its base is not known to Python yet.
	bool registerClass(const std::string& name, const py::object& wrapper, Descriptors& known)
	{
		const auto object = boost::dynamic_pointer_cast<Serializable>(ClassFactory::instance().createShared(name));
		if (!PyObject_HasAttrString(wrapper.ptr(), object->getBaseClassName().c_str())) return false;
		object->pyRegisterClass(wrapper);
		DynlibDescriptor& descriptor = known[name];
		descriptor.isSerializable    = true;
		for (int i = 0; i < object->getBaseClassNumber(); ++i)
			descriptor.baseClasses.insert(object->getBaseClassName(i));
		return true;
	}

	/// What YADE does while it starts, for those of our classes it has not met; bases before derived classes.
	void registerClasses()
	{
		const py::object wrapper = py::import("yade.wrapper");
		// the table is not const, only the way to it is; YADE offers no public function to add a class
		Descriptors& known   = const_cast<Descriptors&>(Omega::instance().getDynlibsDescriptor());
		Names        waiting = ownNames();
		waiting.erase(std::remove_if(waiting.begin(), waiting.end(), [&](const std::string& n) { return known.count(n) > 0; }), waiting.end());
		if (waiting.empty()) return;
		for (std::size_t before = 0; before != waiting.size();) {
			before = waiting.size();
			waiting.erase(
			        std::remove_if(waiting.begin(), waiting.end(), [&](const std::string& n) { return registerClass(n, wrapper, known); }),
			        waiting.end());
		}
		if (!waiting.empty()) throw std::runtime_error("yade_brick: the base of class " + waiting.front() + " is unknown to YADE");
		OpenGLRenderer::initDone = false; // or the 3-D view, if open, would not know how to treat the new classes
	}

	/// Lets interactions and shapes find their functors in the loop that runs next: YADE keeps those that they met first, whatever O.engines is later.
	void forgetFunctors()
	{
		const Scene& scene = *Omega::instance().getScene();
		for (const auto& I : *scene.interactions) {
			auto& known      = I->functorCache;
			known.geomExists = true; // as far as is known
			known.geom.reset(), known.phys.reset(), known.constLaw.reset();
		}
		for (const auto& b : *scene.bodies)
			if (b && b->shape) b->shape->boundFunctor.reset();
	}

	py::list load()
	{
#ifndef YADE_BRICK_REAL_HEADERS
		if (!hostMismatch().empty()) throw std::runtime_error("yade_brick does not fit the running YADE: " + hostMismatch() + ".");
#endif
		probeLayout();
		registerClasses();
		py::list names;
		for (const std::string& name : ownNames())
			names.append(name);
		return names;
	}

} // namespace
} // namespace yade

extern "C" __attribute__((visibility("default"))) PyObject* PyInit__core()
{
	static PyModuleDef definition = { PyModuleDef_HEAD_INIT,
		                          "_core",
		                          "Names of the classes of yade_brick; what they were compiled with; a helper of the engine loop.",
		                          -1,
		                          nullptr,
		                          nullptr,
		                          nullptr,
		                          nullptr,
		                          nullptr };
	try {
		const boost::python::list names  = yade::load();
		const auto                forget = boost::python::make_function(&yade::forgetFunctors);
		PyObject* const           self   = PyModule_Create(&definition);
		if (self && PyModule_AddObject(self, "classes", boost::python::incref(names.ptr())) == 0
		    && PyModule_AddObject(self, "forgetFunctors", boost::python::incref(forget.ptr())) == 0
		    && PyModule_AddStringConstant(self, "headers", yade::headers) == 0)
			return self;
	} catch (const boost::python::error_already_set&) {
	} catch (const std::exception& e) {
		PyErr_SetString(PyExc_ImportError, e.what());
	}
	return nullptr;
}
