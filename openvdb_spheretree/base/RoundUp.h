// SPDX-License-Identifier: Apache-2.0
/// @file RoundUp.h
/// @brief Arithmetic on radii that never comes out below the true value, and is exact where the
/// true value is a double: what was covered stays covered.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace openvdb_spheretree {
namespace detail {

inline double nextUp(double x)
{
    return std::nextafter(x, std::numeric_limits<double>::infinity());
}

inline double addUp(double a, double b)
{
    const double sum = a + b;
    const double partOfB = sum - a; // Knuth's two-sum: what of a + b got lost
    const double lost = (a - (sum - partOfB)) + (b - partOfB);
    return lost > 0 ? nextUp(sum) : sum;
}

inline double multiplyUp(double a, double b)
{
    const double product = a * b;
    return std::fma(a, b, -product) > 0 ? nextUp(product) : product;
}

inline double divideUp(double a, double b)
{
    const double quotient = a / b;
    return std::fma(quotient, b, -a) < 0 ? nextUp(quotient) : quotient;
}

/// @param x  not negative
inline double sqrtUp(double x)
{
    const double root = std::sqrt(x);
    return std::fma(root, root, -x) < 0 ? nextUp(root) : root;
}

inline double toDoubleUp(int64_t x)
{
    const double rounded = double(x);
    // 2^63 itself does not convert back; it is above every int64 already.
    return rounded < 0x1p63 && int64_t(rounded) < x ? nextUp(rounded) : rounded;
}

inline float toFloatUp(double x)
{
    if (x > double(std::numeric_limits<float>::max()))
        return std::numeric_limits<float>::infinity();
    const float rounded = float(x);
    return double(rounded) < x ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                               : rounded;
}

/// @return floor(sqrt(value)) for value >= 0.
inline int64_t floorSqrt(int64_t value)
{
    auto root = uint64_t(std::sqrt(double(value)));
    if (value < (int64_t(1) << 52)) return int64_t(root); // exact as it is: both fit a double
    while (root * root > uint64_t(value)) --root;
    while ((root + 1) * (root + 1) <= uint64_t(value)) ++root;
    return int64_t(root);
}

/// @return the largest integer whose square is at most @a x.
inline int64_t integerRoot(unsigned __int128 x)
{
    int64_t root = int64_t(std::sqrt((long double)(x)));
    while (root > 0 && (unsigned __int128)(root) * (unsigned __int128)(root) > x) --root;
    while ((unsigned __int128)(root + 1) * (unsigned __int128)(root + 1) <= x) ++root;
    return root;
}

} // namespace detail
} // namespace openvdb_spheretree
