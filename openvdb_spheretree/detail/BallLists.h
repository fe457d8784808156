// SPDX-License-Identifier: Apache-2.0
/// @file detail/BallLists.h
/// @brief Which balls reach into which child of a cubic cell.

#pragma once

#include "ExactBall.h"

#include <cstddef>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// The spheres that reach into each child of a cell, as one array with offsets. Reused, as building
/// these lists is most of the work for small spheres.
class BallLists {
public:
    /// Children along an axis, first and last.
    struct Range {
        int32_t first, last;
    };

    /// @param origin, log2    the cell
    /// @param childLog2       its children's size; children are numbered x slowest, as in OpenVDB
    /// @param alongX          those wanted; others get no ball
    void build(const std::vector<Ball>& balls, const int32_t* begin, const int32_t* end,
        const openvdb::Coord& origin, int log2, int childLog2, Range alongX = {0, INT32_MAX})
    {
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
    struct Entry {
        int32_t child, ball;
    };

    void enter(const Ball& ball, int32_t index)
    {
        int32_t first[3], last[3]; // of the children under the ball's box
        const int32_t size = int32_t(1) << mLog2;
        for (int a = 0; a < 3; ++a) {
            first[a] = (std::max(ball.lo[a], mOrigin[a]) - mOrigin[a]) >> mChildLog2;
            last[a] = (std::min(ball.hi[a], mOrigin[a] + (size - 1)) - mOrigin[a]) >> mChildLog2;
        }
        first[0] = std::max(first[0], mAlongX.first);
        last[0] = std::min(last[0], mAlongX.last);
        for (int32_t x = first[0]; x <= last[0]; ++x) {
            for (int32_t y = first[1]; y <= last[1]; ++y) {
                for (int32_t z = first[2]; z <= last[2]; ++z) enterChild(ball, index, x, y, z);
            }
        }
    }
    void enterChild(const Ball& ball, int32_t index, int32_t x, int32_t y, int32_t z)
    {
        const int n = mLog2 - mChildLog2;
        const int32_t child = (((x << n) | y) << n) | z, size = int32_t(1) << mChildLog2;
        if (mFull[child]) return;
        const int32_t origin[3] = {mOrigin[0] + (x << mChildLog2), mOrigin[1] + (y << mChildLog2),
            mOrigin[2] + (z << mChildLog2)};
        if (!ball.touches(origin, size)) return;
        if (ball.contains(origin, size)) {
            mFull[child] = 1;
            return;
        }
        mEntries.push_back({child, index});
        ++mOffset[child + 1];
    }

    openvdb::Coord mOrigin;
    int mLog2 = 0, mChildLog2 = 0;
    Range mAlongX{0, INT32_MAX};
    std::vector<char> mFull;
    std::vector<int32_t> mOffset, mItems;
    std::vector<Entry> mEntries;
};

} // namespace detail
} // namespace openvdb_spheretree
