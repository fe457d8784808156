// SPDX-License-Identifier: Apache-2.0
#include "LevelFrame.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree {

namespace {

using Wide = unsigned __int128;

/// @return x y in 256 bits: the upper half, the lower half.
std::pair<Wide, Wide> product(Wide x, Wide y)
{
    const Wide low = ~uint64_t(0);
    const Wide xl = x & low, xh = x >> 64, yl = y & low, yh = y >> 64;
    const Wide middle = xh * yl + (xl * yl >> 64); // at most 2^128 - 2^64
    const Wide other = xl * yh + (middle & low);
    return {xh * yh + (middle >> 64) + (other >> 64), other << 64 | (xl * yl & low)};
}

/// sqrt(D) <= sqrt(a) + sqrt(b) + sqrt(c), for D >= c, by squaring what is left until no root is.
bool withinRoots(int64_t D, int64_t a, int64_t b, int64_t c)
{
    // (sqrt(D) - sqrt(c))^2 <= (sqrt(a) + sqrt(b))^2, so: rest <= 2 sqrt(ab) + 2 sqrt(Dc)
    const __int128 rest = __int128(D) + c - a - b;
    if (rest <= 0) return true;
    const Wide ab = Wide(a) * Wide(b), Dc = Wide(D) * Wide(c);
    const Wide restSq = Wide(rest) * Wide(rest);
    if (restSq <= 4 * ab + 4 * Dc) return true;
    const Wide left = restSq - 4 * ab - 4 * Dc; // left <= 8 sqrt(ab Dc)
    return product(left, left) <= product(8 * ab, 8 * Dc);
}

} // namespace

int64_t coverSqOfRoots(int64_t a, int64_t b, int64_t c)
{
    const long double sum =
        std::sqrt((long double)(a)) + std::sqrt((long double)(b)) + std::sqrt((long double)(c));
    int64_t D = std::max(c, int64_t(sum * sum)); // right but for rounding
    while (D > c && !withinRoots(D, a, b, c)) --D;
    while (withinRoots(D + 1, a, b, c)) ++D;
    return D;
}

LevelFrame::LevelFrame(
    int level, const openvdb::Coord& origin, const SphereTreeSettings& settings, int flatAxis)
    : mLevel(level), mDistance(settings.dist())
{
    const auto* given = settings.find<PyramidOptions>();
    const PyramidOptions& options = given ? *given : PyramidOptions();
    mTight = level == 0 || options.scale == RadiusScale::Tight;
    for (int k = 0; k < level; ++k) {
        mScale *= options.factor;
        if (mScale <= kMaxScale) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "the object is too wide for factor="
                << options.factor << ": level " << k + 1 << " would have voxels of " << mScale
                << ", and " << kMaxScale << " is the most: use another factor, or larger voxels");
    }
    const int64_t grown = mScale - 1;
    mGrowthSq = mDistance.lengthSq(grown, grown, settings.dim == 3 ? grown : 0);
    if (mGrowthSq == INT64_MAX) throwTooWide();
    for (int axis = 0; axis < 3; ++axis) {
        const bool scaled = settings.dim == 3 || axis != flatAxis;
        mStep[axis] = scaled ? 2 * mScale : 2;
        mFirst[axis] = (level == 0 ? 0 : 2 * int64_t(origin[axis])) + (scaled ? grown : 0);
    }
}

void LevelFrame::throwTooWide() const
{
    OPENVDB_THROW(openvdb::ValueError,
        "the balls of level " << mLevel << ", with voxels of " << mScale
                              << ", are too wide for dist=" << toString(mDistance)
                              << ": use smaller weights, a smaller factor, or larger voxels");
}

RootSum LevelFrame::radius(int32_t radiusSq) const
{
    const int64_t covered = mTight ? mDistance.closedSq(radiusSq) : int64_t(radiusSq);
    const Wide scaled = 4 * Wide(mScale) * Wide(mScale) * Wide(covered);
    // The square of the sum of both roots has to fit 63 bits.
    constexpr int64_t kNear = Distance::kFar / 2 * (Distance::kFar / 2);
    if (scaled < Wide(kNear) && mGrowthSq < kNear) return {int64_t(scaled), mGrowthSq};
    const long double sum = std::sqrt((long double)(scaled)) + std::sqrt((long double)(mGrowthSq));
    if (sum >= (long double)(Distance::kFar)) throwTooWide();
    return {int64_t(scaled), mGrowthSq};
}

} // namespace openvdb_spheretree
