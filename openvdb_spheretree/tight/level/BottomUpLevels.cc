// SPDX-License-Identifier: Apache-2.0
#include "BottomUpLevels.h"

#include "ChildMoves.h"
#include "LevelRegions.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using Units = HeldPoints; ///< of each unit its extreme points

/// @return for each unit the ball it is deepest in; for an empty one, any that is near.
std::vector<int32_t> parentsOf(const Units& units, const std::vector<ExactSphere>& finer,
    const std::vector<ExactSphere>& balls, openvdb::util::NullInterrupter* interrupter)
{
    const BallGrid grid(balls);
    std::vector<int32_t> parents(units.size(), -1);
    detail::parallelFor(units.size(), interrupter, [&](std::size_t i) {
        if (units[i].empty()) {
            parents[i] = anyNear(finer[i], balls, grid);
            return;
        }
        int64_t best = -1;
        for (const int32_t b : grid.near(voxelBall(units[i].front()), 1)) {
            const int64_t depth = balls[b].radiusSq - radiusSqToHold(balls[b], units[i]);
            if (depth <= best) continue;
            best = depth;
            parents[i] = b;
        }
        assert(parents[i] >= 0); // some ball holds each unit
    });
    return parents;
}

/// @return extreme points of the units of each ball.
HeldPoints pointsOf(const Units& units, const std::vector<int32_t>& owner, std::size_t balls,
    openvdb::util::NullInterrupter* interrupter)
{
    HeldPoints points(balls);
    for (std::size_t i = 0; i < units.size(); ++i) {
        auto& all = points[owner[i]];
        all.insert(all.end(), units[i].begin(), units[i].end());
    }
    detail::parallelFor(balls, interrupter, [&](std::size_t b) { dropInnerPoints(points[b]); });
    return points;
}

/// @return at most @a count balls, each unit in one of them: the finer balls merged and placed anew by
/// turns.
std::vector<ExactSphere> fewerBalls(
    const TightLevel& finer, const Units& units, int64_t count, const LevelMaker& maker)
{
    const UnitGoal goal(units);
    std::vector<ExactSphere> balls = finer.balls;
    HeldPoints points = units;
    bool areInside = !finer.digital.empty();
    for (auto many = int64_t(balls.size()); many > count;) {
        // Leaf balls hold little each: they are merged at once to about what is asked for.
        const int64_t first = maker.firstTowards(count);
        many = areInside && first < many ? first : halvedTowards(many, count);
        const auto merged = maker.merged(ungrouped(balls), points, areInside, many);
        balls =
            ballsOf(many > count ? maker.placedBetween(merged, goal) : maker.placed(merged, goal));
        const auto owner = parentsOf(units, finer.balls, balls, maker.interrupter);
        points = pointsOf(units, owner, balls.size(), maker.interrupter);
        areInside = false;
    }
    if (!maker.searchesLevelOf(balls.size())) return balls;
    return ballsOf(withoutEmpty(maker.improve(ungrouped(balls), ungrouped(finer.balls), goal)));
}

/// Places the balls of a level anew for their children's regions alone.
void placeAbove(TightLevel& level, TightLevel& finer, const std::vector<VoxelRegion>& regions,
    const LevelMaker& maker)
{
    const auto below = regionsBelow(regions, finer.parent, level.balls.size(), maker);
    const VoxelGoal goal(maker.object.level(0), below);
    level.balls = ballsOf(maker.placed(eachInItsGroup(level.balls), goal, false));
    adoptOrphans(finer, level.balls);
    dropChildless(level, finer);
}

} // namespace

TightLevel coarserLevel(
    TightLevel& finer, std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    const Units units = extremePoints(
        powerCells(finer.balls, regions, object, maker.interrupter), object, maker.interrupter);
    TightLevel level;
    level.balls = fewerBalls(finer, units, count, maker);
    finer.parent = parentsOf(units, finer.balls, level.balls, maker.interrupter);
    dropChildless(level, finer);
    if (maker.searchesLevelOf(level.balls.size())) {
        moveChildren(level.balls, finer, regions, maker);
    }
    placeAbove(level, finer, regions, maker);
    regions = heldBelow(level.balls, regions, finer.parent, maker);
    return level;
}

std::vector<TightLevel> bottomUpLevels(
    const TightLevel& finest, const std::vector<int64_t>& counts, const LevelMaker& maker)
{
    std::vector<TightLevel> levels{finest};
    if (counts.size() == 1) return levels;
    maker.requireRoomForRegions(finest.balls);
    auto regions = regionsOf(finest.balls, maker.object.level(0), maker.interrupter);
    for (std::size_t k = 1; k < counts.size(); ++k) {
        TightLevel above = coarserLevel(levels.back(), regions, counts[k], maker);
        levels.push_back(std::move(above));
    }
    return levels;
}

} // namespace openvdb_spheretree::tight
