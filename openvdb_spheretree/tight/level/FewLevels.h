// SPDX-License-Identifier: Apache-2.0
/// @file FewLevels.h
/// @brief Levels of few balls, found without merging the leaf balls.
///
/// Where balls are few, the start decides what a search finds, and merges of leaf balls are a poor start:
/// each decides for the two balls that it replaces, and of a box or a torus nothing tells them where the
/// cuts between few balls should be. Clusters of voxels see the whole object, and cost milliseconds.
/// 1. The coarsest level comes first, and is bound to no other one. Starts are balls around clusters
///    of voxels (ClusterCover.h), from several seeds, and balls around many more clusters, merged.
/// 2. The cheapest starts are placed anew until nothing changes, and the best of them is searched
///    (CoverSearch.h).
/// 3. Finer levels are found in the same way, but bound to the level above: what a ball holds counts only
///    where its ancestors hold it (FinerLevel.h). The start is dealt out to the balls of that level.
/// 4. A level that would cost more than the one above it, or than one ball, is a copy of that.
///
/// A level may cost more than the same level of less quality where those above it cost less: it is bound to
/// these.
///
/// Cost: by the balls that are asked for, and a few passes over the voxels; not by leaf balls. Costs are
/// counted on samples.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// Up to so many spheres are few.
constexpr int64_t kFewSpheres = 64;

/// @param counts   of balls, finest first, falling
/// @param quality  how many starts there are, and how long the best is searched
std::vector<TightLevel> fewLevels(
    const std::vector<int64_t>& counts, Quality quality, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
