// SPDX-License-Identifier: Apache-2.0
/// @file RoundDown.h
/// @brief Arithmetic on radii that never comes out above the true value, and is exact where that is
/// a double: what was inside stays inside. The counterpart of RoundUp.h.

#pragma once

#include <cmath>
#include <limits>

namespace openvdb_spheretree {
namespace detail {

inline double nextDown(double x)
{
    return std::nextafter(x, -std::numeric_limits<double>::infinity());
}

inline double multiplyDown(double a, double b)
{
    const double product = a * b;
    return std::fma(a, b, -product) < 0 ? nextDown(product) : product;
}

/// @param x  not negative
inline double sqrtDown(double x)
{
    const double root = std::sqrt(x);
    return std::fma(root, root, -x) > 0 ? nextDown(root) : root;
}

/// @return infinity for what is beyond all floats, as toFloatUp() does.
inline float toFloatDown(double x)
{
    if (x > double(std::numeric_limits<float>::max()))
        return std::numeric_limits<float>::infinity();
    const float rounded = float(x);
    return double(rounded) > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                               : rounded;
}

} // namespace detail
} // namespace openvdb_spheretree
