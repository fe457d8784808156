// SPDX-License-Identifier: Apache-2.0
/// @file BallLists.h
/// @brief Which spheres reach into which child of a node or of another cube.

#pragma once

#include "ClippedSphere.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// The spheres that reach into each child of a cube. Reused, as building these lists is most of the
/// work for small spheres. Cost: goes by the children from the first to the last that a ball
/// reaches; the first build of a size makes the lists of all.
class BallLists {
public:
    /// Children along an axis, first and last.
    struct Range {
        int32_t first, last;
    };

    /// @param origin, log2    the cube
    /// @param childLog2       its children's size, no more than 32 along an axis; they are numbered
    ///                        x slowest, as in OpenVDB
    /// @param alongX          children elsewhere along x get no ball
    void build(const ClippedSphere* balls, const int32_t* begin, const int32_t* end,
        const openvdb::Coord& origin, int log2, int childLog2, Range alongX = {0, INT32_MAX})
    {
        assert(log2 - childLog2 <= kMostAlongLog2);
        mAlongX = alongX;
        mOrigin = origin;
        mLog2 = log2;
        mChildLog2 = childLog2;
        clear(std::size_t(1) << (3 * (log2 - childLog2)));
        for (const int32_t* i = begin; i != end; ++i) enter(balls[*i], *i);
        int32_t sum = 0;
        for (std::size_t c = mFirst; c < mEnd; ++c) {
            List& list = mLists[c];
            list.begin = sum;
            sum += list.end;
            list.end = list.begin;
        }
        mItems.resize(mEntries.size());
        for (const Entry& entry : mEntries) mItems[mLists[entry.child].end++] = entry.ball;
    }
    /// No ball reaches the children before and after these; if none reaches any, the end comes first.
    std::size_t firstReached() const { return mFirst; }
    std::size_t endReached() const { return mEnd; }
    bool full(std::size_t child) const { return mLists[child].full; }
    const int32_t* begin(std::size_t child) const { return mItems.data() + mLists[child].begin; }
    const int32_t* end(std::size_t child) const { return mItems.data() + mLists[child].end; }
    openvdb::Coord childOrigin(std::size_t child) const
    {
        const int n = mLog2 - mChildLog2, mask = (1 << n) - 1, c = int(child);
        const openvdb::Coord at(c >> (2 * n), (c >> n) & mask, c & mask);
        return mOrigin.offsetBy(at[0] << mChildLog2, at[1] << mChildLog2, at[2] << mChildLog2);
    }

private:
    static constexpr int kMostAlongLog2 = 5, kMostAlong = 1 << kMostAlongLog2; ///< children

    struct Entry {
        int32_t child, ball;
    };

    /// A child's place among the items. While balls are entered, end is their number.
    struct List {
        int32_t begin = 0, end = 0;
        bool full = false;
    };

    /// The children under the ball's box.
    struct Children {
        int32_t first[3], last[3];
    };

    void clear(std::size_t children)
    {
        for (std::size_t c = mFirst; c < mEnd; ++c) mLists[c] = {};
        mLists.resize(children);
        mEntries.clear();
        mFirst = children;
        mEnd = 0;
    }

    void enter(const ClippedSphere& ball, int32_t index)
    {
        Children under;
        const int32_t size = int32_t(1) << mLog2;
        for (int a = 0; a < 3; ++a) {
            under.first[a] = (std::max(ball.lo[a], mOrigin[a]) - mOrigin[a]) >> mChildLog2;
            under.last[a] =
                (std::min(ball.hi[a], mOrigin[a] + (size - 1)) - mOrigin[a]) >> mChildLog2;
        }
        under.first[0] = std::max(under.first[0], mAlongX.first);
        under.last[0] = std::min(under.last[0], mAlongX.last);
        for (int a = 0; a < 3; ++a) {
            if (under.first[a] > under.last[a]) return;
        }
        mFirst = std::min(mFirst, childAt(under.first));
        mEnd = std::max(mEnd, childAt(under.last) + 1);
        if (ball.plain) enterPlain(ball, index, under);
        else enterAny(ball, index, under);
    }

    /// Squares of each axis are computed once; one that is beyond the ball's has no sum within it.
    void enterPlain(const ClippedSphere& ball, int32_t index, const Children& under)
    {
        for (int a = 0; a < 3; ++a) {
            for (int32_t i = under.first[a]; i <= under.last[a]; ++i) {
                mNearSq[a][i] = square(ball.nearest(a, lowest(a, i), highest(a, i)));
                mFarSq[a][i] = ball.isInBox(a, lowest(a, i), highest(a, i))
                    ? square(ball.farthest(a, lowest(a, i), highest(a, i)))
                    : ball.radiusSq + 1;
            }
        }
        for (int32_t x = under.first[0]; x <= under.last[0]; ++x) {
            for (int32_t y = under.first[1]; y <= under.last[1]; ++y) {
                const int64_t nearSq = mNearSq[0][x] + mNearSq[1][y];
                const int64_t farSq = mFarSq[0][x] + mFarSq[1][y];
                if (nearSq > ball.radiusSq) continue;
                for (int32_t z = under.first[2]; z <= under.last[2]; ++z) {
                    if (nearSq + mNearSq[2][z] > ball.radiusSq) continue;
                    enterChild(childAt(x, y, z), index, farSq + mFarSq[2][z] <= ball.radiusSq);
                }
            }
        }
    }
    void enterAny(const ClippedSphere& ball, int32_t index, const Children& under)
    {
        for (int32_t x = under.first[0]; x <= under.last[0]; ++x) {
            for (int32_t y = under.first[1]; y <= under.last[1]; ++y) {
                for (int32_t z = under.first[2]; z <= under.last[2]; ++z) {
                    if (mLists[childAt(x, y, z)].full) continue;
                    const int32_t first[3] = {lowest(0, x), lowest(1, y), lowest(2, z)};
                    const int32_t last[3] = {highest(0, x), highest(1, y), highest(2, z)};
                    if (!ball.touches(first, last)) continue;
                    enterChild(childAt(x, y, z), index, ball.contains(first, last));
                }
            }
        }
    }
    void enterChild(std::size_t child, int32_t index, bool contained)
    {
        List& list = mLists[child];
        if (list.full) return;
        if (contained) {
            list.full = true;
            return;
        }
        mEntries.push_back({int32_t(child), index});
        ++list.end;
    }

    std::size_t childAt(int32_t x, int32_t y, int32_t z) const
    {
        const int n = mLog2 - mChildLog2;
        return std::size_t((((x << n) | y) << n) | z);
    }
    std::size_t childAt(const int32_t (&at)[3]) const { return childAt(at[0], at[1], at[2]); }
    /// Voxels of child i along an axis.
    int32_t lowest(int axis, int32_t i) const { return mOrigin[axis] + (i << mChildLog2); }
    int32_t highest(int axis, int32_t i) const
    {
        return lowest(axis, i) + ((int32_t(1) << mChildLog2) - 1);
    }

    openvdb::Coord mOrigin;
    int mLog2 = 0, mChildLog2 = 0;
    Range mAlongX{0, INT32_MAX};
    std::vector<List> mLists;         ///< by child
    std::size_t mFirst = 0, mEnd = 0; ///< of the children under balls' boxes
    std::vector<int32_t> mItems;      ///< the balls of the children, one after the other
    std::vector<Entry> mEntries;      ///< pairs of a child and a ball, in the order of balls
    int64_t mNearSq[3][kMostAlong], mFarSq[3][kMostAlong]; ///< of one ball, by child
};

} // namespace openvdb_spheretree::detail
