// SPDX-License-Identifier: Apache-2.0
#include "LevelMaker.h"

#include "TightLevels.h"
#include <openvdb_spheretree/tight/merge/StrictMerging.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

int LevelMaker::trialsFor(std::size_t count)
{
    constexpr std::size_t kLeast = 4, kMost = 100, kAll = 200000;
    return int(std::max(kLeast, std::min(kMost, kAll / count)));
}

SearchedCover LevelMaker::search(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverGoal& goal, int trialsPerBall, int number) const
{
    const SearchEffort effort{fit, trialsPerBall, uint64_t(number) << 40, flat};
    return improveCover(start, finer, object, goal, effort, interrupter);
}

std::vector<CoverBall> LevelMaker::improve(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverGoal& goal) const
{
    // More trials of one search gain little. But searches of few balls end in different places, and
    // take little time: so there are several.
    constexpr std::size_t kBalls = 128, kMost = 6;
    const std::size_t searches = std::max<std::size_t>(1, std::min(kMost, kBalls / start.size()));
    SearchedCover best;
    best.balls = start;
    for (int number = 0; number < int(searches); ++number) {
        SearchedCover found = search(start, finer, goal, trialsFor(start.size()), number);
        if (found.change < best.change) best = std::move(found);
    }
    return std::move(best.balls);
}

std::vector<ExactSphere> LevelMaker::merged(const std::vector<ExactSphere>& balls,
    const std::vector<std::vector<openvdb::Coord>>& points, int64_t count) const
{
    constexpr int kNeighbours = 8;
    HeldByLeafBalls held = heldVoxels(points);
    held.areInside = false;
    StrictMerging merging(object, balls, std::move(held), fit, flat, interrupter);
    return ballsOfCut(mergeToCount(merging, kNeighbours, count, interrupter), count);
}

std::vector<CoverBall> filledUp(
    const std::vector<CoverBall>& cover, const std::vector<CoverBall>& leafBalls)
{
    std::vector<CoverBall> filled;
    for (const CoverBall& ball : cover) {
        if (!ball.empty()) filled.push_back(ball);
    }
    for (const CoverBall& ball : leafBalls) {
        if (filled.size() == cover.size()) break;
        if (std::find(cover.begin(), cover.end(), ball) == cover.end()) filled.push_back(ball);
    }
    return filled;
}

} // namespace openvdb_spheretree::tight
