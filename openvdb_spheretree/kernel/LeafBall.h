// SPDX-License-Identifier: Apache-2.0
/// @file LeafBall.h
/// @brief The kernel of the rasteriser: the 512 voxels of a leaf against one ball, as mask bits.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Centres within so many units of all the leaf's voxels along every axis suit the kernel's 16
/// bits: see LeafBall.cc.
constexpr int64_t kLeafBallReach = 4680;

/// @brief ORs the voxels q of the ball |2^shift q - center|^2 <= coverSq into the words of a leaf:
/// word x, bit 8 y + z.
/// @param center   from the leaf's corner; |2^shift q - center| <= kLeafBallReach on each axis
/// @param coverSq  at most kLeafBallReach^2
/// @param shift    2^shift units are a voxel; 1 to 4
void orBallIntoLeaf(const int64_t center[3], int64_t coverSq, int shift, uint64_t words[8]);

/// @brief The same without vector instructions, for processors whose are not known.
void orBallIntoLeafPortable(const int64_t center[3], int64_t coverSq, int shift, uint64_t words[8]);

/// Of a norm: coordinates up to this keep its values within 31 bits.
constexpr int64_t kLeafNormReach = int64_t(1) << 20;

/// @brief The same for the ball { q : N(2^shift q - center) <= limit } of a norm.
/// @param center  |2^shift q - center| <= kLeafNormReach on each axis
/// @param limit   below 2^31
void orNormBallIntoLeaf(
    const int64_t center[3], const Distance& norm, int64_t limit, int shift, uint64_t words[8]);

} // namespace detail
} // namespace openvdb_spheretree
