// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where YADE code looks for GenericSpheresContact.
#pragma once

#include <core/Interaction.hpp>
#include <core/State.hpp>
#include <pkg/dem/DemXDofGeom.hpp>
