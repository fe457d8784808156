// SPDX-License-Identifier: Apache-2.0
/// @file LabelOffsets.h
/// @brief Power labels as they are kept: an offset along each axis a voxel (PowerMap.h).

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// Offsets along one axis, 512 a leaf; one of the arrays is null, both if the axis takes no part.
struct AxisOffsets {
    LargeArray<int8_t> narrow;
    LargeArray<int16_t> wide;

    bool empty() const { return !narrow && !wide; }
    /// Makes room for @a size offsets. @return where they go.
    template <typename Offset>
    Offset* make(std::size_t size)
    {
        if constexpr (sizeof(Offset) == 1) return (narrow = makeLargeArray<int8_t>(size)).get();
        else return (wide = makeLargeArray<int16_t>(size)).get();
    }
};

using LabelOffsets = std::array<AxisOffsets, 3>; ///< along x, y, z

} // namespace openvdb_spheretree::detail
