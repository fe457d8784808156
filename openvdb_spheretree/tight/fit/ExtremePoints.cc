// SPDX-License-Identifier: Apache-2.0
#include "ExtremePoints.h"

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// A point, and where it is in which slice.
struct SlicePoint {
    int64_t slice, u, v;
    Coord at;
};

/// @return whether going from a over b to c does not turn left: then b is no corner.
bool turnsRight(const SlicePoint& a, const SlicePoint& b, const SlicePoint& c)
{
    const __int128 left = __int128(b.u - a.u) * (c.v - a.v);
    return left - __int128(b.v - a.v) * (c.u - a.u) <= 0;
}

/// Appends the corners of the hull of points that are ordered by u, then v.
void appendHull(const SlicePoint* begin, const SlicePoint* end, std::vector<Coord>& corners,
    std::vector<SlicePoint>& chain)
{
    if (end - begin <= 2) {
        for (; begin != end; ++begin) corners.push_back(begin->at);
        return;
    }
    chain.clear();
    const auto grow = [&](const SlicePoint& p, std::size_t atLeast) {
        while (chain.size() > atLeast && turnsRight(*(chain.end() - 2), chain.back(), p)) {
            chain.pop_back();
        }
        chain.push_back(p);
    };
    for (const SlicePoint* p = begin; p != end; ++p) grow(*p, 1);
    const std::size_t lower = chain.size();
    for (const SlicePoint* p = end - 1; p-- != begin;) grow(*p, lower);
    chain.pop_back(); // the first point again
    for (const SlicePoint& p : chain) corners.push_back(p.at);
}

/// Parallel slices. The number of a point's slice is a sum of its coordinates with these factors, and
/// its place there are the coordinates along two axes.
struct Slicing {
    int x, y, z; ///< factors
    int u, v;    ///< axes
};

constexpr Slicing kAlongAxes[3] = {{0, 0, 1, 0, 1}, {0, 1, 0, 0, 2}, {1, 0, 0, 1, 2}};
constexpr Slicing kDiagonal[6] = {{1, 1, 0, 0, 2}, {1, -1, 0, 0, 2}, {1, 0, 1, 0, 1},
    {1, 0, -1, 0, 1}, {0, 1, 1, 1, 0}, {0, 1, -1, 1, 0}};

/// Keeps the corners of each slice's hull.
void keepSliceHulls(std::vector<Coord>& points, const Slicing& by)
{
    thread_local std::vector<SlicePoint> order, chain;
    order.clear();
    for (const Coord& p : points) {
        const int64_t slice = int64_t(by.x) * p[0] + int64_t(by.y) * p[1] + int64_t(by.z) * p[2];
        order.push_back({slice, p[by.u], p[by.v], p});
    }
    std::sort(order.begin(), order.end(), [](const SlicePoint& a, const SlicePoint& b) {
        return a.slice != b.slice ? a.slice < b.slice : a.u != b.u ? a.u < b.u : a.v < b.v;
    });
    points.clear();
    for (std::size_t i = 0; i < order.size();) {
        std::size_t j = i + 1;
        while (j < order.size() && order[j].slice == order[i].slice) ++j;
        appendHull(&order[i], &order[i] + (j - i), points, chain);
        i = j;
    }
}

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
    constexpr std::size_t kMany = 40; // diagonal slices cost more than they save below
    if (points.size() >= 5) {
        for (const Slicing& slices : kAlongAxes) keepSliceHulls(points, slices);
        if (points.size() > kMany) {
            for (const Slicing& slices : kDiagonal) keepSliceHulls(points, slices);
        }
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

} // namespace openvdb_spheretree::tight
