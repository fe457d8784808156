// SPDX-License-Identifier: Apache-2.0
/// @file SearchedLevels.h
/// @brief The levels of quality=best, from the middle out.
///
/// 1. The middle level is searched by itself (FreeLevel.h).
/// 2. Coarser levels come from the level below them (CoarserLevel.h).
/// 3. Finer levels come from the leaf balls, and are bound to the levels above them: what a ball
///    holds counts only where its ancestors hold it (FinerLevel.h).
///
/// If the finest level is to be all leaf balls, the others come from it by step 2.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tight/region/LeafBalls.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param forest  of the leaf balls, for the start of the middle level
/// @param counts  of balls, finest first, falling
/// @param leaves  of the forest
/// @param middle  index of the level to begin with
std::vector<TightLevel> searchedLevels(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const LeafBalls& leaves, std::size_t middle,
    const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
