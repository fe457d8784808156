// SPDX-License-Identifier: Apache-2.0
#include "FinerLevel.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>

#include <cassert>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// @return the voxels of @a cell in @a region, or those outside of it.
VoxelRegion partOf(const VoxelRegion& cell, const VoxelRegion& region, bool inside)
{
    VoxelRegion result;
    for (const RegionLeaf& part : cell) {
        const LeafMask& other = maskIn(region, part.leaf);
        const LeafMask mask = inside ? part.mask & other : part.mask - other;
        if (!mask.none()) result.push_back({part.leaf, mask});
    }
    return result;
}

/// @return the groups that have parts of a cell, the one with the largest part first.
std::vector<int32_t> groupsFor(VoxelRegion cell, const std::vector<int32_t>& candidates,
    const std::vector<VoxelRegion>& regions)
{
    std::vector<int32_t> groups;
    while (!cell.empty()) {
        int64_t most = 0;
        int32_t best = -1;
        for (const int32_t group : candidates) {
            int64_t held = 0;
            for (const RegionLeaf& part : partOf(cell, regions[group], true)) {
                held += part.mask.count();
            }
            if (held <= most) continue;
            most = held;
            best = group;
        }
        assert(best >= 0); // regions together are the object
        if (best < 0) break;
        groups.push_back(best);
        cell = partOf(cell, regions[best], false);
    }
    return groups;
}

} // namespace

std::vector<VoxelRegion> chainRegions(
    const TightLevel& level, const std::vector<VoxelRegion>& above, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    std::vector<VoxelRegion> regions(level.balls.size());
    detail::parallelFor(regions.size(), maker.interrupter, [&](std::size_t i) {
        regions[i] = above.empty() ? regionOf(level.balls[i], object)
                                   : clipped(above[level.parent[i]], level.balls[i], object);
    });
    return regions;
}

std::vector<CoverBall> dealtOut(const BallCells& cells, const TightLevel& coarser,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker)
{
    const BallGrid grid(coarser.balls);
    std::vector<std::vector<int32_t>> groups(cells.balls.size());
    detail::parallelFor(groups.size(), maker.interrupter, [&](std::size_t i) {
        groups[i] = groupsFor(cells.cells[i], grid.near(cells.balls[i], 1), regions);
    });
    std::vector<CoverBall> dealt;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (const int32_t group : groups[i]) dealt.push_back({cells.balls[i], group});
    }
    return dealt;
}

std::vector<CoverBall> mergedInGroups(const std::vector<CoverBall>& balls,
    const std::vector<VoxelRegion>& regions, int64_t count, bool areInside, const LevelMaker& maker)
{
    if (int64_t(balls.size()) <= count) return balls;
    std::vector<VoxelRegion> held(balls.size());
    detail::parallelFor(held.size(), maker.interrupter, [&](std::size_t i) {
        const VoxelRegion region = regionOf(balls[i].ball, maker.object.level(0));
        held[i] = partOf(region, regions[balls[i].group], true);
    });
    SlackMerging merging(
        maker.object, balls, std::move(held), maker.fit, maker.flat, maker.interrupter, areInside);
    constexpr int kNeighbours = 6;
    const std::vector<ForestNode> forest =
        mergeToCount(merging, kNeighbours, count, maker.interrupter);
    std::vector<int32_t> group(groupsOf(balls));
    group.resize(forest.size(), -1);
    for (std::size_t i = 0; i < forest.size(); ++i) { // parents come after their children
        if (forest[i].parent >= 0) group[forest[i].parent] = group[i];
    }
    std::vector<CoverBall> merged;
    for (const int32_t node : cutOf(forest, count)) {
        merged.push_back({forest[node].ball, group[node]});
    }
    return merged;
}

TightLevel finerLevel(const TightLevel& coarser, const std::vector<VoxelRegion>& regions,
    const BallCells& leafBalls, int64_t count, const LevelMaker& maker)
{
    const std::vector<CoverBall> dealt = dealtOut(leafBalls, coarser, regions, maker);
    const VoxelGoal goal(maker.object.level(0), regions);
    const auto balls = filledUp(
        maker.improve(mergedInGroups(dealt, regions, count, true, maker), dealt, goal), dealt);
    TightLevel level;
    level.balls = ballsOf(balls);
    level.parent = groupsOf(balls);
    return level;
}

} // namespace openvdb_spheretree::tight
