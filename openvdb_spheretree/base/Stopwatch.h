// SPDX-License-Identifier: Apache-2.0
/// @file Stopwatch.h
/// @brief Wall-clock time since its construction.

#pragma once

#include <chrono>

namespace openvdb_spheretree::detail {

class Stopwatch {
public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - mStart).count();
    }

private:
    std::chrono::steady_clock::time_point mStart = std::chrono::steady_clock::now();
};

} // namespace openvdb_spheretree::detail
