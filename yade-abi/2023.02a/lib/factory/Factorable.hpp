// SPDX-License-Identifier: GPL-2.0-or-later
//
// Root of YADE's objects: what the class factory can make by name.
#pragma once

#include <lib/base/Math.hpp>

#include <boost/enable_shared_from_this.hpp>

namespace yade {

class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
	Factorable() { }
	virtual ~Factorable();
	virtual std::string getBaseClassName(unsigned int = 0) const; // "" past the last base
	virtual int         getBaseClassNumber() const;
	virtual std::string getClassName() const;
};
YADE_ABI_SIZE(Factorable, 24)

} // namespace yade
