// SPDX-License-Identifier: Apache-2.0
/// @file LeafBall.h
/// @brief The kernel of the rasteriser: the 512 voxels of a leaf against one ball, as mask bits.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// No voxel of the leaf may be farther than this from the center along any axis: then 16 bits hold
/// all that is compared, as 7 * 4680 < 2^15 - 1 (LeafBall.cc).
constexpr int64_t kLeafBallReach = 4680;

/// @brief ORs the voxels q of the ball |2^shift q - center|^2 <= radiusSq into the words of a leaf.
/// @param center    from the leaf's corner; |2^shift q - center| <= kLeafBallReach on each axis
/// @param radiusSq  at most kLeafBallReach^2
/// @param shift     2^shift units are a voxel; 1 to 4
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

} // namespace openvdb_spheretree::detail
