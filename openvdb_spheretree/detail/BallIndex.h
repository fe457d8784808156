// SPDX-License-Identifier: Apache-2.0
/// @file detail/BallIndex.h
/// @brief Which medial ball is centred at a voxel, and which one a voxel's label is, without a
/// search.
///
/// Balls are ordered by centre, voxels by leaf. A leaf's centres are bits of a mask; the bits before
/// a centre, counted, are its rank in the order of leaves; one table takes ranks to balls. 88 bytes
/// a leaf, 4 a ball. (A binary search over all balls took five times as long as all else that a
/// voxel of the Sphere-DAG costs.)

#pragma once

#include "../LeafLayout.h"
#include "../MedialAxis.h"
#include "../PowerMap.h"

#include <openvdb/util/NodeMasks.h>
#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

class BallIndex {
public:
    /// @param balls  of that layout, ordered by centre
    BallIndex(const LeafLayout& layout, const std::vector<MedialBall>& balls,
        openvdb::util::NullInterrupter* interrupter);

    /// @return the index of the ball that is centred at @a center; there must be one.
    int32_t at(PowerMap::Voxel center) const { return mBallOfRank[rankOf(center)]; }

private:
    struct Centres {
        LeafMask mask{};
        std::array<uint16_t, 8> before{}; ///< centres of the leaf in the words before each
        uint32_t rank = 0;                ///< of the leaf's first centre
    };

    std::size_t rankOf(PowerMap::Voxel center) const
    {
        const Centres& centres = mCentres[center.leaf];
        const uint32_t x = center.offset >> 6;
        const uint64_t before = (uint64_t(1) << (center.offset & 63)) - 1;
        return std::size_t(centres.rank) + centres.before[x]
            + openvdb::util::CountOn(centres.mask[x] & before);
    }
    void countRanks();

    std::vector<Centres> mCentres; ///< one a leaf
    std::vector<int32_t> mBallOfRank;
};

} // namespace detail
} // namespace openvdb_spheretree
