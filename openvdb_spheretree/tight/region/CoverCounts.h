// SPDX-License-Identifier: Apache-2.0
/// @file CoverCounts.h
/// @brief How many balls of a cover hold each object voxel, for 512 voxels of a leaf at a time.
///
/// The counts of a leaf are stored as bit planes: plane i is the mask of the voxels whose count has
/// bit i. Adding a ball is a ripple of carries from plane to plane; most end after two. Balls that
/// hold all of a leaf are counted in one number beside the planes: of the leaves that a large ball
/// reaches, these are most.
///
/// Which voxels would be uncovered without one ball, or two, is decided by the voxels that are held
/// exactly once or twice. These can be read by many threads at the same time.
///
/// Memory: 4 bytes a leaf, and 64 for each bit of the largest possible count.

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

    /// @return the voxels held by exactly one ball.
    LeafMask once(std::size_t leaf) const;
    /// @return the voxels held by exactly two.
    LeafMask twice(std::size_t leaf) const;

private:
    /// Adds 1 at the voxels of @a carry, or takes 1 off: then carries go where a bit was 0, and
    /// @a inverted is all ones.
    void ripple(std::size_t leaf, LeafMask carry, uint64_t inverted);
    /// @return the voxels whose count in the planes is 0, 1 or 2.
    LeafMask countedAs(std::size_t leaf, uint32_t count) const;
    LeafMask* planes(std::size_t leaf) { return &mPlanes[leaf * mPerLeaf]; }
    const LeafMask* planes(std::size_t leaf) const { return &mPlanes[leaf * mPerLeaf]; }

    std::size_t mPerLeaf;
    std::vector<LeafMask> mPlanes; ///< of a leaf: bit 0 of the counts, bit 1, ...
    std::vector<uint32_t> mWhole;  ///< balls that hold all of a leaf, not in its planes
};

} // namespace tight
} // namespace openvdb_spheretree
