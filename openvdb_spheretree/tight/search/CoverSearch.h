// SPDX-License-Identifier: Apache-2.0
/// @file CoverSearch.h
/// @brief Makes a cover cheaper with the same number of balls: places each anew, tries changes, and
/// keeps what lowers the cost.
///
/// 1. Every ball is placed anew, over and over, until nothing changes.
/// 2. Many trials disturb one ball and refit its neighbours (CoverTrial.h). A few times in a
///    search, balls move elsewhere (CoverRelocation.h).
/// 3. Every ball is placed anew once more.
///
/// Trials of a batch start from the same cover and run in parallel. Of those that lower the cost,
/// the first ones whose surroundings do not meet are kept. A counter decides what is tried, and the
/// number of balls how often. So the result depends neither on the number of threads nor on their
/// speed.

#pragma once

#include "CoverGoal.h"
#include "CoverPart.h"
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::tight {

struct SearchedCover {
    std::vector<CoverBall> balls; ///< a dropped ball for which none was inserted is empty
    double change = 0;            ///< of the cost, voxels, counted on samples: not above 0
};

/// @param balls  a cover in the sense of @a goal
/// @param finer  smaller balls to insert: leaf balls, or a finer level. If there are none, no ball
///               moves elsewhere, and balls that no voxel needs are dropped.
SearchedCover improveCover(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
    const SampledObject& object, const CoverGoal& goal, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
