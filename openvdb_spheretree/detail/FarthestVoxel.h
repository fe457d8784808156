// SPDX-License-Identifier: Apache-2.0
/// @file detail/FarthestVoxel.h
/// @brief The one-sided Hausdorff distance: how far the farthest voxel of a set is from an object.

#pragma once

#include "MaskDifference.h"
#include "NearestVoxel.h"

namespace openvdb_spheretree {
namespace detail {

/// @return the largest squared distance, in voxels, of a voxel of @a cells to the object; 0
///         if there are no cells. Exact (below 2^29 voxels), and the same for any number of
///         threads.
/// @param cells  those of a block of 128 stand together, as maskDifference() leaves them
/// @param mask   the object
/// @param object the same, as an index
/// @note Cost: at most a microsecond or so a cell where the distance is a few voxels; cells far
///       nearer than the farthest are dismissed by the block.
int64_t farthestDistSq(const std::vector<VoxelCell>& cells, const openvdb::MaskTree& mask,
    const NearestVoxel& object, openvdb::util::NullInterrupter* interrupter);

} // namespace detail
} // namespace openvdb_spheretree
