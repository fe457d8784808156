// SPDX-License-Identifier: Apache-2.0
/// @file LevelStages.h
/// @brief Stages of all levels of an object: the OR pyramid, and the edges of the Sphere-DAG.

#pragma once

#include "BenchmarkStages.h"

namespace spheretree_benchmark {

std::vector<BenchmarkStage> levelStages(bool more);

} // namespace spheretree_benchmark
