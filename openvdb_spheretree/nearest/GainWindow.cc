// SPDX-License-Identifier: Apache-2.0
#include "GainWindow.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree::nearest {

namespace {

using tight::kFine;
using tight::kFineShift;

/// A window may reach beyond the ends of coordinates; samples do not.
int32_t toCoordinate(int64_t sample)
{
    constexpr int64_t kFirst = std::numeric_limits<int32_t>::min();
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max();
    return int32_t(std::max(kFirst, std::min(sample, kLast)));
}

/// @return the bits first to last of a word.
uint64_t bitsBetween(int32_t first, int32_t last)
{
    return ~uint64_t(0) << first & ~uint64_t(0) >> (63 - last);
}

} // namespace

void GainWindow::reset(
    const tight::SampledObject& object, const tight::FineBox& box, int level, bool flat)
{
    mLevel = level;
    const int shift = level + kFineShift;
    int64_t origin[3];
    for (int a = 0; a < 3; ++a) {
        const bool plane = flat && a == 2;
        origin[a] = plane ? 0 : box.lo[a] >> shift;
        if (a == 2) origin[a] &= ~int64_t(7); // bytes of leaves are bytes of rows
        mSize[a] = plane ? 1 : int32_t((box.hi[a] >> shift) + 1 - origin[a]);
        mFineOrigin[a] = origin[a] * (int64_t(1) << shift);
    }
    mWords = (mSize[2] + 63) / 64;
    const std::size_t words = std::size_t(mSize[0]) * mSize[1] * mWords;
    mObject.assign(words, 0);
    mFree.assign(words, ~uint64_t(0));
    openvdb::CoordBBox met; // of the window, where there can be samples
    for (int a = 0; a < 3; ++a) {
        met.min()[a] = toCoordinate(origin[a]);
        met.max()[a] = toCoordinate(origin[a] + mSize[a] - 1);
    }
    const tight::SampleLevel& samples = object.level(level);
    samples.forEachLeaf(met, [&](std::size_t leaf) {
        openvdb::Coord at;
        for (int a = 0; a < 3; ++a) at[a] = int32_t(samples.origin(leaf)[a] - origin[a]);
        const LeafMask& mask = samples.mask(leaf);
        const int x0 = std::max(0, at[0]), x1 = std::min(mSize[0], at[0] + kLeafDim);
        const int y0 = std::max(0, at[1]), y1 = std::min(mSize[1], at[1] + kLeafDim);
        for (int x = x0; x < x1; ++x) {
            uint64_t* row = &mObject[(std::size_t(x) * mSize[1] + y0) * mWords + (at[2] >> 6)];
            uint64_t rows = mask[x - at[0]] >> (8 * (y0 - at[1]));
            for (int y = y0; y < y1; ++y, row += mWords, rows >>= 8) {
                *row |= (rows & 0xff) << (at[2] & 63);
            }
        }
    });
}

/// Calls visit(row, first, last) for the rows of samples in a sphere, as far as they are in the window.
template <typename Visit>
void GainWindow::visitRows(const LocalSphere& sphere, const Visit& visit) const
{
    const auto range = [this](int64_t center, int64_t reach, int axis) {
        const int64_t first = (center - reach + kFine - 1) >> kFineShift;
        const int64_t last = (center + reach) >> kFineShift;
        return std::pair(int32_t(std::max<int64_t>(first, 0)),
            int32_t(std::min<int64_t>(last, mSize[axis] - 1)));
    };
    if (sphere.radiusSq < 0) return;
    const auto& [cx, cy, cz] = sphere.center;
    const auto [x0, x1] = range(cx, detail::floorSqrt(sphere.radiusSq), 0);
    for (int32_t x = x0; x <= x1; ++x) {
        const int64_t restX = sphere.radiusSq - detail::square(kFine * x - cx);
        const auto [y0, y1] = range(cy, detail::floorSqrt(restX), 1);
        for (int32_t y = y0; y <= y1; ++y) {
            const int64_t rest = restX - detail::square(kFine * y - cy);
            const auto [z0, z1] = range(cz, detail::floorSqrt(rest), 2);
            if (z0 <= z1) visit(std::size_t(x) * mSize[1] + y, z0, z1);
        }
    }
}

void GainWindow::cover(const ExactSphere& sphere)
{
    visitRows(toLocal(sphere), [this](std::size_t row, int32_t first, int32_t last) {
        uint64_t* const words = &mFree[row * mWords];
        for (int32_t word = first >> 6; word <= last >> 6; ++word) {
            const int32_t begin = std::max(first - 64 * word, 0);
            words[word] &= ~bitsBetween(begin, std::min(last - 64 * word, 63));
        }
    });
}

void GainWindow::sum()
{
    const std::size_t rows = std::size_t(mSize[0]) * mSize[1];
    mSums.resize(rows * (mSize[2] + 1));
    int32_t* next = mSums.data();
    for (std::size_t row = 0; row < rows; ++row) {
        int32_t sum = 0;
        for (int32_t z = 0; z < mSize[2]; ++z) {
            const std::size_t word = row * mWords + (z >> 6);
            const int free = mFree[word] >> (z & 63) & 1, object = mObject[word] >> (z & 63) & 1;
            *next++ = sum;
            sum += free * (2 * object - 1);
        }
        *next++ = sum;
    }
}

int64_t GainWindow::gain(const LocalSphere& sphere) const
{
    int64_t sum = 0;
    visitRows(sphere, [&](std::size_t row, int32_t first, int32_t last) {
        const int32_t* const sums = &mSums[row * (mSize[2] + 1)];
        sum += sums[last + 1] - sums[first];
    });
    return sum;
}

bool GainWindow::holds(const LocalSphere& sphere) const
{
    const int64_t reach = detail::floorSqrt(sphere.radiusSq);
    for (int a = 0; a < 3; ++a) {
        if (mSize[a] == 1) continue; // the plane
        if (sphere.center[a] < reach || sphere.center[a] + reach >= kFine * mSize[a]) return false;
    }
    return true;
}

LocalSphere GainWindow::toLocal(const ExactSphere& sphere) const
{
    LocalSphere local;
    for (int a = 0; a < 3; ++a) local.center[a] = (sphere.center[a] - mFineOrigin[a]) >> mLevel;
    local.radiusSq = sphere.radiusSq >> (2 * mLevel);
    return local;
}

ExactSphere GainWindow::moved(
    const ExactSphere& sphere, const LocalSphere& from, const LocalSphere& to) const
{
    ExactSphere result = sphere;
    for (int a = 0; a < 3; ++a) {
        result.center[a] += (to.center[a] - from.center[a]) * (int64_t(1) << mLevel);
    }
    if (to.radiusSq != from.radiusSq) {
        result.radiusSq = to.radiusSq * (int64_t(1) << (2 * mLevel));
    }
    return result;
}

} // namespace openvdb_spheretree::nearest
