// SPDX-License-Identifier: Apache-2.0
/// @file BoundedErrors.h
/// @brief Errors of a level that a budget bounds, as those of a tree of this level alone.

#pragma once

#include "LevelCounts.h"
#include "TightLevels.h"
#include <openvdb_spheretree/measure/LevelMeter.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::tight {

/// @param level  has no parents
/// @param tree   with settings, object and transform, and without nodes; a copy, to which the level
///               is appended
/// @return those figures that the settings bound.
BoundedError errorOf(const TightLevel& level, SphereTree tree, const detail::LevelMeter& meter,
    openvdb::util::NullInterrupter* interrupter);

/// @param tree  as of errorOf()
/// @return whether the level is within the bounds of the settings; true if there are none.
bool keepsBounds(const TightLevel& level, const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
