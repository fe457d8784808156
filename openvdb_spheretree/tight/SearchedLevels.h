// SPDX-License-Identifier: Apache-2.0
/// @file tight/SearchedLevels.h
/// @brief The levels of quality=best: each is searched by itself, from the finest one up.
///
/// 1. The finest level, unless it is all leaves, is a cut of the merge forest, searched with the
///    voxels as what has to be covered. This is where freedom counts most: it is not bound to any
///    level above or below.
/// 2. Its cells, the voxels that each ball covers best, are the units of the next coarser level: the
///    balls of that level start from merging them, and are searched such that every unit is held as
///    a whole by some ball. The best of these becomes the parent.
/// 3. The units of a ball together are a unit of the next level; and so on.
///
/// A voxel's chain is the ball of its cell and that one's ancestors, each of which holds the unit it
/// is in.

#pragma once

#include "../MedialAxis.h"
#include "CoverSearch.h"
#include "MergeForest.h"
#include "SampledObject.h"
#include "TightLevels.h"

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// @param forest  of the leaves, for the start of the finest level
/// @param counts  of balls, finest first, falling
/// @param leaves  the leaves of the forest
std::vector<TightLevel> searchedLevels(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& leaves,
    const SampledObject& object, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
