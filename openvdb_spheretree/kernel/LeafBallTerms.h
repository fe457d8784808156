// SPDX-License-Identifier: Apache-2.0
/// @file LeafBallTerms.h
/// @brief What the vector kernel and the portable one compare (LeafBall.cc).

#pragma once

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// The terms t(i) of each axis. Voxel (x, y, z) of the leaf is in the ball when
///     ofY[y] + ofZ[z] - least <= most - ofX[x]
/// where the right side is never negative.
struct alignas(32) BallTerms {
    int32_t ofX[8], ofY[8], ofZ[8];
    int32_t most;  ///< of ofX; it is at one of its ends
    int32_t least; ///< the least limit of a word

    BallTerms(const int64_t center[3], int64_t radiusSq, int shift)
    {
        const int32_t half = int32_t(1) << (shift - 1);
        const auto x = int32_t(center[0]), y = int32_t(center[1]), z = int32_t(center[2]);
        for (int32_t i = 0; i < 8; ++i) {
            ofX[i] = i * (half * i - x);
            ofY[i] = i * (half * i - y);
            ofZ[i] = i * (half * i - z);
        }
        most = std::max(ofX[0], ofX[7]);
        least = ((int32_t(radiusSq) - x * x - y * y - z * z) >> (shift + 1)) - most; // rounded down
    }
};

} // namespace openvdb_spheretree::detail
