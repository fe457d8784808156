// SPDX-License-Identifier: Apache-2.0
/// @file Rounding.h
/// @brief Arithmetic on radii that errs to one side, and is exact where the true value is a double.
///
/// `...Up` is never below the true value: what was covered stays covered. `...Down` is never above
/// it: what was inside stays inside. The sign of an error is known from fma(), which rounds once.

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace openvdb_spheretree::detail {

inline double nextUp(double x)
{
    return std::nextafter(x, std::numeric_limits<double>::infinity());
}

inline double nextDown(double x)
{
    return std::nextafter(x, -std::numeric_limits<double>::infinity());
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

inline double multiplyDown(double a, double b)
{
    const double product = a * b;
    return std::fma(a, b, -product) < 0 ? nextDown(product) : product;
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

/// @param x  not negative
inline double sqrtDown(double x)
{
    const double root = std::sqrt(x);
    return std::fma(root, root, -x) > 0 ? nextDown(root) : root;
}

inline double toDoubleUp(int64_t x)
{
    const double rounded = double(x);
    // 2^63 itself does not convert back; it is above every int64 already.
    return rounded < 0x1p63 && int64_t(rounded) < x ? nextUp(rounded) : rounded;
}

/// @return infinity for what is beyond all floats.
inline float toFloatUp(double x)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (x > double(std::numeric_limits<float>::max())) return kInfinity;
    const float rounded = float(x);
    return double(rounded) < x ? std::nextafter(rounded, kInfinity) : rounded;
}

/// @return infinity for what is beyond all floats.
inline float toFloatDown(double x)
{
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (x > double(std::numeric_limits<float>::max())) return kInfinity;
    const float rounded = float(x);
    return double(rounded) > x ? std::nextafter(rounded, -kInfinity) : rounded;
}

} // namespace openvdb_spheretree::detail
