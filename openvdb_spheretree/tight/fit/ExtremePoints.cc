// SPDX-License-Identifier: Apache-2.0
#include "ExtremePoints.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// Parallel slices. The number of a point's slice is a sum of its coordinates with these factors, and
/// its place there are the coordinates along two axes. Of points in ascending order, those of a slice
/// ascend by their places, too.
struct Slicing {
    int x, y, z; ///< factors
    int u, v;    ///< axes

    int64_t of(const Coord& p) const
    {
        return int64_t(x) * p[0] + int64_t(y) * p[1] + int64_t(z) * p[2];
    }
};

constexpr Slicing kAlongAxes[3] = {{0, 0, 1, 0, 1}, {0, 1, 0, 0, 2}, {1, 0, 0, 1, 2}};
constexpr Slicing kDiagonal[6] = {{1, 1, 0, 0, 2}, {1, -1, 0, 0, 2}, {1, 0, 1, 0, 1},
    {1, 0, -1, 0, 1}, {0, 1, 1, 0, 1}, {0, 1, -1, 0, 1}};

/// Finds the corners of hulls in slices of points, which ascend.
class SliceHulls {
public:
    /// Keeps the corners of each slice's hull. The points stay in order.
    void keepCorners(std::vector<Coord>& points, const Slicing& by)
    {
        sortBySlice(points, by);
        mIsCorner.assign(points.size(), 0);
        for (std::size_t i = 0; i < mOrder.size();) {
            std::size_t j = i + 1;
            while (j < mOrder.size() && mSlice[mOrder[j]] == mSlice[mOrder[i]]) ++j;
            markHull(points, by, i, j);
            i = j;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (mIsCorner[i]) points[kept++] = points[i];
        }
        points.resize(kept);
    }

private:
    /// Numbers the points by slice, and in each slice as they come.
    void sortBySlice(const std::vector<Coord>& points, const Slicing& by)
    {
        mSlice.clear();
        for (const Coord& p : points) mSlice.push_back(by.of(p));
        const auto ends = std::minmax_element(mSlice.begin(), mSlice.end());
        const int64_t first = *ends.first, slices = *ends.second - first + 1;
        mOrder.resize(points.size());
        constexpr int64_t kFew = 4096;
        if (slices > kFew) {
            std::iota(mOrder.begin(), mOrder.end(), 0);
            std::stable_sort(mOrder.begin(), mOrder.end(),
                [&](uint32_t a, uint32_t b) { return mSlice[a] < mSlice[b]; });
            return;
        }
        mBegin.assign(std::size_t(slices) + 1, 0);
        for (const int64_t slice : mSlice) ++mBegin[std::size_t(slice - first) + 1];
        std::partial_sum(mBegin.begin(), mBegin.end(), mBegin.begin());
        for (uint32_t i = 0; i < mSlice.size(); ++i) {
            mOrder[mBegin[std::size_t(mSlice[i] - first)]++] = i;
        }
    }

    /// Marks the corners of the hull of a slice: the points with the numbers at @a begin to @a end.
    void markHull(
        const std::vector<Coord>& points, const Slicing& by, std::size_t begin, std::size_t end)
    {
        if (end - begin <= 2) {
            for (; begin != end; ++begin) mIsCorner[mOrder[begin]] = 1;
            return;
        }
        mChain.clear();
        const auto grow = [&](uint32_t p, std::size_t atLeast) {
            while (mChain.size() > atLeast
                && !turnsLeft(points[*(mChain.end() - 2)], points[mChain.back()], points[p], by)) {
                mChain.pop_back();
            }
            mChain.push_back(p);
        };
        for (std::size_t i = begin; i < end; ++i) grow(mOrder[i], 1);
        const std::size_t lower = mChain.size();
        for (std::size_t i = end - 1; i-- > begin;) grow(mOrder[i], lower);
        for (const uint32_t p : mChain) mIsCorner[p] = 1;
    }

    /// @return whether going from a over b to c turns left; else b is no corner.
    static bool turnsLeft(const Coord& a, const Coord& b, const Coord& c, const Slicing& by)
    {
        const auto along = [](const Coord& from, const Coord& to, int axis) -> __int128 {
            return int64_t(to[axis]) - from[axis];
        };
        return along(a, b, by.u) * along(a, c, by.v) > along(a, b, by.v) * along(a, c, by.u);
    }

    std::vector<int64_t> mSlice; ///< of each point
    std::vector<uint32_t> mOrder, mBegin, mChain;
    std::vector<char> mIsCorner;
};

/// The lower and the upper hull of a slice's rows, which are ordered by y.
template <typename Rows>
void appendRowHull(int32_t x, const Rows& rows, std::vector<Coord>& points)
{
    thread_local std::vector<Coord> chain;
    for (const int side : {-1, 1}) {
        chain.clear();
        for (const auto& row : rows) {
            const Coord p(x, row.y, side < 0 ? row.first : row.last);
            while (chain.size() > 1) {
                const Coord &a = *(chain.end() - 2), &b = chain.back();
                const __int128 left = __int128(int64_t(b[1]) - a[1]) * (int64_t(p[2]) - a[2]);
                const __int128 turn =
                    left - __int128(int64_t(b[2]) - a[2]) * (int64_t(p[1]) - a[1]);
                if (side * turn < 0) break;
                chain.pop_back();
            }
            chain.push_back(p);
        }
        points.insert(points.end(), chain.begin(), chain.end());
    }
}

} // namespace

void ExtremePoints::clear()
{
    for (auto& slice : mSlices) slice.clear();
    mPoints.clear();
}

void ExtremePoints::addRow(std::vector<Row>& slice, int32_t y, int32_t first, int32_t last)
{
    // The leaves of a column follow each other: if the row is there, it is one of the last eight.
    for (std::size_t i = slice.size(), tried = 0; i-- > 0 && tried < 8; ++tried) {
        if (slice[i].y != y) continue;
        slice[i].last = last;
        return;
    }
    slice.push_back({y, first, last});
}

void ExtremePoints::add(const Coord& origin, const LeafMask& mask)
{
    if (origin[0] != mSlab[0]) flush();
    mSlab = origin;
    for (int x = 0; x < 8; ++x) {
        uint64_t word = mask[x];
        while (word) {
            const int y = __builtin_ctzll(word) >> 3;
            const auto row = uint32_t(word >> (8 * y) & 0xff);
            word &= ~(uint64_t(0xff) << (8 * y));
            addRow(mSlices[x], origin[1] + y, origin[2] + __builtin_ctz(row),
                origin[2] + 31 - __builtin_clz(row));
        }
    }
}

void ExtremePoints::flush()
{
    for (int x = 0; x < 8; ++x) {
        if (mSlices[x].empty()) continue;
        std::sort(mSlices[x].begin(), mSlices[x].end(),
            [](const Row& a, const Row& b) { return a.y < b.y; });
        appendRowHull(mSlab[0] + x, mSlices[x], mPoints);
        mSlices[x].clear();
    }
}

std::vector<Coord>& ExtremePoints::finish()
{
    flush();
    dropInnerPoints(mPoints);
    return mPoints;
}

void dropInnerPoints(std::vector<Coord>& points)
{
    constexpr std::size_t kFew = 5, kMany = 40; // diagonal slices cost more than they save below
    // Often they are those of two sets, each in order.
    const auto second = std::is_sorted_until(points.begin(), points.end());
    if (std::is_sorted(second, points.end())) {
        std::inplace_merge(points.begin(), second, points.end());
    } else {
        std::sort(points.begin(), points.end());
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < kFew) return;
    thread_local SliceHulls hulls;
    for (const Slicing& slices : kAlongAxes) hulls.keepCorners(points, slices);
    if (points.size() <= kMany) return;
    for (const Slicing& slices : kDiagonal) hulls.keepCorners(points, slices);
}

} // namespace openvdb_spheretree::tight
