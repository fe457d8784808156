// SPDX-License-Identifier: Apache-2.0
/// @file BoxSides.h
/// @brief The sides of a box of voxels, wherever it is.

#pragma once

#include <openvdb/Types.h> // CoordBBox

#include <algorithm>
#include <array>
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

} // namespace openvdb_spheretree::detail
