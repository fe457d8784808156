// SPDX-License-Identifier: Apache-2.0
/// @file LabelSteps.h
/// @brief Power labels as they are kept: three small steps a voxel (PowerMap.h).

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Steps along one axis, 512 a leaf; one of the arrays is null, both if the axis takes no part.
struct AxisSteps {
    LargeArray<int8_t> narrow;
    LargeArray<int16_t> wide;

    bool empty() const { return !narrow && !wide; }
    /// Makes room for @a size steps. @return where they go.
    template <typename Step>
    Step* make(std::size_t size);
};

template <>
inline int8_t* AxisSteps::make<int8_t>(std::size_t size)
{
    narrow = makeLargeArray<int8_t>(size);
    return narrow.get();
}
template <>
inline int16_t* AxisSteps::make<int16_t>(std::size_t size)
{
    wide = makeLargeArray<int16_t>(size);
    return wide.get();
}

using LabelSteps = std::array<AxisSteps, 3>; ///< along x, y, z

} // namespace detail
} // namespace openvdb_spheretree
