// SPDX-License-Identifier: Apache-2.0
/// @file QueryTimes.h
/// @brief Contenders that are asked question by question, and a line of their times (ContenderTimes.h).

#pragma once

#include <functional>
#include <string>
#include <vector>

namespace spheretree_benchmark {

/// One way to answer all questions of a stratum.
struct Contender {
    std::string name;
    std::function<void(int i)> ask; ///< question i
    int every = 1;                  ///< asked of every so many questions: slow ones
};

/// @return microseconds a question, the median of the rounds; in the order of the contenders.
std::vector<double> timesOf(const std::vector<Contender>& contenders, int questions, int rounds);

/// Prints a line: a name, the first contender's time, and the others' as multiples of it.
void printTimes(const std::string& name, const std::vector<Contender>& contenders,
    const std::vector<double>& times);

} // namespace spheretree_benchmark
