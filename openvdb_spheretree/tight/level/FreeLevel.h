// SPDX-License-Identifier: Apache-2.0
/// @file FreeLevel.h
/// @brief A level of quality=best that is searched by itself, bound to no other level.
///
/// A search of few balls ends near its start. So there are several starts: the cut of the merge forest,
/// and finer cuts that are searched and then merged. The cheapest result is taken (dragon-128, 16
/// balls: 137 % of error in place of 147).

#pragma once

#include "LevelMaker.h"
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param forest  of the leaf balls
/// @return a level of at most @a count balls that cover the object.
std::vector<ExactSphere> freeLevel(const std::vector<ForestNode>& forest, int64_t count,
    const std::vector<ExactSphere>& leafBalls, const LevelMaker& maker);

/// @return how many voxels outside the object the balls hold together, counted on samples.
double costOfCover(
    const std::vector<ExactSphere>& balls, const SampledObject& object, const FitEffort& effort);

} // namespace openvdb_spheretree::tight
