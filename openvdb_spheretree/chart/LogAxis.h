// SPDX-License-Identifier: Apache-2.0
/// @file LogAxis.h
/// @brief An axis on which equal ratios are equal distances, and its ticks.

#pragma once

#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// Ends are numbers 1, 2 or 5 times a power of ten.
class LogAxis {
public:
    /// @param low, high  what is to lie on the axis, above 0 and finite
    LogAxis(double low, double high);

    /// @return where @a value is, from 0 at the low end to 1 at the high end.
    double at(double value) const;

    struct Tick {
        double value = 0;
        std::string label; ///< `0.05`, `1`, `20,000`, `1e7`
    };
    /// @return at most nine, with both ends of the axis as far as these are even.
    std::vector<Tick> ticks() const;

private:
    int mFirst, mLast; ///< ends, as numbers of the series 1, 2, 5, 10, 20, ...; 0 is that of 1
};

} // namespace openvdb_spheretree::detail
