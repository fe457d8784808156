// SPDX-License-Identifier: Apache-2.0
/// @file FinerLevel.h
/// @brief A level below a finished one (quality=best). A voxel in a ball counts only if all ancestors of
/// the ball hold it, too.
///
/// There is a group of balls for each ball of the coarser level: its children. First the leaf balls are
/// dealt out. A leaf ball goes to the group whose region has the most of its power cell. If a part of
/// the cell is left, another group gets the leaf ball as well. Then each group is merged by itself,
/// with slack (SlackMerging.h). An outside voxel in balls of several groups costs only once.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// The leaf balls and their power cells.
struct BallCells {
    std::vector<ExactSphere> balls;
    std::vector<VoxelRegion> cells; ///< each in its ball; together the object, no voxel twice
};

/// @return for each ball of @a level the voxels that it and its ancestors hold.
/// @param above  those of the next coarser level; empty if there is none
std::vector<VoxelRegion> chainRegions(
    const TightLevel& level, const std::vector<VoxelRegion>& above, const LevelMaker& maker);

/// Deals a cover out to the groups below a finished level.
/// @param cells    of the cover's balls
/// @param regions  the chainRegions() of @a coarser: together the object
/// @return the balls with their groups; a ball whose cell lies in several comes several times.
std::vector<CoverBall> dealtOut(const BallCells& cells, const TightLevel& coarser,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker);

/// @param balls      that are dealt out
/// @param count      no less than there are groups
/// @param areInside  the balls have no voxel outside the object
/// @return at most @a count of them, or balls that they were merged to within their groups.
std::vector<CoverBall> mergedInGroups(const std::vector<CoverBall>& balls,
    const std::vector<VoxelRegion>& regions, int64_t count, bool areInside,
    const LevelMaker& maker);

/// @param coarser  whose balls become parents
/// @param regions  its chainRegions(): together the object
/// @param count    of balls, at most
TightLevel finerLevel(const TightLevel& coarser, const std::vector<VoxelRegion>& regions,
    const BallCells& leafBalls, int64_t count, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
