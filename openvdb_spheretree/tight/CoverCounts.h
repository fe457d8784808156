// SPDX-License-Identifier: Apache-2.0
/// @file tight/CoverCounts.h
/// @brief How many balls of a cover hold each object voxel, for 512 voxels of a leaf at a time.
///
/// Bit i of the counts of a leaf is one mask; adding a ball is a ripple of carries from mask to
/// mask, most of which end after two. Who takes a ball out for a moment asks for the voxels that
/// are held exactly once or twice, and changes nothing: many can ask at the same time.
///
/// Cost: 64 bytes a leaf, and as much again for each bit that the largest possible count has.

#pragma once

#include "../LeafLayout.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

class CoverCounts {
public:
    /// @param most  no voxel is ever held by more balls
    CoverCounts(std::size_t leaves, uint32_t most);

    /// Counts of different leaves may be changed at the same time.
    void add(std::size_t leaf, const LeafMask& mask);
    /// @param mask  voxels whose count is not 0
    void remove(std::size_t leaf, const LeafMask& mask);

    LeafMask once(std::size_t leaf) const;
    LeafMask twice(std::size_t leaf) const;
    const LeafMask& moreThanOnce(std::size_t leaf) const { return mMore[leaf]; }

private:
    LeafMask* planes(std::size_t leaf) { return &mPlanes[leaf * mPerLeaf]; }
    const LeafMask* planes(std::size_t leaf) const { return &mPlanes[leaf * mPerLeaf]; }

    std::size_t mPerLeaf;
    std::vector<LeafMask> mPlanes; ///< of a leaf: bit 0 of the counts, bit 1, ...
    std::vector<LeafMask> mMore;   ///< voxels with any bit but bit 0
};

} // namespace tight
} // namespace openvdb_spheretree
