// SPDX-License-Identifier: GPL-2.0-or-later
//
// All interactions, real and potential; each also stands in Body::intrs of both bodies.
#pragma once

#include <core/Interaction.hpp>

namespace yade {

class InteractionContainer : public Serializable {
	using List = std::vector<shared_ptr<Interaction>>;

	List                                 linIntrs, sortedIntrs;
	const std::vector<shared_ptr<Body>>* bodies;
	std::size_t                          currSize;
	shared_ptr<Interaction>              empty;
	List                                 interaction;

public:
	using iterator = List::iterator;

	bool       dirty;
	std::mutex drawloopmutex;
	bool       serializeSorted;
	long       iterColliderLastRun;

	InteractionContainer() = delete; // the scene has one
	~InteractionContainer() override;

	iterator                       begin() { return linIntrs.begin(); }
	iterator                       end() { return linIntrs.end(); }
	std::size_t                    size() { return currSize; }
	shared_ptr<Interaction>&       operator[](std::size_t i) { return linIntrs[i]; }
	const shared_ptr<Interaction>& operator[](std::size_t i) const { return linIntrs[i]; }

	bool                           insert(Body::id_t, Body::id_t);
	bool                           insert(const shared_ptr<Interaction>&); // false if present; the bodies must exist
	bool                           erase(Body::id_t, Body::id_t, int linPos);
	const shared_ptr<Interaction>& find(Body::id_t, Body::id_t); // in any order; null if there is none
	void                           requestErase(Body::id_t, Body::id_t);
	void                           requestErase(const shared_ptr<Interaction>&);
	void                           requestErase(Interaction*);

	friend struct InteractionContainerLayout;
};
struct InteractionContainerLayout {
	YADE_ABI_SIZE(InteractionContainer, 192)
	YADE_ABI_OFFSET(InteractionContainer, linIntrs, 24)
	YADE_ABI_OFFSET(InteractionContainer, currSize, 80)
	YADE_ABI_OFFSET(InteractionContainer, dirty, 128)
	YADE_ABI_OFFSET(InteractionContainer, iterColliderLastRun, 184)
};

} // namespace yade
