// SPDX-License-Identifier: Apache-2.0
/// @file AlternatingTimes.h
/// @brief A table of contenders for the same questions (ContenderTimes.h).

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
