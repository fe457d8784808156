// SPDX-License-Identifier: Apache-2.0
/// @file ContenderTimes.h
/// @brief Contenders for the same questions, timed by turns in one process: what disturbs the machine
/// disturbs all of them, so ratios say more than times.
///
/// Time is that of the thread's processor, and of several rounds the median.

#pragma once

#include <functional>
#include <vector>

namespace spheretree_benchmark {

/// @param runs  one a contender: asks all questions; one that takes less than the clock can tell is
///              repeated
/// @return the seconds of each run.
std::vector<double> medianSeconds(const std::vector<std::function<void()>>& runs, int rounds);

} // namespace spheretree_benchmark
