// SPDX-License-Identifier: Apache-2.0
/// @file LeafBall.h
/// @brief The kernel of the rasteriser: the 512 voxels of a leaf against one ball, as mask bits.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// No voxel of the leaf may be farther than this from the center along any axis: then 16 bits hold
/// all that is compared, as 7 * 4680 < 2^15 - 1 (LeafBall.cc).
constexpr int64_t kLeafBallReach = 4680;

/// @brief ORs the voxels q of the ball |2^shift q - center|^2 <= radiusSq into the words of a leaf.
/// @param center    from the leaf's corner; |2^shift q - center| <= kLeafBallReach on each axis
/// @param radiusSq  at most kLeafBallReach^2
/// @param shift     2^shift units are a voxel; 1 to 10
void orBallIntoLeaf(const int64_t center[3], int64_t radiusSq, int shift, uint64_t words[8]);

/// @brief The same for processors whose vector instructions are not known.
void orBallIntoLeafPortable(
    const int64_t center[3], int64_t radiusSq, int shift, uint64_t words[8]);

/// The same for norms: weights are at most 255, so N is at most 3 * 255 * 2^20 < 2^31.
constexpr int64_t kLeafNormReach = int64_t(1) << 20;

/// @brief The same for the ball { q : N(2^shift q - center) <= limit } of a norm.
/// @param center  |2^shift q - center| <= kLeafNormReach on each axis
/// @param limit   below 2^31
void orNormBallIntoLeaf(
    const int64_t center[3], const Distance& norm, int64_t limit, int shift, uint64_t words[8]);

/// What both kernels of Euclidean balls compare (LeafBall.cc): the terms t(i) of each axis. Voxel (x, y, z) of the leaf is in the ball when
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
