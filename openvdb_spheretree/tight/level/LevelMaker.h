// SPDX-License-Identifier: Apache-2.0
/// @file LevelMaker.h
/// @brief The searches and merges that make the levels of quality=best.

#pragma once

#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverSearch.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

struct LevelMaker {
    const SampledObject& object;
    FitEffort fit;
    bool flat;
    openvdb::util::NullInterrupter* interrupter;

    /// @return how many trials a ball of a level of @a count balls gets: fewer of many, to bound the
    /// time.
    static int trialsFor(std::size_t count);

    /// @return the level after one search: CoverSearch.h.
    /// @param number  of the search: another one makes other trials
    SearchedCover search(const std::vector<CoverBall>& start, const std::vector<CoverBall>& finer,
        const CoverGoal& goal, int trialsPerBall, int number = 0) const;

    /// @return the level after the best of several searches.
    std::vector<CoverBall> improve(const std::vector<CoverBall>& start,
        const std::vector<CoverBall>& finer, const CoverGoal& goal) const;
    /// @param balls   may hold voxels outside the object
    /// @param points  extreme points of the voxels that each ball has to hold
    /// @return the balls merged to @a count, which hold these voxels.
    std::vector<ExactSphere> merged(const std::vector<ExactSphere>& balls,
        const std::vector<std::vector<openvdb::Coord>>& points, int64_t count) const;
};

/// @return the cover without its empty balls, and in their place leaf balls that are not in it yet, as
/// far as there are any. Leaf balls cost nothing.
std::vector<CoverBall> filledUp(
    const std::vector<CoverBall>& cover, const std::vector<CoverBall>& leafBalls);

} // namespace openvdb_spheretree::tight
