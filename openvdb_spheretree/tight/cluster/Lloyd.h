// SPDX-License-Identifier: Apache-2.0
/// @file Lloyd.h
/// @brief k-means: weighted points in clusters around centers.
///
/// S. Lloyd, "Least squares quantization in PCM", 1982. The first centers are far apart: each is a
/// point, drawn with a chance that goes as its weight times its squared distance to the nearest one
/// so far (D. Arthur and S. Vassilvitskii, "k-means++", 2007); with seed 0 it is always the
/// farthest one (T. Gonzalez 1985).
/// 1. Every point goes to the nearest center; of equal ones, to the first.
/// 2. Every center goes to the middle of its points. One without points goes to the point that is
///    farthest from its own center.
/// 3. That is repeated until no point goes elsewhere, kRounds times at most.
///
/// All in integers, in one thread: the same for the same points. Cost: rounds x points x centers.

#pragma once

#include "VoxelBlocks.h"

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

using FineCenter = std::array<int64_t, 3>; ///< 1/16 voxel

/// @param points  not empty
/// @param count   of clusters, at least 1; of fewer points there are as many as points
/// @param seed    another one begins elsewhere
std::vector<FineCenter> clusterCenters(
    const std::vector<VoxelBlock>& points, std::size_t count, uint64_t seed);

} // namespace openvdb_spheretree::tight
