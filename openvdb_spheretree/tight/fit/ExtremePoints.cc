// SPDX-License-Identifier: Apache-2.0
#include "ExtremePoints.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// Parallel slices. The number of a point's slice is a sum of its coordinates with the factors X,
/// Y, Z, and its place there are the coordinates along the axes U and V. Of points in ascending
/// order, those of a slice ascend by their places, too.
template <int X, int Y, int Z, int U, int V>
struct Slicing {
    static int64_t of(const Coord& p)
    {
        return X * int64_t(p[0]) + Y * int64_t(p[1]) + Z * int64_t(p[2]);
    }
    static int32_t u(const Coord& p) { return p[U]; }
    static int32_t v(const Coord& p) { return p[V]; }
};

/// Finds the corners of hulls in slices of points, which ascend.
class SliceHulls {
public:
    void keepCornersAlongAxes(std::vector<Coord>& points)
    {
        keepCorners<Slicing<0, 0, 1, 0, 1>>(points);
        keepCorners<Slicing<0, 1, 0, 0, 2>>(points);
        keepCorners<Slicing<1, 0, 0, 1, 2>>(points);
    }

    void keepCornersAcrossDiagonals(std::vector<Coord>& points)
    {
        keepCorners<Slicing<1, 1, 0, 0, 2>>(points);
        keepCorners<Slicing<1, -1, 0, 0, 2>>(points);
        keepCorners<Slicing<1, 0, 1, 0, 1>>(points);
        keepCorners<Slicing<1, 0, -1, 0, 1>>(points);
        keepCorners<Slicing<0, 1, 1, 0, 1>>(points);
        keepCorners<Slicing<0, 1, -1, 0, 1>>(points);
    }

private:
    /// A point in its slice.
    struct Place {
        int32_t u, v;
        uint32_t point;
    };

    /// Keeps the corners of each slice's hull. The points stay in order.
    template <typename By>
    void keepCorners(std::vector<Coord>& points)
    {
        int64_t first = By::of(points.front()), last = first;
        for (const Coord& p : points) {
            first = std::min(first, By::of(p));
            last = std::max(last, By::of(p));
        }
        constexpr int64_t kFew = 4096;
        if (last - first < kFew) countSlices<By>(points, first, last);
        else sortSlices<By>(points);
        mIsCorner.assign(points.size(), 0);
        uint32_t begin = 0;
        for (const uint32_t end : mEnd) {
            markHull(begin, end);
            begin = end;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (mIsCorner[i]) points[kept++] = points[i];
        }
        points.resize(kept);
    }

    /// Lists the places slice by slice, by a counting sort.
    template <typename By>
    void countSlices(const std::vector<Coord>& points, int64_t first, int64_t last)
    {
        mEnd.assign(std::size_t(last - first) + 2, 0);
        for (const Coord& p : points) ++mEnd[std::size_t(By::of(p) - first) + 1];
        std::partial_sum(mEnd.begin(), mEnd.end(), mEnd.begin());
        mPlaces.resize(points.size());
        for (uint32_t i = 0; i < points.size(); ++i) {
            const Coord& p = points[i];
            mPlaces[mEnd[std::size_t(By::of(p) - first)]++] = {By::u(p), By::v(p), i};
        }
    }

    /// The same for slices far apart.
    template <typename By>
    void sortSlices(const std::vector<Coord>& points)
    {
        std::vector<uint32_t> order(points.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return By::of(points[a]) < By::of(points[b]); });
        mEnd.clear();
        mPlaces.clear();
        for (const uint32_t i : order) {
            const Coord& p = points[i];
            const bool isNext =
                !mPlaces.empty() && By::of(points[mPlaces.back().point]) != By::of(p);
            if (isNext) mEnd.push_back(uint32_t(mPlaces.size()));
            mPlaces.push_back({By::u(p), By::v(p), i});
        }
        mEnd.push_back(uint32_t(mPlaces.size()));
    }

    /// Marks the corners of the hull of a slice: the places from @a begin to @a end.
    void markHull(uint32_t begin, uint32_t end)
    {
        if (end - begin <= 2) {
            for (; begin != end; ++begin) mIsCorner[mPlaces[begin].point] = 1;
            return;
        }
        mChain.resize(2 * std::size_t(end - begin));
        std::size_t length = 0;
        const auto grow = [&](const Place& place, std::size_t atLeast) {
            while (length > atLeast && !turnsLeft(mChain[length - 2], mChain[length - 1], place)) {
                --length;
            }
            mChain[length++] = place;
        };
        for (uint32_t i = begin; i < end; ++i) grow(mPlaces[i], 1);
        const std::size_t lower = length;
        for (uint32_t i = end - 1; i-- > begin;) grow(mPlaces[i], lower);
        for (std::size_t i = 0; i < length; ++i) mIsCorner[mChain[i].point] = 1;
    }

    /// @return whether going from a over b to c turns left; else b is no corner.
    static bool turnsLeft(const Place& a, const Place& b, const Place& c)
    {
        const auto along = [](int32_t from, int32_t to) -> __int128 { return int64_t(to) - from; };
        return along(a.u, b.u) * along(a.v, c.v) > along(a.v, b.v) * along(a.u, c.u);
    }

    std::vector<Place> mPlaces, mChain;
    std::vector<uint32_t> mEnd; ///< of each slice, in mPlaces
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
    hulls.keepCornersAlongAxes(points);
    if (points.size() > kMany) hulls.keepCornersAcrossDiagonals(points);
}

} // namespace openvdb_spheretree::tight
