// SPDX-License-Identifier: Apache-2.0
/// @file VoxelBlocks.h
/// @brief The object as a few thousand weighted points: the voxels of each block of 2^k voxels a
/// side, k as small as a bound on their number allows.
///
/// Each block with a voxel becomes one point, in the middle of its voxels, and as heavy as they are
/// many. So thin parts stay, whatever the blocks' size. Cost: one pass over the voxels.

#pragma once

#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

struct VoxelBlock {
    int64_t center[3]; ///< of its voxels, 1/16 voxel, rounded
    int64_t voxels = 0;
};

/// @param most  blocks, at least 8: blocks on both sides of the origin are never one
/// @return the blocks, by place; none of an empty object.
std::vector<VoxelBlock> voxelBlocks(const SampleLevel& object, std::size_t most);

} // namespace openvdb_spheretree::tight
