// SPDX-License-Identifier: Apache-2.0
/// @file NearCube.h
/// @brief Boxes at the origin whose sides differ by one at most, and the one that holds nearest to
/// a number of a shape's voxels.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// @param voxels  1 or more
/// @param count   count(sides): how many voxels the shape has in the box of these sides; never
///                less in a larger box, and without bound
/// @return the voxels of the box
template <typename Count>
openvdb::CoordBBox nearCubeOf(int64_t voxels, const Count& count)
{
    // The sides grow by one in turn: n n n, n+1 n n, n+1 n+1 n, ...
    const auto sides = [](int n) { return openvdb::Coord((n + 2) / 3, (n + 1) / 3, n / 3); };
    int low = 0, high = 3; // count(low) < voxels <= count(high), once found
    while (count(sides(high)) < voxels) low = high, high *= 2;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (count(sides(middle)) < voxels ? low : high) = middle;
    }
    const int64_t missing = voxels - count(sides(low));
    const bool lowIsNearer = missing < count(sides(high)) - voxels;
    return {openvdb::Coord(0), sides(lowIsNearer ? low : high).offsetBy(-1)};
}

} // namespace openvdb_spheretree::detail
