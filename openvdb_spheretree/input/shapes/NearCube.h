// SPDX-License-Identifier: Apache-2.0
/// @file NearCube.h
/// @brief The box [0, a) x [0, b) x [0, c) with sides that differ by one at most, of which a shape
/// fills nearest to a number of voxels.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Sides grow by one in turn: n n n, n+1 n n, n+1 n+1 n, ...
inline openvdb::Coord nearCube(int step)
{
    return openvdb::Coord((step + 2) / 3, (step + 1) / 3, step / 3);
}

/// @param voxels  1 or more
/// @param count   count(sides): how many voxels the shape has in the box of these sides; never
///                less in a larger box, and without bound
template <typename Count>
openvdb::Coord nearCubeOf(int64_t voxels, const Count& count)
{
    int low = 0, high = 3; // count(low) < voxels <= count(high), once found
    while (count(nearCube(high)) < voxels) low = high, high *= 2;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (count(nearCube(middle)) < voxels ? low : high) = middle;
    }
    const int64_t missing = voxels - count(nearCube(low));
    return nearCube(missing < count(nearCube(high)) - voxels ? low : high);
}

/// @return the voxels of the box of these sides.
inline openvdb::CoordBBox boxOfSides(const openvdb::Coord& sides)
{
    return {openvdb::Coord(0), sides.offsetBy(-1)};
}

} // namespace detail
} // namespace openvdb_spheretree
