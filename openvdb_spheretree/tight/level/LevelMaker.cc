// SPDX-License-Identifier: Apache-2.0
#include "LevelMaker.h"

#include "LevelWork.h"
#include "TightLevels.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>
#include <openvdb_spheretree/tight/merge/StrictMerging.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// @return the cut of @a count balls, with their groups; of more if there are more groups.
std::vector<CoverBall> groupedCut(
    const std::vector<ForestNode>& forest, const std::vector<CoverBall>& leafBalls, int64_t count)
{
    std::vector<int32_t> group = groupsOf(leafBalls);
    group.resize(forest.size(), -1);
    for (std::size_t i = 0; i < forest.size(); ++i) { // parents come after their children
        if (forest[i].parent >= 0) group[forest[i].parent] = group[i];
    }
    std::vector<CoverBall> cut;
    const int64_t some = std::min(count, int64_t(leafBalls.size()));
    for (const int32_t node : cutOf(forest, some)) cut.push_back({forest[node].ball, group[node]});
    return cut;
}

} // namespace

FitEffort LevelMaker::mergingTo(int64_t count) const
{
    FitEffort effort = merging;
    effort.diagonals = effort.diagonals || count <= kFewBalls;
    return effort;
}

FitEffort LevelMaker::fitOf(int64_t balls) const
{
    FitEffort effort = fit;
    effort.restarts = effort.restarts && balls <= kFewOnCoarse;
    return effort;
}

int LevelMaker::searchesOf(int64_t balls) const
{
    constexpr int64_t kBalls = 128;
    return int(std::clamp<int64_t>(kBalls / balls, 1, searches));
}

int LevelMaker::trialsOf(int64_t balls) const
{
    constexpr int64_t kFewest = 4, kOfAllBalls = 200000;
    const int64_t most = trialsPerBall;
    return int(std::clamp(kOfAllBalls / balls, std::min(kFewest, most), most));
}

std::vector<CoverBall> LevelMaker::improve(const std::vector<CoverBall>& start,
    const std::vector<CoverBall>& finer, const CoverGoal& goal) const
{
    const auto size = int64_t(start.size());
    SearchedCover best;
    best.balls = start;
    for (uint64_t number = 0; number < uint64_t(searchesOf(size)); ++number) {
        const detail::Step step(interrupter, LevelWork(*this).ofSearch(size));
        const SearchEffort effort{fitOf(size), trialsOf(size), number << 40, flat, relocations};
        SearchedCover found = improveCover(start, finer, object, goal, effort, interrupter);
        if (found.change < best.change) best = std::move(found);
    }
    return std::move(best.balls);
}

std::vector<CoverBall> LevelMaker::placed(const std::vector<CoverBall>& cover,
    const CoverGoal& goal, bool drop, const std::vector<CoverBall>& spare) const
{
    const detail::Step step(interrupter, LevelWork(*this).ofPlacing(int64_t(cover.size())));
    SearchEffort effort{fitOf(int64_t(cover.size())), 0, 0, flat};
    effort.sweeps = sweeps;
    auto balls = improveCover(cover, spare, object, goal, effort, interrupter).balls;
    return drop ? withoutEmpty(std::move(balls)) : balls;
}

std::vector<CoverBall> LevelMaker::placedBetween(
    const std::vector<CoverBall>& cover, const CoverGoal& goal) const
{
    LevelMaker quick(*this);
    quick.sweeps = std::min(sweeps, kFewSweeps);
    return quick.placed(cover, goal);
}

int64_t LevelMaker::dilatedFor(int64_t leafBalls, int64_t count) const
{
    constexpr double kWorth = 1.5; // times as many: else little is saved
    const auto few = std::max(dilatedAtLeast, int64_t(dilatedPerBall * double(count)));
    return double(leafBalls) > kWorth * double(few) ? few : 0;
}

std::vector<ExactSphere> LevelMaker::fitted(
    const std::vector<ExactSphere>& balls, const HeldPoints& points) const
{
    std::vector<ExactSphere> result(balls);
    detail::parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        if (points[i].empty()) return;
        thread_local CoveringFit window;
        window.open(object, points[i], {balls[i]}, merging.samples);
        result[i] = window.best(merging, flat).ball;
    });
    return result;
}

std::vector<CoverBall> LevelMaker::merged(const std::vector<CoverBall>& balls,
    const HeldPoints& points, bool areInside, int64_t count) const
{
    StrictMerging model(
        object, balls, heldVoxels(points, areInside), mergingTo(count), flat, interrupter);
    const detail::Step step(interrupter, LevelWork(*this).ofMerging(int64_t(balls.size()), count));
    return groupedCut(mergeToCount(model, neighbours, count, interrupter), balls, count);
}

std::vector<ExactSphere> LevelMaker::mergedCover(
    const std::vector<ExactSphere>& balls, bool areInside, int64_t count) const
{
    const auto points = powerCellPoints(balls, object.level(0), interrupter);
    return ballsOf(merged(ungrouped(balls), points, areInside, count));
}

std::vector<CoverBall> LevelMaker::mergedWithSlack(
    const std::vector<CoverBall>& balls, std::vector<VoxelRegion> regions, int64_t count) const
{
    constexpr int kNeighbours = 6;
    SlackMerging model(object, balls, std::move(regions), fit, flat, interrupter, false);
    return groupedCut(mergeToCount(model, kNeighbours, count, interrupter), balls, count);
}

WorkingMemory LevelMaker::regionMemory(const std::vector<ExactSphere>& balls) const
{
    const SampleLevel& voxels = object.level(0);
    return WorkingMemory()
        .addSamples(voxels.leafCount(), object.dim())
        .addRegions(balls, voxels, interrupter);
}

void LevelMaker::requireRoomForRegions(const std::vector<ExactSphere>& balls) const
{
    regionMemory(balls).require(
        memory, "the regions of " + std::to_string(balls.size()) + " balls");
}

double LevelMaker::costOf(const std::vector<ExactSphere>& balls) const
{
    const BallGrid grid(balls);
    std::vector<double> costs(balls.size()); // of each, without those before it
    detail::parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        thread_local CoveringFit window;
        window.open(object, balls[i], fit.samples);
        for (const int32_t other : grid.meeting(window.box())) {
            if (other < int32_t(i)) window.cover(balls[other]);
        }
        costs[i] = window.costOf({balls[i]});
    });
    return std::accumulate(costs.begin(), costs.end(), 0.0);
}

LevelMaker levelMakerFor(const SphereTreeSettings& settings, const SampledObject& object,
    std::size_t leafBalls, detail::StepProgress* interrupter)
{
    return {effortOf(settings.tight().quality, leafBalls), object, settings.dim == 2, interrupter,
        settings.memory};
}

int64_t halvedTowards(int64_t many, int64_t count)
{
    constexpr double kRounding = 1e-9;
    const double ratio = double(many) / double(count);
    const double steps = std::max(1.0, std::ceil(std::log2(ratio) - kRounding));
    return std::max<int64_t>(count, std::llround(double(many) / std::pow(ratio, 1 / steps)));
}

std::vector<CoverBall> withoutEmpty(std::vector<CoverBall> cover)
{
    cover.erase(std::remove_if(
                    cover.begin(), cover.end(), [](const CoverBall& ball) { return ball.empty(); }),
        cover.end());
    return cover;
}

} // namespace openvdb_spheretree::tight
