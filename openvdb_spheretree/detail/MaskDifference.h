// SPDX-License-Identifier: Apache-2.0
/// @file detail/MaskDifference.h
/// @brief The voxels of one mask that another has not, node by node.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// A cube of 8, 128 or 4096 voxels a side with voxels in it: of 8, those of the words (word x, bit
/// 8 y + z); of more, all.
struct VoxelCell {
    openvdb::Coord origin;
    int32_t size = 8;
    uint64_t words[8] = {};

    int64_t voxels() const;
    /// @return the first voxel, x slowest.
    openvdb::Coord first() const;
};

struct MaskDifference {
    int64_t voxels = 0;
    std::vector<VoxelCell> cells; ///< in node order of the first mask
};

/// @return a \ b. Tiles are compared as tiles; a tile is descended only where the other has nodes.
MaskDifference maskDifference(const openvdb::MaskTree& a, const openvdb::MaskTree& b,
    openvdb::util::NullInterrupter* interrupter);

/// @return the topology of @a tree as a mask.
openvdb::MaskTree maskOf(const openvdb::BoolTree& tree);

/// @return the number of active voxels.
int64_t countVoxels(const openvdb::MaskTree& tree);

} // namespace detail
} // namespace openvdb_spheretree
