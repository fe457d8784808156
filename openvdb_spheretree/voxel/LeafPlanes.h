// SPDX-License-Identifier: Apache-2.0
/// @file LeafPlanes.h
/// @brief Planes of 8 x 8 voxels as words: bit 8 u + v, where u and v are the two axes of the plane
/// in the order x, y, z.

#pragma once

#include "LeafLayout.h"

#include <cstdint>

namespace openvdb_spheretree::detail {

constexpr uint64_t kColumn = 0x0101010101010101; ///< v = 0 in every row

/// @return the plane moved by @a du rows and @a dv columns, each -7 to 7; what leaves it is lost.
inline uint64_t movedPlane(uint64_t plane, int du, int dv)
{
    if (dv > 0) plane = plane << dv & kColumn * (0xff << dv & 0xff);
    if (dv < 0) plane = plane >> -dv & kColumn * (0xff >> -dv);
    return du > 0 ? plane << 8 * du : plane >> -8 * du;
}

/// @return the voxels of a leaf with coordinate @a at (0 to 7) along @a axis.
inline uint64_t planeOf(const LeafMask& mask, Axis axis, int at)
{
    if (axis == Axis::X) return mask[at];
    uint64_t plane = 0;
    for (int x = 0; x < 8; ++x) {
        uint64_t row = mask[x] >> 8 * at & 0xff;
        if (axis == Axis::Z) { // the product gathers bit 0 of every byte in the highest byte
            row = (mask[x] >> at & kColumn) * 0x0102040810204080 >> 56;
        }
        plane |= row << 8 * x;
    }
    return plane;
}

/// @return the offset in its leaf of a voxel of such a plane.
inline uint32_t offsetInPlane(Axis axis, int at, uint32_t bit)
{
    if (axis == Axis::X) return 64 * at + bit;
    if (axis == Axis::Y) return 64 * (bit >> 3) + 8 * at + (bit & 7);
    return 8 * bit + at;
}

} // namespace openvdb_spheretree::detail
