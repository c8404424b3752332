// SPDX-License-Identifier: GPL-2.0-or-later
//
// Numbering of classes for dispatch. There are six families (Shape, Material, State, Bound, IGeom, IPhys), each with a counter.
// YADE exports no table of virtual functions for this class: it is kept pure here, and the order of the functions is what matters.
#pragma once

#include <lib/base/AbiAssert.hpp>

namespace yade {

class Indexable {
public:
	virtual void incrementMaxCurrentlyUsedClassIndexOfKin() = 0;
	virtual int& modifyClassIndex()                         = 0;
	virtual ~Indexable() { }
	virtual const int& getClassIndex() const                      = 0;
	virtual const int& getBaseClassIndex(int) const               = 0;
	virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const = 0;

protected:
	/// To be called by the constructor of every class below the top of a family: its first object takes the next free number.
	void createIndex()
	{
		int& index = modifyClassIndex();
		if (index >= 0) return;
		index = getMaxCurrentlyUsedClassIndexOfKin() + 1;
		incrementMaxCurrentlyUsedClassIndexOfKin();
	}
};
YADE_ABI_SIZE(Indexable, 8)

} // namespace yade

/// In a class of the plugin that takes part in dispatch.
#define REGISTER_CLASS_INDEX(Class, Base)                                                                                                                      \
private:                                                                                                                                                       \
	static int& classIndexOfThisClass()                                                                                                                    \
	{                                                                                                                                                      \
		static int index = -1;                                                                                                                         \
		return index;                                                                                                                                  \
	}                                                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	static const int& getClassIndexStatic() { return classIndexOfThisClass(); }                                                                            \
	int&              modifyClassIndex() override { return classIndexOfThisClass(); }                                                                      \
	const int&        getClassIndex() const override { return classIndexOfThisClass(); }                                                                   \
	const int&        getBaseClassIndex(int depth) const override { return depth == 1 ? Base::getClassIndex() : Base::getBaseClassIndex(depth - 1); }

// In YADE's own classes; those at the top of a family list the functions in another order than Indexable does.
#define YADE_HOST_INDEX                                                                                                                                        \
	int&       modifyClassIndex() override;                                                                                                                \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int) const override;

#define YADE_HOST_INDEX_TOP                                                                                                                                    \
	YADE_HOST_INDEX                                                                                                                                        \
	const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                                                        \
	void       incrementMaxCurrentlyUsedClassIndexOfKin() override;
