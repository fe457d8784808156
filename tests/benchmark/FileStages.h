// SPDX-License-Identifier: Apache-2.0
/// @file FileStages.h
/// @brief Stages at the two ends: reading objects, and making, writing and reading points.

#pragma once

#include "BenchmarkStages.h"

namespace spheretree_benchmark {

std::vector<BenchmarkStage> readingStages();
std::vector<BenchmarkStage> writingStages();

} // namespace spheretree_benchmark
