// SPDX-License-Identifier: Apache-2.0
/// @file BottomUpLevels.h
/// @brief Levels above a finest one that is given: all leaf balls, or the fewest balls within a
/// bound.
///
/// First the balls of a coarser level have to hold the power cells of the finer balls, each cell as
/// a whole. Which ball holds which cell is free: balls are merged, and some levels searched
/// (CoverSearch.h). The ball that a cell is deepest in becomes the parent of the finer ball. Of
/// levels that are searched, children then move to other parents (ChildMoves.h); where balls are
/// large, all that is decided at half the resolution or less (HalvedObject.h). Then parents are
/// fixed. Now a ball must hold only those voxels of its children's regions that no other ball holds
/// for children of its own, and is placed anew.

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

/// @param finest  holds the object
/// @param counts  of balls, finest first, falling; the first is that of @a finest
/// @return all levels, finest first.
std::vector<TightLevel> bottomUpLevels(
    const TightLevel& finest, const std::vector<int64_t>& counts, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
