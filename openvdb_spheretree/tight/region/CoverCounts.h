// SPDX-License-Identifier: Apache-2.0
/// @file CoverCounts.h
/// @brief How many balls of a cover hold each object voxel, for 512 voxels of a leaf at a time.
///
/// The counts of a leaf are stored as bit planes: plane i is the mask of the voxels whose count has
/// bit i. To add a ball, carries ripple from plane to plane; most end after two. Balls that hold
/// all of a leaf are counted in one number beside the planes. A large ball holds most of the leaves
/// that it reaches.
///
/// Which voxels would be uncovered without one ball, or two, follows from the voxels that are held
/// by exactly one, or two. Many threads may read these at the same time.
///
/// Memory: 4 bytes a leaf, and 64 for each bit of the largest possible count.

#pragma once

#include <openvdb_spheretree/voxel/LeafMask.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

class CoverCounts {
public:
    /// @param most  no voxel is ever held by more balls
    CoverCounts(std::size_t leaves, uint32_t most);

    /// Counts of different leaves may be changed at the same time.
    void add(std::size_t leaf, const LeafMask& mask);
    /// @param mask  as it was added
    void remove(std::size_t leaf, const LeafMask& mask);

    /// @return the voxels held by exactly @a count balls.
    LeafMask heldBy(std::size_t leaf, uint32_t count) const;

private:
    /// Adds 1 at the voxels of @a carry, or subtracts 1 if @a inverted is all ones: then the carry
    /// goes on where a bit was 0.
    void ripple(std::size_t leaf, LeafMask carry, uint64_t inverted);

    std::size_t mPerLeaf = 1;      ///< planes: bits of the largest count
    std::vector<LeafMask> mPlanes; ///< of a leaf: bit 0 of the counts, bit 1, ...
    std::vector<uint32_t> mWhole;  ///< balls that hold all of a leaf, not in its planes
};

} // namespace openvdb_spheretree::tight
