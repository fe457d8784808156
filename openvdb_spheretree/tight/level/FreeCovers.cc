// SPDX-License-Identifier: Apache-2.0
#include "FreeCovers.h"

#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Of the balls of the start, each holds little: they are merged at once to about what is asked for, or
/// to so many.
constexpr int64_t kFirst = 512;

} // namespace

FreeCovers::FreeCovers(
    const std::vector<ExactSphere>& start, bool areInside, const LevelMaker& maker)
    : mMaker(maker), mAreInside(areInside), mStart(int64_t(start.size()))
{
    mCovers[mStart] = start;
}

const std::vector<ExactSphere>& FreeCovers::cover(int64_t count)
{
    count = std::min(count, mStart);
    for (;;) {
        const auto [many, balls] = *mCovers.lower_bound(count);
        if (many == count) return mCovers[count];
        const bool isStart = many == mStart;
        const int64_t first = std::max(mMaker.startTimes * count, kFirst);
        const int64_t next = isStart && first < many ? first : halvedTowards(many, count);
        mCovers[next] = fewer(balls, isStart && mAreInside, next);
    }
}

std::vector<ExactSphere> FreeCovers::fewer(
    const std::vector<ExactSphere>& balls, bool areInside, int64_t count) const
{
    const SampleLevel& object = mMaker.object.level(0);
    const auto points = powerCellPoints(balls, object, mMaker.interrupter);
    const auto merged = mMaker.merged(ungrouped(balls), points, areInside, count);
    return ballsOf(mMaker.placed(merged, VoxelGoal(object)));
}

} // namespace openvdb_spheretree::tight
