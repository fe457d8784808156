// SPDX-License-Identifier: Apache-2.0
/// @file CoarserLevel.h
/// @brief A level above a finished one (quality=best).
///
/// First its balls have to hold the power cells of the finer balls, each cell as a whole. A search is
/// free to choose which ball holds which cell. The ball that holds a cell becomes the parent of the
/// finer ball. Then parents are fixed. Now a ball must hold only those voxels of its children's regions
/// that no other ball holds for children of its own.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param finer    without parents; receives them
/// @param regions  of its balls: the voxels with a chain of balls from them down; receives those of
///                 the new level
/// @param count    of balls, at most
TightLevel coarserLevel(
    TightLevel& finer, std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
