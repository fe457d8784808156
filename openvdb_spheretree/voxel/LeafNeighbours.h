// SPDX-License-Identifier: Apache-2.0
/// @file LeafNeighbours.h
/// @brief The 26 leaves around each leaf of a layout, as a table: what LeafWalk.h finds for one
/// leaf after the other. Cost: linear in leaves, 108 bytes a leaf.

#pragma once

#include "LeafLayout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

class LeafNeighbours {
public:
    static constexpr uint32_t kNone = ~uint32_t(0);

    explicit LeafNeighbours(const LeafLayout& layout);

    /// @return the leaf at @a dx, @a dy, @a dz (-1 to 1) leaves from @a leaf; kNone without one.
    uint32_t at(uint32_t leaf, int dx, int dy, int dz) const
    {
        return mNeighbours[leaf][9 * (dx + 1) + 3 * (dy + 1) + (dz + 1)];
    }

private:
    std::vector<std::array<uint32_t, 27>> mNeighbours;
};

} // namespace detail
} // namespace openvdb_spheretree
