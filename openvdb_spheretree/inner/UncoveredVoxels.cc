// SPDX-License-Identifier: Apache-2.0
#include "UncoveredVoxels.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

/// The leaves along an axis that hold the coordinates from c - reach to c + reach, counted from the
/// leaf of c.
struct LeafRange {
    int first, last;

    LeafRange(int32_t c, int64_t reach)
        : first(int(((c - reach) >> 3) - (c >> 3))), last(int(((c + reach) >> 3) - (c >> 3)))
    {}
};

/// How far c is from the nearest and the farthest coordinate of such a leaf.
struct Gap {
    int64_t least, most;

    Gap(int32_t c, int leaf)
    {
        const int64_t below = int64_t(c & 7) - int64_t(kLeafDim) * leaf; // from the leaf's first
        const int64_t above = kLeafDim - 1 - below;                      // to its last
        least = std::max<int64_t>(0, std::max(-below, -above));
        most = std::max(below, above);
    }
};

} // namespace

UncoveredVoxels::UncoveredVoxels(const LeafLayout& layout, int dim)
    : mLayout(layout), mDim(dim), mLeft(layout.voxelCount()), mMasks(layout.leafCount()),
      mCounts(layout.leafCount(), 0), mChangedAt(layout.leafCount(), 0)
{
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        mMasks[leaf] = layout.mask(leaf);
        mCounts[leaf] = uint16_t(mMasks[leaf].count());
    }
}

template <typename Visit>
void UncoveredVoxels::visitLeaves(const MedialBall& ball, const Visit& visit) const
{
    const openvdb::Coord& c = ball.center;
    const int64_t limit = int64_t(ball.radiusSq) - 1;
    const uint32_t center = *mLayout.findLeaf(c);
    const LeafRange alongX(c[0], floorSqrt(limit));
    for (int i = alongX.first; i <= alongX.last; ++i) {
        const Gap x(c[0], i);
        const uint32_t column = mLayout.neighbour(center, Axis::X, i);
        const int64_t restX = limit - x.least * x.least;
        const LeafRange alongY(c[1], floorSqrt(restX));
        for (int j = alongY.first; j <= alongY.last; ++j) {
            const Gap y(c[1], j);
            const uint32_t row = mLayout.neighbour(column, Axis::Y, j);
            const int64_t restY = restX - y.least * y.least;
            const LeafRange alongZ(c[2], mDim == 2 ? 0 : floorSqrt(restY));
            for (int k = alongZ.first; k <= alongZ.last; ++k) {
                const Gap z(c[2], k);
                const int64_t far = x.most * x.most + y.most * y.most + z.most * z.most;
                if (!visit(row + uint32_t(k), far <= limit)) return; // leaves in order along z
            }
        }
    }
}

int64_t UncoveredVoxels::countIn(const MedialBall& ball) const
{
    int64_t count = 0;
    visitLeaves(ball, [&](uint32_t leaf, bool whole) {
        if (whole || mCounts[leaf] == 0) count += mCounts[leaf];
        else count += (partInside(ball, leaf) & mMasks[leaf]).count();
        return true;
    });
    return count;
}

void UncoveredVoxels::cover(const MedialBall& ball, uint32_t now)
{
    visitLeaves(ball, [&](uint32_t leaf, bool whole) {
        if (mCounts[leaf] == 0) return true;
        const LeafMask inside = whole ? LeafMask::full() : partInside(ball, leaf);
        const int taken = (inside & mMasks[leaf]).count();
        mMasks[leaf] -= inside;
        mCounts[leaf] = uint16_t(mCounts[leaf] - taken);
        mLeft -= taken;
        if (taken > 0) mChangedAt[leaf] = now;
        return true;
    });
}

bool UncoveredVoxels::mayHaveChanged(const MedialBall& ball, uint32_t then) const
{
    bool changed = false;
    visitLeaves(ball, [&](uint32_t leaf, bool) {
        changed = mChangedAt[leaf] > then;
        return !changed;
    });
    return changed;
}

} // namespace openvdb_spheretree::detail
