// SPDX-License-Identifier: Apache-2.0
/// @file detail/LeafBall.h
/// @brief The kernel of the rasteriser: the 512 voxels of a leaf against one ball, as mask bits.

#pragma once

#include "../Distance.h"

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Centres nearer than this to the leaf's voxels along every axis, in doubled coordinates, are
/// within the kernel's 16 bits (it compares squares within a leaf, which differ by up to 28 d +
/// 196).
constexpr int64_t kLeafBallReach2 = 1100;

/// @brief ORs the voxels of the ball into the words of a leaf: word x, bit 8 y + z.
/// @param center2  doubled, from the leaf's corner; |2 q - center2| <= kLeafBallReach2 on each axis
/// @param coverSq  at most kLeafBallReach2^2
void orBallIntoLeaf(const int64_t center2[3], int64_t coverSq, uint64_t words[8]);

/// @brief The same without vector instructions, for processors whose are not known.
void orBallIntoLeafPortable(const int64_t center2[3], int64_t coverSq, uint64_t words[8]);

/// Of a norm: doubled coordinates up to this keep its values within 31 bits.
constexpr int64_t kLeafNormReach2 = int64_t(1) << 20;

/// @brief The same for the ball { q : N(2 q - center2) <= limit } of a norm.
/// @param center2  |2 q - center2| <= kLeafNormReach2 on each axis
/// @param limit    below 2^31
void orNormBallIntoLeaf(
    const int64_t center2[3], const Distance& norm, int64_t limit, uint64_t words[8]);

} // namespace detail
} // namespace openvdb_spheretree
