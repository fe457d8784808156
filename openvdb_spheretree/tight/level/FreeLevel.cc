// SPDX-License-Identifier: Apache-2.0
#include "FreeLevel.h"

#include "TightLevels.h"
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverPart.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace openvdb_spheretree::tight {

std::vector<ExactSphere> freeLevel(const std::vector<ForestNode>& forest, int64_t count,
    const std::vector<ExactSphere>& leafBalls, const LevelMaker& maker)
{
    // Balls in the cover that a start is merged from, for each ball of the level; 1: not merged. With
    // many balls all starts end alike, and each takes long: then there are fewer.
    constexpr int64_t kTimesAsMany[] = {1, 2, 3, 4, 5, 8};
    constexpr int64_t kMostStarts = std::size(kTimesAsMany), kBalls = 128;
    constexpr int kTrialsPerBall = 20; // to find a start
    const int64_t starts = std::max<int64_t>(1, std::min(kMostStarts, kBalls / count));

    const std::vector<CoverBall> spare = ungrouped(leafBalls);
    const VoxelGoal goal(maker.object.level(0));
    const auto searched = [&](const std::vector<ExactSphere>& balls, int trialsPerBall,
                              int number) {
        const auto found = maker.search(ungrouped(balls), spare, goal, trialsPerBall, number);
        return ballsOf(filledUp(found.balls, spare));
    };
    std::vector<ExactSphere> best;
    double least = std::numeric_limits<double>::infinity();
    for (int number = 0; number < int(starts); ++number) {
        const int64_t many = count * kTimesAsMany[number];
        if (many > int64_t(leafBalls.size())) break;
        std::vector<ExactSphere> balls = ballsOfCut(forest, many);
        if (many != count) {
            balls = searched(balls, kTrialsPerBall, 0);
            balls = maker.merged(
                balls, powerCellPoints(balls, maker.object.level(0), maker.interrupter), count);
        }
        balls = searched(balls, maker.trialsFor(balls.size()), number);
        if (starts == 1) return balls;
        const double cost = costOfCover(balls, maker.object, maker.fit);
        if (cost >= least) continue;
        least = cost;
        best = std::move(balls);
    }
    return best;
}

double costOfCover(
    const std::vector<ExactSphere>& balls, const SampledObject& object, const FitEffort& effort)
{
    CoveringFit fit;
    double cost = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        fit.open(object, balls[i], effort.samples);
        for (std::size_t before = 0; before < i; ++before) {
            if (FineBox(balls[before]).meets(fit.box())) fit.cover(balls[before]);
        }
        cost += fit.costOf({balls[i]});
    }
    return cost;
}

} // namespace openvdb_spheretree::tight
