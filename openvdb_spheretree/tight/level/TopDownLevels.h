// SPDX-License-Identifier: Apache-2.0
/// @file TopDownLevels.h
/// @brief Levels of few balls, from the coarsest to the finest, each inside the regions of the one
/// above it.
///
/// Where balls are few, the start decides what a search finds. So there are several, and each level
/// begins with what is best for it alone:
/// 1. Starts are a cover of the object by as many balls, bound to nothing (FreeCovers.h), and those
///    around clusters of voxels (ClusterCover.h), which see the whole object: of a box or a torus
///    nothing tells merges where the cuts between few balls should be.
/// 2. The cheapest starts are dealt out to the groups of the level above (GroupedCover.h), merged
///    to the count within these, and placed anew until nothing changes. The coarsest level is bound
///    to nothing.
/// 3. The best of them is searched (CoverSearch.h) where time allows it.
/// 4. A level that would cost more than the one above it, or than one ball, is a copy of that.
/// 5. Other levels of the same counts may be given, such as those of less quality; their balls are
///    starts as well. A level may still cost more than its given one, as it is bound to other balls
///    above it. Then the given levels take the place of all that are coarser, and the level is made
///    again below these, with its given balls as a start.
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

/// @param counts        of balls, finest first, falling; at most kFewOnCoarse of them
/// @param free          of the same object
/// @param withClusters  try balls around clusters, too
/// @param quality       how many starts there are, and how long the best is searched
/// @param given         levels of the same counts, or none
/// @return the levels. None costs more than the given one, counted on samples, before balls without
/// a child are dropped.
std::vector<TightLevel> topDownLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker,
    const std::vector<TightLevel>& given = {});

} // namespace openvdb_spheretree::tight
