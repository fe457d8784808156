// SPDX-License-Identifier: Apache-2.0
/// @file LevelEffort.h
/// @brief What makes a quality: how long levels are worked on, and how exactly.

#pragma once

#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::tight {

/// Up to so many balls are few: their levels come from the top (TopDownLevels.h), and are searched.
constexpr int64_t kFewBalls = 64;
/// The finest level gets so many more on a coarse level of the pyramid: some are not needed on the
/// object.
constexpr int64_t moreOnCoarse(int64_t count) { return count / 8; }
/// The most that a level of few balls has there.
constexpr int64_t kFewOnCoarse = kFewBalls + moreOnCoarse(kFewBalls);

struct LevelEffort {
    FitEffort fit; ///< of balls that are placed anew
    /// Of balls that two are merged to. Without diagonals, Al.100 has 1.7 % of error with 512
    /// balls, in place of 1.3.
    FitEffort merging{true, 4, 1, false, 16};
    int neighbours = 3; ///< that a ball may merge with: 6 gain little
    int sweeps = 10;    ///< of placing anew
    /// Leaf balls that are merged are placed anew, first half as many more where they were not
    /// dilated. Else only where they are few.
    bool placesStart = true;
    /// Many leaf balls are dilated and pruned (DilatedCover.h) to about so many times as many as
    /// they are merged to then: LevelMaker::dilatedFor().
    double dilatedPerBall = 1.33;
    int64_t dilatedAtLeast = 1536; ///< to no fewer: to merge these takes little time
    /// Levels of so many balls and fewer are searched (CoverSearch.h), and their children may move
    /// from one of them to another.
    int64_t searchedUpTo = 0;
    int searches = 1;      ///< of a level, at most
    int trialsPerBall = 8; ///< of a search, at most
    /// In so many rounds at most, children try other parents (ChildMoves.h). The first gains most.
    int childMoves = 2;
    /// As of SearchEffort. 6 take half as long again, and gain only in long searches.
    std::size_t relocations = 3;
};

/// @return the effort of a quality.
/// @param leafBalls  of the whole object
LevelEffort effortOf(Quality quality, std::size_t leafBalls);

} // namespace openvdb_spheretree::tight
