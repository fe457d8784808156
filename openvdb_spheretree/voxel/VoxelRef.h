// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRef.h
/// @brief A voxel of a layout by its leaf and its index there, and offsets from one to another.

#pragma once

#include "LeafLayout.h"

#include <cstdint>

namespace openvdb_spheretree {

struct VoxelRef {
    uint32_t leaf;  ///< in the layout
    uint32_t index; ///< in the leaf: 64 x + 8 y + z
};

/// Where an offset along an axis leads from a voxel of a leaf.
struct Target {
    int leaves;     ///< so many leaves further along the axis
    uint32_t index; ///< in that leaf
};

inline Target targetOf(Axis axis, uint32_t index, int offset)
{
    const int shift = 6 - 3 * int(axis);
    const int here = int(index >> shift & 7), there = here + offset;
    return {there >> 3, uint32_t(int(index) + ((there & 7) - here) * (1 << shift))};
}

/// @param offset  voxels along @a axis, forwards or backwards; all in between are in the layout
/// @return the voxel there.
inline VoxelRef moved(const LeafLayout& layout, Axis axis, VoxelRef voxel, int offset)
{
    const Target target = targetOf(axis, voxel.index, offset);
    if (target.leaves != 0) voxel.leaf = layout.neighbour(voxel.leaf, axis, target.leaves);
    voxel.index = target.index;
    return voxel;
}

} // namespace openvdb_spheretree
