// SPDX-License-Identifier: Apache-2.0
/// @file Stage.h
/// @brief A stopwatch, and stages: each adds its time to a sum, and tells the interrupter its name.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <chrono>

namespace openvdb_spheretree::detail {

/// Wall-clock time since its construction.
class Stopwatch {
public:
    double seconds() const
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - mStart).count();
    }

private:
    std::chrono::steady_clock::time_point mStart = std::chrono::steady_clock::now();
};

/// From its construction to its end. @a interrupter and @a sum may be null.
class Stage {
public:
    Stage(const char* name, openvdb::util::NullInterrupter* interrupter, double* sum)
        : mInterrupter(interrupter), mSum(sum)
    {
        if (mInterrupter) mInterrupter->start(name);
    }
    ~Stage()
    {
        if (mSum) *mSum += mWatch.seconds();
        if (mInterrupter) mInterrupter->end();
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

private:
    openvdb::util::NullInterrupter* mInterrupter;
    double* mSum;
    Stopwatch mWatch;
};

/// @return what @a work returns.
template <typename Work>
auto timed(
    const char* name, openvdb::util::NullInterrupter* interrupter, double* sum, const Work& work)
{
    const Stage stage(name, interrupter, sum);
    return work();
}

} // namespace openvdb_spheretree::detail
