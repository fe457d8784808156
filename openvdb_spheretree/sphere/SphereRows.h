// SPDX-License-Identifier: Apache-2.0
/// @file SphereRows.h
/// @brief The voxels of a sphere in a cube, row by row along z.

#pragma once

#include "ClippedSphere.h"

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// Calls f(x, y, lo, hi) for the rows of a sphere, and of its clip, in the cube of @a size voxels
/// at
/// @a origin: voxels (x, y, lo...hi), counted from the cube's corner. Rows may be empty (lo > hi).
/// The sphere's box must meet the cube.
template <typename F>
void forEachRow(const ClippedSphere& sphere, const openvdb::Coord& origin, int32_t size, const F& f)
{
    int32_t first[3], last[3]; // of the sphere's box in the cube
    int64_t center[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(sphere.lo[a], origin[a]) - origin[a];
        last[a] = std::min(sphere.hi[a], origin[a] + (size - 1)) - origin[a];
        center[a] = sphere.center[a] - inUnits(origin[a], sphere.shift);
    }
    const int64_t voxel = inUnits(1, sphere.shift);
    int64_t dx = inUnits(first[0], sphere.shift) - center[0];
    for (int32_t x = first[0]; x <= last[0]; ++x, dx += voxel) {
        int64_t dy = inUnits(first[1], sphere.shift) - center[1];
        for (int32_t y = first[1]; y <= last[1]; ++y, dy += voxel) {
            const int64_t reach = sphere.distance.reach(dx, dy, sphere.radiusSq);
            if (reach < 0) continue;
            const Interval run(center[2], reach, sphere.shift);
            f(x, y, int32_t(std::max<int64_t>(run.lo, first[2])),
                int32_t(std::min<int64_t>(run.hi, last[2])));
        }
    }
}

/// @return the bits of lo...hi, which are in order, of a row of eight.
inline uint64_t rowBits(int32_t lo, int32_t hi) { return (0xffu >> (7 - hi)) & (0xffu << lo); }

} // namespace openvdb_spheretree::detail
