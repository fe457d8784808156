// SPDX-License-Identifier: Apache-2.0
/// @file DenseAgreement.h
/// @brief Whether a tree is the one that the dense program of DenseTree.h builds.

#pragma once

#include "BuiltTrees.h"
#include "DenseTree.h"

#include <vector>

namespace spheretree_test {

DenseSettings denseSettings(const SphereTreeSettings& settings);

testing::AssertionResult agree(const std::vector<DenseLevel>& expected, const SphereTree& tree);

} // namespace spheretree_test
