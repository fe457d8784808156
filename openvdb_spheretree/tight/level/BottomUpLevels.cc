// SPDX-License-Identifier: Apache-2.0
#include "BottomUpLevels.h"

#include "CarriedLevels.h"
#include "ChildMoves.h"
#include "LevelRegions.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/region/HalvedObject.h>
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

/// @return at most @a count balls, each unit in one of them: the finer balls merged, and searched.
std::vector<ExactSphere> fewerBalls(
    const TightLevel& finer, const Units& units, int64_t count, const LevelMaker& maker)
{
    const bool areInside = !finer.digital.empty();
    auto balls = maker.merged(ungrouped(finer.balls), units, areInside, count);
    const bool isSearched = maker.searchesLevelOf(std::size_t(count));
    // To place many for whole cells gains nothing.
    if (count > kFewBalls && !isSearched) return ballsOf(balls);
    const UnitGoal goal(units);
    balls = maker.placed(balls, goal);
    if (!isSearched) return ballsOf(balls);
    return ballsOf(withoutEmpty(maker.improve(balls, ungrouped(finer.balls), goal)));
}

/// Decides which balls a level has, and which of them each finer ball hangs below.
TightLevel parentLevel(TightLevel& finer, const Units& units,
    const std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    TightLevel level;
    level.balls = fewerBalls(finer, units, count, maker);
    finer.parent = parentsOf(units, finer.balls, level.balls, maker.interrupter);
    dropChildless(level, finer);
    if (maker.searchesLevelOf(level.balls.size())) {
        moveChildren(level.balls, finer, regions, maker);
    }
    return level;
}

TightLevel placedParentLevel(TightLevel& finer, const std::vector<VoxelRegion>& regions,
    int64_t count, const LevelMaker& maker);

/// As parentLevel(), but decided at half the resolution, or at less. Each ball then grows until it
/// holds the units of its children.
TightLevel parentLevelOf(const HalvedObject& halved, TightLevel& finer, const Units& units,
    const std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    std::vector<VoxelRegion> halvedRegions(regions.size());
    detail::parallelFor(regions.size(), maker.interrupter,
        [&](std::size_t i) { halvedRegions[i] = halved.regionOf(regions[i]); });
    const HeldPoints held =
        extremePoints(halvedRegions, halved.object().level(0), maker.interrupter);
    TightLevel halvedFiner;
    for (std::size_t i = 0; i < finer.balls.size(); ++i) {
        ExactSphere& ball = halvedFiner.balls.emplace_back(halved.centerOf(finer.balls[i]));
        ball.radiusSq = radiusSqToHold(ball, held[i]);
    }
    TightLevel level =
        placedParentLevel(halvedFiner, halvedRegions, count, maker.forObject(halved.object()));
    finer.parent = halvedFiner.parent;
    for (ExactSphere& ball : level.balls) {
        ball = lifted(ball, halved.step());
        ball.radiusSq = 0; // it grows below
    }
    for (std::size_t i = 0; i < units.size(); ++i) {
        ExactSphere& parent = level.balls[std::size_t(finer.parent[i])];
        parent.radiusSq = std::max(parent.radiusSq, radiusSqToHold(parent, units[i]));
    }
    return level;
}

/// @return whether balls of a level are large (kLeavesOfLargeBall), and there is much to decide:
/// merging alone takes as long at any resolution.
bool areLargeAndSearched(int64_t count, const LevelMaker& maker)
{
    return maker.searchesLevelOf(std::size_t(count))
        && maker.object.level(0).leafCount() > std::size_t(count) * kLeavesOfLargeBall;
}

/// As parentLevel(), at the resolution that suits the balls.
TightLevel suitedParentLevel(TightLevel& finer, const Units& units,
    const std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    if (areLargeAndSearched(count, maker)) {
        const HalvedObject halved(maker.object.level(0), maker.flat);
        // Of voxels far from each other nearly all leaves are left: nothing would be gained.
        const std::size_t left = halved.object().level(0).leafCount();
        if (2 * left <= maker.object.level(0).leafCount()) {
            return parentLevelOf(halved, finer, units, regions, count, maker);
        }
    }
    return parentLevel(finer, units, regions, count, maker);
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

/// Decides on a level, and places its balls anew. Recursion: as deep as the resolution can be
/// halved.
TightLevel placedParentLevel(TightLevel& finer, const std::vector<VoxelRegion>& regions,
    int64_t count, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    const Units units = extremePoints(
        powerCells(finer.balls, regions, object, maker.interrupter), object, maker.interrupter);
    TightLevel level = suitedParentLevel(finer, units, regions, count, maker);
    placeAbove(level, finer, regions, maker);
    return level;
}

} // namespace

TightLevel coarserLevel(
    TightLevel& finer, std::vector<VoxelRegion>& regions, int64_t count, const LevelMaker& maker)
{
    TightLevel level = placedParentLevel(finer, regions, count, maker);
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
