// SPDX-License-Identifier: Apache-2.0
/// @file TestBallLists.cc
/// @brief Lists of balls against each pair of a ball and a child: one object for cubes of several sizes, one after
/// the other, with balls in them, across their sides and elsewhere.

#include <openvdb_spheretree/sphere/BallLists.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using detail::BallLists;
using detail::ClippedSphere;
using openvdb::Coord;
using openvdb::CoordBBox;

constexpr int kShift = 1;

std::vector<ClippedSphere> someBalls(const Coord& origin, int32_t side, std::mt19937& random)
{
    std::uniform_int_distribution<int32_t> place(-side, 4 * side), radius(0, 2 * side); // in halves
    const CoordBBox clip(origin.offsetBy(-side), origin.offsetBy(3 * side));
    std::vector<ClippedSphere> balls;
    for (std::size_t count = random() % 7; balls.size() < count;) {
        ExactSphere sphere;
        for (int axis = 0; axis < 3; ++axis) {
            sphere.center[axis] = 2 * int64_t(origin[axis]) + place(random);
        }
        const int64_t size = radius(random);
        sphere.radiusSq = size * size;
        ClippedSphere ball;
        if (clipSphere(sphere, Distance(), kShift, clip, ball)) balls.push_back(ball);
    }
    return balls;
}

TEST(BallLists, HoldEachBallThatReachesIntoAChildWhateverWasBuiltBefore)
{
    struct Size {
        int log2, childLog2;
    };
    std::mt19937 random(5);
    BallLists lists;
    int64_t pairs = 0, fulls = 0, none = 0;
    for (int round = 0; round < 300; ++round) {
        const Size size = std::vector<Size>{{12, 7}, {7, 5}, {5, 3}, {8, 4}}[random() % 4];
        const int32_t side = 1 << size.log2;
        const Coord origin(-side, 0, 3 * side);
        const auto balls = someBalls(origin, side, random);
        std::vector<int32_t> order;
        for (std::size_t i = 0; i < balls.size(); ++i) order.push_back(int32_t(i));
        lists.build(balls.data(), order.data(), order.data() + order.size(), origin, size.log2,
            size.childLog2);
        if (lists.firstReached() >= lists.endReached()) ++none;
        const int32_t children = 1 << (size.log2 - size.childLog2),
                      last = (1 << size.childLog2) - 1;
        for (std::size_t child = 0; child < std::size_t(children * children * children); ++child) {
            const Coord lo = lists.childOrigin(child), hi = lo.offsetBy(last);
            std::vector<int32_t> expected;
            bool isFull = false;
            for (const int32_t i : order) {
                const ClippedSphere& ball = balls[std::size_t(i)];
                const CoordBBox box{Coord(ball.lo), Coord(ball.hi)};
                if (isFull || !box.hasOverlap({lo, hi}) || !ball.touches(lo.data(), hi.data()))
                    continue;
                isFull = ball.contains(lo.data(), hi.data());
                if (!isFull) expected.push_back(i);
            }
            ASSERT_EQ(lists.full(child), isFull) << round << ' ' << child;
            ASSERT_EQ(std::vector<int32_t>(lists.begin(child), lists.end(child)), expected)
                << round << ' ' << child;
            if (!expected.empty() || isFull) {
                ASSERT_LE(lists.firstReached(), child) << round;
                ASSERT_GT(lists.endReached(), child) << round;
            }
            pairs += int64_t(expected.size());
            fulls += isFull;
        }
    }
    EXPECT_GT(pairs, 10000);
    EXPECT_GT(fulls, 1000);
    EXPECT_GT(none, 10);
}

} // namespace
