// SPDX-License-Identifier: Apache-2.0
/// @file NearestBit.h
/// @brief The voxel of a row that is nearest to a point, where bits stand for voxels.

#pragma once

#include <openvdb/util/NodeMasks.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

inline int lowestBit(uint32_t bits) { return int(openvdb::util::FindLowestOn(bits)); }
inline int highestBit(uint32_t bits) { return int(openvdb::util::FindHighestOn(bits)); }

/// @param row  not empty; bit 31 is off
/// @return the bit z with the smallest |2 z - point2|; of two, the lower one.
inline int nearestBit(uint32_t row, int64_t point2)
{
    const int split = point2 < 0 ? 0 : int(std::min<int64_t>(point2 / 2 + 1, 31));
    const uint32_t below = row & ((1u << split) - 1), above = row & ~((1u << split) - 1);
    if (!below) return lowestBit(above);
    if (!above) return highestBit(below);
    const int lower = highestBit(below), upper = lowestBit(above);
    return point2 - 2 * lower <= 2 * upper - point2 ? lower : upper;
}

} // namespace openvdb_spheretree::detail
