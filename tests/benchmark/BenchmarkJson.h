// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkJson.h
/// @brief The same numbers as the table's, and what the machine is, as JSON.

#pragma once

#include "Growth.h"
#include "Measurement.h"

#include <string>
#include <vector>

namespace spheretree_benchmark {

/// Where and when measurements were made.
struct BenchmarkMachine {
    std::string date;      ///< ISO 8601, UTC
    std::string processor; ///< its model, where that is known
    int threads = 1;
    double load = -1; ///< processes that ran on average in the minute before; negative: not known
};

/// @return this machine, now.
BenchmarkMachine thisMachine();

std::string benchmarkJson(const BenchmarkMachine& machine,
    const std::vector<Measurement>& measurements, const std::vector<Growth>& growths);

} // namespace spheretree_benchmark
