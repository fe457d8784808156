// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRef.h
/// @brief A voxel of a layout by its leaf and its index there, and the way from one to another.

#pragma once

#include "LeafLayout.h"

#include <cstdint>

namespace openvdb_spheretree {

struct VoxelRef {
    uint32_t leaf;  ///< in the layout
    uint32_t index; ///< in the leaf: 64 x + 8 y + z
};

/// @param steps  voxels along @a axis, forwards or backwards; all on the way are in the layout
/// @return the voxel there.
inline VoxelRef moved(const LeafLayout& layout, Axis axis, VoxelRef voxel, int steps)
{
    const int shift = 6 - 3 * int(axis);
    const int here = int(voxel.index >> shift & 7), there = here + steps;
    if (there < 0 || there > 7) voxel.leaf = layout.neighbour(voxel.leaf, axis, there >> 3);
    voxel.index = uint32_t(int(voxel.index) + (((there & 7) - here) << shift));
    return voxel;
}

} // namespace openvdb_spheretree
