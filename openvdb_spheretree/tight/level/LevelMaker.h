// SPDX-License-Identifier: Apache-2.0
/// @file LevelMaker.h
/// @brief What covers become the levels of a tree with: merging, placing anew, and the search.

#pragma once

#include "LevelEffort.h"
#include <openvdb_spheretree/base/StepProgress.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>
#include <openvdb_spheretree/tight/region/WorkingMemory.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverSearch.h>
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// Extreme points of what each ball of a cover has to hold.
using HeldPoints = std::vector<std::vector<openvdb::Coord>>;

/// What the levels of an object are made with.
struct LevelMaker : LevelEffort {
    const SampledObject& object;
    bool flat;
    detail::StepProgress* interrupter; ///< may be null; what its steps cost, LevelWork.h says
    int64_t memory = 0;                ///< as of SphereTreeSettings

    /// @return the same for another object, such as a coarser one.
    LevelMaker forObject(const SampledObject& other) const
    {
        return {*this, other, flat, interrupter, memory};
    }

    /// @return the same for another quality.
    /// @param leafBalls  of the whole object
    LevelMaker ofQuality(Quality quality, std::size_t leafBalls) const
    {
        return {effortOf(quality, leafBalls), object, flat, interrupter, memory};
    }

    /// @return `merging`; with diagonals where few balls are left: of dragon-512 64 have 72 in
    /// place of 77 % with `fast`.
    FitEffort mergingTo(int64_t count) const;
    /// @return `fit`, without restarts where there are many balls: with 512, `best` has 4 % less
    /// error then, in 0.9 of the time; with few, restarts gain 1 %.
    FitEffort fitOf(int64_t balls) const;
    bool searchesLevelOf(std::size_t balls) const { return int64_t(balls) <= searchedUpTo; }
    /// @return how many searches a level gets. More trials of one search gain little; but searches
    /// of few balls end in different places, and take little time.
    int searchesOf(int64_t balls) const;
    /// @return how many trials a ball gets in each.
    int trialsOf(int64_t balls) const;

    /// @return the level after the best of several searches.
    std::vector<CoverBall> improve(const std::vector<CoverBall>& start,
        const std::vector<CoverBall>& finer, const CoverGoal& goal) const;
    /// @return the cover with each ball placed anew until nothing changes, or `sweeps` times;
    /// without those that no voxel needs if @a drop is given.
    /// @param spare  a cover, too: empty balls, and those that no voxel needs, move to places of
    ///               these where that gains something
    std::vector<CoverBall> placed(const std::vector<CoverBall>& cover, const CoverGoal& goal,
        bool drop = true, const std::vector<CoverBall>& spare = {}) const;
    /// The same with few sweeps, for balls that will be merged further: what more sweeps gain is
    /// lost then.
    std::vector<CoverBall> placedBetween(
        const std::vector<CoverBall>& cover, const CoverGoal& goal) const;
    /// @return to about how many balls @a leafBalls are dilated and pruned before they are merged
    /// to @a count; 0: they are merged as they are, as there are not many more.
    int64_t dilatedFor(int64_t leafBalls, int64_t count) const;
    /// @param points  that each ball has to hold; if there are none, it stays
    /// @return the balls that hold the points with the least cost that is found, each by itself;
    /// counted on samples, none costs more than before.
    std::vector<ExactSphere> fitted(
        const std::vector<ExactSphere>& balls, const HeldPoints& points) const;
    /// @param balls      balls of different groups never merge
    /// @param points     a ball must hold those of all balls that it is merged from
    /// @param areInside  the balls have no voxel outside the object
    /// @return the balls merged to @a count, or to one for each group.
    std::vector<CoverBall> merged(const std::vector<CoverBall>& balls, const HeldPoints& points,
        bool areInside, int64_t count) const;
    /// The same with slack (SlackMerging.h), which is better and takes longer.
    /// @param regions  voxels of each ball; together the object
    std::vector<CoverBall> mergedWithSlack(
        const std::vector<CoverBall>& balls, std::vector<VoxelRegion> regions, int64_t count) const;
    /// @param balls  that cover the object; each has to hold its power cell
    /// @return the balls merged to @a count.
    std::vector<ExactSphere> mergedCover(
        const std::vector<ExactSphere>& balls, bool areInside, int64_t count) const;
    /// @return what the regions of the balls take, with the samples.
    WorkingMemory regionMemory(const std::vector<ExactSphere>& balls) const;
    /// @throw openvdb::ValueError if that is more than `memory`
    void requireRoomForRegions(const std::vector<ExactSphere>& balls) const;
    /// @return how many voxels outside the object the balls hold together, counted on samples.
    double costOf(const std::vector<ExactSphere>& balls) const;
};

/// @return that for the quality and memory of the settings.
/// @param leafBalls    of the whole object
/// @param interrupter  may be null
LevelMaker levelMakerFor(const SphereTreeSettings& settings, const SampledObject& object,
    std::size_t leafBalls, detail::StepProgress* interrupter);

/// A ball is large if the object has more leaf nodes than that for each: half the resolution is
/// enough to decide what hangs below it. (dragon-512, 64 balls: 66.2 in place of 65.5 %, in two
/// thirds of the tree's time; with half as many 68.0.)
constexpr std::size_t kLeavesOfLargeBall = 64;

/// @return how many balls come next on the way from @a many to @a count, fewer: in equal ratios of
/// at most two. Merging and placing anew by turns (FreeCovers.h) goes in such steps.
int64_t halvedTowards(int64_t many, int64_t count);

/// @return the cover without its empty balls.
std::vector<CoverBall> withoutEmpty(std::vector<CoverBall> cover);

} // namespace openvdb_spheretree::tight
