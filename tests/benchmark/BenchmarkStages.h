// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkStages.h
/// @brief The stages that are measured, by name; docs/benchmark.md says what each one does.

#pragma once

#include "BenchmarkInput.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace spheretree_benchmark {

/// A stage that is ready: each call does it once. @return the number of balls it began with, where
/// its time goes by balls and not by voxels; else 0.
using Work = std::function<int64_t()>;

struct BenchmarkStage {
    std::string name;
    std::function<Work(const InputPtr&)> prepare;        ///< makes what the stage works on
    std::function<bool(const BenchmarkObject&)> applies; ///< empty: to every object
    bool once = false;                                   ///< seconds to minutes: no second run
};

/// @param more  whether to name the stages, too, that only those who work on them want to see
std::vector<BenchmarkStage> benchmarkStages(bool more);

} // namespace spheretree_benchmark
