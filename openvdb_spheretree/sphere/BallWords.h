// SPDX-License-Identifier: Apache-2.0
/// @file BallWords.h
/// @brief The voxels of a ball in a cube: row by row, or as the mask words of a leaf.

#pragma once

#include "ClippedSphere.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/kernel/LeafBall.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>

namespace openvdb_spheretree {
namespace detail {

/// Calls f(x, y, lo, hi) for the rows of a ball in the cube of @a size voxels at @a origin, which
/// its box must meet: voxels (x, y, lo...hi), counted from the cube's corner. Some rows may be
/// empty (lo > hi).
template <typename F>
void forEachRow(const ClippedSphere& ball, const openvdb::Coord& origin, int32_t size, const F& f)
{
    int32_t first[3], last[3]; // of the ball's box
    int64_t center[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(ball.lo[a], origin[a]) - origin[a];
        last[a] = std::min(ball.hi[a], origin[a] + (size - 1)) - origin[a];
        center[a] = ball.center[a] - inUnits(origin[a], ball.shift);
    }
    const int64_t voxel = inUnits(1, ball.shift);
    int64_t dx = inUnits(first[0], ball.shift) - center[0];
    for (int32_t x = first[0]; x <= last[0]; ++x, dx += voxel) {
        int64_t dy = inUnits(first[1], ball.shift) - center[1];
        for (int32_t y = first[1]; y <= last[1]; ++y, dy += voxel) {
            const int64_t reach = ball.distance.reach(dx, dy, ball.radiusSq);
            if (reach < 0) continue;
            const Interval run(center[2], reach, ball.shift);
            f(x, y, int32_t(std::max<int64_t>(run.lo, first[2])),
                int32_t(std::min<int64_t>(run.hi, last[2])));
        }
    }
}

/// @return the bits of lo...hi, which are in order, of a row of eight.
inline uint64_t rowBits(int32_t lo, int32_t hi) { return (0xffu >> (7 - hi)) & (0xffu << lo); }

/// ORs what is in a ball's box of the words of the leaf at @a origin, which it must meet, into
/// others.
inline void orBoxOfWords(const uint64_t from[8], const ClippedSphere& ball,
    const openvdb::Coord& origin, uint64_t words[8])
{
    int32_t first[3], last[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(ball.lo[a], origin[a]) - origin[a];
        last[a] = std::min(ball.hi[a], origin[a] + 7) - origin[a];
        assert(first[a] <= last[a]);
    }
    const uint64_t rows = ~uint64_t(0) >> (8 * (7 - last[1])) & ~uint64_t(0) << (8 * first[1]);
    const uint64_t box = rows & rowBits(first[2], last[2]) * 0x0101010101010101;
    for (int32_t x = first[0]; x <= last[0]; ++x) words[x] |= from[x] & box;
}

/// ORs the voxels of a ball into the words of the leaf at @a origin (word x, bit 8 y + z), which
/// its box must meet. By a kernel where that is exact.
inline void orBallIntoWords(
    const ClippedSphere& ball, const openvdb::Coord& origin, uint64_t words[8])
{
    int64_t center[3], farthest = 0;
    const int64_t middle = inUnits(7, ball.shift - 1);
    for (int a = 0; a < 3; ++a) {
        center[a] = ball.center[a] - inUnits(origin[a], ball.shift);
        farthest = std::max(farthest, std::abs(center[a] - middle) + middle);
    }
    const bool euclidean = ball.distance.isEuclidean();
    const int64_t most = euclidean ? kLeafBallReach : kLeafNormReach;
    if (farthest > most || ball.radiusSq > most * most) {
        forEachRow(ball, origin, 8, [&](int32_t x, int32_t y, int32_t lo, int32_t hi) {
            if (lo <= hi) words[x] |= rowBits(lo, hi) << (8 * y);
        });
        return;
    }
    uint64_t drawn[8] = {};
    uint64_t* const target = ball.clipped ? drawn : words;
    if (euclidean) {
        orBallIntoLeaf(center, ball.radiusSq, ball.shift, target);
    } else {
        orNormBallIntoLeaf(center, ball.distance, floorSqrt(ball.radiusSq), ball.shift, target);
    }
    if (ball.clipped) orBoxOfWords(drawn, ball, origin, words);
}

} // namespace detail
} // namespace openvdb_spheretree
