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
        const auto& [many, balls] = *mCovers.lower_bound(count);
        if (many == count) return mCovers[count];
        const bool isStart = many == mStart;
        const int64_t first = std::max(mMaker.placesStart ? 2 * count : count, kFirst);
        const int64_t next = isStart && first < many ? first : halvedTowards(many, count);
        const bool isPlaced = mMaker.placesStart || !isStart || next <= kFirst;
        const auto cover = merged(balls, isStart && mAreInside, next);
        mCovers[next] = isPlaced ? placed(cover) : cover;
    }
}

std::vector<ExactSphere> FreeCovers::merged(
    const std::vector<ExactSphere>& balls, bool areInside, int64_t count) const
{
    const auto points = powerCellPoints(balls, mMaker.object.level(0), mMaker.interrupter);
    return ballsOf(mMaker.merged(ungrouped(balls), points, areInside, count));
}

std::vector<ExactSphere> FreeCovers::placed(const std::vector<ExactSphere>& balls) const
{
    return ballsOf(mMaker.placed(ungrouped(balls), VoxelGoal(mMaker.object.level(0))));
}

} // namespace openvdb_spheretree::tight
