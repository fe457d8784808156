// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/ChildMoves.h>

#include "support/Expectations.h"
#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// @return how much less there is around the parents.
int64_t expectMoved(const MergedLeaves& merged, int64_t children, int64_t parents)
{
    const auto levels = merged.levels({children, parents});
    const auto regions = merged.regions(levels[0].balls);
    TightLevel finer = levels[0];
    std::vector<ExactSphere> balls = levels[1].balls;
    moveChildren(balls, finer, regions, merged.maker);
    EXPECT_EQ(balls.size(), levels[1].balls.size());
    EXPECT_EQ(finer.balls, levels[0].balls);
    const auto below = voxelsOf(regions, merged.object.level(0));
    EXPECT_EQ(together(heldBelow(balls, finer.parent, below)), merged.voxels);
    const auto there = thereOf(ungrouped(balls)); // a ball without children is empty
    const int64_t gained = excess(levels[1].balls, merged.voxels) - excess(there, merged.voxels);
    EXPECT_GE(gained, 0);
    return gained;
}

TEST(ChildMoves, KeepChainsAndPay)
{
    Random random(1);
    int64_t gained = 0;
    for (int turn = 0; turn < 4; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(12, 10, 9), 0.5, random));
        gained += expectMoved(merged, 30, 8);
    }
    EXPECT_GE(double(gained), expectedFigure("child_moves.voxels_gained"));
}

/// Many moves are made at a time.
TEST(ChildMoves, KeepChainsInWideObjects)
{
    Random random(2);
    for (int turn = 0; turn < 3; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(60, 6, 5), 0.5, random));
        EXPECT_GT(expectMoved(merged, 60, 20), 0);
    }
}

/// Parents of one or two children lose their last one, and are tried as its neighbours' new parents after that.
TEST(ChildMoves, KeepChainsWhereParentsLoseTheirLastChild)
{
    Random random(3);
    for (int turn = 0; turn < 3; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(30, 8, 7), 0.4, random));
        for (const int64_t parents : {60, 50, 35}) expectMoved(merged, 64, parents);
    }
}

} // namespace
