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
    LevelMaker maker(merged.maker);
    maker.childMoves = 8; // to the end
    moveChildren(balls, finer, regions, maker);
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
    for (int turn = 0; turn < 8; ++turn) {
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

/// Some parents lose their last child, while other moves are tried with them.
TEST(ChildMoves, KeepChainsWhereParentsLoseTheirLastChild)
{
    Random random(3);
    for (int turn = 0; turn < 3; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(30, 8, 7), 0.4, random));
        for (const int64_t parents : {120, 100, 80, 60, 50, 35, 20}) {
            expectMoved(merged, 128, parents);
        }
    }
}

ExactSphere ballAt(const Coord& center, int64_t radius)
{
    ExactSphere ball = voxelBall(center);
    ball.radiusSq = kFine * kFine * radius * radius;
    return ball;
}

/// A child's ball may hold more than its region, and so contain the ball of a parent.
TEST(ChildMoves, KeepTheChainOfAChildThatContainsItsNewParent)
{
    const Coord alone(8, 0, 0), other(8, 18, 0), middle(1, 0, 0);
    const MergedLeaves merged(Voxels{Coord(0, 0, 0), middle, Coord(2, 0, 0), alone, other});
    const auto regions = merged.regions({ballAt(alone, 0), ballAt(middle, 1), ballAt(other, 0)});
    TightLevel finer{{ballAt(middle, 8), ballAt(middle, 1), ballAt(other, 0)}, {0, 1, 0}, {}};
    std::vector<ExactSphere> balls{ballAt(Coord(8, 9, 0), 9), ballAt(middle, 1)};
    moveChildren(balls, finer, regions, merged.maker);
    EXPECT_EQ(finer.parent, (std::vector<int32_t>{1, 1, 0}));
    const auto below = voxelsOf(regions, merged.object.level(0));
    EXPECT_EQ(together(heldBelow(balls, finer.parent, below)), merged.voxels);
}

} // namespace
