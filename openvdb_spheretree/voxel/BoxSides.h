// SPDX-License-Identifier: Apache-2.0
/// @file BoxSides.h
/// @brief The sides and the voxels of a box, wherever it is.

#pragma once

#include <openvdb/Types.h> // CoordBBox

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// In 64 bits: openvdb::CoordBBox::dim() and extents() wrap around at the ends of coordinates.
/// @return zeros for an empty box, as those have it
inline std::array<int64_t, 3> sidesOf(const openvdb::CoordBBox& box)
{
    if (box.empty()) return {};
    const auto side = [&](int axis) { return int64_t(box.max()[axis]) - box.min()[axis] + 1; };
    return {side(0), side(1), side(2)};
}

inline int64_t longestSideOf(const openvdb::CoordBBox& box)
{
    const auto side = sidesOf(box);
    return std::max({side[0], side[1], side[2]});
}

/// @return from corner to corner, in voxels.
inline double diagonalOf(const openvdb::CoordBBox& box)
{
    const auto side = sidesOf(box);
    return std::hypot(double(side[0]), double(side[1]), double(side[2]));
}

/// Calls f(ijk) for every voxel of a box, x first. Its iterators step beyond the last coordinate, and do not end there.
template <typename F>
void forEachVoxelOf(const openvdb::CoordBBox& box, const F& f)
{
    for (int64_t x = box.min()[0]; x <= box.max()[0]; ++x) {
        for (int64_t y = box.min()[1]; y <= box.max()[1]; ++y) {
            for (int64_t z = box.min()[2]; z <= box.max()[2]; ++z) {
                f(openvdb::Coord(int32_t(x), int32_t(y), int32_t(z)));
            }
        }
    }
}

} // namespace openvdb_spheretree::detail
