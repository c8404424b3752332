// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies by id. Erased ids leave holes, which iteration skips and operator[] does not.
#pragma once

#include <core/Body.hpp>

#include <boost/iterator/filter_iterator.hpp>

namespace yade {

class BodyContainer : public Serializable {
	using List = std::vector<shared_ptr<Body>>;
	struct NotEmpty {
		bool operator()(const shared_ptr<Body>& b) const { return bool(b); }
	};

public:
	using iterator = boost::filter_iterator<NotEmpty, List::iterator>;

	List              body;
	bool              dirty, checkedByCollider;
	std::vector<int>  insertedBodies, erasedBodies, realBodies;
	bool              useRedirection, enableRedirection;
	std::vector<int>  subdomainBodies;
	std::mutex        drawloopmutex;

	BodyContainer() = delete; // the scene has one
	~BodyContainer() override;

	iterator                begin() { return iterator(NotEmpty(), body.begin(), body.end()); }
	iterator                end() { return iterator(NotEmpty(), body.end(), body.end()); }
	std::size_t             size() const { return body.size(); } // with holes
	shared_ptr<Body>&       operator[](unsigned id) { return body[id]; }
	const shared_ptr<Body>& operator[](unsigned id) const { return body[id]; }
	bool                    exists(int id) const;
	int                     insert(shared_ptr<Body>);
	bool                    erase(int id, bool eraseClumpMembers);
};
YADE_ABI_SIZE(BodyContainer, 200)
YADE_ABI_OFFSET(BodyContainer, body, 24)
YADE_ABI_OFFSET(BodyContainer, useRedirection, 128)
YADE_ABI_OFFSET(BodyContainer, drawloopmutex, 160)

} // namespace yade
