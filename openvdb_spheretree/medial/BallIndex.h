// SPDX-License-Identifier: Apache-2.0
/// @file BallIndex.h
/// @brief Which medial ball is centred at a voxel, without a search.
///
/// Balls are ordered by centre, voxels by leaf. A leaf's centres are bits of a mask; the bits
/// before a centre, counted, are its rank in the order of leaves, which is as good a name for a
/// ball as its index and is found in one cache line. One table takes ranks to balls, for the few
/// that are asked for. 128 bytes a leaf, 4 a ball.

#pragma once

#include "PowerMap.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <hwy/base.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

class BallIndex {
public:
    /// @param centers  of the balls, a mask for each leaf
    BallIndex(const LeafLayout& layout, const std::vector<LeafMask>& centers,
        openvdb::util::NullInterrupter* interrupter);

    /// @return the rank of the ball that is centred at @a center; there must be one.
    int32_t rankAt(VoxelRef center) const
    {
        const Centres& centres = mCentres[wordOf(center.leaf, center.index)];
        const uint64_t before = (uint64_t(1) << (center.index & 63)) - 1;
        return centres.rank + int32_t(hwy::PopCount(centres.mask & before));
    }
    /// @return the index of the ball of that rank in the order of balls: by centre.
    int32_t ballOf(int32_t rank) const { return mBallOfRank[std::size_t(rank)]; }

private:
    /// A word of a leaf's mask.
    struct Centres {
        uint64_t mask = 0;
        int32_t rank = 0; ///< of the word's first centre
    };

    static std::size_t wordOf(uint32_t leaf, uint32_t offset)
    {
        return std::size_t(leaf) * kLeafDim + (offset >> 6);
    }
    /// @return the number of centres.
    std::size_t countRanks(const std::vector<LeafMask>& centers);

    std::vector<Centres> mCentres; ///< eight a leaf
    std::vector<int32_t> mBallOfRank;
};

} // namespace detail
} // namespace openvdb_spheretree
