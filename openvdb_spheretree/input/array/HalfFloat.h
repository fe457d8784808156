// SPDX-License-Identifier: Apache-2.0
/// @file HalfFloat.h
/// @brief Numbers of 16 bits (IEEE 754 binary16) as floats, exactly.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace openvdb_spheretree::detail {

inline float fromHalf(uint16_t bits)
{
    const int exponent = bits >> 10 & 31;
    const int fraction = bits & 1023;
    float size;
    if (exponent == 31) {
        size = fraction ? std::numeric_limits<float>::quiet_NaN()
                        : std::numeric_limits<float>::infinity();
    } else if (exponent == 0) {
        size = std::ldexp(float(fraction), -24);
    } else {
        size = std::ldexp(float(1024 + fraction), exponent - 25);
    }
    return bits >> 15 ? -size : size;
}

} // namespace openvdb_spheretree::detail
