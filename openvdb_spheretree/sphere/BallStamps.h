// SPDX-License-Identifier: Apache-2.0
/// @file BallStamps.h
/// @brief Balls of a few voxels as mask words that are computed once: most of the balls of a thin
/// object are one of some hundred.
///
/// What such a ball looks like depends on its size, on where its center is between voxels, and on
/// where in a leaf its box begins along y and z. Each of its slices along x is then a word for each
/// of two by two leaves. (Drawn row by row, a ball of 30 rows takes ten times as long.)

#pragma once

#include "ClippedSphere.h"

#include <array>
#include <cstdint>
#include <unordered_map>

namespace openvdb_spheretree::detail {

/// The slices of a ball, from its first: words of the leaves [first, first], [first, next], [next,
/// first] and [next, next] along y and z.
struct BallStamp {
    static constexpr int kSide = 8;
    std::array<std::array<uint64_t, 4>, kSide> slices = {};
};

/// Stamps, made when they are first used. All balls must be of one distance and unit. A level has
/// some hundred to some thousand of them, and there are no more than 10^5 Euclidean ones (30 MB).
class BallStamps {
public:
    /// @return whether a ball has a stamp: it is not clipped, and its box is no wider than a leaf.
    static bool has(const ClippedSphere& ball)
    {
        if (ball.clipped || ball.shift > 1) return false; // finer centers are hardly ever alike
        for (int a = 0; a < 3; ++a) {
            if (ball.hi[a] - ball.lo[a] >= BallStamp::kSide) return false;
        }
        return true;
    }

    const BallStamp& of(const ClippedSphere& ball)
    {
        // Which ball it is, from the corner of the leaf that its box begins in along y and z, and
        // from the box itself along x. A ball that fits is less than 4.5 voxels in radius: its
        // radiusSq is below 2^32 in any distance's units.
        uint64_t key = uint64_t(ball.radiusSq);
        for (int a = 0; a < 3; ++a) key = key << 1 | uint64_t(ball.center[a] & 1);
        key = key << 6 | uint64_t(ball.lo[1] & 7) << 3 | uint64_t(ball.lo[2] & 7);
        const auto found = mStamps.find(key);
        if (found != mStamps.end()) return found->second;
        return mStamps.emplace(key, make(ball)).first->second;
    }

private:
    static BallStamp make(const ClippedSphere& ball)
    {
        BallStamp stamp;
        const openvdb::Coord corner(ball.lo[0], ball.lo[1] & ~7, ball.lo[2] & ~7);
        ClippedSphere local = ball; // from that corner: a stamp may reach beyond 32 bits
        for (int a = 0; a < 3; ++a) {
            local.lo[a] -= corner[a];
            local.hi[a] -= corner[a];
            local.center[a] -= inUnits(corner[a], ball.shift);
        }
        forEachRow(local, openvdb::Coord(0), 2 * BallStamp::kSide,
            [&](int32_t x, int32_t y, int32_t lo, int32_t hi) {
                for (int32_t z = lo; z <= hi; ++z) {
                    uint64_t& word = stamp.slices[x][(y >> 3) << 1 | z >> 3];
                    word |= uint64_t(1) << (8 * (y & 7) + (z & 7));
                }
            });
        return stamp;
    }

    std::unordered_map<uint64_t, BallStamp> mStamps;
};

} // namespace openvdb_spheretree::detail
