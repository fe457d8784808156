// SPDX-License-Identifier: Apache-2.0
/// @file BallIndex.h
/// @brief Which medial ball has its center at a voxel, without a search.
///
/// The centers in a leaf are the bits of a mask. The number of bits before a center is its *rank*
/// in the order of leaves. The rank names a ball as well as its index does, and is found in one
/// cache line. A table takes ranks to indices in the order of balls. 128 bytes a leaf, 4 a ball.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <hwy/base.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class BallIndex {
public:
    /// @param centers  of the balls, a mask for each leaf
    BallIndex(const LeafLayout& layout, const std::vector<LeafMask>& centers,
        openvdb::util::NullInterrupter* interrupter);

    /// @return the rank of the ball with its center at @a center; there must be one.
    int32_t rankAt(VoxelRef center) const
    {
        const Word& word = mWords[wordOf(center.leaf, center.index)];
        const uint64_t before = (uint64_t(1) << (center.index & 63)) - 1;
        return word.rank + int32_t(hwy::PopCount(word.mask & before));
    }
    /// @return the index of the ball of that rank in the order of balls: by center.
    int32_t ballOf(int32_t rank) const { return mBallOfRank[std::size_t(rank)]; }

private:
    /// A word of a leaf's mask.
    struct Word {
        uint64_t mask = 0;
        int32_t rank = 0; ///< of the word's first center
    };

    static std::size_t wordOf(uint32_t leaf, uint32_t index)
    {
        return std::size_t(leaf) * kLeafDim + (index >> 6);
    }

    std::vector<Word> mWords; ///< eight a leaf
    std::vector<int32_t> mBallOfRank;
};

} // namespace openvdb_spheretree::detail
