// SPDX-License-Identifier: GPL-2.0-or-later
// Asks for memory that will be read soon. YADE's bodies and interactions are spread over the heap; in a large scene each would be waited for.
#pragma once

#include <core/Scene.hpp>

namespace yade {

/// The first bytes of an object.
inline void prefetch(const void* object, std::size_t bytes)
{
	constexpr std::size_t line = 64;
	for (std::size_t at = 0; at < bytes; at += line)
		__builtin_prefetch(static_cast<const char*>(object) + at);
}

/// Whether a scene does not fit into the caches next to a core, so that asking ahead is worth its own time.
inline bool isLarge(const Scene& scene) { return scene.interactions->size() > 4000; }

/// What the loop over interactions will read next. Other threads may be changing these interactions: of them only addresses are read, to be looked up ahead.
/// @param geomBytes, physBytes that will be read of geometry and physics
inline void prefetchFollowing(const Scene& scene, const Interaction& I, std::size_t geomBytes, std::size_t physBytes)
{
	if (!isLarge(scene)) return;
	constexpr std::size_t far = 8, near = 4; // a chain of two reads: the interaction, then what it points at
	const auto&           all  = *scene.interactions;
	const std::size_t     here = I.linIx, count = scene.interactions->size();
	if (here + far < count) prefetch(all[here + far].get(), sizeof(Interaction));
	if (here + near >= count) return;
	const Interaction& next = *all[here + near];
	if (!next.phys) return;
	prefetch(next.geom.get(), geomBytes);
	prefetch(next.phys.get(), physBytes);
}

} // namespace yade
