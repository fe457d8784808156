// SPDX-License-Identifier: Apache-2.0
/// @file ForkServer.h
/// @brief Tries many inputs in child processes: one that kills its child, or hangs it, is named, and
/// the others are tried all the same.
///
/// 1. Each child takes a share of the inputs, one after the other, and notes in shared memory which
///    one it is at and how it ended.
/// 2. A child that dies, or is stopped by its alarm, has died of the input that it was at. A new
///    child goes on with the next one.
///
/// Cost: a process a finding, not one an input. The result does not depend on the number of children.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace spheretree_test {

struct ForkLimits {
    int children = 2;
    unsigned seconds = 60;               ///< for one input, before it counts as a hang
    uint64_t memory = uint64_t(1) << 30; ///< bytes that a child may take beyond its start
};

struct Finding {
    int64_t input;
    std::string what; ///< "Segmentation fault", "no end after 60 s", "asked for ... bytes", ...
};

struct ForkedRun {
    int64_t read = 0, refused = 0;
    std::vector<Finding> findings; ///< in the order of inputs
    std::string summary() const;
};

/// @brief Try the inputs 0 to @a count - 1.
/// @param prepare  runs once in every child, and returns the function that tries an input there: true
///                 if it was read, false if it was refused as it should be, an exception otherwise
/// @note No thread may run in the calling process: a fork takes only the calling one with it. TBB
///       makes none under a tbb::global_control of 1.
ForkedRun runForked(int64_t count, const std::function<std::function<bool(int64_t)>()>& prepare,
    const ForkLimits& limits = {});

} // namespace spheretree_test
