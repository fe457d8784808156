// SPDX-License-Identifier: Apache-2.0
/// @file FarthestVoxel.h
/// @brief The one-sided Hausdorff distance: how far the farthest voxel of a set is from an object.

#pragma once

#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// What is known of a set of voxels once it has been counted.
struct VoxelCount {
    int64_t voxels = 0;
    /// Voxels of the set: one in each eighth of a node of 128 that has any, or one of a tile.
    struct Sample {
        std::size_t node;
        openvdb::Coord voxel;
    };
    std::vector<Sample> samples;
};

VoxelCount countVoxels(const MaskMinus& set, openvdb::util::NullInterrupter* interrupter);

/// @return the largest squared distance, in voxels, of a voxel of @a set to the object; 0 if it has
///         none. Exact (below 2^29 voxels), and the same for any number of threads.
/// @param samples  of the set, by countVoxels()
/// @param mask     the object
/// @param object   the same, as an index
/// @note Cost: where the distance is a few voxels, at most about a microsecond a leaf. Voxels far
///       nearer than the farthest are dismissed by whole nodes. Memory: a node's leaves a thread.
int64_t farthestDistSq(const MaskMinus& set, const std::vector<VoxelCount::Sample>& samples,
    const openvdb::MaskTree& mask, const NearestVoxel& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
