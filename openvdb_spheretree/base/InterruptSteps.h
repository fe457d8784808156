// SPDX-License-Identifier: Apache-2.0
/// @file InterruptSteps.h
/// @brief An interrupter for loops of one thread whose steps are too short to ask it at each: readers of text, say.

#pragma once

#include "Parallel.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>

namespace openvdb_spheretree::detail {

class InterruptSteps {
public:
    /// @param interrupter  may be null
    explicit InterruptSteps(openvdb::util::NullInterrupter* interrupter) : mInterrupter(interrupter)
    {}

    /// @param steps  that are done, each of a microsecond or less
    /// @throw Interrupted
    void add(std::size_t steps = 1)
    {
        mSinceAsked += steps;
        if (mSinceAsked < kAskEvery) return;
        mSinceAsked = 0;
        checkInterrupt(mInterrupter);
    }

private:
    static constexpr std::size_t kAskEvery = 4096;

    openvdb::util::NullInterrupter* mInterrupter;
    std::size_t mSinceAsked = 0;
};

} // namespace openvdb_spheretree::detail
