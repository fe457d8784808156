// SPDX-License-Identifier: Apache-2.0
/// @file TopDownLevels.h
/// @brief Levels of few balls, from the coarsest to the finest, each inside the regions of the one above it.
///
/// Where balls are few, the start decides what a search finds. So there are several, and each level begins
/// with what is best for it alone:
/// 1. Starts are a cover of the object by as many balls, bound to nothing (FreeCovers.h), and those around
///    clusters of voxels (ClusterCover.h), which see the whole object: of a box or a torus nothing
///    tells merges where the cuts between few balls should be.
/// 2. The cheapest starts are dealt out to the groups of the level above (GroupedCover.h), merged to the
///    count within these, and placed anew until nothing changes. The coarsest level is bound to nothing.
/// 3. The best of them is searched (CoverSearch.h) where time allows it.
/// 4. A level that would cost more than the one above it, or than one ball, is a copy of that.
///
/// A level may cost more than the same level of less quality where those above it cost less: it is bound to
/// these.
///
/// Cost: by the balls that are asked for, and passes over the voxels; not by leaf balls. Costs are
/// counted on samples.

#pragma once

#include "FreeCovers.h"
#include "LevelMaker.h"
#include "TightLevels.h"

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param counts        of balls, finest first, falling; at most kFewBalls
/// @param free          of the same object
/// @param withClusters  try balls around clusters, too
/// @param quality       how many starts there are, and how long the best is searched
std::vector<TightLevel> topDownLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker);

/// @return whether few balls are not worth the time of another try, from the bottom.
bool areFromTopAlone(const std::vector<int64_t>& counts, Quality quality);

} // namespace openvdb_spheretree::tight
