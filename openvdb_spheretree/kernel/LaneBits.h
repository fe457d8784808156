// SPDX-License-Identifier: Apache-2.0
/// @file LaneBits.h
/// @brief Comparisons of 64 values at once, as the bits of a word.

#pragma once

#include <cstdint>

namespace openvdb_spheretree::detail {

/// @return bit i: a[i] == b[i], of 64 values each.
uint64_t equalLanes(const int32_t* a, const int32_t* b);

/// Values that stand before the 64 of a row, for likeBefore().
constexpr int kLaneMargin = 8;

/// Bit 8 y + z, for the values of one x of a leaf: whether the voxel's value is that of the voxel
/// before it along y, or z.
struct LikeBefore {
    uint64_t alongY, alongZ;
};

/// @param row  64 values, behind kLaneMargin others that are read too, of any content: the first
///             voxel along an axis has none before it.
LikeBefore likeBefore(const int32_t* row);

} // namespace openvdb_spheretree::detail
