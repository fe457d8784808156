// SPDX-License-Identifier: Apache-2.0
/// @file ValueBound.h
/// @brief A number that a grid's values are compared with, exactly.

#pragma once

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

/// A double, or a 64-bit integer that no double holds.
struct ValueBound {
    ValueBound(double number = 0) : nearest(number) {}
    static ValueBound of(int64_t integer);

    double nearest;  ///< the number, or the double next to it
    double rest = 0; ///< the number less `nearest`; not 0 only of integers beyond 2^53

    bool operator<(const ValueBound& o) const
    {
        return nearest < o.nearest || (nearest == o.nearest && rest < o.rest);
    }
};

namespace detail {
/// @return the number as one would type it.
std::string toText(const ValueBound& bound);
} // namespace detail

} // namespace openvdb_spheretree
