// SPDX-License-Identifier: Apache-2.0
/// @file CoverCounts.h
/// @brief How many balls of a cover hold each object voxel, for 512 voxels of a leaf at a time.
///
/// Bit i of the counts of a leaf is one mask; adding a ball is a ripple of carries from mask to
/// mask, most of which end after two. A ball that holds all of a leaf is one more in a number beside
/// them: of large balls that is most of what they reach. Who takes a ball out for a moment asks for
/// the voxels that are held exactly once or twice, and changes nothing: many can ask at the same
/// time.
///
/// Cost: 4 bytes a leaf, and 64 for each bit that the largest possible count has.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

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
    /// @param mask  as it was added
    void remove(std::size_t leaf, const LeafMask& mask);

    LeafMask once(std::size_t leaf) const;
    LeafMask twice(std::size_t leaf) const;

private:
    /// @return the voxels whose planes say 0, 1 or 2.
    LeafMask planesSay(std::size_t leaf, uint32_t count) const;
    LeafMask* planes(std::size_t leaf) { return &mPlanes[leaf * mPerLeaf]; }
    const LeafMask* planes(std::size_t leaf) const { return &mPlanes[leaf * mPerLeaf]; }

    std::size_t mPerLeaf;
    std::vector<LeafMask> mPlanes; ///< of a leaf: bit 0 of the counts, bit 1, ...
    std::vector<uint32_t> mWhole;  ///< balls that hold all of a leaf, not in its planes
};

} // namespace tight
} // namespace openvdb_spheretree
