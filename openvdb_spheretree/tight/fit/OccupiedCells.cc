// SPDX-License-Identifier: Apache-2.0
#include "OccupiedCells.h"

#include <openvdb_spheretree/base/Hash.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::tight {

using openvdb::Coord;

std::size_t CoordHash::operator()(const Coord& at) const
{
    const uint64_t xy = uint64_t(uint32_t(at[0])) << 32 | uint32_t(at[1]);
    return std::size_t(detail::hash(detail::hash(xy) ^ uint32_t(at[2])));
}

void OccupiedCells::add(const Coord& cell)
{
    Coord part = cell;
    for (std::size_t level = 0; level < kLevels; ++level) {
        Parts& parts = mGroups[level][part >> kShift];
        const bool isNew = parts.empty();
        parts.push_back(part);
        if (!isNew) return; // the groups above know it
        part = part >> kShift;
    }
}

void OccupiedCells::remove(const Coord& cell)
{
    Coord part = cell;
    for (std::size_t level = 0; level < kLevels; ++level) {
        const auto group = mGroups[level].find(part >> kShift);
        Parts& parts = group->second;
        *std::find(parts.begin(), parts.end(), part) = parts.back();
        parts.pop_back();
        if (!parts.empty()) return;
        mGroups[level].erase(group);
        part = part >> kShift;
    }
}

} // namespace openvdb_spheretree::tight
