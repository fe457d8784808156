// SPDX-License-Identifier: Apache-2.0
#include "BallIndex.h"

#include "Parallel.h"

#include <algorithm>
#include <limits>

namespace openvdb_spheretree {
namespace detail {

namespace {

/// Finds the leaves of balls of one slab: leaves of equal x, which stand together. Most balls lie
/// in the leaf of the one before, or close behind it.
class LeafFinder {
public:
    LeafFinder(const LeafLayout& layout, int32_t x)
        : mLayout(layout), mBegin(firstNotBefore(0, layout.leafCount(), {x, kLowest, kLowest})),
          mEnd(firstNotBefore(mBegin, layout.leafCount(), {x + 1, kLowest, kLowest})), mLeaf(mBegin)
    {}

    uint32_t leafOf(const openvdb::Coord& ijk)
    {
        const openvdb::Coord origin = ijk & ~7;
        if (mLayout.origin(mLeaf) == origin) return mLeaf;
        const bool ahead = mLayout.origin(mLeaf) < origin;
        if (ahead && mLeaf + 1 < mEnd && mLayout.origin(mLeaf + 1) == origin) return ++mLeaf;
        return mLeaf = firstNotBefore(ahead ? mLeaf + 1 : mBegin, ahead ? mEnd : mLeaf, origin);
    }

private:
    static constexpr int32_t kLowest = std::numeric_limits<int32_t>::min();

    uint32_t firstNotBefore(uint32_t begin, uint32_t end, const openvdb::Coord& origin) const
    {
        while (begin < end) {
            const uint32_t middle = begin + (end - begin) / 2;
            if (mLayout.origin(middle) < origin) begin = middle + 1;
            else end = middle;
        }
        return begin;
    }

    const LeafLayout& mLayout;
    const uint32_t mBegin, mEnd;
    uint32_t mLeaf;
};

/// Balls whose leaves have the same x are neighbours in the order: where each such slab begins.
std::vector<std::size_t> slabBegins(const std::vector<MedialBall>& balls)
{
    std::vector<std::size_t> begins;
    for (auto ball = balls.begin(); ball != balls.end();) {
        begins.push_back(std::size_t(ball - balls.begin()));
        const int32_t x = ball->center[0] | 7;
        ball = std::upper_bound(ball, balls.end(), x,
            [](int32_t last, const MedialBall& b) { return last < b.center[0]; });
    }
    begins.push_back(balls.size());
    return begins;
}

} // namespace

BallIndex::BallIndex(const LeafLayout& layout, const std::vector<MedialBall>& balls,
    openvdb::util::NullInterrupter* interrupter)
    : mCentres(std::size_t(layout.leafCount()) * kLeafDim), mBallOfRank(balls.size())
{
    const std::vector<std::size_t> begins = slabBegins(balls);
    // No two slabs share a leaf: their leaves differ in x.
    std::vector<uint32_t> leafOfBall(balls.size());
    parallelFor(begins.size() - 1, interrupter, [&](std::size_t slab) {
        LeafFinder finder(layout, balls[begins[slab]].center[0] & ~7);
        for (std::size_t i = begins[slab]; i < begins[slab + 1]; ++i) {
            const uint32_t leaf = leafOfBall[i] = finder.leafOf(balls[i].center);
            const uint32_t offset = leafOffset(balls[i].center);
            mCentres[wordOf(leaf, offset)].mask |= uint64_t(1) << (offset & 63);
        }
    });
    countRanks();
    parallelFor(begins.size() - 1, interrupter, [&](std::size_t slab) {
        for (std::size_t i = begins[slab]; i < begins[slab + 1]; ++i) {
            const int32_t rank = rankAt({leafOfBall[i], leafOffset(balls[i].center)});
            mBallOfRank[std::size_t(rank)] = int32_t(i);
        }
    });
}

void BallIndex::countRanks()
{
    int32_t rank = 0;
    for (Centres& centres : mCentres) {
        centres.rank = rank;
        rank += int32_t(hwy::PopCount(centres.mask));
    }
}

} // namespace detail
} // namespace openvdb_spheretree
