// SPDX-License-Identifier: Apache-2.0
/// @file MonotoneLevels.h
/// @brief No level has a larger error than a coarser one.
///
/// Levels are found one by one, or are cuts of one forest, and more balls need not be better: four
/// balls of a torus hold more than one. Such a level becomes a copy of the coarser one, with fewer
/// balls than it may have. Each copy hangs below its original, and has the children that the
/// original's children had. So a chain goes on through the copy, which holds what the original
/// holds.

#pragma once

#include "TightLevels.h"
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param levels   finest first
/// @param covered  how many voxels each level covers, all of the object among them; nothing:
///                 unknown, and the level stays as it is
/// @return the levels, with copies of coarser ones where these cover less. Balls without a child
///         are dropped, as no chain needs them.
std::vector<TightLevel> monotoneLevels(
    std::vector<TightLevel> levels, std::vector<std::optional<int64_t>> covered);

/// @brief The same, with what levels cover counted. All leaf balls stay, even given ones that reach
/// far out of the object; and all levels do if a bound on the finest one's distances would be lost.
/// @param leafBalls  how many the object has; 0 if no level has them all
/// @param tree       as of errorOf() (BoundedErrors.h)
std::vector<TightLevel> monotoneLevels(const std::vector<TightLevel>& levels, std::size_t leafBalls,
    const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
