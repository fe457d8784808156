// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/LevelMaker.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

constexpr FitEffort kAll{true, 12, 1, false, 40};

TEST(LevelMaker, TheCostOfACoverIsThatOfTheUnion)
{
    Random random(1);
    for (const int64_t count : {1, 2, 7, 20}) {
        const MergedLeaves merged(shapes::noise(Coord(8, 7, 7), 0.5, random), false, kAll);
        const auto balls = merged.cut(count);
        EXPECT_EQ(merged.maker.costOf(balls), double(excess(balls, merged.voxels)));
    }
}

TEST(LevelMaker, PlacesACoverAnewAndNeverWorse)
{
    Random random(2);
    int64_t before = 0, after = 0;
    for (const double rate : {0.3, 0.6}) {
        const MergedLeaves merged(shapes::noise(Coord(9, 8, 8), rate, random), false, kAll);
        const VoxelGoal goal(merged.object.level(0));
        for (const int64_t count : {2, 9, 30}) {
            const auto balls = ballsOf(merged.maker.placed(ungrouped(merged.cut(count)), goal));
            EXPECT_EQ(heldBy(balls, merged.voxels), merged.voxels);
            EXPECT_LE(balls.size(), std::size_t(count));
            EXPECT_LE(excess(balls, merged.voxels), excess(merged.cut(count), merged.voxels));
            before += excess(merged.cut(count), merged.voxels);
            after += excess(balls, merged.voxels);
        }
    }
    EXPECT_LT(after, before);
}

/// The second ball holds nothing that the first does not hold.
TEST(LevelMaker, DropsBallsThatNoVoxelNeedsUnlessTheyAreToStay)
{
    const MergedLeaves merged(shapes::ball(30));
    const VoxelGoal goal(merged.object.level(0));
    const std::vector<CoverBall> cover{{{{0, 0, 0}, 16 * 16 * 29}}, {{{0, 0, 0}, 16 * 16 * 9}}};
    EXPECT_EQ(merged.maker.placed(cover, goal).size(), 1u);
    const auto all = merged.maker.placed(cover, goal, false);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_TRUE(all[1].empty());
}

TEST(LevelMaker, FitsEachBallToItsPointsAlone)
{
    Random random(5);
    const MergedLeaves merged(shapes::noise(Coord(9, 8, 8), 0.5, random), false, kAll);
    const auto balls = merged.cut(6);
    HeldPoints points(balls.size()); // of the last ball none
    for (const Coord& v : merged.voxels) {
        const auto ball = std::find_if(
            balls.begin(), balls.end() - 1, [&](const ExactSphere& b) { return holds(b, v); });
        if (ball != balls.end() - 1) points[std::size_t(ball - balls.begin())].push_back(v);
    }
    const auto fitted = merged.maker.fitted(balls, points);
    ASSERT_EQ(fitted.size(), balls.size());
    int64_t before = 0, after = 0;
    for (std::size_t i = 0; i + 1 < balls.size(); ++i) {
        EXPECT_EQ(heldBy({fitted[i]}, points[i]), points[i]);
        before += excess({balls[i]}, merged.voxels);
        after += excess({fitted[i]}, merged.voxels);
        EXPECT_LE(excess({fitted[i]}, merged.voxels), excess({balls[i]}, merged.voxels));
    }
    EXPECT_LT(after, before);
    EXPECT_EQ(fitted.back(), balls.back());
}

TEST(LevelMaker, HalvesInEqualSteps)
{
    EXPECT_EQ(halvedTowards(1024, 64), 512);
    EXPECT_EQ(halvedTowards(100, 99), 99);
    EXPECT_EQ(halvedTowards(128, 64), 64);
    EXPECT_EQ(halvedTowards(300, 100), 173); // 300 / sqrt(3)
    EXPECT_EQ(halvedTowards(2, 1), 1);
    for (const int64_t count : {1, 7, 64}) {
        int64_t many = 100000;
        for (int step = 0; many > count; ++step) {
            ASSERT_LT(step, 18);
            const int64_t next = halvedTowards(many, count);
            ASSERT_LT(next, many);
            ASSERT_GE(2 * next, many - 1);
            many = next;
        }
        EXPECT_EQ(many, count);
    }
}

TEST(LevelMaker, ManyBallsDescendFromTheirBestStartAlone)
{
    const SampledObject object = sampled({Coord(0, 0, 0)});
    FitEffort effort = kAll;
    for (const bool restarts : {false, true}) {
        effort.restarts = restarts;
        const LevelMaker maker{{effort}, object, false, nullptr};
        EXPECT_EQ(maker.fitOf(kFewOnCoarse).restarts, restarts);
        EXPECT_FALSE(maker.fitOf(kFewOnCoarse + 1).restarts);
    }
}

} // namespace
