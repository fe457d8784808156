// SPDX-License-Identifier: Apache-2.0
/// @file TreeStages.h
/// @brief Stages that make whole trees, and the exact errors of one.

#pragma once

#include "BenchmarkStages.h"

#include <openvdb_spheretree/tree/SphereTree.h>

namespace spheretree_benchmark {

/// @return the tree that later stages work on: an extended one, without topology. It is kept until
/// that of another object is asked for.
std::shared_ptr<const openvdb_spheretree::SphereTree> extendedTree(const BenchmarkInput& in);

std::vector<BenchmarkStage> treeStages(bool more);

} // namespace spheretree_benchmark
