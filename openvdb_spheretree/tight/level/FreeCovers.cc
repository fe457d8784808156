// SPDX-License-Identifier: Apache-2.0
#include "FreeCovers.h"

#include "LevelWork.h"
#include <openvdb_spheretree/tight/region/DilatedCover.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

FreeCovers::FreeCovers(
    const std::vector<ExactSphere>& start, bool areInside, const LevelMaker& maker)
    : mMaker(maker), mAreInside(areInside), mStart(int64_t(start.size()))
{
    mCovers[mStart] = {start, false};
}

const std::vector<ExactSphere>& FreeCovers::cover(int64_t count)
{
    count = std::min(count, mStart);
    while (mCovers.lower_bound(count)->first != count) {
        const auto& [many, larger] = *mCovers.lower_bound(count);
        const bool isStart = many == mStart;
        const Next found = next(many, count, isStart, mMaker);
        Cover made{
            isStart ? mergedStart(found) : mMaker.mergedCover(larger.balls, false, found.count),
            found.count > count};
        if (found.isPlaced) made.balls = placed(made.balls, made.isBetween);
        mCovers[found.count] = std::move(made);
    }
    Cover& asked = mCovers[count];
    if (asked.isBetween) asked = {placed(asked.balls, false), false};
    return asked.balls;
}

std::vector<ExactSphere> FreeCovers::searched(int64_t count)
{
    const std::vector<ExactSphere>& balls = cover(count);
    if (!mMaker.searchesLevelOf(balls.size())) return balls;
    const std::vector<ExactSphere>& smaller = cover(4 * count);
    return ballsOf(withoutEmpty(
        mMaker.improve(ungrouped(balls), ungrouped(smaller), VoxelGoal(mMaker.object.level(0)))));
}

FreeCovers::Next FreeCovers::next(
    int64_t many, int64_t count, bool isStart, const LevelMaker& maker)
{
    // Of the balls of the start, each holds little: they are merged at once to what is asked for,
    // or to so many. Where they are placed on the way, half as many more come first.
    constexpr int64_t kFirst = 512;
    const bool areMany = isStart && maker.dilatedFor(many, std::max(count, kFirst)) > 0;
    const bool isPlacedOnTheWay = maker.placesStart && !areMany;
    const int64_t first = std::max(isPlacedOnTheWay ? count + count / 2 : count, kFirst);
    const int64_t next = isStart && first < many ? first : halvedTowards(many, count);
    return {next, maker.placesStart || !isStart || next <= kFirst,
        isStart ? maker.dilatedFor(many, next) : 0};
}

std::vector<ExactSphere> FreeCovers::mergedStart(const Next& next) const
{
    const FittedBalls few = next.dilated > 0 ? dilatedStart(next) : FittedBalls();
    if (few.balls.empty())
        return mMaker.mergedCover(mCovers.at(mStart).balls, mAreInside, next.count);
    return ballsOf(mMaker.merged(ungrouped(few.balls), few.points, false, next.count));
}

FreeCovers::FittedBalls FreeCovers::dilatedStart(const Next& next) const
{
    const detail::Step step(mMaker.interrupter, LevelWork(mMaker).ofDilating(mStart, next.dilated));
    const std::vector<ExactSphere>& start = mCovers.at(mStart).balls;
    const SampleLevel& voxels = mMaker.object.level(0);
    const auto dilated = dilatedCover(start, next.dilated, next.count, voxels, mMaker.interrupter);
    if (dilated.size() == start.size()) return {};
    FittedBalls few;
    few.points = powerCellPoints(dilated, voxels, mMaker.interrupter);
    few.balls = mMaker.fitted(dilated, few.points);
    return few;
}

std::vector<ExactSphere> FreeCovers::placed(
    const std::vector<ExactSphere>& balls, bool isBetween) const
{
    const VoxelGoal goal(mMaker.object.level(0));
    const std::vector<CoverBall> cover = ungrouped(balls);
    return ballsOf(isBetween ? mMaker.placedBetween(cover, goal) : mMaker.placed(cover, goal));
}

} // namespace openvdb_spheretree::tight
