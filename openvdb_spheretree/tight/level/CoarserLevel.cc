// SPDX-License-Identifier: Apache-2.0
#include "CoarserLevel.h"

#include "ChildMoves.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>
#include <cassert>

namespace openvdb_spheretree::tight {

namespace {

/// Extreme points of each unit.
using Units = std::vector<std::vector<openvdb::Coord>>;

/// @return for each unit the ball it is deepest in; for an empty one, any that is near.
std::vector<int32_t> parentsOf(const Units& units, const std::vector<ExactSphere>& finer,
    const std::vector<ExactSphere>& balls, openvdb::util::NullInterrupter* interrupter)
{
    const BallGrid grid(balls);
    std::vector<int32_t> parents(units.size(), -1);
    detail::parallelFor(units.size(), interrupter, [&](std::size_t i) {
        if (units[i].empty()) {
            parents[i] = leastProtruding(finer[i], balls);
            return;
        }
        int64_t best = -1;
        for (const int32_t b : grid.near(voxelBall(units[i].front()), 1)) {
            int64_t farthest = 0;
            for (const openvdb::Coord& p : units[i]) {
                farthest = std::max(farthest, radiusSqToHold(balls[b], voxelBall(p)));
            }
            const int64_t depth = balls[b].radiusSq - farthest;
            if (depth <= best) continue;
            best = depth;
            parents[i] = b;
        }
        assert(parents[i] >= 0); // some ball holds each unit
    });
    return parents;
}

} // namespace

TightLevel coarserLevel(
    TightLevel& finer, std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    const Units units = extremePoints(
        powerCells(finer.balls, regions, object, maker.interrupter), object, maker.interrupter);
    TightLevel level;
    level.balls = finer.balls;
    if (count < int64_t(finer.balls.size())) {
        level.balls = ballsOf(maker.improve(ungrouped(maker.merged(finer.balls, units, count)),
            ungrouped(finer.balls), UnitGoal(units)));
    }
    finer.parent = parentsOf(units, finer.balls, level.balls, maker.interrupter);
    dropChildless(level, finer);
    constexpr int kTurns = 2;
    for (int turn = 0; turn < kTurns; ++turn) {
        moveChildren(level.balls, finer, regions, maker);
        const auto below =
            regionsBelow(regions, finer.parent, level.balls.size(), maker.interrupter);
        level.balls =
            ballsOf(maker.improve(eachInItsGroup(level.balls), {}, VoxelGoal(object, below)));
        // A ball that was dropped leaves its children to others. No voxel needs them for its chain.
        for (std::size_t i = 0; i < finer.balls.size(); ++i) {
            if (!level.balls[finer.parent[i]].empty()) continue;
            finer.parent[i] = leastProtruding(finer.balls[i], level.balls);
        }
        dropChildless(level, finer);
    }
    regions = regionsBelow(regions, finer.parent, level.balls.size(), maker.interrupter);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        regions[i] = clipped(regions[i], level.balls[i], object);
    }
    return level;
}

} // namespace openvdb_spheretree::tight
