// SPDX-License-Identifier: Apache-2.0
/// @file CoverSearch.h
/// @brief Makes a cover cheaper without more balls (quality=best): tries changes, and keeps those that
/// lower the cost.
///
/// 1. Every ball is placed anew, over and over, until nothing changes.
/// 2. Many trials disturb one ball and refit its neighbours (CoverTrial.h). Six times in a search,
///    balls move elsewhere (CoverRelocation.h).
/// 3. Every ball is placed anew once more.
///
/// Trials of a batch start from the same cover and run in parallel. Of those that lower the cost, the
/// first ones whose surroundings do not meet are kept. A counter decides what is tried, and the number
/// of balls how often: the result is the same for any number of threads, and for any speed.

#pragma once

#include "CoverGoal.h"
#include "CoverPart.h"
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct SearchedCover {
    std::vector<CoverBall> balls; ///< empty ones where balls went, if none put in lowers the cost
    double change = 0;            ///< of the cost, voxels, counted on samples: not above 0
};

/// @param balls  a cover in the sense of @a goal
/// @param finer  small balls, to be put in where one is to spare: leaf balls, or a finer level.
///               If there are none, balls stay where they are, or go if no voxel needs them.
SearchedCover improveCover(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
    const SampledObject& object, const CoverGoal& goal, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
