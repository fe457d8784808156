// SPDX-License-Identifier: Apache-2.0
#include "CarriedLevels.h"

#include "ChildMoves.h"
#include "GroupedCover.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>

#include <cstddef>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Levels whose balls are large enough, and are placed anew from the finest up. A ball above that no voxel
/// needs is empty, until all are placed.
class Placing {
public:
    Placing(std::vector<TightLevel> levels, int64_t most, const LevelMaker& maker)
        : mLevels(std::move(levels)), mMost(most), mMaker(maker), mVoxels(maker.object.level(0)),
          mChains(mLevels.size() + 1)
    {
        std::vector<ExactSphere> all;
        for (const TightLevel& level : mLevels) {
            all.insert(all.end(), level.balls.begin(), level.balls.end());
        }
        mMaker.requireRoomForRegions(all);
        for (std::size_t k = mLevels.size(); k-- > 1;) {
            mChains[k] = chainRegions(mLevels[k], mChains[k + 1], mMaker);
        }
    }

    std::vector<TightLevel> run()
    {
        placeFinest();
        for (std::size_t k = 1; k < mLevels.size(); ++k) placeAbove(k);
        for (std::size_t k = 1; k < mLevels.size(); ++k) dropChildless(mLevels[k], mLevels[k - 1]);
        return std::move(mLevels);
    }

private:
    void placeFinest()
    {
        TightLevel& level = mLevels.front();
        const bool isOnly = mLevels.size() == 1;
        std::vector<CoverBall> cover = ungrouped(level.balls);
        for (std::size_t i = 0; !isOnly && i < cover.size(); ++i) cover[i].group = level.parent[i];
        const VoxelGoal goal = isOnly ? VoxelGoal(mVoxels) : VoxelGoal(mVoxels, mChains[1]);
        cover = mMaker.placed(cover, goal);
        if (int64_t(cover.size()) > mMost) cover = mMaker.placed(fewer(cover), goal);
        level.balls = ballsOf(cover);
        if (!isOnly) level.parent = groupsOf(cover);
        mRegions = regionsOf(level.balls, mVoxels, mMaker.interrupter);
    }

    /// @return the finest balls merged to as many as there may be, each within its group.
    std::vector<CoverBall> fewer(const std::vector<CoverBall>& cover) const
    {
        const TightLevel finest{ballsOf(cover), groupsOf(cover), {}};
        const auto held = chainRegions(finest, mChains[1], mMaker); // mChains[1]: none of one level
        const auto cells = powerCells(finest.balls, held, mVoxels, mMaker.interrupter);
        const auto points = extremePoints(cells, mVoxels, mMaker.interrupter);
        return mMaker.merged(cover, points, false, mMost);
    }

    /// Of its children's regions a ball must hold what no other ball of the level holds of its own
    /// children's; and that counts only where its ancestors hold it.
    void placeAbove(std::size_t k)
    {
        TightLevel &level = mLevels[k], &finer = mLevels[k - 1];
        const std::size_t balls = level.balls.size();
        mChains[k].clear();
        auto below = regionsBelow(mRegions, finer.parent, balls, mMaker.interrupter);
        if (!level.parent.empty()) {
            detail::parallelFor(balls, mMaker.interrupter, [&](std::size_t i) {
                below[i] = intersectionOf(below[i], mChains[k + 1][level.parent[i]]);
            });
        }
        const VoxelGoal goal(mVoxels, below);
        level.balls = ballsOf(mMaker.placed(eachInItsGroup(level.balls), goal, false));
        adoptOrphans(finer, level.balls);
        mRegions = regionsBelow(mRegions, finer.parent, balls, mMaker.interrupter);
        detail::parallelFor(balls, mMaker.interrupter, [&](std::size_t i) {
            const ExactSphere& ball = level.balls[i];
            mRegions[i] = ball.empty() ? VoxelRegion() : clipped(mRegions[i], ball, mVoxels);
        });
    }

    std::vector<TightLevel> mLevels;
    const int64_t mMost; ///< balls of the finest level
    const LevelMaker& mMaker;
    const SampleLevel& mVoxels;
    std::vector<std::vector<VoxelRegion>> mChains; ///< of the levels that are not placed yet
    std::vector<VoxelRegion> mRegions; ///< of the level placed last: voxels with a chain down
};

} // namespace

ExactSphere lifted(const ExactSphere& ball, const PyramidStep& step)
{
    // A voxel's children are its middle plus or minus half a voxel along each axis that is halved.
    constexpr int64_t kHalf = kFine / 2;
    constexpr int64_t kToChild[] = {0, 0, 12, 14}; // kHalf times the root of 2, of 3, rounded up
    ExactSphere fine = ball;
    for (int a = 0; a < step.dim; ++a) {
        fine.center[a] = 2 * ball.center[a] + kFine * int64_t(step.origin[a]) + kHalf;
    }
    const int64_t radius = 2 * detail::ceilSqrt(ball.radiusSq) + kToChild[step.dim];
    fine.radiusSq = radius * radius;
    return fine;
}

std::vector<TightLevel> carriedDown(
    std::vector<TightLevel> levels, const PyramidStep& step, int64_t most, const LevelMaker& finer)
{
    for (TightLevel& level : levels) {
        for (ExactSphere& ball : level.balls) ball = lifted(ball, step);
        level.digital.clear();
    }
    return Placing(std::move(levels), most, finer).run();
}

} // namespace openvdb_spheretree::tight
