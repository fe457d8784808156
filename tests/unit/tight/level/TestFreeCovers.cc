// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/FreeCovers.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

TEST(FreeCovers, CoverTheObjectBetterThanMergesAlone)
{
    Random random(1);
    int64_t merging = 0, found = 0;
    for (const double rate : {0.3, 0.5, 0.9}) {
        const MergedLeaves merged(shapes::noise(Coord(11, 9, 8), rate, random));
        FreeCovers free(merged.leaves, true, merged.maker);
        for (const int64_t count : {40, 12, 5, 1}) {
            const auto& balls = free.cover(count);
            EXPECT_LE(balls.size(), std::size_t(count));
            EXPECT_EQ(heldBy(balls, merged.voxels), merged.voxels);
            merging += excess(merged.cut(count), merged.voxels);
            found += excess(balls, merged.voxels);
        }
    }
    EXPECT_LT(found, merging);
}

TEST(FreeCovers, AreTheStartWhereThatIsNoLarger)
{
    Random random(2);
    const MergedLeaves merged(shapes::noise(Coord(6, 6, 5), 0.5, random));
    FreeCovers free(merged.leaves, true, merged.maker);
    EXPECT_EQ(free.cover(int64_t(merged.leaves.size())), merged.leaves);
    EXPECT_EQ(free.cover(1000000), merged.leaves);
}

/// Of more leaf balls than are merged in pairs.
TEST(FreeCovers, OfManyLeafBallsBeginWithDilatedOnes)
{
    Random random(5);
    const Voxels voxels = shapes::noise(Coord(50, 44, 34), 0.8, random);
    const SampledObject object = sampled(voxels);
    const std::vector<ExactSphere> leaves = fineBalls(CoreStages(*maskOf(voxels)).balls);
    const LevelMaker maker{{{false, 4, 1, false, 16}}, object, false, nullptr};
    ASSERT_GT(maker.dilatedFor(int64_t(leaves.size()), 1050), 0); // of 700, half as many more
    LevelMaker without(maker);
    without.dilatedPerBall = 100;
    FreeCovers free(leaves, true, maker), plain(leaves, true, without);
    for (const int64_t count : {700, 100}) {
        const auto &balls = free.cover(count), &others = plain.cover(count);
        EXPECT_NE(balls, others);
        EXPECT_LE(balls.size(), std::size_t(count));
        EXPECT_EQ(heldBy(balls, voxels), voxels);
        EXPECT_LT(double(excess(balls, voxels)), 1.1 * double(excess(others, voxels)));
    }
}

/// Whoever looks for a bound asks in any order; what was found stays where it is.
TEST(FreeCovers, CanBeAskedInAnyOrder)
{
    Random random(3);
    const MergedLeaves merged(shapes::noise(Coord(10, 9, 8), 0.5, random));
    FreeCovers free(merged.leaves, true, merged.maker);
    const auto& one = free.cover(1);
    const auto copy = one;
    for (const int64_t count : {2, 4, 8, 16, 12, 10, 9, 11, 3}) {
        const auto& balls = free.cover(count);
        EXPECT_LE(balls.size(), std::size_t(count));
        EXPECT_EQ(heldBy(balls, merged.voxels), merged.voxels);
    }
    EXPECT_EQ(one, copy);
    EXPECT_EQ(&free.cover(1), &one);
}

/// Those on the way to fewer balls are placed twice, and wholly where they are asked for later.
TEST(FreeCovers, ArePlacedUntilNothingChangesWhenTheyAreAskedFor)
{
    Random random(4);
    const MergedLeaves merged(shapes::noise(Coord(24, 18, 16), 0.5, random));
    FreeCovers free(merged.leaves, true, merged.maker);
    free.cover(1);
    for (const int64_t count : {512, 256, 128, 64}) {
        const std::vector<ExactSphere> balls = free.cover(count);
        const VoxelGoal goal(merged.object.level(0));
        EXPECT_EQ(ballsOf(merged.maker.placed(ungrouped(balls), goal)), balls) << count;
    }
}

TEST(FreeCovers, OfAFlatObjectStayInItsPlane)
{
    Random random(4);
    const MergedLeaves merged(shapes::noise(Coord(20, 20, 1), 0.6, random), true);
    FreeCovers free(merged.leaves, true, merged.maker);
    for (const int64_t count : {20, 3}) {
        for (const ExactSphere& ball : free.cover(count)) EXPECT_EQ(ball.center[2], 0);
        EXPECT_EQ(heldBy(free.cover(count), merged.voxels), merged.voxels);
    }
}

} // namespace
