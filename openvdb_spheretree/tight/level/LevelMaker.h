// SPDX-License-Identifier: Apache-2.0
/// @file LevelMaker.h
/// @brief What all levels of quality=best are made with.

#pragma once

#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverSearch.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct LevelMaker {
    const SampledObject& object;
    FitEffort fit;
    bool flat;
    openvdb::util::NullInterrupter* interrupter;

    /// At so many balls the time for a ball would become hours for all of them.
    static int trialsFor(std::size_t count);

    /// @return the level after one search: CoverSearch.h.
    /// @param number  another one tries other things
    SearchedCover search(const std::vector<CoverBall>& start, const std::vector<CoverBall>& finer,
        const CoverGoal& goal, int trialsPerBall, int number = 0) const;

    /// @return the level after the best of some searches.
    std::vector<CoverBall> improve(const std::vector<CoverBall>& start,
        const std::vector<CoverBall>& finer, const CoverGoal& goal) const;
};

/// @return the cover, with leaves that are not in it in the places of empty balls; where there are
/// no such leaves, without these places. Leaves cost nothing.
std::vector<CoverBall> filledUp(
    const std::vector<CoverBall>& cover, const std::vector<CoverBall>& leaves);

} // namespace tight
} // namespace openvdb_spheretree
