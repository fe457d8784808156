// SPDX-License-Identifier: Apache-2.0
/// @file TransformStages.h
/// @brief Stages of one level: mask, layout, distances, labels, medial balls, topology.

#pragma once

#include "BenchmarkStages.h"

namespace spheretree_benchmark {

std::vector<BenchmarkStage> transformStages();

} // namespace spheretree_benchmark
