// SPDX-License-Identifier: Apache-2.0
/// @file detail/StageTimer.h
/// @brief Adds the time a stage takes to a sum of seconds.

#pragma once

#include <chrono>
#include <utility>

namespace openvdb_spheretree {
namespace detail {

/// @return what @a work returns; its seconds are added to @a sum, unless that is null.
template <typename Work>
auto timed(double* sum, const Work& work)
{
    struct Timer {
        double* sum;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Timer()
        {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            if (sum) *sum += passed.count();
        }
    } timer{sum};
    return work();
}

} // namespace detail
} // namespace openvdb_spheretree
