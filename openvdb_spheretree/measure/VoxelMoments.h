// SPDX-License-Identifier: Apache-2.0
/// @file VoxelMoments.h
/// @brief How many voxels a set has, and the sums of their coordinates and of the products of these,
/// in exact integers.
///
/// A tile has them in closed form, whatever its size; a leaf by rows of eight voxels, from a table of
/// the 256 rows there are. Coordinates fit 32 bits and a count 63, so all sums fit 128.
/// Cost: some hundred operations a leaf, a few a tile.

#pragma once

#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <array>

namespace openvdb_spheretree::detail {

/// Sums over voxels, of the coordinates of their centers in index space.
struct VoxelMoments {
    using Integer = __int128;

    Integer count = 0;
    std::array<Integer, 3> first{};  ///< of x, y, z
    std::array<Integer, 6> second{}; ///< of xx, yy, zz, yz, xz, xy

    /// Where the product of two axes is in `second`.
    static constexpr int product(int a, int b) { return a == b ? a : 6 - a - b; }

    /// @return those of the same voxels, all of them moved.
    VoxelMoments movedBy(const std::array<Integer, 3>& offset) const;
    VoxelMoments& operator+=(const VoxelMoments& other);
};

/// @return those of a cube of voxels whose first one is the origin.
VoxelMoments momentsOfCube(int64_t side);

/// @return those of voxels of a leaf that begins at the origin.
VoxelMoments momentsOf(const LeafMask& mask);

/// @return those of the active voxels. Parallel; the result does not depend on threads.
/// @throw Interrupted
VoxelMoments momentsOf(
    const openvdb::MaskTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);
VoxelMoments momentsOf(
    const openvdb::BoolTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree::detail
