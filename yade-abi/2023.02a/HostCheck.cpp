// SPDX-License-Identifier: GPL-2.0-or-later
//
// Asks the running YADE, before any class is registered, whether it is the one that this library was compiled for: its version,
// and the size and defaults of objects that it makes itself. A YADE of another version, or a library compiled with flags that
// change the layout, is found here whether YADE opens the library while starting or a script imports it.

#include <core/Aabb.hpp>
#include <core/Interaction.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/DemXDofGeom.hpp>
#include <pkg/dem/FrictPhys.hpp>

#include <boost/python/extract.hpp>
#include <boost/python/import.hpp>

#include <cstdlib>
#include <malloc.h>

namespace yade {
namespace {

	/// Bytes that the allocator gives for a request: sizes can only be compared after its rounding.
	std::size_t allocated(std::size_t bytes)
	{
		void*             block = std::malloc(bytes);
		const std::size_t got   = malloc_usable_size(block);
		std::free(block);
		return got;
	}

	/// An object made by YADE, or null with a message if it is not what we take it for.
	template <class Class> shared_ptr<Class> make(const std::string& name, std::string& mismatch)
	{
		constexpr std::size_t slack = 16; // the allocator does not split off a smaller rest
		try {
			const shared_ptr<Factorable> made = ClassFactory::instance().createShared(name);
			const std::size_t            has  = malloc_usable_size(dynamic_cast<void*>(made.get()));
			const std::size_t            want = allocated(sizeof(Class));
			if (has < want || has > want + slack)
				mismatch = name + " objects have about " + std::to_string(has) + " bytes in YADE, " + std::to_string(sizeof(Class)) + " in the plugin";
			const shared_ptr<Class> cast = boost::dynamic_pointer_cast<Class>(made);
			if (!cast && mismatch.empty()) mismatch = "YADE's class " + name + " is another than the plugin's";
			if (mismatch.empty()) return cast;
		} catch (const std::exception& e) {
			mismatch = "YADE has no class " + name + " (" + e.what() + ")";
		}
		return {};
	}

	std::string versionMismatch()
	{
		if (!Py_IsInitialized() || !PyGILState_Check()) return {};
		std::string running;
		try {
			running = py::extract<std::string>(py::import("yade.config").attr("version"))();
		} catch (const py::error_already_set&) {
			PyErr_Clear();
			return "the running program does not say which version of YADE it is";
		}
		if (running == YADE_BRICK_YADE_VERSION) return {};
		return "this is YADE " + running + ", the plugin was built for " YADE_BRICK_YADE_VERSION;
	}

	std::string layoutMismatch()
	{
		std::string mismatch;
		// data classes only: engines need a scene, which does not exist yet when YADE opens its libraries
		make<Sphere>("Sphere", mismatch);
		make<Box>("Box", mismatch);
		make<Wall>("Wall", mismatch);
		make<Aabb>("Aabb", mismatch);
		make<GenericSpheresContact>("GenericSpheresContact", mismatch);
		make<FrictPhys>("FrictPhys", mismatch);
		make<Body>("Body", mismatch);
		const shared_ptr<FrictMat> material = make<FrictMat>("FrictMat", mismatch);
		const shared_ptr<State>    state    = make<State>("State", mismatch);
		if (!mismatch.empty()) return mismatch;
		if (material->density != 1000 || material->poisson != .25) return "the defaults of FrictMat are not where the plugin expects them";
		if (state->refOri.w() != 1 || state->densityScaling != -1 || &state->pos != &state->se3.position)
			return "the defaults of State are not where the plugin expects them";
		return {};
	}

} // namespace

const std::string& hostMismatch()
{
	static const std::string mismatch = [] {
		const std::string version = versionMismatch();
		const std::string found   = version.empty() ? layoutMismatch() : version;
		return found.empty() ? found
		                     : found
		                + ". Nothing was registered. Build yade-brick again with its own CMakeLists.txt, which sets the flags YADE needs, on the "
		                  "machine whose YADE you run";
	}();
	return mismatch;
}

} // namespace yade
