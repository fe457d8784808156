// SPDX-License-Identifier: Apache-2.0
/// @file FinerLevel.h
/// @brief A level below a finished one (quality=best): what a ball holds counts where all of its
/// ancestors hold it, too.
///
/// The leaves are dealt out to groups, one for each ball of the coarser level: a leaf goes to the
/// group whose region has the most of its cell. Where a part of the cell is left, another group gets
/// the leaf as well. A group is merged by itself, with slack, and costs are common to all.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// The leaves, and how the object is shared among them.
struct BallCells {
    std::vector<FineBall> balls;
    std::vector<VoxelRegion> cells; ///< disjoint, each in its ball; together the object
};

/// @return for each ball of @a level the voxels that it and its ancestors hold.
/// @param above  those of the next coarser level; empty if there is none
std::vector<VoxelRegion> chainRegions(
    const TightLevel& level, const std::vector<VoxelRegion>& above, const LevelMaker& maker);

/// @param coarser  whose balls become parents
/// @param regions  its chainRegions(): together the object
/// @param count    of balls, at most
TightLevel finerLevel(const TightLevel& coarser, const std::vector<VoxelRegion>& regions,
    const BallCells& leaves, int64_t count, const LevelMaker& maker);

} // namespace tight
} // namespace openvdb_spheretree
