// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/GroupedCover.h>
#include <openvdb_spheretree/tight/level/LevelRegions.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Deals the leaf balls out below some balls, and expects that each voxel is in one cell.
GroupedCover expectDealt(const MergedLeaves& merged, const std::vector<ExactSphere>& coarsest)
{
    const SampleLevel& object = merged.object.level(0);
    TightLevel coarser;
    coarser.balls = coarsest;
    const auto regions = chainRegions(coarser, {}, merged.maker);
    EXPECT_EQ(voxelsOf(regions, object), voxelsOf(merged.regions(coarser.balls), object));
    GroupedCover dealt = dealtOut(merged.leaves, coarser, regions, merged.maker);
    EXPECT_EQ(dealt.cells.size(), dealt.balls.size());
    const auto cells = voxelsOf(dealt.cells, object);
    std::size_t voxels = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        voxels += cells[i].size();
        const auto& [ball, group] = dealt.balls[i];
        EXPECT_TRUE(std::count(merged.leaves.begin(), merged.leaves.end(), ball));
        EXPECT_FALSE(cells[i].empty());
        EXPECT_EQ(heldBy({ball}, heldBy({coarsest.at(std::size_t(group))}, cells[i])), cells[i]);
    }
    EXPECT_EQ(together(cells), merged.voxels);
    EXPECT_EQ(voxels, merged.voxels.size()) << "no voxel twice";
    return dealt;
}

TEST(GroupedCover, DealsOutEveryVoxelOnce)
{
    Random random(1);
    for (const double rate : {0.3, 0.5, 0.9}) {
        const MergedLeaves merged(shapes::noise(Coord(9, 8, 7), rate, random));
        for (const int64_t count : {1, 3, 9}) expectDealt(merged, merged.cut(count));
    }
}

TEST(GroupedCover, HasABallInEachGroupThatHasAPartOfItsCell)
{
    MergedLeaves merged(shapes::ball(30));
    merged.leaves = {{{0, 0, 0}, 16 * 16 * 29}};
    // The right one holds more.
    const std::vector<ExactSphere> halves{{{-64, 0, 0}, 109 * 109}, {{32, 0, 0}, 109 * 109}};
    const GroupedCover dealt = expectDealt(merged, halves);
    ASSERT_EQ(dealt.balls.size(), 2u);
    EXPECT_EQ(dealt.balls[0].group, 1) << "the group with the most of it comes first";
    EXPECT_EQ(dealt.balls[1].group, 0);
}

TEST(GroupedCover, MergedWithinGroupsKeepsChains)
{
    Random random(2);
    const MergedLeaves merged(shapes::noise(Coord(9, 8, 7), 0.5, random));
    const SampleLevel& object = merged.object.level(0);
    TightLevel coarser;
    coarser.balls = merged.cut(4);
    const auto regions = chainRegions(coarser, {}, merged.maker);
    const GroupedCover dealt = dealtOut(merged.leaves, coarser, regions, merged.maker);
    const auto points = extremePoints(dealt.cells, object, nullptr);
    for (const int64_t count : {17, 4, 1}) {
        TightLevel finer;
        const auto balls = merged.maker.merged(dealt.balls, points, true, count);
        EXPECT_EQ(balls.size(), std::size_t(std::max<int64_t>(count, 4)));
        finer.balls = ballsOf(balls);
        finer.parent = groupsOf(balls);
        expectChains({finer, coarser}, merged.voxels);
    }
}

} // namespace
