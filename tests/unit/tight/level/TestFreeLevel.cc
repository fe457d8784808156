// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/FreeLevel.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, false, 40};

struct Merged : MergedLeaves {
    explicit Merged(const Voxels& voxels) : MergedLeaves(voxels, false, ::kEffort) {}
};

/// What one search of the cut leads to.
std::vector<ExactSphere> searchedCut(const Merged& merged, int64_t count)
{
    const auto spare = ungrouped(merged.leaves);
    const auto cut = ungrouped(ballsOfCut(merged.forest, count));
    const auto found = merged.maker.search(
        cut, spare, VoxelGoal(merged.object.level(0)), LevelMaker::trialsFor(cut.size()));
    return ballsOf(filledUp(found.balls, spare));
}

TEST(FreeLevel, TheCostOfACoverIsThatOfTheUnion)
{
    Random random(1);
    for (const int64_t count : {1, 2, 7, 20}) {
        const Merged merged(shapes::noise(Coord(8, 7, 7), 0.5, random));
        const auto balls = ballsOfCut(merged.forest, count);
        EXPECT_EQ(costOfCover(balls, merged.object, kEffort), double(excess(balls, merged.voxels)));
    }
}

TEST(FreeLevel, CoversTheObjectAndTakesTheCheapestEnd)
{
    Random random(2);
    int better = 0;
    for (int object = 0; object < 2; ++object) {
        const Merged merged(shapes::noise(Coord(7, 7, 6), 0.4, random));
        for (const int64_t count : {3, 6}) {
            const auto balls = freeLevel(merged.forest, count, merged.leaves, merged.maker);
            ASSERT_EQ(int64_t(balls.size()), count);
            for (const Coord& v : merged.voxels) {
                ASSERT_TRUE(std::any_of(balls.begin(), balls.end(),
                    [&](const ExactSphere& ball) { return holds(ball, v); }));
            }
            const auto one = excess(searchedCut(merged, count), merged.voxels);
            const auto cheapest = excess(balls, merged.voxels);
            ASSERT_LE(cheapest, one);
            better += cheapest < one;
        }
    }
    EXPECT_GT(better, 1); // otherwise the other starts are for nothing
}

/// There are not enough leaves for most starts.
TEST(FreeLevel, TakesAllLeavesWhereThatIsTheCount)
{
    const Merged merged({Coord(0, 0, 0), Coord(0, 20, 0), Coord(9, 0, 0)});
    const auto balls = freeLevel(merged.forest, 3, merged.leaves, merged.maker);
    EXPECT_EQ(balls.size(), 3u);
    EXPECT_EQ(excess(balls, merged.voxels), 0);
}

} // namespace
