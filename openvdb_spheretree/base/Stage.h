// SPDX-License-Identifier: Apache-2.0
/// @file Stage.h
/// @brief Adds the time a stage takes to a sum of seconds, and tells the interrupter its name.

#pragma once

#include "Stopwatch.h"

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

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
