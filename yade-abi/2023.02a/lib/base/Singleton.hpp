// SPDX-License-Identifier: GPL-2.0-or-later
//
// The one object of a class. Declared only: both the pointer and the function that fills it live in libyade.so.
#pragma once

template <class T> struct Singleton {
	static T* self;
	static T& instance();
};
