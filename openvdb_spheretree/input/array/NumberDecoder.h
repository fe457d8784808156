// SPDX-License-Identifier: Apache-2.0
/// @file NumberDecoder.h
/// @brief Numbers as they stand in a file to the values of a grid.

#pragma once

#include "ArrayLayout.h"

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// The values that a grid of Value has for the numbers of a layout. Integers are exact; those beyond
/// 2^63 - 1 become 2^63 - 1. A NaN becomes the background.
template <typename Value>
class NumberDecoder {
public:
    /// @param layout  of a type that goes with Value: bool, int32_t, int64_t, float or double
    NumberDecoder(const ArrayLayout& layout, Value background);

    /// @param in  bytes of @a count numbers that are neighbours in the file
    /// @return how many of them are NaN
    std::size_t operator()(const uint8_t* in, std::size_t count, Value* out) const
    {
        return mDecode(in, count, out, *this);
    }

    double slope, intercept;
    Value background;

private:
    std::size_t (*mDecode)(const uint8_t*, std::size_t, Value*, const NumberDecoder&);
};

} // namespace openvdb_spheretree::detail
