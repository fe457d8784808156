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

/// The spheres that reach into each child of a cube, as one array with offsets. Reused, as building
/// these lists is most of the work for small spheres.
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
        const std::size_t count = std::size_t(1) << (3 * (log2 - childLog2));
        mFull.assign(count, 0);
        mOffset.assign(count + 1, 0);
        mEntries.clear();
        for (const int32_t* i = begin; i != end; ++i) enter(balls[*i], *i);
        for (std::size_t c = 0; c < count; ++c) mOffset[c + 1] += mOffset[c];
        mItems.resize(mEntries.size());
        for (auto e = mEntries.rbegin(); e != mEntries.rend(); ++e) {
            mItems[--mOffset[e->child + 1]] = e->ball;
        }
        // Each offset was moved to the front of its own child's items: one place to the left of
        // where it is read.
        mOffset.push_back(int32_t(mItems.size()));
    }
    std::size_t size() const { return mFull.size(); }
    bool full(std::size_t child) const { return mFull[child]; }
    const int32_t* begin(std::size_t child) const { return mItems.data() + mOffset[child + 1]; }
    const int32_t* end(std::size_t child) const { return mItems.data() + mOffset[child + 2]; }
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

    /// The children under the ball's box.
    struct Children {
        int32_t first[3], last[3];
    };

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
                    if (mFull[childAt(x, y, z)]) continue;
                    const int32_t first[3] = {lowest(0, x), lowest(1, y), lowest(2, z)};
                    const int32_t last[3] = {highest(0, x), highest(1, y), highest(2, z)};
                    if (!ball.touches(first, last)) continue;
                    enterChild(childAt(x, y, z), index, ball.contains(first, last));
                }
            }
        }
    }
    void enterChild(int32_t child, int32_t index, bool contained)
    {
        if (mFull[child]) return;
        if (contained) {
            mFull[child] = 1;
            return;
        }
        mEntries.push_back({child, index});
        ++mOffset[child + 1];
    }

    int32_t childAt(int32_t x, int32_t y, int32_t z) const
    {
        const int n = mLog2 - mChildLog2;
        return (((x << n) | y) << n) | z;
    }
    /// Voxels of child i along an axis.
    int32_t lowest(int axis, int32_t i) const { return mOrigin[axis] + (i << mChildLog2); }
    int32_t highest(int axis, int32_t i) const
    {
        return lowest(axis, i) + ((int32_t(1) << mChildLog2) - 1);
    }

    openvdb::Coord mOrigin;
    int mLog2 = 0, mChildLog2 = 0;
    Range mAlongX{0, INT32_MAX};
    std::vector<char> mFull;
    std::vector<int32_t> mOffset, mItems;
    std::vector<Entry> mEntries;
    int64_t mNearSq[3][kMostAlong], mFarSq[3][kMostAlong]; ///< of one ball, by child
};

} // namespace openvdb_spheretree::detail
