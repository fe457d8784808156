// SPDX-License-Identifier: Apache-2.0
#include "SearchedLevels.h"

#include "../detail/Parallel.h"
#include "DebtFit.h"
#include "ExtremePoints.h"
#include "PowerCells.h"
#include "StrictMerging.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Coord;
using Units = std::vector<std::vector<Coord>>;

/// Few balls need more trials each: their error is in a few numbers, and all of them matter.
int trialsFor(int64_t count)
{
    constexpr int64_t kAll = 24000, kLeast = 40, kMost = 400;
    return int(std::max(kLeast, std::min(kMost, kAll / count)));
}

/// What all levels are made with.
struct Maker {
    const SampledObject& object;
    SearchEffort effort;
    openvdb::util::NullInterrupter* interrupter;

    std::vector<FineBall> improve(std::vector<FineBall> start, const std::vector<FineBall>& finer,
        const CoverDebt& debt) const
    {
        SearchEffort search = effort;
        search.trialsPerBall = trialsFor(int64_t(start.size()));
        return improveCover(std::move(start), finer, object, debt, search, interrupter);
    }
};

std::vector<FineBall> ballsOf(const std::vector<ForestNode>& forest, int64_t count)
{
    std::vector<FineBall> balls;
    for (const int32_t node : cutOf(forest, count)) balls.push_back(forest[node].ball);
    return balls;
}

TightLevel finestLevel(const std::vector<ForestNode>& forest, int64_t count,
    const std::vector<MedialBall>& leaves, const Maker& maker)
{
    TightLevel level;
    level.balls = ballsOf(forest, count);
    if (count == int64_t(leaves.size())) {
        level.digital = leaves;
        return level;
    }
    level.balls = maker.improve(std::move(level.balls), ballsOf(forest, int64_t(leaves.size())),
        VoxelDebt(maker.object.level(0)));
    return level;
}

/// The balls of a coarser level before the search: the finer ones, merged.
std::vector<FineBall> mergedBalls(
    const std::vector<FineBall>& finer, const Units& units, int64_t count, const Maker& maker)
{
    HeldByLeaves held = heldVoxels(units);
    held.areInside = false;
    StrictMerging merging(maker.object, finer, std::move(held), maker.effort.fit, maker.effort.flat,
        maker.interrupter);
    constexpr int kNeighbours = 8;
    return ballsOf(mergeToRoot(merging, kNeighbours, maker.interrupter), count);
}

/// @return how far inside a ball a unit is, 1/256 voxel^2; negative where it is not.
int64_t depthIn(const FineBall& ball, const std::vector<Coord>& unit)
{
    int64_t farthest = 0;
    for (const Coord& p : unit) {
        farthest = std::max(farthest, radiusSqToHold(ball, voxelBall(p)));
    }
    return ball.radiusSq - farthest;
}

/// @return for each unit the ball it is deepest in.
std::vector<int32_t> parentsOf(const Units& units, const std::vector<FineBall>& balls,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> parents(units.size(), 0);
    detail::parallelFor(units.size(), interrupter, [&](std::size_t i) {
        int64_t best = -1;
        for (std::size_t b = 0; b < balls.size(); ++b) {
            const int64_t depth = depthIn(balls[b], units[i]);
            if (depth <= best) continue;
            best = depth;
            parents[i] = int32_t(b);
        }
    });
    return parents;
}

/// Balls without children go; @a parents become links to those that are left.
void keepParents(std::vector<FineBall>& balls, std::vector<int32_t>& parents)
{
    std::vector<int32_t> index(balls.size(), -1);
    for (const int32_t parent : parents) index[parent] = 0;
    std::vector<FineBall> kept;
    for (std::size_t b = 0; b < balls.size(); ++b) {
        if (index[b] < 0) continue;
        index[b] = int32_t(kept.size());
        kept.push_back(balls[b]);
    }
    for (int32_t& parent : parents) parent = index[parent];
    balls.swap(kept);
}

Units unitsAbove(const Units& units, const std::vector<int32_t>& parents, std::size_t count)
{
    Units above(count);
    for (std::size_t i = 0; i < units.size(); ++i) {
        above[parents[i]].insert(above[parents[i]].end(), units[i].begin(), units[i].end());
    }
    for (auto& unit : above) dropInnerPoints(unit);
    return above;
}

} // namespace

std::vector<TightLevel> searchedLevels(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& leaves,
    const SampledObject& object, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter)
{
    const Maker maker{object, {effort, 0, flat}, interrupter};
    std::vector<TightLevel> levels{finestLevel(forest, counts.front(), leaves, maker)};
    if (counts.size() == 1) return levels;
    Units units = cellPoints(levels.back().balls, object.level(0), interrupter);
    for (std::size_t k = 1; k < counts.size(); ++k) {
        TightLevel& finer = levels.back();
        TightLevel level;
        level.balls = finer.balls;
        if (counts[k] < int64_t(finer.balls.size())) {
            level.balls = maker.improve(
                mergedBalls(finer.balls, units, counts[k], maker), finer.balls, UnitDebt(units));
        }
        finer.parent = parentsOf(units, level.balls, interrupter);
        keepParents(level.balls, finer.parent);
        units = unitsAbove(units, finer.parent, level.balls.size());
        levels.push_back(std::move(level));
    }
    return levels;
}

} // namespace tight
} // namespace openvdb_spheretree
