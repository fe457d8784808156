// SPDX-License-Identifier: Apache-2.0
/// @file GroupedCover.h
/// @brief A cover in groups: one for each ball of a finished level, and the balls of a group are to
/// be its children. A voxel in a ball counts only if all ancestors of the ball hold it, too.
///
/// Balls of a cover that knows nothing of the level are dealt out. A ball goes to the group whose
/// region has the most of its power cell. If a part of the cell is left, another group gets the
/// ball as well, and so on. An outside voxel in balls of several groups costs only once.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// Balls with their groups, and what each is to hold: voxels in the ball and in its group's region,
/// no voxel twice. A ball may be in several groups.
struct GroupedCover {
    std::vector<CoverBall> balls;
    std::vector<VoxelRegion> cells;
};

/// @param balls    together they hold the object
/// @param coarser  the finished level
/// @param regions  its chainRegions() (LevelRegions.h): together the object
GroupedCover dealtOut(const std::vector<ExactSphere>& balls, const TightLevel& coarser,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
