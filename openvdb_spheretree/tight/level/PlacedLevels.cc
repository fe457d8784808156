// SPDX-License-Identifier: Apache-2.0
#include "PlacedLevels.h"

#include "GroupedCover.h"
#include "LevelRegions.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Levels whose balls are large enough, and are placed anew from the finest up. A ball above that
/// no voxel needs is empty, until all are placed.
class Placing {
public:
    Placing(std::vector<TightLevel> levels, int64_t most, const LevelMaker& maker,
        const std::vector<ExactSphere>& spare)
        : mLevels(std::move(levels)), mMost(most), mMaker(maker), mVoxels(maker.object.level(0)),
          mSpare(spare), mChains(mLevels.size() + 1)
    {
        mMaker.requireRoomForRegions(allBalls(mLevels));
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
        const std::vector<CoverBall> spare = spareInGroups();
        if (!spare.empty()) cover.resize(std::max(cover.size(), std::size_t(mMost)));
        cover = mMaker.placed(cover, goal, true, spare);
        if (int64_t(cover.size()) > mMost) cover = mMaker.placed(fewer(cover), goal);
        level.balls = ballsOf(cover);
        if (!isOnly) level.parent = groupsOf(cover);
        mRegions = regionsOf(level.balls, mVoxels, mMaker.interrupter);
    }

    std::vector<CoverBall> spareInGroups() const
    {
        if (mSpare.empty() || mLevels.size() == 1) return ungrouped(mSpare);
        return dealtOut(mSpare, mLevels[1], mChains[1], mMaker).balls;
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
        auto below = regionsBelow(mRegions, finer.parent, balls, mMaker);
        if (!level.parent.empty()) {
            detail::parallelFor(balls, mMaker.interrupter, [&](std::size_t i) {
                below[i] = intersectionOf(below[i], mChains[k + 1][level.parent[i]]);
            });
        }
        const VoxelGoal goal(mVoxels, below);
        level.balls = ballsOf(mMaker.placed(eachInItsGroup(level.balls), goal, false));
        adoptOrphans(finer, level.balls);
        mRegions = heldBelow(level.balls, mRegions, finer.parent, mMaker);
    }

    std::vector<TightLevel> mLevels;
    const int64_t mMost; ///< balls of the finest level
    const LevelMaker& mMaker;
    const SampleLevel& mVoxels;
    const std::vector<ExactSphere>& mSpare;
    std::vector<std::vector<VoxelRegion>> mChains; ///< of the levels that are not placed yet
    std::vector<VoxelRegion> mRegions; ///< of the level placed last: voxels with a chain down
};

} // namespace

std::vector<TightLevel> placedLevels(std::vector<TightLevel> levels, int64_t most,
    const LevelMaker& maker, const std::vector<ExactSphere>& spare)
{
    return Placing(std::move(levels), most, maker, spare).run();
}

} // namespace openvdb_spheretree::tight
