// SPDX-License-Identifier: Apache-2.0
/// @file AlternatingTimes.h
/// @brief Contenders for the same questions, timed by turns: what disturbs the machine disturbs all
/// of them.
///
/// Time is that of the thread's processor, so that other work on the machine counts little. The
/// median of the rounds is the result, and what others take in units of the first contender's time:
/// these ratios can be compared between machines, the times cannot.

#pragma once

#include <functional>
#include <string>
#include <vector>

namespace spheretree_benchmark {

struct Contender {
    std::string name;
    /// Answers all questions, and returns a sum of the answers: so none is left out by the
    /// compiler, and contenders that answer the same question can be compared.
    std::function<double()> run;
};

/// @brief Prints a row for each contender: nanoseconds a question, the ratio to the first one, and
/// the mean answer.
/// @param title      of the table
/// @param questions  that one run answers
void printTimes(const std::string& title, const std::vector<Contender>& contenders,
    std::size_t questions, int rounds);

} // namespace spheretree_benchmark
