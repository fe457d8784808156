// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/BallsInBox.h>

#include <openvdb_spheretree/tight/fit/BallReach.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include "support/FineBalls.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

using Balls = std::vector<ExactSphere>;
using Ids = std::vector<int32_t>;

int64_t powerOf(const ExactSphere& ball, const Coord& v)
{
    return ball.radiusSq - radiusSqToHold(ball, voxelBall(v));
}

/// @return the corners of a box: a difference of powers, which is linear, is smallest at one of them.
Voxels cornersOf(const CoordBBox& box)
{
    Voxels corners;
    for (int i = 0; i < 8; ++i) {
        Coord& v = corners.emplace_back();
        for (int a = 0; a < 3; ++a) v[a] = (i >> a & 1) ? box.max()[a] : box.min()[a];
    }
    return corners;
}

bool isStrongerInAll(const ExactSphere& a, const ExactSphere& b, const CoordBBox& box)
{
    const Voxels corners = cornersOf(box);
    return std::all_of(corners.begin(), corners.end(),
        [&](const Coord& v) { return powerOf(a, v) > powerOf(b, v); });
}

/// A box around a place, and balls near it; a list of these balls in some order.
struct RandomBalls {
    RandomBalls(uint32_t seed, const Coord& at, int reach, int largest)
    {
        Random random(seed);
        box = CoordBBox(at + random.coord(-6, 0), at + random.coord(1, 8));
        for (int i = random.between(1, 60); i-- > 0;) {
            ExactSphere ball = randomBall(random, -reach, reach, largest);
            for (int a = 0; a < 3; ++a) ball.center[a] += 16 * int64_t(at[a]);
            balls.push_back(ball);
        }
        for (int32_t i = 0; i < int32_t(balls.size()); ++i) {
            if (random.chance(0.8)) ids.push_back(i);
        }
        std::reverse(ids.begin(), ids.end());
    }

    CoordBBox box;
    Balls balls;
    Ids ids;
};

/// What is left out holds nothing that one before it in the list does not hold.
void expectAllThatMatter(const RandomBalls& some, const Ids& listed, int& leftOut)
{
    auto next = listed.begin();
    for (auto id = some.ids.begin(); id != some.ids.end(); ++id) {
        if (next != listed.end() && *next == *id) {
            ++next;
            continue;
        }
        const ExactSphere& ball = some.balls[*id];
        if (!BoxReach(ball, some.box).meets(ball)) continue;
        ASSERT_TRUE(std::any_of(some.ids.begin(), id, [&](int32_t other) {
            return isStrongerInAll(some.balls[other], ball, some.box);
        })) << *id;
        ++leftOut;
    }
    ASSERT_EQ(next, listed.end()); // in order
}

TEST(BallsInBox, LeavesOutWhatHoldsNoMoreThanOneBeforeIt)
{
    int leftOut = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const RandomBalls some(seed, Coord(0), 12, 14);
        StrongestBall strongest;
        Ids listed;
        BallsInBox(some.balls).list(some.box, some.ids, false, strongest, listed);
        ASSERT_NO_FATAL_FAILURE(expectAllThatMatter(some, listed, leftOut)) << seed;
    }
    EXPECT_GT(leftOut, 4000);
}

/// Beside the ends of coordinates, and where squares have more digits than a double.
TEST(BallsInBox, LeavesOutNoMoreFarAwayAndOfHugeBalls)
{
    int leftOut = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const Coord at(seed % 2 ? 2147483000 : -2147483000, seed % 3 ? 1 << 30 : 0, -77);
        const int largest = seed % 5 ? 3000 : 30000;
        const RandomBalls some(seed, at, largest + 5, largest);
        StrongestBall strongest;
        Ids listed;
        BallsInBox(some.balls).list(some.box, some.ids, false, strongest, listed);
        ASSERT_NO_FATAL_FAILURE(expectAllThatMatter(some, listed, leftOut)) << seed;
    }
    EXPECT_GT(leftOut, 1000);
}

TEST(BallsInBox, ComparesAllWithTheStrongestWhenListedAgain)
{
    int leftOut = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const RandomBalls some(seed, Coord(0), 12, 14);
        const BallsInBox inBox(some.balls);
        StrongestBall strongest;
        Ids first, again, expected;
        inBox.list(some.box, some.ids, false, strongest, first);
        inBox.list(some.box, first, false, strongest, again);
        for (const int32_t id : first) {
            const bool isWeaker =
                isStrongerInAll(some.balls[strongest.ball], some.balls[id], some.box);
            if (!isWeaker) expected.push_back(id);
        }
        ASSERT_EQ(again, expected) << seed;
        leftOut += int(first.size() - again.size());
    }
    EXPECT_GT(leftOut, 500);
}

TEST(BallsInBox, TheStrongestHasTheMostPowerInTheMiddle)
{
    for (uint32_t seed = 0; seed < 500; ++seed) {
        RandomBalls some(seed, Coord(40, -30, 7), 12, 14);
        some.box.max() = some.box.min() + Coord(4, 2, 6); // its middle is a voxel
        if (some.ids.empty()) continue;
        const Coord middle = some.box.min() + Coord(2, 1, 3);
        StrongestBall strongest;
        Ids listed;
        BallsInBox(some.balls).list(some.box, some.ids, false, strongest, listed);
        int64_t most = INT64_MIN;
        for (const int32_t id : some.ids) most = std::max(most, powerOf(some.balls[id], middle));
        ASSERT_EQ(double(most), strongest.power) << seed;
        ASSERT_EQ(most, powerOf(some.balls[strongest.ball], middle)) << seed;
    }
}

TEST(BallsInBox, EndsWithABallThatHoldsAllOfTheBox)
{
    constexpr std::size_t kVector = 8; // balls at a time, at most
    const CoordBBox box(Coord(0), Coord(7));
    const int64_t toCorner = 3 * 56 * 56 + 1; // from the middle, 1/16 voxel
    for (std::size_t place = 0; place < 40; ++place) {
        // Of equal balls beside the box none is stronger in all of it.
        Balls balls(60, ExactSphere{{-16, 56, 56}, 10000});
        balls[place] = {{56, 56, 56}, toCorner};
        Ids ids(balls.size());
        std::iota(ids.begin(), ids.end(), 0);
        for (const bool isHeld : {true, false}) {
            if (!isHeld) balls[place].radiusSq -= 2;
            const BallsInBox inBox(balls);
            StrongestBall some, others;
            Ids until, all;
            inBox.list(box, ids, true, some, until);
            inBox.list(box, ids, false, others, all);
            ASSERT_EQ(all.size(), ids.size());
            if (isHeld) {
                ASSERT_GT(until.size(), place);
                ASSERT_LE(until.size(), place + kVector);
            } else {
                ASSERT_EQ(until, all);
            }
        }
    }
}

TEST(BallsInBox, AppendsToAList)
{
    const Balls balls{{{0, 0, 0}, 400}, {{800, 0, 0}, 400}};
    StrongestBall strongest;
    Ids listed{7};
    BallsInBox(balls).list(CoordBBox(Coord(0), Coord(7)), {1, 0}, false, strongest, listed);
    EXPECT_EQ(listed, (Ids{7, 0}));
    EXPECT_EQ(strongest.ball, 0);
    BallsInBox(balls).list(CoordBBox(Coord(0), Coord(7)), {}, false, strongest, listed);
    EXPECT_EQ(listed, (Ids{7, 0}));
}

} // namespace
