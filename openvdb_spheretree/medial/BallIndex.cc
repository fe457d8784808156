// SPDX-License-Identifier: Apache-2.0
#include "BallIndex.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

namespace openvdb_spheretree::detail {

BallIndex::BallIndex(const LeafLayout& layout, const std::vector<LeafMask>& centers,
    openvdb::util::NullInterrupter* interrupter)
    : mWords(std::size_t(layout.leafCount()) * kLeafDim)
{
    int32_t rank = 0;
    for (std::size_t leaf = 0; leaf < centers.size(); ++leaf) {
        for (uint32_t x = 0; x < kLeafDim; ++x) {
            const uint64_t mask = centers[leaf][x];
            mWords[leaf * kLeafDim + x] = {mask, rank};
            rank += int32_t(hwy::PopCount(mask));
        }
    }
    mBallOfRank.resize(std::size_t(rank));
    // Ranks and balls both go slab by slab, in different orders within one.
    parallelFor(layout.slabCount(), interrupter, [&](std::size_t slab) {
        const uint32_t leaf = layout.slab(uint32_t(slab)).begin;
        const int32_t first = mWords[wordOf(leaf, 0)].rank;
        visitWithPlaces(layout, uint32_t(slab), centers.data() + leaf,
            [&](uint32_t at, uint32_t index, std::size_t place) {
                mBallOfRank[std::size_t(rankAt({at, index}))] = first + int32_t(place);
            });
    });
}

} // namespace openvdb_spheretree::detail
