// SPDX-License-Identifier: Apache-2.0
/// @file detail/ExactBall.h
/// @brief Integer arithmetic on closed spheres that never overflows: what lies inside, and the box.
///
/// Everything is in doubled coordinates, so that centres between voxels stay integers. A sphere may
/// be one of a norm. All that is used of a distance is that it grows with each coordinate: the
/// nearest and the farthest voxel of a box are so along every axis.

#pragma once

#include "../SphereUnion.h"

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Integers q with |2 q - center2| <= reach2, as a closed interval (empty: lo > hi).
struct Interval {
    int64_t lo, hi;
    Interval(int64_t center2, int64_t reach2)
        : lo((center2 - reach2 + 1) >> 1), hi((center2 + reach2) >> 1)
    {}
};

/// @return the voxels along @a axis between the first and the last that the sphere holds, exactly:
/// the other two axes owe half a voxel where the centre is between voxels. Empty with the sphere.
inline Interval extent(const ExactSphere& s, int axis, const Distance& distance)
{
    const int64_t reach =
        distance.reach(s.center2[(axis + 1) % 3] & 1, s.center2[(axis + 2) % 3] & 1, s.coverSq);
    return reach < 0 ? Interval(1, 0) : Interval(s.center2[axis], reach);
}

/// A sphere to be drawn: with the box of its voxels, already clipped.
struct Ball {
    int64_t center2[3];
    int64_t coverSq;
    Distance distance;
    int32_t lo[3], hi[3]; ///< inclusive
    bool clipped;         ///< the box is smaller than the sphere's own
    bool plain;           ///< Euclidean, and small enough that squares near its box do not overflow

    /// Balls of this size and less are plain: 2^29 and a cube of 4096 voxels, doubled, squared.
    static constexpr int64_t kMaxPlainCoverSq = int64_t(1) << 58;

    /// @return whether the ball holds what is so far from its centre; the most that is asked are
    /// the corners of a cube that meets its box.
    bool holds(const int64_t d[3]) const
    {
        if (plain) return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= coverSq;
        return distance.lengthSq(d[0], d[1], d[2]) <= coverSq;
    }

    /// @return whether the box meets the cube of @a size voxels at @a origin and the sphere comes
    /// as near as one of its voxels, the clip aside.
    bool touches(const int32_t origin[3], int32_t size) const
    {
        int64_t d[3];
        for (int a = 0; a < 3; ++a) {
            const int64_t first = 2 * int64_t(origin[a]), last = first + 2 * (int64_t(size) - 1);
            d[a] = std::max(first, std::min(center2[a], last)) - center2[a];
        }
        return holds(d);
    }

    /// @return whether every voxel of the cube is in the sphere and in the clip.
    bool contains(const int32_t origin[3], int32_t size) const
    {
        int64_t d[3];
        for (int a = 0; a < 3; ++a) {
            const int64_t last = int64_t(origin[a]) + size - 1;
            if (origin[a] < lo[a] || last > hi[a]) return false;
            const int64_t below = center2[a] - 2 * int64_t(origin[a]);
            d[a] = std::max(below, 2 * last - center2[a]);
        }
        return holds(d);
    }
};

/// @return false if the clipped sphere is empty (or certainly holds no voxel).
inline bool clippedBall(
    const ExactSphere& s, const Distance& distance, const openvdb::CoordBBox& clip, Ball& ball)
{
    ball.distance = distance;
    ball.clipped = false;
    for (int a = 0; a < 3; ++a) {
        const Interval range = extent(s, a, distance);
        const int64_t lo = std::max<int64_t>(range.lo, clip.min()[a]);
        const int64_t hi = std::min<int64_t>(range.hi, clip.max()[a]);
        if (lo > hi) return false;
        ball.lo[a] = int32_t(lo);
        ball.hi[a] = int32_t(hi);
        ball.center2[a] = s.center2[a];
        ball.clipped = ball.clipped || lo != range.lo || hi != range.hi;
    }
    ball.plain = distance.isEuclidean() && s.coverSq <= Ball::kMaxPlainCoverSq;
    ball.coverSq = std::min(s.coverSq, INT64_MAX - 1); // lengths that do not fit are beyond it
    return true;
}

} // namespace detail
} // namespace openvdb_spheretree
