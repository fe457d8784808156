// SPDX-License-Identifier: Apache-2.0
/// @file LevelRegions.h
/// @brief The voxels of a level's balls that have a chain: up to the coarsest level, or down to the
/// finest one.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @return for each ball of @a level the voxels that it and its ancestors hold.
/// @param above  those of the next coarser level; empty if there is none
std::vector<VoxelRegion> chainRegions(
    const TightLevel& level, const std::vector<VoxelRegion>& above, const LevelMaker& maker);

/// @return for each of @a count parents the union of its children's regions.
std::vector<VoxelRegion> regionsBelow(const std::vector<VoxelRegion>& regions,
    const std::vector<int32_t>& parents, std::size_t count, const LevelMaker& maker);

/// @return of each ball of a level those voxels of its children's regions that it holds; none of an
/// empty ball.
/// @param regions, parents  of the balls of the next finer level
std::vector<VoxelRegion> heldBelow(const std::vector<ExactSphere>& balls,
    const std::vector<VoxelRegion>& regions, const std::vector<int32_t>& parents,
    const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
