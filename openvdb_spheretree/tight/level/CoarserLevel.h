// SPDX-License-Identifier: Apache-2.0
/// @file CoarserLevel.h
/// @brief A level above a finished one (quality=best).
///
/// First its balls hold the finer one's cells as wholes: which ball holds which cell is free, and
/// that decides who is whose child. Then parents are settled, and a ball owes only those voxels of
/// its children's regions that no other ball of the level has from its own children.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// @param finer    without parents; receives them
/// @param regions  of its balls: the voxels that have a chain of balls from them down; those of the
///                 new level in the end
/// @param count    of balls, at most
TightLevel coarserLevel(
    TightLevel& finer, std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker);

} // namespace tight
} // namespace openvdb_spheretree
