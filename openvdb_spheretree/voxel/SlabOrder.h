// SPDX-License-Identifier: Apache-2.0
/// @file SlabOrder.h
/// @brief The order of medial balls: by center, x first. It is not the order of leaves.

#pragma once

#include "LeafLayout.h"

#include <openvdb/util/NodeMasks.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return the number of voxels in some masks.
inline std::size_t countMarks(const LeafMask* masks, std::size_t count)
{
    std::size_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += std::size_t(masks[i].count());
    return sum;
}

/// Adds the bits of each byte of @a word to eight sums.
inline void countBytes(uint64_t word, std::size_t* sums)
{
    word -= word >> 1 & 0x5555555555555555;
    word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
    word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
    for (int y = 0; y < 8; ++y) sums[y] += word >> 8 * y & 0xff;
}

/// Calls visit(leaf, index, place) for the marked voxels of a slab: its leaf, its index there, and
/// its rank among the marked voxels of the slab in the order of coordinates. Voxels are visited by
/// x, then row of leaves by row of leaves. Leaves of a row have the same y, so the voxels of a row
/// come before those of the next one. In a row they are ordered by y, then by leaf, then by z.
/// @param marks  a mask for each leaf of the slab
template <typename Visit>
void visitWithPlaces(
    const LeafLayout& layout, uint32_t slabIndex, const LeafMask* marks, const Visit& visit)
{
    const LeafLayout::Slab slab = layout.slab(slabIndex);
    std::vector<uint32_t> rows; // the first leaf of each, and the slab's end
    for (uint32_t leaf = slab.begin; leaf < slab.end; ++leaf) {
        const bool starts = rows.empty() || layout.origin(leaf)[1] != layout.origin(leaf - 1)[1];
        if (starts) rows.push_back(leaf);
    }
    rows.push_back(slab.end);
    std::size_t before = 0; // voxels in earlier rows
    for (uint32_t x = 0; x < 8; ++x) {
        for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
            std::size_t place[9] = {};
            for (uint32_t leaf = rows[row]; leaf < rows[row + 1]; ++leaf) {
                countBytes(marks[leaf - slab.begin][x], place + 1);
            }
            place[0] = before;
            for (int y = 0; y < 8; ++y) place[y + 1] += place[y];
            before = place[8];
            for (uint32_t leaf = rows[row]; leaf < rows[row + 1]; ++leaf) {
                for (uint64_t word = marks[leaf - slab.begin][x]; word; word &= word - 1) {
                    const uint32_t bit = openvdb::util::FindLowestOn(word);
                    visit(leaf, 64 * x + bit, place[bit >> 3]++);
                }
            }
        }
    }
}

} // namespace openvdb_spheretree::detail
