// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <openvdb_spheretree/sphere/LeafVoxels.h>

#include "support/FineBalls.h"

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

void expectVoxels(const ExactSphere& ball, const Coord& origin)
{
    const LeafMask mask = openvdb_spheretree::detail::voxelsOf(ball, kFineShift, origin);
    bool any = false;
    for (int i = 0; i < 512; ++i) {
        const bool held = holds(ball, origin.offsetBy(i >> 6, i >> 3 & 7, i & 7));
        ASSERT_EQ(mask[i >> 6] >> (i & 63) & 1, held) << i << " of " << origin;
        any = any || held;
    }
    if (any) {
        ASSERT_TRUE(BoxReach(ball, CoordBBox::createCube(origin, 8)).meets(ball));
    }
}

TEST(BallReach, HoldsWhatTheBallHolds)
{
    Random random(2);
    for (int i = 0; i < 3000; ++i) {
        const Coord origin = random.coord(-24, 24) & ~7;
        ASSERT_NO_FATAL_FAILURE(expectVoxels(randomBall(random, -20, 20, 3 + i % 40), origin));
    }
}

/// The surface passes through the leaf, or just by it.
TEST(BallReach, HoldsWhatFarAndHugeBallsHold)
{
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
        const Coord origin = random.coord(-(1 << 24), 1 << 24) & ~7;
        ExactSphere ball;
        double sum = 0;
        const int reach = 1 << random.between(8, 28);
        for (int a = 0; a < 3; ++a) {
            const int64_t away = random.between(-reach, reach);
            ball.center[a] = 16 * int64_t(origin[a]) + away;
            sum += double(away) * double(away);
        }
        const double radius = std::sqrt(sum) + random.between(-200, 200);
        ball.radiusSq = int64_t(std::max(0.0, radius) * std::max(0.0, radius));
        ASSERT_NO_FATAL_FAILURE(expectVoxels(ball, origin));
    }
}

/// One voxel on the surface, or it and what is beyond.
TEST(BallReach, HoldsTheTipsOfHugeBalls)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 8; ++i) {
            for (const int64_t far : {900, 1 << 20, -900, -(1 << 20)}) {
                ExactSphere ball{{16 * 3, 16 * 3, 16 * 3}, 256 * (far - i) * (far - i)};
                ball.center[axis] = 16 * far;
                ASSERT_NO_FATAL_FAILURE(expectVoxels(ball, Coord(0, 0, 0)));
                --ball.radiusSq;
                ASSERT_NO_FATAL_FAILURE(expectVoxels(ball, Coord(0, 0, 0)));
            }
        }
    }
}

/// Balls around the sizes that 16 bits have room for, and larger ones that end in the leaf.
TEST(BallReach, HoldsWhatBallsOfAbout300VoxelsHold)
{
    Random random(6);
    for (int i = 0; i < 6000; ++i) {
        const Coord origin = random.coord(-24, 24) & ~7;
        const int most = i % 3 ? 4900 : 300;
        ExactSphere ball{{0, 0, 0}, 0};
        double sum = 0;
        for (int a = 0; a < 3; ++a) {
            const bool far = a == i % 3 || random.chance(0.5);
            const int64_t away = far ? random.between(4400, 4900) : random.between(0, most);
            const bool below = random.chance(0.5);
            ball.center[a] = 16 * int64_t(origin[a]) + (below ? 112 - away : away);
            sum += double(away) * double(away);
        }
        const double radius = std::sqrt(sum) - random.between(-20, 200);
        ball.radiusSq = int64_t(radius * radius);
        ASSERT_NO_FATAL_FAILURE(expectVoxels(ball, origin));
    }
}

TEST(BallReach, IsReachedByBallsAsNearAsItsBox)
{
    Random random(4);
    int reached = 0;
    for (int i = 0; i < 3000; ++i) {
        const ExactSphere ball = randomBall(random, -12, 20, 8);
        int64_t sum = 0;
        for (const int64_t c : ball.center) {
            const int64_t d = std::max<int64_t>(0, std::max(-c, c - 112));
            sum += d * d;
        }
        ASSERT_EQ(
            BoxReach(ball, CoordBBox::createCube(Coord(0), 8)).meets(ball), sum <= ball.radiusSq);
        reached += sum <= ball.radiusSq;
    }
    EXPECT_GT(reached, 300);
    EXPECT_LT(reached, 2700);
}

TEST(BallReach, LiesInTheBoxOfItsBall)
{
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        const ExactSphere ball = randomBall(random, -5, 5, i % 6);
        const CoordBBox box = ballBox(ball);
        for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-12), Coord(12)))) {
            if (!holds(ball, v)) continue;
            ASSERT_TRUE(box.isInside(v));
        }
        if (box == CoordBBox()) continue;
        ASSERT_FALSE(box.empty());
        for (int a = 0; a < 3; ++a) {
            ASSERT_LE(16 * box.max()[a], double(ball.center[a]) + ball.radius());
            ASSERT_GE(16 * box.min()[a], double(ball.center[a]) - ball.radius());
        }
    }
    EXPECT_EQ(ballBox(ExactSphere()), CoordBBox());
    EXPECT_EQ(ballBox({{8, 0, 0}, 49}), CoordBBox()); // between two voxels
}

} // namespace
