// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkOptions.h
/// @brief What the benchmark is asked for, beside the options of Google Benchmark.

#pragma once

#include <string>
#include <vector>

namespace spheretree_benchmark {

struct BenchmarkOptions {
    std::vector<std::string> objects; ///< in place of the usual ones, by name
    std::string jsonFile;             ///< where the numbers go as well; empty: nowhere
    bool largest = false;             ///< objects of more than a million leaf nodes, too
    bool more = false;                ///< stages that only those who work on them want to see, too
};

/// How to call the program, for -help.
extern const char* const kBenchmarkUsage;

/// @throw std::invalid_argument that names the argument, if it is none of ours
BenchmarkOptions parseOptions(int argc, char** argv);

} // namespace spheretree_benchmark
