// SPDX-License-Identifier: Apache-2.0
/// @file detail/ExactBall.h
/// @brief Integer arithmetic on closed spheres that never overflows: what lies inside, and the box.
///
/// Everything is in doubled coordinates, so that centres between voxels stay integers. A squared
/// distance is never summed up (three squares of 33-bit numbers fit no 64-bit integer); it is taken
/// off coverSq, axis by axis, and what would fall below zero stays there.

#pragma once

#include "../SphereUnion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// @return left - d^2; something negative if that is negative, or if @a left is.
inline int64_t takeSquare(int64_t left, int64_t d)
{
    constexpr int64_t kRootOfLargest = 3037000499; // the last one whose square fits 63 bits
    if (left < 0 || d > kRootOfLargest || d < -kRootOfLargest) return -1;
    return left - d * d;
}

/// @return floor(sqrt(value)) for value >= 0.
inline int64_t floorSqrt(int64_t value)
{
    auto root = uint64_t(std::sqrt(double(value)));
    if (value < (int64_t(1) << 52)) return int64_t(root); // exact as it is: both fit a double
    while (root * root > uint64_t(value)) --root;
    while ((root + 1) * (root + 1) <= uint64_t(value)) ++root;
    return int64_t(root);
}

/// Integers q with |2 q - center2| <= reach2, as a closed interval (empty: lo > hi).
struct Interval {
    int64_t lo, hi;
    Interval(int64_t center2, int64_t reach2)
        : lo((center2 - reach2 + 1) >> 1), hi((center2 + reach2) >> 1)
    {}
};

/// @return the voxels along @a axis between the first and the last that the sphere holds, exactly:
/// the other two axes owe half a voxel where the centre is between voxels. Empty with the sphere.
inline Interval extent(const ExactSphere& s, int axis)
{
    int64_t left = s.coverSq;
    for (int other = 0; other < 3; ++other) {
        if (other != axis) left = takeSquare(left, s.center2[other] & 1);
    }
    return left < 0 ? Interval(1, 0) : Interval(s.center2[axis], floorSqrt(left));
}

/// A sphere to be drawn: with the box of its voxels, already clipped.
struct Ball {
    int64_t center2[3];
    int64_t coverSq;
    int32_t lo[3], hi[3]; ///< inclusive
    bool clipped;         ///< the box is smaller than the sphere's own

    /// @return whether the box meets the cube of @a size voxels at @a origin and the sphere comes
    /// as near as one of its voxels, the clip aside.
    bool touches(const int32_t origin[3], int32_t size) const
    {
        int64_t left = coverSq;
        for (int a = 0; a < 3; ++a) {
            const int64_t first = 2 * int64_t(origin[a]), last = first + 2 * (int64_t(size) - 1);
            left = takeSquare(left, std::max(first, std::min(center2[a], last)) - center2[a]);
        }
        return left >= 0;
    }

    /// @return whether every voxel of the cube is in the sphere and in the clip.
    bool contains(const int32_t origin[3], int32_t size) const
    {
        int64_t left = coverSq;
        for (int a = 0; a < 3; ++a) {
            const int64_t last = int64_t(origin[a]) + size - 1;
            if (origin[a] < lo[a] || last > hi[a]) return false;
            const int64_t below = center2[a] - 2 * int64_t(origin[a]);
            left = takeSquare(left, std::max(below, 2 * last - center2[a]));
        }
        return left >= 0;
    }
};

/// @return false if the clipped sphere is empty (or certainly holds no voxel).
inline bool clippedBall(const ExactSphere& s, const openvdb::CoordBBox& clip, Ball& ball)
{
    ball.clipped = false;
    for (int a = 0; a < 3; ++a) {
        const Interval range = extent(s, a);
        const int64_t lo = std::max<int64_t>(range.lo, clip.min()[a]);
        const int64_t hi = std::min<int64_t>(range.hi, clip.max()[a]);
        if (lo > hi) return false;
        ball.lo[a] = int32_t(lo);
        ball.hi[a] = int32_t(hi);
        ball.center2[a] = s.center2[a];
        ball.clipped = ball.clipped || lo != range.lo || hi != range.hi;
    }
    ball.coverSq = s.coverSq;
    return true;
}

} // namespace detail
} // namespace openvdb_spheretree
