// SPDX-License-Identifier: Apache-2.0
/// @file IntegerRoot.h
/// @brief Squares of integers, and exact roots.

#pragma once

#include <cmath>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// @param x  below 2^31.5 in size
inline int64_t square(int64_t x) { return x * x; }

/// @param value  in [0, 2^52): a double holds it, and so does the correctly rounded root: the one
///               of k^2 - 1 lies 1 / 2k below k, and doubles there are 1 / 2k or less apart
/// @return floor(sqrt(value))
inline int64_t floorSqrtSmall(int64_t value) { return int64_t(std::sqrt(double(value))); }

/// @param value  0 or more
/// @return floor(sqrt(value))
inline int64_t floorSqrt(int64_t value)
{
    if (value < (int64_t(1) << 52)) return floorSqrtSmall(value);
    auto root = uint64_t(std::sqrt(double(value)));
    while (root * root > uint64_t(value)) --root;
    while ((root + 1) * (root + 1) <= uint64_t(value)) ++root;
    return int64_t(root);
}

/// @param value  0 or more
/// @return ceil(sqrt(value))
inline int64_t ceilSqrt(int64_t value)
{
    const int64_t root = floorSqrt(value);
    return root + (square(root) < value);
}

using Uint128 = unsigned __int128;

/// @param value  below 2^126
/// @return floor(sqrt(value))
inline int64_t floorSqrtWide(Uint128 value)
{
    auto root = int64_t(std::sqrt((long double)(value)));
    while (root > 0 && Uint128(root) * Uint128(root) > value) --root;
    while (Uint128(root + 1) * Uint128(root + 1) <= value) ++root;
    return root;
}

/// @param value  below 2^126
/// @return ceil(sqrt(value))
inline int64_t ceilSqrtWide(Uint128 value)
{
    const int64_t root = floorSqrtWide(value);
    return root + (Uint128(root) * Uint128(root) < value);
}

} // namespace openvdb_spheretree::detail
